//! Measures of airfoils and blades.

use super::chord::{self, ChordRecord, StackingRecord};
use super::found::Section;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trueness_geom::progress::{Cancelled, Progress};
use trueness_section::{Airfoil, AirfoilError, Chords, Contour, EdgeRadius, TrailingEdge, airfoil, chords};

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
const NO_CAMBER: f64 = 0.002;
/// Camber lines are highest behind this share of the chord: those in use from 0.15 on.
const HIGHEST_FROM: f64 = 0.12;

impl AirfoilRecord {
    /// What makes the measures doubtful: the circles of a camber line that is highest at its leading edge wander with the points there, and
    /// the chord with them.
    pub fn doubt(&self) -> Option<String> {
        let found = self.measures.as_ref()?;
        let is_cambered = found.camber.abs() > NO_CAMBER * found.chord;
        (is_cambered && found.camber_at < HIGHEST_FROM).then(|| {
            "the camber line is highest at the leading edge: points there are too few or scatter too much to tell where the edge is, and camber \
             and chord hang on that; give more points around it"
                .into()
        })
    }

    /// Those of all contours, whose points are `rows`.
    ///
    /// # Errors
    /// [`Cancelled`], when asked to stop.
    pub fn all(
        sections: &[Section],
        rows: &[Vec<[f64; 2]>],
        progress: &dyn Progress,
    ) -> Result<Vec<AirfoilRecord>, Cancelled> {
        let contours = sections.iter().flat_map(|s| &s.contours);
        let each = |(n, (contour, row)): (usize, (&Contour, &Vec<[f64; 2]>))| {
            let (measures, reason) = match airfoil(row, contour, progress) {
                Ok(found) => {
                    let chords = chords(row, contour, &found);
                    (Some(AirfoilMeasures::new(&found).with_chords(chords)), None)
                }
                Err(AirfoilError::Cancelled(e)) => return Err(e),
                Err(e) => (None, Some(e.to_string())),
            };
            Ok(AirfoilRecord { contour: n as u64, measures, measures_reason: reason })
        };
        contours.zip(rows).enumerate().map(each).collect()
    }
}

impl AirfoilMeasures {
    /// The same with its chords.
    fn with_chords(mut self, found: Result<Chords, AirfoilError>) -> AirfoilMeasures {
        match found {
            Ok(found) => {
                self.chords = chord::records(&found);
                (self.centroid, self.area) = (Some(found.centroid), Some(found.area));
            }
            Err(e) => self.chords_reason = Some(e.to_string()),
        }
        self
    }

    fn new(found: &Airfoil) -> AirfoilMeasures {
        let ([a, b], [c, d]) = (found.leading, found.trailing);
        let edge = |radius: &Result<EdgeRadius, AirfoilError>| {
            let found = radius.as_ref().ok();
            let reason = radius.as_ref().err().map(ToString::to_string);
            (found.map(|r| r.radius), found.map(|r| r.uncertainty), reason)
        };
        let (leading_radius, leading_radius_uncertainty, leading_radius_reason) = edge(&found.leading_radius);
        let (trailing_radius, trailing_radius_uncertainty, trailing_radius_reason) =
            edge(&found.trailing_radius);
        AirfoilMeasures {
            leading_edge: found.leading,
            trailing_edge: found.trailing,
            chord: found.chord,
            chord_angle: libm::atan2(d - b, c - a),
            chords: vec![],
            chords_reason: None,
            centroid: None,
            area: None,
            stacking: None,
            thickness: found.thickness,
            thickness_uncertainty: found.thickness_uncertainty,
            thickness_at: found.thickness_at,
            thickness_center: found.thickness_center,
            camber: found.camber,
            camber_at: found.camber_at,
            leading_radius,
            leading_radius_uncertainty,
            leading_radius_reason,
            trailing_kind: found.trailing_edge.name().into(),
            trailing_thickness: match found.trailing_edge {
                TrailingEdge::Blunt(gap) | TrailingEdge::Open(gap) => Some(gap),
                TrailingEdge::Sharp | TrailingEdge::Round => None,
            },
            trailing_radius,
            trailing_radius_uncertainty,
            trailing_radius_reason,
            camber_line: found.camber_line.iter().map(|([x, y], r)| [*x, *y, *r]).collect(),
        }
    }
}
