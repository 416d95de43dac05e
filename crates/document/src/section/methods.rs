//! The paper's methods, side by side.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The paper's methods of finding the join of one line and one curve.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct MethodsRecord {
    /// The one that the contour is of: `stepwise`, `improved` or `golden`.
    pub chosen: String,
    /// How the interval of `golden` was found: `paper` or `profile`.
    pub interval: String,
    /// What each found.
    pub table: Vec<MethodRecord>,
}

/// What one method found.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct MethodRecord {
    /// `stepwise`, `improved` or `golden`.
    pub method: String,
    /// Where it looked for the join, from the line to the curve.
    pub interval: [[f64; 2]; 2],
    /// Length of that.
    pub interval_length: f64,
    /// The join.
    pub join: [f64; 2],
    /// Points of the line, and their distances from it.
    pub line: ResidualsRecord,
    /// Points of the curve, and their distances from it.
    pub curve: ResidualsRecord,
    /// Control points of the curve.
    pub control_points: u64,
}

/// Distances of points from a segment.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
pub struct ResidualsRecord {
    /// Number of points.
    pub points: u64,
    /// Root mean square.
    pub rms: f64,
    /// Greatest magnitude.
    pub max: f64,
}
