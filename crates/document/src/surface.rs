//! `trueness/surface/1`: a B-spline surface fitted to points.

use super::curvature::{BendRecord, Range};
use super::result::ResultDocument;
use super::word::words;
use super::{Histogram, InputRecord, Statistics, Word};
use crate::scale::Scale;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Name of this document's schema.
pub const SCHEMA: &str = "trueness/surface/1";

/// The whole document. Lengths in millimeters, curvatures in their reciprocal.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct SurfaceDocument {
    /// `trueness/surface/1`.
    pub schema: String,
    /// Version of the program.
    pub version: String,
    /// Always `mm`.
    pub units: String,
    /// The file read.
    pub inputs: Vec<InputRecord>,
    /// Degrees along `u` and `v`.
    pub degree: [u64; 2],
    /// The knots.
    pub knots: KnotsRecord,
    /// Control points: rows along `u`, each ordered by `v`.
    pub control_points: Vec<Vec<[f64; 3]>>,
    /// Where the parameters of the points came from.
    pub base: BaseRecord,
    /// Weight of the thin-plate term, mm².
    pub fairness: f64,
    /// `auto` (generalized cross-validation) or `given`.
    pub fairness_from: String,
    /// Degrees of freedom that the surface uses.
    pub degrees_of_freedom: Option<f64>,
    /// Why they are not known.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub degrees_of_freedom_reason: Option<String>,
    /// Signed distances of all points but those left out and those beyond the border from the surface, at their nearest places; positive on the side of the normal, which is the
    /// derivative by `u` times the derivative by `v`.
    pub deviation: Statistics,
    /// Counts and colors of the deviations.
    pub map: MapRecord,
    /// Point farthest from the surface.
    pub worst: WorstPoint,
    /// Differences between the points and the surface at the parameters that the control points were found with.
    pub residual: Residual,
    /// What came of the tolerance; absent without one.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub tolerance: Option<ToleranceRecord>,
    /// The outline that the surface is cut along in files for CAD and on the page; absent where it is not cut.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub trim: Option<TrimRecord>,
    /// Curvatures at the places nearest to the points.
    pub curvature: CurvatureRecord,
    /// Share of the control points that hardly any point holds: the thin-plate term made them (0 to 1).
    pub unsupported_share: f64,
    /// The same in numbers.
    pub support: SupportRecord,
    /// Control points outside of twice the box of the points.
    pub far_control_points: u64,
    /// Parameter corrections made.
    pub corrections: u64,
    /// Points left out by `--robust`: they contradict their neighbors. No other number counts them.
    pub outliers: u64,
    /// Points beyond the border of the surface: their distance has a part along it. No other number counts them.
    #[serde(default)]
    pub beyond_border: u64,
    /// Points whose nearest place was not found to the last digit.
    pub unsettled: u64,
    /// What makes the surface doubtful.
    pub warnings: Vec<String>,
}

/// Whole knots, ends as often as the degree and one.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct KnotsRecord {
    /// Along `u`.
    pub u: Vec<f64>,
    /// Along `v`.
    pub v: Vec<f64>,
}

/// Where parameters came from.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct BaseRecord {
    /// `plane`, `xy`, `cylinder`, `sphere` or `mesh`.
    pub kind: Word<BaseKind>,
    /// Of a plane the corner of the bounding rectangle, of a cylinder a place of its axis, of a sphere its center, of a mesh the mean
    /// of its vertices.
    pub origin: [f64; 3],
    /// Right-handed unit axes: of a plane the sides of the rectangle (the longer one first) and the normal; of a cylinder the third is its axis; of a
    /// sphere the first points amid the points; of a mesh those in which its vertices spread, most in the first.
    pub axes: [[f64; 3]; 3],
    /// Angle from the longer side of the minimum bounding rectangle to the first axis, radians from −π/2 to π/2: 0 but of a plane whose
    /// rectangle was turned for a tolerance, along the direction in which the surface bends most.
    #[serde(default)]
    pub turned: f64,
    /// Angle from the normal of the least-squares plane to the third axis, radians: 0 but of a plane over whose least-squares plane
    /// the points lie in layers, and over another one in fewer.
    #[serde(default)]
    pub tilted: f64,
    /// Of a cylinder or a sphere.
    pub radius: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub radius_reason: Option<String>,
    /// Whether the points go all around, so that the surface has a seam.
    pub around: bool,
    /// Whether points lie within ten degrees of a pole of the sphere, where the surface is torn or creased.
    #[serde(skip_serializing_if = "is_false", default)]
    pub pole: bool,
    /// Share of the points where layers lie over one another as seen on the base (0 to 1).
    pub folded_share: f64,
    /// Share of the points whose surface stands on edge on the base, at 80° and more (0 to 1).
    #[serde(default)]
    pub standing_share: f64,
    /// Whether so many of them do that the surface is not theirs.
    #[serde(skip_serializing_if = "is_false", default)]
    pub on_edge: bool,
    /// Of a mesh laid flat, factors by which lengths on its facets grew: 1 % of its area has less than the first, 1 % more than the
    /// second.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub stretch: Option<[f64; 2]>,
    /// Whether a mesh was laid within a circle: laid out freely, its rim would cross itself.
    #[serde(skip_serializing_if = "is_false", default)]
    pub round: bool,
}

