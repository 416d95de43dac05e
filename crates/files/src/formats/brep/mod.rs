//! What the readers of CAD models have in common: how entities become edges, shells and instances, and how much may be made of a file.

mod budget;
mod edge;
mod hollow;
mod lost;
pub(crate) mod span;
pub(crate) mod tree;
mod wrong;

pub(crate) use budget::Budget;
pub(crate) use edge::{add_edge, reversed, straight};
pub(crate) use hollow::look_inward;
pub(crate) use lost::holds_anything;
pub(crate) use wrong::{Faulty, Wrong};
