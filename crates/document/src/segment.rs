//! `trueness/segment/1`: elements found in a mesh or cloud.

use super::fit::Number;
use super::result::ResultDocument;
use super::shape::ShapeKind;
use super::{Bounds, InputRecord, SharedNoise, Word};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Name of this document's schema.
pub const SCHEMA: &str = "trueness/segment/1";

/// The whole document. Lengths in millimeters, angles in radians.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct SegmentDocument {
    /// `trueness/segment/1`.
    pub schema: String,
    /// Version of the program.
    pub version: String,
    /// Always `mm`.
    pub units: String,
    /// The file read.
    pub inputs: Vec<InputRecord>,
    /// What was put into regions: `facets` or `points`.
    pub pieces: PieceKind,
    /// How many there are.
    pub count: u64,
    /// How many belong to no region.
    pub unassigned: u64,
    /// Standard deviation of the noise found in the data.
    pub noise: f64,
    /// The noise of the points about their elements, and how far neighbors share it: the uncertainties take it into account.
    #[serde(default)]
    pub shared_noise: Option<SharedNoise>,
    /// Why none is told: the uncertainties are those of independent points.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub shared_noise_reason: Option<String>,
    /// Distance up to which points belong to an element: no point of a region lies farther off.
    pub tolerance: f64,
    /// Whether that distance was given, not found.
    pub tolerance_given: bool,
    /// Angle between neighboring pieces from which on there is an edge between them.
    pub crease: f64,
    /// Least share of the area, or of the points, that a region must have.
    pub min_share: f64,
    /// Seed of everything random.
    pub seed: u64,
    /// The regions, largest first.
    pub regions: Vec<RegionRecord>,
}

impl ResultDocument for SegmentDocument {
    /// Elements judge nothing.
    fn conforms(&self) -> bool {
        true
    }
}

/// What regions are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PieceKind {
    /// Facets of a mesh.
    Facets,
    /// Points of a cloud.
    Points,
}

/// One element and what belongs to it.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct RegionRecord {
    /// Its number, from 0; the label of its facets or points.
    pub number: u64,
    /// `plane`, `cylinder`, `cone`, `sphere` or `torus`.
    pub shape: Word<ShapeKind>,
    /// The element by least squares, by names, as in a fit.
    pub parameters: BTreeMap<String, Number>,
    /// Standard uncertainty of each parameter; of places and directions, coordinate by coordinate.
    pub uncertainty: Option<BTreeMap<String, Number>>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub uncertainty_reason: Option<String>,
    /// Number of facets, or of points of a cloud.
    pub pieces: u64,
    /// Area of the facets, mm²; `null` for a cloud.
    pub area: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub area_reason: Option<String>,
    /// Share of the area of all facets, or of all points of a cloud.
    pub share: f64,
    /// Points that the element was fitted to: those inside the region, not on its edges, where there are enough.
    pub points: u64,
    /// Root mean square of their distances.
    pub rms: f64,
    /// Greatest magnitude of the distances of all points of the region's facets, or of its points: within the tolerance.
    pub max: f64,
    /// Of the points that it was fitted to, greatest less least signed distance.
    pub form_error: f64,
    /// Box around the region.
    pub bounds: Bounds,
    /// The numbers of its facets or points in the file, from 0, where they were asked for.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub members: Option<Vec<u32>>,
}
