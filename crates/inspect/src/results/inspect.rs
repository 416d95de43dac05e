//! `trueness/inspect/1`: a plan, evaluated.

use super::align::AlignNote;
use super::compare::{Comparison, Warning, WarningKind};
use super::fit::{Number, named, uncertainty};
use super::{InputRecord, Role, UNITS, VERSION, Verdict};
use super::{overall, rank};
use crate::characteristic::Value;
use crate::compare;
use crate::inspection::decision::{utilisation, verdict};
use crate::inspection::{Element, Found, Inspection, Taken};
use crate::plan::text::MaterialWord;
use crate::plan::{Limits, Plan, Source, Spec};
use crate::scale::Scale;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use trueness_geom::fit::Method;
use trueness_geom::zone::datum::{Datum, Rule as DatumRule};

/// Name of this document's schema.
pub const SCHEMA: &str = "trueness/inspect/1";

/// The whole document. Lengths in millimetres, angles of features in radians, of characteristics in degrees.
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
    /// Deviations of all that was measured from the reference, as in a comparison; null where the plan asks for none.
    pub deviation: Option<Comparison>,
    /// Why there are none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub deviation_reason: Option<String>,
    /// The colors of the deviations; absent where there are none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub scale: Option<Scale>,
    /// How verdicts are reached: `simple` or `iso14253-1`.
    pub decision_rule: String,
    /// Number of characteristics by verdict.
    pub counts: Counts,
    /// The worst verdict of all characteristics and of the deviations.
    pub verdict: Verdict,
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
    /// `none`, `given`, `best-fit`, `datum`, `pairs` or `rps`.
    pub method: String,
    /// 4×4, row by row: takes measured coordinates to those of the reference.
    pub transform: [[f64; 4]; 4],
    /// Root mean square distance of the points that count, of a best fit (also one that datums began with), of pairs and of
    /// reference points; null of other ways.
    pub rms: Option<f64>,
    /// Their mean distance.
    pub mean_abs: Option<f64>,
    /// Of pairs the distance left of each, of reference points the signed one along its direction; absent of other ways.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub residuals: Option<Vec<f64>>,
    /// Steps of the iteration.
    pub iterations: Option<u64>,
    /// Whether the iteration settled.
    pub converged: Option<bool>,
    /// What is to be said about it.
    pub warnings: Vec<AlignNote>,
}

impl AlignmentRecord {
    fn new(plan: &Plan, found: &Inspection) -> AlignmentRecord {
        let bare = AlignmentRecord {
            method: plan.align.word().into(),
            transform: found.alignment.motion.matrix(),
            rms: None,
            mean_abs: None,
            residuals: None,
            iterations: None,
            converged: None,
            warnings: vec![],
        };
        let mut record = match &found.alignment.found {
            Found::Nothing => bare,
            Found::BestFit(fit) => AlignmentRecord {
                rms: Some(fit.rms),
                mean_abs: Some(fit.mean_abs),
                iterations: Some(fit.iterations as u64),
                converged: Some(fit.converged),
                warnings: fit.warnings.iter().map(AlignNote::of).collect(),
                ..bare
            },
            Found::Rows(fit) => AlignmentRecord {
                rms: Some(fit.rms),
                mean_abs: Some(
                    fit.residuals.iter().map(|r| r.abs()).sum::<f64>() / fit.residuals.len() as f64,
                ),
                residuals: Some(fit.residuals.clone()),
                iterations: Some(fit.iterations as u64),
                converged: Some(fit.converged),
                ..bare
            },
        };
        record.warnings.extend(found.doubts.iter().map(doubt));
        record
    }
}

/// What makes it unlikely that the data are of the part.
fn doubt(warning: &Warning) -> AlignNote {
    let kind = match warning.kind {
        WarningKind::SizeRatio => "size_ratio",
        WarningKind::HardlyOverlapping => "hardly_overlapping",
    };
    AlignNote { kind: kind.into(), text: warning.text.clone() }
}

