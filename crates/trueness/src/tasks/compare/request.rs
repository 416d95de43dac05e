//! What a comparison is asked.

use super::facing::FacingAngle;
use crate::task::{PointReading, ReferenceReading, Text, ToleranceText, choices};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use trueness_files::Columns;
use trueness_geom::deviation::sign_choice::SignRequest;
use trueness_measure::compare::{self, AlongRule, Coverage, MIN_COVERAGE, OutlierRule};

choices! {
    /// How distances are computed.
    pub enum Method {
        Exact = "exact": "The true minimum over all facets",
        Paper = "paper": "The nearest-vertex method of the literature, beside the exact one",
    }
}

choices! {
    /// How inside and outside are told apart.
    pub enum Sign {
        Auto = "auto": "The method that is valid for the reference",
        Pseudonormal = "pseudonormal": "Angle-weighted pseudonormals",
        Winding = "winding": "Generalized winding number",
        None = "none": "Distances without a sign",
    }
}

impl From<Method> for compare::Method {
    fn from(method: Method) -> compare::Method {
        match method {
            Method::Exact => compare::Method::Exact,
            Method::Paper => compare::Method::Paper,
        }
    }
}

impl From<Sign> for SignRequest {
    fn from(sign: Sign) -> SignRequest {
        match sign {
            Sign::Auto => SignRequest::Auto,
            Sign::Pseudonormal => SignRequest::Pseudonormal,
            Sign::Winding => SignRequest::Winding,
            Sign::None => SignRequest::None,
        }
    }
}

/// What a comparison is asked.
///
/// ```
/// use trueness::task::{Outcome, Request};
/// use trueness::{files::FileSources, geom::progress::Silent, tasks::compare::CompareRequest};
/// let request = CompareRequest {
///     measured: "../../corpus/bunny/zipper_res3.ply".into(),
///     references: vec!["../../corpus/bunny/zipper_res4.ply".into()],
///     tolerance: Some("-5,+5".parse()?),
///     inside: 90.0,
///     ..CompareRequest::default()
/// };
/// let done = request.run(&FileSources, &Silent)?;
/// assert_eq!(done.outcome, Outcome::Conforming);
/// let all = &done.document.comparisons[0].deviation.all;
/// assert!(all.count == 1889 && all.rms.is_some_and(|rms| (rms - 1.378).abs() < 0.001));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct CompareRequest {
    /// The scan: points, or a mesh, whose vertices are compared.
    pub measured: PathBuf,
    /// The nominals, or the meshes under test: meshes, or B-spline surfaces; several are ranked side by side. At least one.
    pub references: Vec<PathBuf>,
    /// How the scan is taken.
    #[serde(flatten)]
    pub reading: PointReading,
    /// How the references are taken.
    #[serde(flatten)]
    pub reference_reading: ReferenceReading,
    /// Join vertices of the references within this distance, mm; without it those at the same place.
    pub weld: Option<f64>,
    /// Where to write x, y, z and deviation of every point, in input order. Several references have one file each: `name.1.csv`,
    /// `name.2.csv` …
    pub out: Option<PathBuf>,
    /// Color scale of the report (an object `trueness/scale/1`); without it one that fits the tolerance or the deviations.
    pub scale: Option<PathBuf>,
    /// Bring the scan to the first reference first, by the best fit from any pose.
    pub align: bool,
    /// How distances are computed.
    pub method: Method,
    /// How inside and outside are told apart.
    pub sign: Sign,
    /// Allowed deviation: T for ±T, or -L,+U with both signs, mm; the document then has a verdict.
    pub tolerance: Option<Text<ToleranceText>>,
    /// Regions of the reference with tolerances of their own: a TOML file of `[[region]]` with id, seed or between, tolerance.
    pub regions: Option<PathBuf>,
    /// Share of the points that must lie within the tolerance, percent; for a tolerance.
    pub inside: f64,
    /// Exclude (and count) points farther than this, mm.
    pub max_distance: Option<f64>,
    /// Exclude (and count) points whose nearest place is a boundary edge of the reference.
    pub skip_boundary: bool,
    /// Measure along lines instead of to the nearest place: a direction `X,Y,Z`, or the normals of the `reference` or of the `measured`.
    pub along: Option<Text<AlongRule>>,
    /// Exclude (and count) points whose normals turn away from the reference's by more than this, degrees.
    pub facing: Option<FacingAngle>,
    /// Columns of the normals in a table of points, for `facing` and `along` with `measured`; without it `nx,ny,nz`.
    pub normals: Option<Text<Columns>>,
    /// Exclude (and count) outliers: `mad:5` for 5 × 1.4826 MAD from the median, `3sigma` for 3 σ from the mean.
    pub outliers: Option<Text<OutlierRule>>,
    /// Tell what part of the reference no point covers within a reach: `auto` (three spacings of the points) or mm. A tolerance tells it in
    /// any case.
    pub coverage: Option<Text<Coverage>>,
    /// Share of the reference that the points must cover for a pass, percent; 0: a part of it is measured on purpose.
    pub min_coverage: f64,
    /// Name at most so many worst places above the reference, and as many below; 1 to 1000, without it 3.
    pub worst: Option<u16>,
    /// Compare so many points spread evenly over the measured mesh's area instead of its vertices; at least 1.
    pub sample: Option<u64>,
    /// Also from the reference to the measured mesh: Hausdorff and mean distance.
    pub both: bool,
    /// Of several references: take the errors of the points as independent, as of points probed one by one.
    pub independent: bool,
    /// Add bootstrap intervals, a normality test, the best distribution, Moran's I.
    pub research: bool,
    /// Seed of everything random.
    pub seed: u64,
    /// Keep what a report draws.
    pub view: bool,
}

impl Default for CompareRequest {
    fn default() -> CompareRequest {
        CompareRequest {
            measured: PathBuf::new(),
            references: vec![],
            reading: PointReading::default(),
            reference_reading: ReferenceReading::default(),
            weld: None,
            out: None,
            scale: None,
            align: false,
            method: Method::Exact,
            sign: Sign::Auto,
            tolerance: None,
            regions: None,
            inside: 100.0,
            max_distance: None,
            skip_boundary: false,
            along: None,
            facing: None,
            normals: None,
            outliers: None,
            coverage: None,
            min_coverage: 100.0 * MIN_COVERAGE,
            worst: None,
            sample: None,
            both: false,
            independent: false,
            research: false,
            seed: 0,
            view: false,
        }
    }
}
