//! Segments of contours as documents hold them.

use super::near_arc::NearArc;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A segment.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct SegmentRecord {
    /// Line, arc or spline, with what it is known by.
    #[serde(flatten)]
    pub geometry: GeometryRecord,
    /// Where it starts.
    pub start: [f64; 2],
    /// Where it ends.
    pub end: [f64; 2],
    /// Its length.
    pub length: f64,
    /// Points that belong to it.
    pub count: u64,
    /// Root mean square of their distances.
    pub rms: f64,
    /// Greatest magnitude of their distances.
    pub max: f64,
    /// Curvature at its start and end, positive where it turns to the left.
    pub curvature: [f64; 2],
    /// Of a spline that is nearly an arc, that arc: within a thousandth of its length, and the length half of the radius at least: a flatter
    /// curve is near to many arcs. Absent for others, and for those of `facets`.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub near_arc: Option<NearArc>,
    /// Standard uncertainty of its angle, or of its center and radius, from the scatter of the points.
    pub uncertainty: Option<UncertaintyRecord>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub uncertainty_reason: Option<String>,
    /// Standard uncertainty of its length, from the scatter of the points.
    pub length_uncertainty: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub length_uncertainty_reason: Option<String>,
}

/// Standard uncertainties of what a segment is known by.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum UncertaintyRecord {
    /// Of a line.
    Line {
        /// Of its angle.
        angle: f64,
    },
    /// Of an arc.
    Arc {
        /// Of its center.
        center: [f64; 2],
        /// Of its radius.
        radius: f64,
    },
}

/// What a segment is.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum GeometryRecord {
    /// From its start straight to its end.
    Line {
        /// Angle of its direction with the first axis.
        angle: f64,
    },
    /// Part of a circle.
    Arc {
        /// Center of the circle.
        center: [f64; 2],
        /// Its radius.
        radius: f64,
        /// Angle of the start, seen from the center.
        start_angle: f64,
        /// Angle run through, positive counter-clockwise.
        sweep: f64,
    },
    /// A B-spline.
    Spline {
        /// Its degree.
        degree: u64,
        /// Its knots, the ends `degree + 1` times.
        knots: Vec<f64>,
        /// Its control points.
        control_points: Vec<[f64; 2]>,
        /// Greatest distance from the curve that was fitted.
        deviation: f64,
    },
}
