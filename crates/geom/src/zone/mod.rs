//! Tolerance zones: the smallest zone of a given form and attitude that holds all points.
//!
//! A zone of form alone is a fit ([`crate::fit`] by minimum zone). The zones here are held by datums: their direction is
//! given, or stands at a given angle to a given direction and is free to turn about it, or a frame leaves some motions free.
//!
//! | zone | where |
//! |---|---|
//! | between two parallel planes | [`slab`], [`slab_at_angle`] |
//! | within a cylinder | [`tube`], [`tube_at_angle`] |
//! | about a true geometry, with motions left free | [`motion`] |
//! | frames that datums make | [`datum`] |
//! | parameters of areal texture | [`texture`] |

mod azimuth;
mod circle;
pub mod datum;
pub mod motion;
mod planes;
pub mod texture;
mod tubes;

pub use planes::{Slab, parallel_planes, slab, slab_at_angle};
pub use tubes::{Tube, tube, tube_at_angle};

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
    /// The search did not settle.
    #[error("the zone was not found: the search did not settle")]
    NotSettled,
    /// Stopped through the progress argument.
    #[error("cancelled")]
    Cancelled,
}

/// Refuses no points and points that are not numbers.
fn sane(points: &[crate::space::Point]) -> Result<(), ZoneError> {
    if points.is_empty() {
        return Err(ZoneError::NoPoints);
    }
    match points.iter().position(|p| p.iter().any(|x| !x.is_finite())) {
        Some(index) => Err(ZoneError::NotFinite { index }),
        None => Ok(()),
    }
}
