//! `trueness/align/1`: the motion that brings a measured part onto its reference.

mod note;

pub use note::{AlignNote, AlignNoteKind};

use super::result::ResultDocument;
use super::{InputRecord, Role};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Name of this document's schema.
pub const SCHEMA: &str = "trueness/align/1";

/// The whole document. Lengths in millimeters, angles in radians.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct AlignDocument {
    /// `trueness/align/1`.
    pub schema: String,
    /// Version of the program.
    pub version: String,
    /// Always `mm`.
    pub units: String,
    /// The files read: the measured first.
    pub inputs: Vec<InputRecord>,
    /// `best-fit`, `chebyshev`, `zones`, `pairs`, `3-2-1` or `rps`.
    pub method: String,
    /// 4×4, row by row, acting on columns (x, y, z, 1): takes measured coordinates to those of the reference. With a `scale` its rotation is
    /// multiplied by it.
    pub transform: [[f64; 4]; 4],
    /// How many times as large the measured was made, where that was asked for.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub scale: Option<f64>,
    /// Its standard uncertainty.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub scale_std_uncertainty: Option<f64>,
    /// Angle of its rotation, radians.
    pub angle: f64,
    /// Root of the weighted mean square distance of what counts.
    pub rms: f64,
    /// Weighted mean distance of what counts.
    pub mean_abs: f64,
    /// Steps of the last iteration.
    pub iterations: u64,
    /// Whether the iteration settled: the last step was less than a thousandth of its own uncertainty.
    pub converged: bool,
    /// Of the six degrees of freedom, those that the parts determine.
    pub degrees_of_freedom: u64,
    /// The motions that stay free.
    pub free: Vec<FreeMotion>,
    /// The motions that rims alone hold, with the way that they leave.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub slack: Vec<SlackMotion>,
    /// The components of the motion that were to stay zero.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub lock: Option<LockRecord>,
    /// What a best fit tells beyond that, also the one that `chebyshev` or `zones` began with; absent for the other methods.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub best_fit: Option<BestFitRecord>,
    /// Of `chebyshev`: the greatest distance, which is the least that there is.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub chebyshev: Option<ChebyshevRecord>,
    /// Of `zones`: the greatest excess over a tolerance, which is the least that there is.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub zones: Option<ZonesRecord>,
    /// Of `pairs`, `3-2-1` and `rps`: what is left in each row of the table, in its order.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub pairs: Vec<PairRecord>,
    /// What is to be said about the result.
    pub warnings: Vec<AlignNote>,
    /// Seed of everything random.
    pub seed: u64,
}

/// The alignment that a comparison began with.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct AlignedTo {
    /// The reference that the measured was brought to.
    pub reference: String,
    /// 4×4, row by row: takes the coordinates of the measured file to those compared.
    pub transform: [[f64; 4]; 4],
    /// Root of the weighted mean square distance of what counts.
    pub rms: f64,
    /// Weighted mean distance of what counts.
    pub mean_abs: f64,
    /// Steps of the last iteration.
    pub iterations: u64,
    /// Whether the iteration settled.
    pub converged: bool,
    /// Points without a weight in the fit; they are compared all the same.
    pub left_out: u64,
    /// What is to be said about the result.
    pub warnings: Vec<AlignNote>,
}

impl AlignedTo {
    /// What makes it unreliable.
    pub fn doubts(&self) -> impl Iterator<Item = AlignNoteKind> {
        self.warnings.iter().map(|w| *w.kind).filter(|kind| kind.is_doubt())
    }

    /// As [`AlignDocument::sound`].
    pub fn sound(&self) -> bool {
        sound(&self.warnings)
    }
}

/// Whether an alignment with these warnings may be relied on.
fn sound(warnings: &[AlignNote]) -> bool {
    !warnings.iter().any(|w| w.kind.is_doubt())
}

/// What a best fit tells.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct BestFitRecord {
    /// Weighted median distance of all points that have a place on the reference.
    pub median: f64,
    /// Points that count.
    pub used: u64,
    /// Points that do not: outliers, beside a boundary edge, on the other side of a wall.
    pub left_out: u64,
    /// Share of the measured surface that counts, 0 to 1.
    pub share: f64,
    /// Mean of the measured points in the frame of the reference: what the rotation vector of the covariance is about.
    pub center: [f64; 3],
    /// Covariance of the rotation vector (radians) and the translation (mm); zero along free motions.
    pub covariance: [[f64; 6]; 6],
    /// Standard uncertainties of the same six.
    pub std_uncertainty: [f64; 6],
    /// Greatest over least eigenvalue of the normal equations.
    pub condition: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub condition_reason: Option<String>,
    /// Other poses that fit nearly as well, best first.
    pub alternatives: Vec<AlternativeRecord>,
}

