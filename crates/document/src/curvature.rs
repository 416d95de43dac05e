//! `trueness/curvature/1`: curvatures of a mesh or cloud, place by place.

mod kind;
mod without;

pub use kind::CurvatureKind;
pub use without::NoCurvature;

use super::result::ResultDocument;
use super::word::named;
use super::{Histogram, InputRecord, SharedNoise, Statistics, Word};
use crate::scale::Scale;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Name of this document's schema.
pub const SCHEMA: &str = "trueness/curvature/1";

/// The whole document. Lengths in millimeters, curvatures in their reciprocal.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct CurvatureDocument {
    /// `trueness/curvature/1`.
    pub schema: String,
    /// Version of the program.
    pub version: String,
    /// Always `mm`.
    pub units: String,
    /// The file read.
    pub inputs: Vec<InputRecord>,
    /// What has curvatures: `vertices` of a mesh or `points` of a cloud.
    pub places: Word<PlaceKind>,
    /// Degree of the polynomials fitted to the neighborhoods.
    pub degree: u64,
    /// What was taken into a neighborhood.
    pub neighborhood: Neighborhood,
    /// Whether places on a boundary have values.
    pub boundary: bool,
    /// Always `positive towards the normal`: a curvature is positive where the surface bends towards its normal, negative on a
    /// convex body whose normals point outward.
    pub sign: String,
    /// Where the side of the normals comes from: `facets`, or `neighbors` in a cloud.
    pub normals: Word<NormalSource>,
    /// Of a cloud: parts that hang together, each with its normals to one side; 0 of a mesh.
    pub parts: u64,
    /// All vertices or points.
    pub total: u64,
    /// Those that have curvatures.
    pub count: u64,
    /// Those that have none, by reason: `not_finite`, `unused`, `not_a_surface`, `boundary`, `few_neighbors`, `undetermined`, `folded`.
    pub without: BTreeMap<Word<NoCurvature>, u64>,
    /// Mean curvature, the mean of the principal curvatures, 1/mm.
    pub mean: Quantity,
    /// Gaussian curvature, their product, 1/mm².
    pub gaussian: Quantity,
    /// Greater principal curvature, 1/mm.
    pub k1: Quantity,
    /// Lesser principal curvature, 1/mm.
    pub k2: Quantity,
    /// The noise of the vertices or points, and how far neighbors share it: the uncertainties take it into account.
    #[serde(default)]
    pub shared_noise: Option<SharedNoise>,
    /// Why none is told: the uncertainties are those of independent points.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub shared_noise_reason: Option<String>,
    /// Standard uncertainty of the mean curvature, 1/mm: as the residuals tell it, or as `shared_noise` does where that is more.
    pub uncertainty: Range,
    /// Standard deviation of the neighbors from the polynomial.
    pub residual: Range,
    /// Condition of the least-squares systems.
    pub condition: Range,
    /// Neighbors of a place.
    pub neighbors: Range,
    /// Distance of the farthest neighbor.
    pub reach: Range,
}

impl ResultDocument for CurvatureDocument {
    /// Curvatures judge nothing.
    fn conforms(&self) -> bool {
        true
    }
}

/// What has curvatures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlaceKind {
    /// The vertices of a mesh.
    Vertices,
    /// The points of a cloud.
    Points,
}

named!(PlaceKind, "kind of place", [PlaceKind::Vertices, PlaceKind::Points], |kind| match kind {
    PlaceKind::Vertices => "vertices",
    PlaceKind::Points => "points",
});

/// Where the side of the normals comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NormalSource {
    /// The facets of a mesh.
    Facets,
    /// The neighbors in a cloud.
    Neighbors,
}

named!(NormalSource, "source of normals", [NormalSource::Facets, NormalSource::Neighbors], |source| {
    match source {
        NormalSource::Facets => "facets",
        NormalSource::Neighbors => "neighbors",
    }
});

/// What was taken into a neighborhood.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Neighborhood {
    /// At least so many neighbors.
    Count {
        /// How many.
        neighbors: u64,
    },
    /// All within a distance.
    Radius {
        /// That distance, millimeters.
        radius: f64,
    },
}

/// One of the curvatures over all places.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Quantity {
    /// Over the places, each counting once.
    pub statistics: Statistics,
    /// Counts of the values.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub histogram: Option<Histogram>,
    /// Where it is greatest.
    pub maximum: CurvaturePlace,
    /// Where it is least.
    pub minimum: CurvaturePlace,
    /// Its colors.
    pub scale: Scale,
}

/// A vertex or point with its curvatures.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CurvaturePlace {
    /// Its number in the file, from 0.
    pub index: u64,
    /// Where it lies.
    pub position: [f64; 3],
    /// How the surface bends there.
    #[serde(flatten)]
    pub bend: BendRecord,
    /// Standard uncertainty of the mean curvature.
    pub uncertainty: f64,
    /// Standard deviation of the neighbors from the polynomial, millimeters.
    pub residual: f64,
    /// Condition of the least-squares system.
    pub condition: f64,
    /// Neighbors.
    pub neighbors: u64,
}

/// Normal and curvatures of a surface at a place, positive where it bends towards the normal.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BendRecord {
    /// Unit normal.
    pub normal: [f64; 3],
    /// Greater principal curvature, 1/mm.
    pub k1: f64,
    /// Lesser principal curvature.
    pub k2: f64,
    /// Unit tangent in which the surface bends by the greater one.
    pub k1_direction: [f64; 3],
    /// And by the lesser one.
    pub k2_direction: [f64; 3],
    /// Mean curvature.
    pub mean: f64,
    /// Gaussian curvature, 1/mm².
    pub gaussian: f64,
}

/// Range of a quantity.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Range {
    /// Least.
    pub min: f64,
    /// Half of the values are below.
    pub median: f64,
    /// Greatest.
    pub max: f64,
}

impl Range {
    /// Of numbers; `None` of none.
    pub fn of(mut all: Vec<f64>) -> Option<Range> {
        let (min, max) =
            all.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(*x), b.max(*x)));
        let middle = all.len() / 2;
        (!all.is_empty()).then(|| {
            let median = *all.select_nth_unstable_by(middle, f64::total_cmp).1;
            Range { min, median, max }
        })
    }
}

impl CurvatureDocument {
    /// What was found of a curvature.
    pub fn quantity(&self, kind: CurvatureKind) -> &Quantity {
        match kind {
            CurvatureKind::Mean => &self.mean,
            CurvatureKind::Gaussian => &self.gaussian,
            CurvatureKind::K1 => &self.k1,
            CurvatureKind::K2 => &self.k2,
        }
    }
}
