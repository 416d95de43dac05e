//! From what was found by a plan to the result document.

use super::decision::{utilization, verdict};
use super::{Element, Found, Inspection, MeasuredFeature, Uncertainty, excluded_points};
use crate::align::{note, notes_of_rows, notes_of_search};
use crate::characteristic::{
    Characteristic, FrameOf, NoElement, NotMeasured, Place, Question, Spec, Texture, Value, nearest,
};
use crate::compare;
use crate::fit::{named, uncertainty};
use crate::noise::{NoiseOrReason, points_per_independent, record as noise_record};
use crate::plan::Plan;
use crate::requirement::{Limits, Source, ZoneOffset};
use crate::words::ToWord;
use std::collections::BTreeMap;
use trueness_document::align::{AlignNote, AlignNoteKind};
use trueness_document::compare::{Comparison, Warning, WarningKind};
use trueness_document::fit::Number;
use trueness_document::inspect::*;
use trueness_document::scale::Scale;
use trueness_document::{InputRecord, Role, UNITS, VERSION, Verdict, VerdictReason, Word, overall};
use trueness_geom::feature::Nominal;
use trueness_geom::fit::Method;
use trueness_geom::shape::Shape;
use trueness_geom::zone::datum::{Datum, Rule as DatumRule};

/// The document of what was found by a plan.
pub fn document(
    plan: &Plan,
    record: PlanRecord,
    found: &Inspection,
    inputs: Vec<InputRecord>,
) -> InspectDocument {
    let characteristics: Vec<CharacteristicRecord> =
        (0..plan.specs.len()).map(|n| characteristic(plan, found, n)).collect();
    let alignment = alignment_record(plan, found);
    let (deviation, scale) = deviation(found, &inputs, &alignment).unzip();
    let doubts = doubts(&alignment, &inputs);
    let (shared_noise, shared_noise_reason) = noise_record(&found.noise);
    let count = |verdict| characteristics.iter().filter(|c| c.verdict == verdict).count() as u64;
    let verdict = match doubts.is_empty() {
        true => overall(
            (characteristics.iter().map(|c| c.verdict)).chain(deviation.as_ref().and_then(|d| d.verdict)),
        ),
        // The values may be those of another pose or another face.
        false => Verdict::Undecided,
    };
    let open = deviation.as_ref().filter(|d| d.verdict == Some(Verdict::Undecided));
    let of_deviation = open.map_or(vec![], |d| d.verdict_reasons.clone());
    InspectDocument {
        schema: SCHEMA.into(),
        version: VERSION.into(),
        units: UNITS.into(),
        title: plan.title.clone(),
        plan: record,
        inputs,
        alignment,
        features: plan
            .features
            .iter()
            .zip(&found.features)
            .zip(&found.faces)
            .map(|((p, t), faces)| FeatureRecord { faces: faces.clone(), ..feature(p, t, &found.noise) })
            .collect(),
        shared_noise,
        shared_noise_reason,
        deviation_reason: deviation.is_none().then(|| "the plan has no [deviation]".into()),
        decision_rule: plan.decision.rule.word().into(),
        counts: Counts {
            pass: count(Verdict::Pass),
            fail: count(Verdict::Fail),
            undecided: count(Verdict::Undecided),
            not_measured: count(Verdict::NotMeasured),
        },
        verdict,
        verdict_reasons: match (verdict, doubts.is_empty()) {
            (Verdict::Undecided, true) => of_deviation,
            _ => doubts,
        },
        characteristics,
        deviation,
        deviation_map: None,
        scale,
    }
}

/// What makes every value doubtful: an alignment that cannot be relied on, a reference that was not read in whole.
fn doubts(alignment: &AlignmentRecord, inputs: &[InputRecord]) -> Vec<VerdictReason> {
    let kinds: Vec<AlignNoteKind> = alignment.doubts().map(|note| *note.kind).collect();
    let references = inputs.iter().filter(|i| i.role == Role::Reference);
    compare::unreliable_alignment(&kinds)
        .into_iter()
        .chain(references.filter_map(compare::incomplete))
        .collect()
}

