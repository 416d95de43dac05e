//! `trueness/inspect/1`: a plan, evaluated.

mod decimals;
mod place;

pub use place::{FrameSource, MeasuredPlace, PlaceRecord};

use super::align::{AlignNote, AlignNoteKind};
use super::compare::Comparison;
use super::face::FaceRecord;
use super::fit::Number;
use super::place_map::PlaceMap;
use super::result::ResultDocument;
use super::shape::FitMethod;
use super::verdict::rank;
use super::word::named;
use super::{InputRecord, SharedNoise, Verdict, VerdictReason, Word};
use crate::plan::{Class, MaterialWord, SizeWord, TextureWord};
use crate::scale::Scale;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Name of this document's schema.
pub const SCHEMA: &str = "trueness/inspect/1";

/// The whole document. Lengths in millimeters, angles of features in radians, of characteristics in degrees.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct InspectDocument {
    /// `trueness/inspect/1`.
    pub schema: String,
    /// Version of the program.
    pub version: String,
    /// Always `mm`.
    pub units: String,
    /// The plan's heading.
    pub title: Option<String>,
    /// The plan that was evaluated.
    pub plan: PlanRecord,
    /// The files read.
    pub inputs: Vec<InputRecord>,
    /// How the measured data came to lie on the reference.
    pub alignment: AlignmentRecord,
    /// The features, in the plan's order.
    pub features: Vec<FeatureRecord>,
    /// The characteristics, in the plan's order.
    pub characteristics: Vec<CharacteristicRecord>,
    /// The noise of what was measured, and how far neighbors share it: the uncertainties of the features take it into account, and with
    /// `noise = "measured"` those of the values.
    #[serde(default)]
    pub shared_noise: Option<SharedNoise>,
    /// Why none is told: the uncertainties of the features are those of independent points.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub shared_noise_reason: Option<String>,
    /// Deviations of all that was measured from the reference, as in a comparison; null where the plan asks for none.
    pub deviation: Option<Comparison>,
    /// Why there are none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub deviation_reason: Option<String>,
    /// Deviations at places that are the same for every part, for the map of a trend; absent where it was not asked for.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub deviation_map: Option<PlaceMap>,
    /// The colors of the deviations; absent where there are none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub scale: Option<Scale>,
    /// How verdicts are reached: `simple` or `iso14253-1`.
    pub decision_rule: String,
    /// Number of characteristics by verdict.
    pub counts: Counts,
    /// The worst verdict of all characteristics and of the deviations; undecided where the alignment cannot be relied on, and where not all of the
    /// reference was read.
    pub verdict: Verdict,
    /// What makes all of it undecided; absent where nothing does.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub verdict_reasons: Vec<VerdictReason>,
}

/// The plan's file.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct PlanRecord {
    /// As given on the command line.
    pub path: String,
    /// SHA-256 of its bytes, hexadecimal.
    pub sha256: Option<String>,
}

/// How the measured data came to lie on the reference.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct AlignmentRecord {
    /// `none`, `given`, `best-fit`, `chebyshev`, `zones`, `datum`, `pairs` or `rps`.
    pub method: String,
    /// 4×4, row by row: takes measured coordinates to those of the reference.
    pub transform: [[f64; 4]; 4],
    /// Root mean square distance of the points that count, of a best fit (also one that datums began with), of pairs and of
    /// reference points; null of other ways.
    pub rms: Option<f64>,
    /// Their mean distance.
    pub mean_abs: Option<f64>,
    /// Of `chebyshev` the greatest distance of a point that counts: the least there is near the best fit.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub greatest: Option<f64>,
    /// Of `zones` how far the worst point of all is beyond its tolerance, negative where all are within: the least there is near the best fit
    /// where all count in the search.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub excess: Option<f64>,
    /// Of pairs the distance left of each, of reference points the signed one along its direction; absent of other ways.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub residuals: Option<Vec<f64>>,
    /// Of reference points, in the same order: how many millimeters the farthest corner of the part moves per millimeter of error; absent of other ways.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub amplifications: Option<Vec<f64>>,
    /// Points without a weight in the fit, also in the one that datums began with; absent of other ways. They are evaluated all the same.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub left_out: Option<u64>,
    /// Steps of the iteration.
    pub iterations: Option<u64>,
    /// Whether the iteration settled.
    pub converged: Option<bool>,
    /// What is to be said about it.
    pub warnings: Vec<AlignNote>,
}

