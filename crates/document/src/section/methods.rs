//! The paper's methods, side by side.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trueness_section::{Method, Search};

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

impl MethodsRecord {
    /// What the methods found, each with its number of points of the curve.
    pub(super) fn new(chosen: Search, interval: &str, methods: &[(Method, usize)]) -> MethodsRecord {
        let table = methods.iter().map(|(m, on_curve)| method(m, *on_curve)).collect();
        MethodsRecord { chosen: chosen.name().into(), interval: interval.into(), table }
    }
}

fn method(found: &Method, on_curve: usize) -> MethodRecord {
    let [a, b] = found.interval;
    let record = |points: usize, [rms, max]: [f64; 2]| ResidualsRecord { points: points as u64, rms, max };
    MethodRecord {
        method: found.search.name().into(),
        interval: found.interval,
        interval_length: ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt(),
        join: found.join,
        line: record(found.on_line, found.line_residuals),
        curve: record(on_curve, found.curve_residuals),
        control_points: found.curve.points().len() as u64,
    }
}