/// The pose with the least greatest distance.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct ChebyshevRecord {
    /// The greatest distance of a point that counts from the surface.
    pub greatest: f64,
    /// Where that point lies after the motion.
    pub at: [f64; 3],
    /// Points that count.
    pub used: u64,
    /// Points that do not: much farther off than the others and than a hundredth of the size of the reference, beside a boundary edge, on the other
    /// side of a wall, of no facet.
    pub left_out: u64,
    /// Distance of the farthest of those; absent where all count.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub left_out_farthest: Option<f64>,
}

/// The pose with the least greatest excess over the tolerances.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct ZonesRecord {
    /// How far the worst point of all is beyond its tolerance; negative where all are within, by so much at least.
    pub excess: f64,
    /// Where that point lies after the motion.
    pub at: [f64; 3],
    /// Its deviation.
    pub deviation: f64,
    /// Its tolerance: least and greatest deviation.
    pub tolerance: [f64; 2],
    /// Points that are beyond their tolerance.
    pub beyond: u64,
    /// The greatest excess of the points that count in the search for the pose: what is least there. Where all count it is `excess`.
    pub least: f64,
    /// Points that have a tolerance. All of them are judged.
    pub used: u64,
    /// Points that do not count in the search, as those of `chebyshev`, if they are off by more than ten times the widest tolerance, too. They are judged all the same.
    pub left_out: u64,
    /// Distance of the farthest of those; absent where all count.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub left_out_farthest: Option<f64>,
    /// Points at places without a tolerance.
    pub without_zone: u64,
}

/// Another pose that fits nearly as well.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct AlternativeRecord {
    /// As `transform` of the document.
    pub transform: [[f64; 4]; 4],
    /// Angle of the rotation between this pose and the result, radians.
    pub angle: f64,
    /// Its root mean square distance, capped at twenty standard deviations, over that of the result.
    pub ratio: f64,
}

/// A motion that the shape leaves free, in the frame of the reference.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FreeMotion {
    /// `slides` or `turns`.
    pub kind: String,
    /// Unit direction of the slide, or of the axis.
    pub direction: [f64; 3],
    /// A place on the axis; absent for a slide.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub point: Option<[f64; 3]>,
}

/// A motion that rims alone hold.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SlackMotion {
    /// The motion.
    #[serde(flatten)]
    pub motion: FreeMotion,
    /// How far the measured may go at least, root mean square; within it any pose fits as well.
    pub width: f64,
}

/// Components of a motion that stay zero.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LockRecord {
    /// Which: `tx`, `ty`, `tz` of the translation of `center`, `rx`, `ry`, `rz` of the rotation vector, in the frame of the reference.
    pub axes: Vec<String>,
    /// What the motion turns about.
    pub center: [f64; 3],
}

/// A row of the table of places.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct PairRecord {
    /// Number of the row, from 0.
    pub row: u64,
    /// What is left: the distance of a pair, the signed distance along the direction of a row.
    pub residual: f64,
    /// How many millimeters the corner of the reference's box that moves farthest moves per millimeter of error in this row; absent of pairs.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub amplification: Option<f64>,
}

impl ResultDocument for AlignDocument {
    /// Whether it may be relied on, and all points are within their tolerance, where there is one. Against a reference that was not read in
    /// whole nothing is proven.
    fn conforms(&self) -> bool {
        let whole = self.inputs.iter().all(|i| i.role != Role::Reference || i.incomplete.is_none());
        self.sound() && whole && self.zones.as_ref().is_none_or(|z| z.beyond == 0)
    }
}

impl AlignDocument {
    /// The motion of `transform`, without its scale.
    pub fn motion(&self) -> [[f64; 4]; 4] {
        let mut matrix = self.transform;
        let factor = self.scale.unwrap_or(1.0);
        matrix[..3].iter_mut().for_each(|row| row[..3].iter_mut().for_each(|x| *x /= factor));
        matrix
    }

    /// Whether the result may be relied on: it settled, it fits, no unit is wrong, and no other pose fits as well.
    pub fn sound(&self) -> bool {
        sound(&self.warnings)
    }
}