impl AlignmentRecord {
    /// What makes it, and with it every value, unreliable. Other poses that fit as well are no such doubt: there each
    /// characteristic is judged by all of them.
    pub fn doubts(&self) -> impl Iterator<Item = &AlignNote> {
        self.warnings.iter().filter(|w| w.kind.0.is_doubt() && w.kind.0 != AlignNoteKind::Ambiguous)
    }
}

/// A feature as it was found.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct FeatureRecord {
    /// Its name.
    pub id: String,
    /// `point`, `line`, `plane`, `circle`, `sphere`, `cylinder`, `cone` or `torus`.
    pub shape: Word<Class>,
    /// Where it comes from: `points`, `nominal`, `seed`, `faces` or `derived`.
    pub source: Word<FeatureSource>,
    /// Number of its points.
    pub points: u64,
    /// Share of its nominal area that was measured.
    pub coverage: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub coverage_reason: Option<String>,
    /// How its element was associated.
    pub method: Word<FitMethod>,
    /// The element, by names, as in a fit; null where there is none.
    pub parameters: Option<BTreeMap<String, Number>>,
    /// Where it was measured, and its size; null where there is no element.
    #[serde(default)]
    pub measured: Option<MeasuredPlace>,
    /// The same as the model has it: the place of its nominal that is nearest to the measured one. Null where it has no nominal.
    #[serde(default)]
    pub nominal: Option<MeasuredPlace>,
    /// Standard uncertainty of each parameter by the points' scatter.
    pub uncertainty: Option<BTreeMap<String, Number>>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub uncertainty_reason: Option<String>,
    /// Greatest less least signed distance from the element.
    pub form_error: Option<f64>,
    /// Root mean square of the distances.
    pub rms: Option<f64>,
    /// Why there is no element, or no distance from it.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub reason: Option<String>,
    /// How near facets had to be to the nominal feature; absent where it was not sought by it.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub extract: Option<ExtractRecord>,
    /// Points of it in dents deeper than its extract distance; absent where there are none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub dents: Option<u64>,
    /// Measured points that it leaves out; absent where there are none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub left_out: Option<LeftOutRecord>,
    /// The faces of the reference that it is, where that is a CAD model; absent else.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub faces: Vec<FaceRecord>,
}

impl FeatureRecord {
    /// Points in deep dents and points that it leaves out, by what they are: those of which there are some.
    pub fn classes(&self) -> Vec<(&'static str, u64)> {
        let of = |o: &LeftOutRecord| {
            [
                ("class.edge", o.edge),
                ("class.broken", o.broken),
                ("class.deep", o.deep),
                ("class.high", o.high),
                ("class.between", o.between),
                ("class.outliers", o.outliers),
                ("class.beyond", o.beyond),
            ]
        };
        let mut all = vec![("class.dents", self.dents.unwrap_or(0))];
        all.extend(self.left_out.as_ref().map(of).into_iter().flatten());
        all.retain(|class| class.1 > 0);
        all
    }
}

/// Measured points that a feature leaves out.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct LeftOutRecord {
    /// Points within its reach of which it is not certain that they are of it: what each value would be with them, its characteristic tells.
    pub others: u64,
    /// Points on its edges, where scans are rounded: none of those.
    #[serde(default)]
    pub edge: u64,
    /// Those of them along its edges that no face explains: burrs, grooves, chamfers that are not drawn.
    #[serde(default)]
    pub broken: u64,
    /// Those of them that go on into the material beyond its extract distance: holes, deep dents.
    #[serde(default)]
    pub deep: u64,
    /// Those of them that go on out of the material: bumps, what stands on it.
    #[serde(default)]
    pub high: u64,
    /// Those of them between it and the other side of a wall, off both.
    #[serde(default)]
    pub between: u64,
    /// Points of a scan that stick out, with no more than two together: outliers.
    #[serde(default)]
    pub outliers: u64,
    /// Points that lie where the feature is, but farther off than its extract distance.
    pub beyond: u64,
    /// How far off the farthest of these is; null where there are none.
    pub farthest: Option<f64>,
    /// Whether a reference has the feature. Else nothing but the points tells of these.
    pub on_reference: bool,
}

