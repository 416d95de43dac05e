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

/// Curves and surfaces that rest on others at most, one on another.
pub(crate) const MAX_BASES: usize = 16;
/// Damaged entities that are told one by one; they are others' faults as well.
pub(crate) const MAX_TOLD: usize = 1000;
/// Why a surface in no face is not read.
pub(crate) const WITHOUT_ENDS: &str = "is a surface without ends, in no face";
