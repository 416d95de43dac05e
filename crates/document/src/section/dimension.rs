//! Dimensions between the segments of a section.

use super::vocabulary::DimensionKind;
use crate::Word;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The dimensions between segments: how many there are, and the first of them.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
pub struct DimensionsRecord {
    /// How many there are.
    pub count: u64,
    /// Whether some are not listed.
    pub truncated: bool,
    /// Plane after plane.
    pub items: Vec<DimensionRecord>,
}

/// A dimension between two segments.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct DimensionRecord {
    /// `angle` that a line and the next of its contour enclose, `width` between parallel lines that face each other, distance of
    /// the `centers` of two arcs, or `gap` between two contours.
    pub kind: Word<DimensionKind>,
    /// The segments that it is of.
    pub of: [MemberRecord; 2],
    /// Its value: a length, of an angle radians.
    pub value: f64,
    /// Its standard uncertainty, from the scatter of the points.
    pub std_uncertainty: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub std_uncertainty_reason: Option<String>,
    /// The two places between which it is measured; of an angle, the end of the first line and the start of the next.
    pub between: [[f64; 2]; 2],
}

/// A segment of a contour, both by their numbers from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct MemberRecord {
    /// Number of the contour in `contours`.
    pub contour: u64,
    /// Number of the segment in it.
    pub segment: u64,
}