/// How near facets had to be to the nominal feature.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct ExtractRecord {
    /// Greatest distance.
    pub distance: f64,
    /// Greatest angle between the normals, degrees.
    pub angle: f64,
    /// What was left out along the bounds.
    pub margin: f64,
    /// Whether vertices that other facets share counted.
    pub rim: bool,
    /// Least share of the nominal area that had to be measured.
    pub coverage: f64,
}

/// A characteristic with its verdict.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct CharacteristicRecord {
    /// Its name.
    pub id: String,
    /// What it is: `flatness`, `position`, …
    pub kind: String,
    /// Its sign on drawings, where it has one.
    pub symbol: String,
    /// The toleranced feature; of a size of two planes, both, with a dash between.
    pub feature: String,
    /// The datums, the first one first: `A`, a common datum `A-B`, with a material requirement `A(M)`.
    pub datums: Vec<String>,
    /// What modifies it: the tolerance class, the size, the offset of the zone, the intersection planes, the material requirement, the
    /// datums' association, the parameter.
    pub modifiers: Vec<String>,
    /// Form of the zone: `width`, `diameter` or `value` (a dimension or parameter).
    pub zone: Word<ZoneForm>,
    /// Nominal value of a dimension.
    pub nominal: Option<f64>,
    /// Width or diameter of the zone; the greatest allowed value.
    pub tolerance: Option<f64>,
    /// Least allowed value of a dimension.
    pub lower: Option<f64>,
    /// Greatest allowed value; with a material requirement, the tolerance and its bonus.
    pub upper: f64,
    /// The value; millimeters, degrees for an angle.
    pub value: Option<f64>,
    /// Unit of the value: `mm`, `deg`, or `1` for a ratio.
    pub unit: String,
    /// Expanded uncertainty of the value (k = 2): value less and plus this hold the true one. Null where the plan states neither it nor the
    /// noise of the points.
    pub uncertainty: Option<f64>,
    /// Where it comes from: `plan`, `noise`, or `plan and noise`.
    pub uncertainty_source: Option<String>,
    /// What noise adds to the value on the average, where it leads away from the true one to one side: the interval lies about the value
    /// less this. It is not taken off the value. Absent where noise adds nothing.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub noise_bias: Option<f64>,
    /// From and to where the true value lies: about the value less `noise_bias`, longer where little is known of the form below the noise.
    /// What `iso14253-1` decides by. Absent where there is no uncertainty.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub interval: Option<[f64; 2]>,
    /// How the verdict was reached.
    pub decision_rule: String,
    /// The verdict.
    pub verdict: Verdict,
    /// Why there is no value.
    pub reason: Option<String>,
    /// Share of what is allowed that the value takes up; 1 is at a limit.
    #[serde(rename = "utilisation")]
    pub utilization: Option<f64>,
    /// Places where the value is reached.
    pub witness: Vec<[f64; 3]>,
    /// Where a leader may end: on the feature.
    pub anchor: Option<[f64; 3]>,
    /// Further numbers.
    pub parts: BTreeMap<String, f64>,
    /// Of a position or a profile: where its feature lies, in the frame of its true place; absent of other kinds.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub place: Option<PlaceRecord>,
    /// The value with the points of its features and datums of which it is not certain whose they are; absent where there are none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub value_with_others: Option<f64>,
    /// What the reader should know.
    pub notes: Vec<String>,
    /// The standard and clause that define it.
    pub standard: String,
}

/// Where a feature's points come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeatureSource {
    /// A file of its own.
    Points,
    /// The measured data about its nominal element.
    Nominal,
    /// The measured data about the surface of the reference that a seed lies on.
    Seed,
    /// The measured data about faces of a CAD model.
    Faces,
    /// Other features.
    Derived,
}

named!(
    FeatureSource,
    "source of a feature",
    [
        FeatureSource::Points,
        FeatureSource::Nominal,
        FeatureSource::Seed,
        FeatureSource::Faces,
        FeatureSource::Derived
    ],
    |source| match source {
        FeatureSource::Points => "points",
        FeatureSource::Nominal => "nominal",
        FeatureSource::Seed => "seed",
        FeatureSource::Faces => "faces",
        FeatureSource::Derived => "derived",
    }
);

