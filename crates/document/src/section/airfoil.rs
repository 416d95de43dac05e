//! Measures of airfoils and blades.

use super::chord::{ChordRecord, StackingRecord};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The measures of a contour as a profile, or why there are none.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct AirfoilRecord {
    /// Number of the contour in `contours`, from 0.
    pub contour: u64,
    /// What was measured.
    pub measures: Option<AirfoilMeasures>,
    /// Why nothing was.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub measures_reason: Option<String>,
}

/// Measures of a profile. Lengths in millimeters; `…_at` are shares of the chord, from the leading edge.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct AirfoilMeasures {
    /// The place farthest from the trailing edge.
    pub leading_edge: [f64; 2],
    /// The trailing edge; of one with two corners, or of an open row, the middle between these.
    pub trailing_edge: [f64; 2],
    /// Distance of the two.
    pub chord: f64,
    /// Angle of the way from leading to trailing edge with the first axis, radians.
    pub chord_angle: f64,
    /// The chord by each of its usual definitions, with their angles and twists.
    #[serde(default)]
    pub chords: Vec<ChordRecord>,
    /// Why there are none, nor centroid and area.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub chords_reason: Option<String>,
    /// Center of the area that the profile encloses.
    #[serde(default)]
    pub centroid: Option<[f64; 2]>,
    /// That area.
    #[serde(default)]
    pub area: Option<f64>,
    /// How far the profile's stacking point is from where it should be, where a nominal or that point was given.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub stacking: Option<StackingRecord>,
    /// Diameter of the greatest inscribed circle.
    pub thickness: f64,
    /// Its standard uncertainty, from the scatter of the points.
    pub thickness_uncertainty: f64,
    /// Where along the chord its center is.
    pub thickness_at: f64,
    /// The center.
    pub thickness_center: [f64; 2],
    /// Greatest distance of the camber line from the chord, positive to the left of the way from leading to trailing edge.
    pub camber: f64,
    /// Where along the chord that is.
    pub camber_at: f64,
    /// Radius of curvature at the leading edge.
    pub leading_radius: Option<f64>,
    /// Its standard uncertainty, from the scatter of the points.
    pub leading_radius_uncertainty: Option<f64>,
    /// Why there is no radius.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub leading_radius_reason: Option<String>,
    /// What the trailing edge is: `sharp` (a corner), `blunt` (two corners), `round`, `open` (the row ends there).
    pub trailing_kind: String,
    /// Distance of the two corners, or of the ends of an open row.
    pub trailing_thickness: Option<f64>,
    /// Radius of curvature at a round trailing edge.
    pub trailing_radius: Option<f64>,
    /// Its standard uncertainty, from the scatter of the points.
    pub trailing_radius_uncertainty: Option<f64>,
    /// Why there is no radius.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub trailing_radius_reason: Option<String>,
    /// Center (x, y) and radius of circles inscribed into the profile, from the leading to the trailing edge.
    pub camber_line: Vec<[f64; 3]>,
}

/// A camber of less than this share of the chord is none.
const MIN_CAMBER_SHARE: f64 = 0.002;
/// Camber lines are highest behind this share of the chord: those in use from 0.15 on.
const MIN_HIGHEST_CAMBER_SHARE: f64 = 0.12;

impl AirfoilRecord {
    /// What makes the measures doubtful: the circles of a camber line that is highest at its leading edge wander with the points there, and
    /// the chord with them.
    pub fn doubt(&self) -> Option<String> {
        let found = self.measures.as_ref()?;
        let is_cambered = found.camber.abs() > MIN_CAMBER_SHARE * found.chord;
        (is_cambered && found.camber_at < MIN_HIGHEST_CAMBER_SHARE).then(|| {
            "the camber line is highest at the leading edge: points there are too few or scatter too much to tell where the edge is, and camber \
             and chord hang on that; give more points around it"
                .into()
        })
    }
}
