//! What a drawing of a contour would have, as offers.

use super::dimension::MemberRecord;
use super::vocabulary::OfferKind;
use crate::Word;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A relation, or a whole number, that the points allow. The contour does not have it: it is as it was found.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct OfferRecord {
    /// `horizontal` or `vertical` line, lines that are `parallel`, `in_line` or at a `right_angle`, `tangent` segments, `equal_radii` or
    /// `concentric` arcs, or a whole number of steps: `radius`, `diameter`, `length` of a line, `distance` of parallel lines, distance of
    /// `centers`.
    pub kind: Word<OfferKind>,
    /// The segments that it is about.
    pub segments: Vec<MemberRecord>,
    /// The value found: a length, or an angle in radians; of `in_line`, `tangent`, `equal_radii` and `concentric` how far that is missed.
    pub found: f64,
    /// Its standard uncertainty, from the scatter of the points; of `concentric` that along the way from center to center.
    pub std_uncertainty: f64,
    /// The value offered.
    pub offered: f64,
    /// Of a whole number the step that it is a multiple of, millimeters.
    pub step: Option<f64>,
    /// The difference in standard uncertainties. With what is offered the sum of the squared distances grows by its square times the
    /// variance of the points (twice the logarithm of the likelihood ratio is the square).
    pub z: f64,
    /// The probability of a difference as large, if what is offered holds.
    pub p: f64,
    /// The probability that a value which has nothing to do with it would be offered, too.
    pub chance: f64,
}
