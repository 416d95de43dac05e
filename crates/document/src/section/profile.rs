//! The profile of a line against its tolerance.

use crate::compare::ToleranceShares;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A point far off the nominal.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
pub struct WorstRecord {
    /// Number of its contour, from 0.
    pub contour: u64,
    /// Its number in the contour, from 0.
    pub index: u64,
    /// The point, in its plane.
    pub point: [f64; 2],
    /// The place of the nominal nearest to it.
    pub nearest: [f64; 2],
    /// Its deviation.
    pub deviation: f64,
}

/// The deviations against a tolerance of the profile (ISO 1101, profile any line).
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct ProfileRecord {
    /// Limits of the deviation, and the shares of the points.
    #[serde(flatten)]
    pub shares: ToleranceShares,
    /// Width of the zone: `upper` − `lower`. Of ±T it is 2 T, the number in the frame of a drawing; the zone is even about the nominal then.
    pub zone_width: f64,
    /// The point farthest beyond the limits, or nearest to them where all are within.
    pub worst: Option<WorstRecord>,
    /// Share of the nominal's length that points run along (0 to 1).
    pub covered: f64,
    /// Share of the points that have a counterpart on the nominal (0 to 1).
    pub counterparts: f64,
    /// The share of both that a pass needs.
    pub min_coverage: f64,
}