/// A feature as it was found.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct FeatureRecord {
    /// Its name.
    pub id: String,
    /// `point`, `line`, `plane`, `circle`, `sphere`, `cylinder`, `cone` or `torus`.
    pub shape: String,
    /// Where it comes from: `points`, `nominal`, `seed` or `derived`.
    pub source: String,
    /// Number of its points.
    pub points: u64,
    /// Share of its nominal area that was measured.
    pub coverage: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub coverage_reason: Option<String>,
    /// How its element was associated.
    pub method: String,
    /// The element, by names, as in a fit; null where there is none.
    pub parameters: Option<BTreeMap<String, Number>>,
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
    /// What modifies it: the tolerance class, the size, the material requirement, the datums' association, the parameter.
    pub modifiers: Vec<String>,
    /// Form of the zone: `width`, `diameter` or `value` (a dimension or parameter).
    pub zone: String,
    /// Nominal value of a dimension.
    pub nominal: Option<f64>,
    /// Width or diameter of the zone; the greatest allowed value.
    pub tolerance: Option<f64>,
    /// Least allowed value of a dimension.
    pub lower: Option<f64>,
    /// Greatest allowed value; with a material requirement, the tolerance and its bonus.
    pub upper: f64,
    /// The value; millimetres, degrees for an angle.
    pub value: Option<f64>,
    /// Unit of the value: `mm`, `deg`, or `1` for a ratio.
    pub unit: String,
    /// Expanded uncertainty of the value (k = 2); null where the plan gives none.
    pub uncertainty: Option<f64>,
    /// How the verdict was reached.
    pub decision_rule: String,
    /// The verdict.
    pub verdict: Verdict,
    /// Why there is no value.
    pub reason: Option<String>,
    /// Share of what is allowed that the value takes up; 1 is at a limit.
    pub utilisation: Option<f64>,
    /// Places where the value is reached.
    pub witness: Vec<[f64; 3]>,
    /// Where a leader may end: on the feature.
    pub anchor: Option<[f64; 3]>,
    /// Further numbers.
    pub parts: BTreeMap<String, f64>,
    /// What the reader should know.
    pub notes: Vec<String>,
    /// The standard and clause that define it.
    pub standard: String,
}

