//! Search among points.

pub mod neighbours;