/// Share of points in layers beyond which the surface is doubtful.
pub const MAX_FOLDED_SHARE: f64 = 0.01;

/// Factor to which lengths may shrink as a mesh is laid flat: of what is laid flat more densely the knots tell one place from the next no
/// more.
const MIN_SHRINKING: f64 = 0.05;

impl BaseRecord {
    /// Whether so many points lie in layers or stand on edge over the base, or one lies so near to its pole, or the mesh is crushed so much
    /// as it is laid flat, that the surface is not theirs.
    pub fn is_doubtful(&self) -> bool {
        self.folded_share > MAX_FOLDED_SHARE
            || self.on_edge
            || self.pole
            || self.stretch.is_some_and(is_crushed)
    }
}

/// Whether lengths shrink so much, where they grow by such factors as a mesh is laid flat, that the knots no longer tell places apart.
pub fn is_crushed([least, _]: [f64; 2]) -> bool {
    least < MIN_SHRINKING
}

impl ResultDocument for SurfaceDocument {
    /// Whether the surface is that of its points, and reaches the tolerance, where there is one.
    fn conforms(&self) -> bool {
        self.tolerance.as_ref().is_none_or(|t| t.reached) && !self.base.is_doubtful()
    }
}

fn is_false(flag: &bool) -> bool {
    !flag
}

/// A point and its deviation.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
pub struct WorstPoint {
    /// Number of the point in the file, from 0.
    pub point: u64,
    /// Where it lies.
    pub position: [f64; 3],
    /// Its signed distance.
    pub deviation: f64,
    /// Parameters of the nearest place.
    pub parameters: [f64; 2],
}

/// What is left at the parameters of the last fit.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Residual {
    /// Sum of the squares.
    pub sum_of_squares: f64,
    /// Root mean square.
    pub rms: f64,
    /// Greatest.
    pub max: f64,
}

/// What came of a tolerance.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct ToleranceRecord {
    /// The tolerance.
    pub value: f64,
    /// Whether all points are within.
    pub reached: bool,
    /// Points beyond it.
    pub outside: u64,
    /// Why no more knots were set: `tolerance`, `noise`, `points` or `memory`.
    pub stopped_by: Word<Reached>,
}

/// The outline of the points.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct TrimRecord {
    /// Half the width of the gaps that do not count.
    pub reach: f64,
    /// Share of the rectangle of the parameters that is within (0 to 1).
    pub share: f64,
    /// The parts that do not hang together, largest first.
    pub regions: Vec<RegionRecord>,
    /// Points of parts with less than 1 % of them, which are left out.
    pub left_out: u64,
}

/// A part of the surface within closed polygons of the parameters.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct RegionRecord {
    /// Around it, against the clock.
    pub outer: Vec<[f64; 2]>,
    /// Around its holes, with the clock.
    pub holes: Vec<Vec<[f64; 2]>>,
}

/// Curvatures, positive where the surface bends towards its normal; `null` where no place has any.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct CurvatureRecord {
    /// Places that have curvatures.
    pub count: u64,
    /// Why numbers are missing.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub reason: Option<String>,
    /// Greater principal curvature.
    pub k1: Option<Range>,
    /// Lesser principal curvature.
    pub k2: Option<Range>,
    /// Mean curvature.
    pub mean: Option<Range>,
    /// Gaussian curvature, 1/mm².
    pub gaussian: Option<Range>,
    /// In the middle of the domain.
    pub middle: Option<PlaceCurvature>,
    /// Counts and colors of each: `mean`, `gaussian`, `k1`, `k2`; those of which no place has a value are absent.
    pub maps: BTreeMap<String, MapRecord>,
}

/// What a report draws values by.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct MapRecord {
    /// Counts of the values.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub histogram: Option<Histogram>,
    /// Mean of the values.
    pub mean: Option<f64>,
    /// Their colors.
    pub scale: Scale,
}

/// Curvatures at a place.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
pub struct PlaceCurvature {
    /// Its parameters.
    pub parameters: [f64; 2],
    /// Where it lies.
    pub position: [f64; 3],
    /// How it bends there.
    #[serde(flatten)]
    pub bend: BendRecord,
}

/// How well the points hold the control points.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
pub struct SupportRecord {
    /// Control points.
    pub control_points: u64,
    /// Of those, without support.
    pub unsupported: u64,
    /// Knot cells.
    pub cells: u64,
    /// Of those, without a point.
    pub empty_cells: u64,
}

words! {
    /// What the parameters of a surface are measured along.
    BaseKind, "base of a surface", {
        /// The least-squares plane.
        Plane = "plane",
        /// x and y themselves.
        Xy = "xy",
        /// The least-squares cylinder.
        Cylinder = "cylinder",
        /// The least-squares sphere.
        Sphere = "sphere",
        /// The facets of a mesh, laid flat.
        Mesh = "mesh",
    }
}

words! {
    /// Why a surface has no more knots.
    Reached, "reason to stop", {
        /// All points are within the tolerance.
        Tolerance = "tolerance",
        /// More knots followed the noise of the points only.
        Noise = "noise",
        /// There would be more control points than points, or spans without points to set knots by.
        Points = "points",
        /// The matrix would take more memory than allowed.
        Memory = "memory",
    }
}