impl CharacteristicRecord {
    /// Tolerance and sign of a material requirement, where the greatest allowed value is not the tolerance alone.
    pub fn requirement(&self) -> Option<(f64, &str)> {
        let signs = [MaterialWord::M, MaterialWord::L].map(MaterialWord::symbol);
        let sign = self.modifiers.iter().map(String::as_str).find(|m| signs.contains(m));
        self.tolerance.zip(sign)
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

impl InspectDocument {
    /// The document of what was found by a plan.
    pub fn new(
        plan: &Plan,
        record: PlanRecord,
        found: &Inspection,
        inputs: Vec<InputRecord>,
    ) -> InspectDocument {
        let characteristics: Vec<CharacteristicRecord> =
            plan.specs.iter().zip(&found.values).map(|(s, v)| characteristic(plan, found, s, v)).collect();
        let (deviation, scale) = deviation(found, &inputs).unzip();
        let count = |verdict| characteristics.iter().filter(|c| c.verdict == verdict).count() as u64;
        InspectDocument {
            schema: SCHEMA.into(),
            version: VERSION.into(),
            units: UNITS.into(),
            title: plan.title.clone(),
            plan: record,
            inputs,
            alignment: AlignmentRecord::new(plan, found),
            features: plan.features.iter().zip(&found.features).map(|(p, t)| feature(p, t)).collect(),
            deviation_reason: deviation.is_none().then(|| "the plan has no [deviation]".into()),
            decision_rule: plan.decision.rule.word().into(),
            counts: Counts {
                pass: count(Verdict::Pass),
                fail: count(Verdict::Fail),
                undecided: count(Verdict::Undecided),
                not_measured: count(Verdict::NotMeasured),
            },
            verdict: overall(
                characteristics.iter().map(|c| c.verdict).chain(deviation.as_ref().and_then(|d| d.verdict)),
            ),
            characteristics,
            deviation,
            scale,
        }
    }
}

impl InspectDocument {
    /// The characteristics in the order in which people look at them: by verdict, the worst first, then those that take up
    /// most of what is allowed.
    pub fn rows(&self) -> Vec<&CharacteristicRecord> {
        let mut rows: Vec<&CharacteristicRecord> = self.characteristics.iter().collect();
        let used = |c: &CharacteristicRecord| c.utilisation.unwrap_or(0.0);
        rows.sort_by(|a, b| rank(b.verdict).cmp(&rank(a.verdict)).then(used(b).total_cmp(&used(a))));
        rows
    }

    /// The worst verdict on a feature; `None` where none is on it.
    pub fn worst_of(&self, feature: &str) -> Option<Verdict> {
        let on = self.characteristics.iter().filter(|c| c.feature.split(JOINED).any(|f| f == feature));
        on.map(|c| c.verdict).max_by_key(|v| rank(*v))
    }
}

/// The deviations as a comparison tells them, with the scale of their colors.
fn deviation(found: &Inspection, inputs: &[InputRecord]) -> Option<(Comparison, Scale)> {
    let deviations = found.deviations.as_ref()?;
    let file = |role| inputs.iter().find(|i| i.role == role).cloned();
    let files = [file(Role::Measured), file(Role::Reference)].into_iter().flatten().collect();
    let inputs = compare::Inputs { files, kind: deviations.kind, scale: None, reverse: vec![] };
    let mut document = compare::document(&deviations.found, inputs, &deviations.options);
    Some((document.comparisons.pop()?, document.scale))
}

/// Between the names of two features.
const JOINED: &str = " – ";

fn feature(plan: &crate::plan::Feature, taken: &Taken) -> FeatureRecord {
    let fit = match &taken.element {
        Ok(Element::Fit(fit)) => Some(fit.as_ref()),
        _ => None,
    };
    let (u, u_reason) = match fit {
        Some(fit) => uncertainty(fit),
        None => (None, Some("there is no fitted element".into())),
    };
    let ray = |point, key: &str, direction| {
        Some(BTreeMap::from([("point".into(), Number::Three(point)), (key.into(), Number::Three(direction))]))
    };
    let parameters = match &taken.element {
        Ok(Element::Fit(fit)) => Some(named(fit.shape.parameters())),
        Ok(Element::Point(p) | Element::Derived(Datum::Point(p))) => {
            Some(BTreeMap::from([("point".into(), Number::Three(*p))]))
        }
        Ok(Element::Derived(Datum::Plane { point, normal })) => ray(*point, "normal", *normal),
        Ok(Element::Derived(Datum::Axis { point, direction })) => ray(*point, "direction", *direction),
        Err(_) => None,
    };
    let (source, extract) = match plan.source {
        Source::Points(_) => ("points", None),
        Source::Derived { .. } => ("derived", None),
        Source::Nominal => ("nominal", extract(plan, taken)),
        Source::Seed(_) => ("seed", extract(plan, taken)),
    };
    FeatureRecord {
        id: taken.id.clone(),
        shape: taken.class.word().into(),
        source: source.into(),
        points: taken.points.len() as u64,
        coverage: taken.coverage,
        coverage_reason: taken
            .coverage
            .is_none()
            .then(|| "there is no nominal area, or no measured one".into()),
        method: plan.method.name().into(),
        parameters,
        uncertainty: u,
        uncertainty_reason: u_reason,
        form_error: fit.map(|f| f.residuals.form_error),
        rms: fit.map(|f| f.residuals.rms),
        reason: taken.element.as_ref().err().cloned(),
        extract,
    }
}

/// How near facets had to be to the nominal.
fn extract(plan: &crate::plan::Feature, taken: &Taken) -> Option<ExtractRecord> {
    let near = plan.extract.near(taken.nominal.as_ref()?);
    let (distance, margin, rim, coverage) = (near.distance, near.margin, near.rim, plan.extract.coverage);
    Some(ExtractRecord { distance, angle: near.angle.to_degrees(), margin, rim, coverage })
}

fn characteristic(
    plan: &Plan,
    found: &Inspection,
    spec: &Spec,
    value: &Result<Value, String>,
) -> CharacteristicRecord {
    let id = |n: &usize| plan.features[*n].id.clone();
    let rule = plan.decision.rule;
    let measured = value.as_ref().ok();
    let (nominal, tolerance) = match spec.limits {
        Limits::Greatest(t) => (None, Some(t)),
        Limits::Between { nominal, .. } => (Some(nominal), None),
    };
    let limits = spec.limits.widened(measured.map_or(0.0, |v| v.bonus));
    let (lower, upper) = limits.range();
    let zone = match (nominal, measured) {
        (Some(_), _) => "value",
        _ if spec.kind.word() == "texture" => "value",
        (None, Some(v)) if v.diametral => "diameter",
        _ => "width",
    };
    let first = spec.features.first().and_then(|n| found.features[*n].zoned().ok());
    let anchor = measured.and_then(|v| v.witness.first().copied());
    let left_out = left_out(found, spec);
    CharacteristicRecord {
        id: spec.id.clone(),
        kind: spec.kind.word().into(),
        symbol: spec.kind.symbol().into(),
        feature: spec.features.iter().map(id).collect::<Vec<_>>().join(JOINED),
        datums: spec.datums.iter().map(|d| d.name(&plan.features)).collect(),
        modifiers: modifiers(spec),
        zone: zone.into(),
        nominal,
        tolerance,
        lower,
        upper,
        value: measured.map(|v| v.value),
        unit: spec.unit().into(),
        uncertainty: spec.uncertainty,
        decision_rule: rule.word().into(),
        verdict: measured.map_or(Verdict::NotMeasured, |v| {
            let found = verdict(v.value, &limits, rule, spec.uncertainty);
            if found == Verdict::Pass && !left_out.is_empty() { Verdict::Undecided } else { found }
        }),
        reason: value.as_ref().err().cloned(),
        utilisation: measured.and_then(|v| utilisation(v.value, &limits)),
        witness: measured.map_or(vec![], |v| v.witness.clone()),
        anchor: anchor.or_else(|| first.and_then(|p| p.first().copied())),
        parts: measured
            .map_or(BTreeMap::new(), |v| v.parts.iter().map(|(k, x)| (k.to_string(), *x)).collect()),
        notes: measured.map_or(vec![], |v| v.notes.iter().cloned().chain(left_out).collect()),
        standard: spec.kind.standard().into(),
    }
}

/// A note for each feature and datum of a characteristic that leaves out points which lie where the reference has it: nothing is
/// proven by the others alone.
fn left_out(found: &Inspection, spec: &Spec) -> Vec<String> {
    let datums = spec.datums.iter().flat_map(|d| &d.features);
    let mut numbers: Vec<usize> = spec.features.iter().chain(datums).copied().collect();
    numbers.sort_unstable();
    numbers.dedup();
    let note = |n: usize| {
        let (taken, out) = (&found.features[n], found.features[n].left_out?);
        Some(format!(
            "feature \"{}\": {} measured points, up to {:.3} mm off, lie where the reference has it and are left out as farther \
             than its extract distance of {:.3} mm; give a larger one to judge them",
            taken.id, out.points, out.farthest, out.limit
        ))
    };
    numbers.into_iter().filter_map(note).collect()
}

/// What modifies a characteristic, as words.
fn modifiers(spec: &Spec) -> Vec<String> {
    let mut all = Vec::new();
    all.extend(spec.class.clone());
    if let Some(size) = spec.size {
        all.push(size.word().to_string());
    }
    all.extend(spec.material.map(|m| m.symbol().to_string()));
    if spec.kind.word() == "texture" {
        all.push(spec.parameter.word().to_string());
    }
    if spec.kind.keys().contains(&"method") {
        all.push(if spec.form == Method::Gaussian { "gaussian" } else { "minimum-zone" }.to_string());
    }
    if !spec.datums.is_empty() {
        let rule = if spec.datum_rule == DatumRule::Gaussian { "gaussian" } else { "minimum-zone" };
        all.push(format!("datums {rule}"));
    }
    if spec.axial {
        all.push("axial".into());
    }
    all
}