/// Form of the zone of a characteristic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ZoneForm {
    /// Between two lines, planes or surfaces.
    Width,
    /// Within a circle, cylinder or sphere.
    Diameter,
    /// None: a dimension or parameter.
    Value,
}

named!(
    ZoneForm,
    "form of a zone",
    [ZoneForm::Width, ZoneForm::Diameter, ZoneForm::Value],
    |form| match form {
        ZoneForm::Width => "width",
        ZoneForm::Diameter => "diameter",
        ZoneForm::Value => "value",
    }
);

impl CharacteristicRecord {
    /// Whether the zone is a diameter.
    pub fn diametral(&self) -> bool {
        *self.zone == ZoneForm::Diameter
    }

    /// The toleranced features: one, or two planes of a size.
    pub fn features(&self) -> Vec<&str> {
        self.feature.split(JOINED).collect()
    }

    /// Which size (`GG`) and where the zone of a profile lies (`UZ`, `OZ`), by the letters of drawings.
    pub fn letters(&self) -> impl Iterator<Item = &str> {
        let of = |m: &&str| matches!(*m, "UZ" | "OZ") || SizeWord::ALL.iter().any(|s| s.word() == *m);
        self.modifiers.iter().filter_map(|m| m.split(' ').next()).filter(of)
    }

    /// Which parameter of a texture (`Sa`).
    pub fn parameter(&self) -> Option<&str> {
        let is_one = |m: &&String| TextureWord::ALL.iter().any(|p| p.word() == *m);
        self.modifiers.iter().find(is_one).map(String::as_str)
    }

    /// Its kind with all that modifies it but the associations that are usual: what tells characteristics of one kind on one
    /// feature apart, as in `size h9 GX`.
    pub fn kind_in_full(&self) -> String {
        let unusual = |m: &&String| !USUAL.contains(&m.as_str());
        let words: Vec<&str> = std::iter::once(&self.kind)
            .chain(self.modifiers.iter().filter(unusual))
            .map(String::as_str)
            .collect();
        words.join(" ")
    }

    /// Tolerance and material requirement, where the greatest allowed value is not the tolerance alone.
    pub fn requirement(&self) -> Option<(f64, MaterialWord)> {
        let stands = |word: &MaterialWord| self.modifiers.iter().any(|m| m == word.symbol());
        self.tolerance.zip([MaterialWord::M, MaterialWord::L].into_iter().find(stands))
    }
}

/// Number of characteristics by verdict.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Counts {
    /// Conforming.
    pub pass: u64,
    /// Not conforming.
    pub fail: u64,
    /// Within the uncertainty of a limit.
    pub undecided: u64,
    /// Without a value.
    pub not_measured: u64,
}

impl ResultDocument for InspectDocument {
    /// Whether all of it passes.
    fn conforms(&self) -> bool {
        self.verdict == Verdict::Pass
    }
}

impl InspectDocument {
    /// The characteristics in the order in which people look at them: by verdict, the worst first, then those that take up
    /// most of what is allowed.
    pub fn rows(&self) -> Vec<&CharacteristicRecord> {
        let mut rows: Vec<&CharacteristicRecord> = self.characteristics.iter().collect();
        let used = |c: &CharacteristicRecord| c.utilization.unwrap_or(0.0);
        rows.sort_by(|a, b| rank(b.verdict).cmp(&rank(a.verdict)).then(used(b).total_cmp(&used(a))));
        rows
    }

    /// The worst verdict on each feature that has one, by its name.
    pub fn worst(&self) -> BTreeMap<&str, Verdict> {
        let mut worst: BTreeMap<&str, Verdict> = BTreeMap::new();
        for (feature, verdict) in
            self.characteristics.iter().flat_map(|c| c.features().into_iter().map(|f| (f, c.verdict)))
        {
            let known = worst.entry(feature).or_insert(verdict);
            if rank(verdict) > rank(*known) {
                *known = verdict;
            }
        }
        worst
    }
}

/// Modifiers that every characteristic has whose plan says nothing else.
const USUAL: [&str; 2] = ["minimum-zone", "datums gaussian"];

/// Between the names of two features.
pub const JOINED: &str = " – ";