fn alignment_record(plan: &Plan, found: &Inspection) -> AlignmentRecord {
    let bare = AlignmentRecord {
        method: plan.align.word().into(),
        transform: found.alignment.motion.matrix(),
        rms: None,
        mean_abs: None,
        greatest: None,
        excess: None,
        residuals: None,
        amplifications: None,
        left_out: None,
        iterations: None,
        converged: None,
        warnings: vec![],
    };
    let mut record = match &found.alignment.found {
        Found::Nothing => bare,
        Found::BestFit(fit) => AlignmentRecord {
            rms: Some(fit.rms),
            mean_abs: Some(fit.mean_abs),
            left_out: Some(fit.excluded_points),
            iterations: Some(fit.iterations as u64),
            converged: Some(fit.converged),
            warnings: fit.warnings.iter().map(note).collect(),
            ..bare
        },
        Found::Chebyshev(minimax, fit) => AlignmentRecord {
            rms: Some(minimax.rms),
            mean_abs: Some(minimax.mean_abs),
            greatest: Some(minimax.greatest),
            left_out: Some(minimax.not_counted.count),
            iterations: Some(fit.iterations as u64),
            converged: Some(fit.converged),
            warnings: notes_of_search(fit, &minimax.not_counted),
            ..bare
        },
        Found::Zones(zones, fit) => AlignmentRecord {
            rms: Some(zones.rms),
            mean_abs: Some(zones.mean_abs),
            excess: Some(zones.excess),
            left_out: Some(zones.not_counted.count),
            iterations: Some(fit.iterations as u64),
            converged: Some(fit.converged),
            warnings: notes_of_search(fit, &zones.not_counted),
            ..bare
        },
        Found::Rows(fit, corners) => AlignmentRecord {
            rms: Some(fit.rms),
            mean_abs: Some(fit.residuals.iter().map(|r| r.abs()).sum::<f64>() / fit.residuals.len() as f64),
            residuals: Some(fit.residuals.clone()),
            amplifications: Some(fit.amplifications(corners)).filter(|by| !by.is_empty()),
            iterations: Some(fit.iterations as u64),
            converged: Some(fit.converged),
            warnings: notes_of_rows(fit, corners),
            ..bare
        },
    };
    record.warnings.extend(found.doubts.iter().map(doubt));
    record
}

/// What makes it unlikely that the data are of the part.
fn doubt(warning: &Warning) -> AlignNote {
    let kind = match warning.kind {
        WarningKind::SizeRatio => AlignNoteKind::SizeRatio,
        WarningKind::HardlyOverlapping => AlignNoteKind::HardlyOverlapping,
    };
    AlignNote { kind: Word(kind), text: warning.text.clone() }
}

/// The deviations as a comparison tells them, with the scale of their colors.
fn deviation(
    found: &Inspection,
    inputs: &[InputRecord],
    alignment: &AlignmentRecord,
) -> Option<(Comparison, Scale)> {
    let deviations = found.deviations.as_ref()?;
    let file = |role| inputs.iter().find(|i| i.role == role).cloned();
    let files = [file(Role::Measured), file(Role::Reference)].into_iter().flatten().collect();
    let inputs = compare::Inputs {
        files,
        kind: deviations.kind,
        scale: None,
        reverse: vec![],
        alignment: None,
        // Of poses that fit as well each characteristic takes the one that suits it; the deviations are those of one.
        doubts: alignment.warnings.iter().map(|note| *note.kind).filter(|kind| kind.is_doubt()).collect(),
    };
    let mut document = compare::document(&deviations.found, inputs, &deviations.options);
    Some((document.comparisons.pop()?, document.scale))
}

fn feature(
    plan: &crate::requirement::Feature,
    taken: &MeasuredFeature,
    noise: &NoiseOrReason,
) -> FeatureRecord {
    let fit = match &taken.element {
        Ok(Element::Fit(fit)) => Some(fit.as_ref()),
        _ => None,
    };
    // Points of files are probed one by one.
    let shared = match plan.source {
        Source::Nominal | Source::Seed(_) | Source::Faces(_) => points_per_independent(noise),
        Source::Points(_) | Source::Derived { .. } => 1.0,
    };
    let (u, u_reason) = match fit {
        Some(fit) => uncertainty(fit, shared),
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
        Source::Points(_) => (FeatureSource::Points, None),
        Source::Derived { .. } => (FeatureSource::Derived, None),
        Source::Nominal => (FeatureSource::Nominal, extract(plan, taken)),
        Source::Seed(_) => (FeatureSource::Seed, extract(plan, taken)),
        Source::Faces(_) => (FeatureSource::Faces, extract(plan, taken)),
    };
    FeatureRecord {
        id: taken.id.clone(),
        shape: Word(taken.class),
        source: Word(source),
        points: taken.points.len() as u64,
        coverage: taken.coverage,
        coverage_reason: taken
            .coverage
            .is_none()
            .then(|| "there is no nominal area, or no measured one".into()),
        method: plan.method.word(),
        parameters,
        measured: measured_place(taken),
        nominal: nominal_place(taken),
        uncertainty: u,
        uncertainty_reason: u_reason,
        form_error: fit.map(|f| f.residuals.form_error),
        rms: fit.map(|f| f.residuals.rms),
        reason: taken.element.as_ref().err().map(NoElement::to_string),
        extract,
        dents: (taken.others.dents > 0).then_some(taken.others.dents as u64),
        left_out: left_out_record(taken),
        faces: vec![],
    }
}

