//! `trueness/fit/1`: an element fitted to points.

use super::result::ResultDocument;
use super::shape::{FitMethod, ShapeKind};
use super::{Histogram, InputRecord, SharedNoise, Word};
use crate::scale::Scale;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Name of this document's schema.
pub const SCHEMA: &str = "trueness/fit/1";

/// The whole document. Lengths in millimeters, angles in radians.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct FitDocument {
    /// `trueness/fit/1`.
    pub schema: String,
    /// Version of the program.
    pub version: String,
    /// Always `mm`.
    pub units: String,
    /// The file read.
    pub inputs: Vec<InputRecord>,
    /// `line`, `plane`, `circle`, `ellipse`, `sphere`, `cylinder`, `cone` or `torus`.
    pub shape: Word<ShapeKind>,
    /// True if the element lies in the plane z = 0, as points of two columns do.
    pub planar: bool,
    /// `gaussian`, `minimum-zone`, `minimum-circumscribed`, `maximum-inscribed` or `robust`.
    pub method: Word<FitMethod>,
    /// The element, by names: `point`, `direction`, `normal`, `center`, `apex`, `radius`, `half_angle`,
    /// `major_radius`, `minor_radius`, as the shape has them.
    pub parameters: BTreeMap<String, Number>,
    /// Standard uncertainty of each parameter; of places and directions, coordinate by coordinate. Errors are shared by neighbors as far as
    /// `shared_noise` tells, else independent.
    pub uncertainty: Option<BTreeMap<String, Number>>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub uncertainty_reason: Option<String>,
    /// The noise of the points about the element, and how far neighbors share it.
    #[serde(default)]
    pub shared_noise: Option<SharedNoise>,
    /// Why none is told: the uncertainties are those of independent points.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub shared_noise_reason: Option<String>,
    /// Greatest less least signed distance, or the width of the zone; of a curve in space, twice the greatest distance.
    pub form_error: f64,
    /// Root mean square of the distances.
    pub rms: f64,
    /// Sum of squares over the distances left after the unknowns, its root.
    pub std_dev: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub std_dev_reason: Option<String>,
    /// Number of points; with `robust`, of those that are no outliers.
    pub count: u64,
    /// Points left out by `robust`.
    pub outliers: u64,
    /// Point with the least signed distance.
    pub minimum: Extreme,
    /// Point with the greatest signed distance.
    pub maximum: Extreme,
    /// Points that hold a zone, a circumscribed or an inscribed element.
    pub touching: Vec<Touching>,
    /// The part of the element that the points lie on.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub extent: Option<Extent>,
    /// Counts of the signed distances of all points.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub histogram: Option<Histogram>,
    /// Colors of the signed distances.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub scale: Option<Scale>,
    /// Steps of the solver on all points.
    pub iterations: u64,
    /// Whether the last step changed nothing that shows.
    pub converged: bool,
    /// Seed of everything random.
    pub seed: u64,
}

impl ResultDocument for FitDocument {
    /// An element judges nothing.
    fn conforms(&self) -> bool {
        true
    }
}

/// A number, or a place or direction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Number {
    /// Millimeters or radians.
    One(f64),
    /// A place in millimeters or a unit direction.
    Three([f64; 3]),
}

/// A point and its signed distance.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Extreme {
    /// Distance from the element, millimeters.
    pub distance: f64,
    /// Index of the point in the file, counted from 0.
    pub point: u64,
    /// Where the point lies.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub position: Option<[f64; 3]>,
}

/// The part of an element that its points lie on, in a frame of the element. The two coordinates are lengths, or angles in
/// radians: of a plane along the first and second axis; of a line, nothing and along the third axis; of what is round,
/// about the third axis from the first, and (cylinder, cone) along it, (sphere) up from the equator, (torus) around the
/// tube from its outer side. A circle and an ellipse have the first alone.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Extent {
    /// Where the frame sits.
    pub origin: [f64; 3],
    /// Its axes.
    pub axes: [[f64; 3]; 3],
    /// Range of the first coordinate; a full turn is 2π.
    pub u: [f64; 2],
    /// Range of the second.
    pub v: [f64; 2],
}

/// A point that touches.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Touching {
    /// Index of the point in the file, counted from 0.
    pub point: u64,
    /// 1 on the outer boundary, −1 on the inner one.
    pub side: i8,
    /// Its share in holding the element: positive, all sum to 1.
    pub multiplier: f64,
    /// Where the point lies.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub position: Option<[f64; 3]>,
}

impl FitDocument {
    /// Digits after the point that show the form error.
    pub fn digits(&self) -> usize {
        self.scale.as_ref().map_or(4, |s| s.decimals as usize)
    }

    /// The farthest points on either side.
    pub fn extremes(&self) -> [&Extreme; 2] {
        [&self.maximum, &self.minimum]
    }
}
