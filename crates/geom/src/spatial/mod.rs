//! Search among points.

pub(crate) mod lists;
pub mod neighbours;