/// Where a feature was measured, and its size.
fn measured_place(taken: &MeasuredFeature) -> Option<MeasuredPlace> {
    let place = taken.middle().ok().or(match &taken.element {
        Ok(Element::Derived(Datum::Axis { point, .. } | Datum::Plane { point, .. })) => Some(*point),
        _ => None,
    });
    let shape = taken.shape().ok();
    Some(MeasuredPlace {
        place: place?,
        diameter: shape.and_then(|s| match s {
            Shape::Cylinder { radius, .. }
            | Shape::Sphere { radius, .. }
            | Shape::Circle { radius, .. }
            | Shape::Circle2 { radius, .. } => Some(2.0 * radius),
            _ => None,
        }),
        angle: shape.and_then(|s| match s {
            Shape::Cone { half_angle, .. } => Some(2.0 * half_angle.to_degrees()),
            _ => None,
        }),
    })
}

/// Where the model has a feature, nearest to where it was measured.
fn nominal_place(taken: &MeasuredFeature) -> Option<MeasuredPlace> {
    let nominal = taken.nominal.as_ref()?;
    let place = measured_place(taken).map(|m| m.place).or_else(|| nominal.places().first().copied());
    Some(MeasuredPlace {
        place: nearest(nominal, place?)?,
        diameter: match nominal {
            Nominal::Cylinder { radius, .. } | Nominal::Sphere { radius, .. } => Some(2.0 * radius),
            _ => None,
        },
        angle: match nominal {
            Nominal::Cone { half_angle, .. } => Some(2.0 * half_angle.to_degrees()),
            _ => None,
        },
    })
}

fn left_out_record(taken: &MeasuredFeature) -> Option<LeftOutRecord> {
    let (of, beyond) = (&taken.others, taken.left_out);
    let others = of.points.len() as u64;
    (others + (of.edge + of.outliers) as u64 > 0 || beyond.is_some()).then(|| LeftOutRecord {
        others,
        edge: of.edge as u64,
        broken: of.broken as u64,
        deep: of.deep as u64,
        high: of.high as u64,
        between: of.between as u64,
        outliers: of.outliers as u64,
        beyond: beyond.map_or(0, |b| b.points),
        farthest: beyond.map(|b| b.farthest),
        on_reference: of.on_reference,
    })
}

/// How near facets had to be to the nominal.
fn extract(plan: &crate::requirement::Feature, taken: &MeasuredFeature) -> Option<ExtractRecord> {
    let near = plan.near(taken.nominal.as_ref()?);
    let (distance, margin, rim, coverage) = (near.distance, near.margin, near.rim, plan.extract.coverage);
    Some(ExtractRecord { distance, angle: near.angle.to_degrees(), margin, rim, coverage })
}

/// Told of a value whose uncertainty by noise could not be found.
const UNKNOWN_UNCERTAINTY: &str =
    "its uncertainty is not known: fewer than nine in ten draws of the noise gave a finite value";

/// What is to be said where the plan has a value's uncertainty found, and it was not.
fn unknown(plan: &Plan, found: &Inspection, n: usize) -> Option<String> {
    let source =
        plan.decision.noise.filter(|_| found.values[n].is_ok() && found.uncertainties[n].is_none())?;
    Some(match source.noise(&found.noise) {
        Ok(_) => UNKNOWN_UNCERTAINTY.to_string(),
        Err(why) => {
            format!(
                "its uncertainty is not known, as the noise is not: {why}; give the `noise` in [decision]"
            )
        }
    })
}

