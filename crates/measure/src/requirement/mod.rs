//! What a plan requires, as values: features, datums, limits and boundaries.
//!
//! The characteristics are asked about these, and the reading of plans makes them.

mod boundary;
mod datum;
mod feature;
mod limits;

pub use boundary::Boundary;
pub use datum::DatumSpec;
pub use feature::{Extract, Feature, Source};
pub use limits::{Basic, Limits, ZoneOffset};
