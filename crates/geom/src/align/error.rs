//! Why there is no alignment.

use crate::closest::{MeshError, QueryError};
use crate::progress::Cancelled;

/// Why there is no alignment.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AlignError {
    /// Too little is measured.
    #[error("{found} points do not determine a pose: at least {needed} are needed")]
    TooFewPoints {
        /// Points that would do.
        needed: usize,
        /// Points given.
        found: usize,
    },
    /// The points lie on one line or at one place.
    #[error("the points lie on one line or at one place: they do not determine a pose")]
    Collinear,
    /// Lists that go together differ in length.
    #[error("{what}: {found} are given where {expected} are needed")]
    Uneven {
        /// Which.
        what: &'static str,
        /// The number of points.
        expected: usize,
        /// The number of the others.
        found: usize,
    },
    /// A weight is negative or no number.
    #[error("row {} has a weight that is not a number from 0 upwards", row + 1)]
    BadWeight {
        /// From 0.
        row: usize,
    },
    /// All weights are zero.
    #[error("all rows have a weight of 0: give one above 0 to those that count")]
    NoWeight,
    /// A direction has no length.
    #[error("row {} has a direction of no length", row + 1)]
    NoDirection {
        /// From 0.
        row: usize,
    },
    /// The rows leave a motion free.
    #[error("the rows leave {free} of the six degrees of freedom open")]
    Underdetermined {
        /// How many.
        free: usize,
    },
    /// The shape leaves motions free.
    #[error("the shape leaves {free} of the six motions free: no pose has the least greatest distance alone")]
    Free {
        /// How many.
        free: usize,
    },
    /// Components of a motion are locked whose start is looked for.
    #[error("what is locked keeps the value that it has at the start: give the start (--from-here)")]
    LockedSearch,
    /// The shape tells no scale.
    #[error("the shape does not tell a scale: measure faces that look at each other, or leave the scale out")]
    ScaleFree,
    /// No point that counts lies where something is asked.
    #[error("no point lies over a place that has a tolerance: give one to places where there are points")]
    NoZone,
    /// The search did not settle.
    #[error("the search for the least greatest distance did not settle")]
    NotSettled,
    /// No point of the measured has a place on the reference at the given start, or at any that was found.
    #[error("at no start do points lie near the reference: is it the same part, in the same unit?")]
    NoOverlap,
    /// A mesh cannot be used.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A point cannot be used.
    #[error(transparent)]
    Point(QueryError),
    /// Stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl From<QueryError> for AlignError {
    fn from(e: QueryError) -> Self {
        match e {
            QueryError::Cancelled(e) => AlignError::Cancelled(e),
            e => AlignError::Point(e),
        }
    }
}
