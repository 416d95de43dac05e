//! The answer for one point, before its place is worked out.

/// The answer for one point, as the search finds it. [`Tree::place`](crate::closest::Tree::place) tells the rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Squared distance, the least over all faces: what [`brute::closest`](crate::closest::brute::closest) finds, bit
    /// for bit.
    pub distance_squared: f64,
    /// The lowest face that attains it.
    pub face: u32,
    /// Where the tree keeps that face.
    pub(super) slot: u32,
    /// Height over that face times the length of its normal, if the closest point is inside it; 0 if on its rim.
    pub(super) height: f64,
}

impl Hit {
    /// No face yet.
    pub(super) const NONE: Hit =
        Hit { distance_squared: f64::INFINITY, face: u32::MAX, slot: u32::MAX, height: 0.0 };

    /// Distance, millimeters.
    #[inline(always)]
    pub fn distance(&self) -> f64 {
        self.distance_squared.sqrt()
    }
}