fn characteristic(plan: &Plan, found: &Inspection, n: usize) -> CharacteristicRecord {
    let (spec, value) = (&found.specs[n], &found.values[n]);
    let id = |n: &usize| plan.features[*n].id.clone();
    let rule = plan.decision.rule;
    let measured = value.as_ref().ok();
    let (nominal, tolerance) = match spec.limits {
        Limits::Greatest(t) => (None, Some(t)),
        Limits::Between { nominal, .. } => (Some(nominal), None),
    };
    let limits = spec.limits.widened(measured.map_or(0.0, |v| v.bonus));
    let (lower, upper) = limits.range();
    let planar = spec.features.first().is_some_and(|n| found.features[*n].planar);
    let diametral = spec.kind.diametral(&Question { spec, features: &plan.features }, planar);
    let zone = match nominal {
        Some(_) => ZoneForm::Value,
        None if spec.kind.word() == Texture.word() => ZoneForm::Value,
        None if diametral => ZoneForm::Diameter,
        None => ZoneForm::Width,
    };
    let first = spec.features.first().and_then(|n| found.features[*n].zoned().ok());
    let anchor = measured.and_then(|v| v.witness.first().copied());
    let uncertainty = found.uncertainties[n];
    let judged = |value: &Result<Value, NotMeasured>| {
        value.as_ref().map_or(Verdict::NotMeasured, |v| {
            verdict(v.value, &spec.limits.widened(v.bonus), rule, uncertainty.map(|u| u.sides))
        })
    };
    let unknown = unknown(plan, found, n);
    let with_others = found.with_others[n].as_ref();
    let doubtful = with_others.map(|v| (v, judged(v)));
    let judged_with = excluded_points::judge(plan, found, spec, judged(value), doubtful);
    let in_other_pose = (found.in_other_poses.iter().map(|values| &values[n]))
        .find(|other| judged(other) != judged(value))
        .filter(|_| value.is_ok());
    let (own, other_pose) = match in_other_pose {
        Some(other) => (Verdict::Undecided, Some(other_pose(other, judged(other)))),
        None => (judged_with.verdict, None),
    };
    CharacteristicRecord {
        id: spec.id.clone(),
        kind: spec.kind.word().into(),
        symbol: spec.kind.symbol().into(),
        feature: spec.features.iter().map(id).collect::<Vec<_>>().join(JOINED),
        datums: spec.datums.iter().map(|d| d.name(&plan.features)).collect(),
        modifiers: modifiers(spec),
        zone: Word(zone),
        nominal,
        tolerance,
        lower,
        upper,
        value: measured.map(|v| v.value),
        unit: spec.unit().into(),
        uncertainty: uncertainty.map(|u| u.expanded),
        uncertainty_source: uncertainty.map(|u| u.source.into()),
        noise_bias: uncertainty.map(|u| u.bias).filter(|bias| *bias != 0.0),
        interval: measured.zip(uncertainty).map(|(v, u)| interval(v.value, u, zone)),
        decision_rule: rule.word().into(),
        verdict: own,
        reason: value.as_ref().err().map(NotMeasured::to_string),
        utilization: measured.and_then(|v| utilization(v.value, &limits)),
        witness: measured.map_or(vec![], |v| v.witness.clone()),
        anchor: anchor.or_else(|| first.and_then(|p| p.first().copied())),
        parts: measured
            .map_or(BTreeMap::new(), |v| v.parts.iter().map(|(k, x)| (k.to_string(), *x)).collect()),
        place: measured.and_then(|v| v.place.as_ref()).map(place_record),
        value_with_others: with_others.and_then(|v| Some(v.as_ref().ok()?.value)),
        notes: measured
            .map_or(vec![], |v| v.notes.clone())
            .into_iter()
            .chain(found.notes[n].iter().cloned())
            .chain(judged_with.notes)
            .chain(other_pose)
            .chain(unknown)
            .collect(),
        standard: spec.kind.standard().into(),
    }
}

/// What is to be said of a characteristic with another verdict in another pose that fits about as well.
fn other_pose(value: &Result<Value, NotMeasured>, verdict: Verdict) -> String {
    let there = match value {
        Ok(v) => format!("the value is {}: {}", excluded_points::round(v.value), verdict.word()),
        Err(why) => format!("there is no value: {why}"),
    };
    format!(
        "the part looks the same in several ways, and in another pose that fits as well {there}; align by points or datums, \
         which tell the ways apart"
    )
}

/// Where the true value lies; no zone is narrower than none.
fn interval(value: f64, u: Uncertainty, zone: ZoneForm) -> [f64; 2] {
    let [below, above] = u.sides;
    let least = if zone == ZoneForm::Value { f64::NEG_INFINITY } else { 0.0 };
    [value - below, value + above].map(|end| end.max(least))
}

/// What modifies a characteristic, as words.
fn modifiers(spec: &Spec) -> Vec<String> {
    let mut all = Vec::new();
    all.extend(spec.class.clone());
    if let Some(size) = spec.size {
        all.push(size.word().to_string());
    }
    match spec.offset {
        ZoneOffset::None => {}
        ZoneOffset::By(offset) => all.push(format!("UZ {offset:+}")),
        ZoneOffset::Free => all.push("OZ".into()),
    }
    if let Some([x, y, z]) = spec.intersection {
        all.push(format!("planes across ({x}, {y}, {z})"));
    }
    all.extend(spec.material.map(|m| m.symbol().to_string()));
    if spec.kind.word() == Texture.word() {
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

/// Of a place that was found.
fn place_record(place: &Place) -> PlaceRecord {
    let [x, _, z] = place.frame.rotation();
    PlaceRecord {
        frame: Word(match place.of {
            FrameOf::Datums => FrameSource::Datums,
            FrameOf::Plan => FrameSource::Plan,
            FrameOf::Aligned => FrameSource::Aligned,
        }),
        origin: place.frame.inverse().point([0.0; 3]),
        x,
        z,
        measured: place.measured,
        exact: place.exact,
        deviation: std::array::from_fn(|k| place.exact[k].map(|exact| place.measured[k] - exact)),
    }
}
