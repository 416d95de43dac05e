//! Why there is no zone.

use crate::space::Point;

/// Why there is no zone.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ZoneError {
    /// No points.
    #[error("there are no points")]
    NoPoints,
    /// A coordinate is infinite or not a number.
    #[error("point {index} has a coordinate that is not a finite number; remove it")]
    NotFinite {
        /// Index of the first such point.
        index: usize,
    },
    /// The direction of the zone or of the datum has no length.
    #[error("a direction has no length")]
    NoDirection,
    /// Points of two planes that are too few, or all in one line.
    #[error("the points of the two planes determine no parallel planes")]
    NoPlanes,
    /// The search did not settle.
    #[error("the zone was not found: the search did not settle")]
    NotSettled,
    /// Stopped through the progress argument.
    #[error("cancelled")]
    Cancelled,
}

/// Refuses no points and points that are not numbers.
pub(super) fn sane(points: &[Point]) -> Result<(), ZoneError> {
    if points.is_empty() {
        return Err(ZoneError::NoPoints);
    }
    match points.iter().position(|p| p.iter().any(|x| !x.is_finite())) {
        Some(index) => Err(ZoneError::NotFinite { index }),
        None => Ok(()),
    }
}
