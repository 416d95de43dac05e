//! The characteristics of a plan.

use super::checker::Checker;
use super::decision::{Decision, Rule};
use super::feature::named;
use super::limits_read::{limits, number};
use super::{datum as datums, material};
use crate::characteristic::{self, Question, Spec};
use crate::requirement::{Basic, Feature, ZoneOffset};
use std::ops::Range;
use trueness_document::plan::{
    At, BasicText, CharacteristicText, DatumMethodWord, FormMethodWord, OffsetText, OneOrTwo, PlanError,
    PlanText, RunoutWord, TextureWord, unknown,
};
use trueness_document::tolerance_class::wrong_side;
use trueness_geom::fit::Method;
use trueness_geom::rigid::Rigid;
use trueness_geom::space::{Vector, unit};
use trueness_geom::zone::datum;

pub(super) fn specs(
    checker: &Checker,
    written: &PlanText,
    features: &[Feature],
    decision: &Decision,
) -> Result<Vec<Spec>, PlanError> {
    let mut all: Vec<Spec> = Vec::new();
    for At { value, span } in &written.characteristic {
        checker.id(&value.id)?;
        if all.iter().any(|s| s.id == value.id.value) {
            return checker.wrong(
                &value.id.span,
                format!("there are two characteristics \"{}\"; give each its own id", value.id.value),
            );
        }
        all.push(spec(checker, value, span, features, decision)?);
    }
    material::resolve(checker, written, features, &mut all)?;
    Ok(all)
}

fn spec(
    checker: &Checker,
    written: &CharacteristicText,
    whole: &Range<usize>,
    features: &[Feature],
    decision: &Decision,
) -> Result<Spec, PlanError> {
    let word = &written.kind.value.0;
    let Some(kind) = characteristic::ALL.iter().copied().find(|c| c.word() == word) else {
        let known: Vec<&str> = characteristic::ALL.iter().map(|c| c.word()).collect();
        return checker.wrong(&written.kind.span, unknown("kind", word, &known));
    };
    for (key, span) in keys(written) {
        if !kind.keys().contains(&key) {
            return checker.wrong(&span, format!("{word} takes no `{key}`{}", instead(word, key)));
        }
    }
    let parameter = written.parameter.as_ref().map_or(TextureWord::Sa, |p| p.value);
    let unit = kind.unit(parameter);
    let toleranced = toleranced(checker, &written.feature, features)?;
    let datums = datums::datums(checker, written, &toleranced, features)?;
    if let Some(n) = datums.iter().position(|d| d.material.is_some())
        && !kind.material_datums()
    {
        let span = written.datums.as_ref().and_then(|d| Some(d.value.get(n)?.span.clone()));
        let what = format!("{word} takes no material requirement on a datum");
        return checker.wrong(&span.unwrap_or(whole.clone()), what);
    }
    let made = Spec {
        id: written.id.value.clone(),
        span: written.id.span.clone(),
        kind,
        datums,
        features: toleranced,
        datum_rule: match written.datum_method.as_ref().map(|m| m.value) {
            Some(DatumMethodWord::MinimumZone) => datum::Rule::MinimumZone,
            _ => datum::Rule::Gaussian,
        },
        frame: frame(checker, written)?,
        basic: basic(checker, written.basic.as_ref())?,
        basic_span: written.basic.as_ref().map(|b| b.span.clone()),
        offset: offset(checker, written)?,
        intersection: intersection(checker, written)?,
        diametral: written.diametral.as_ref().map(|d| d.value),
        form: match written.method.as_ref().map(|m| m.value) {
            Some(FormMethodWord::Gaussian) => Method::Gaussian,
            _ => Method::MinimumZone,
        },
        size: written.size.as_ref().map(|s| s.value),
        limits: limits(checker, written, whole, kind, unit)?,
        limits_span: limits_span(written, whole),
        class: written.class.as_ref().map(|c| c.value.clone()),
        class_span: written.class.as_ref().map_or_else(|| whole.clone(), |c| c.span.clone()),
        axial: written.direction.as_ref().is_some_and(|d| d.value == RunoutWord::Axial),
        parameter,
        material: written.material.as_ref().map(|m| m.value),
        boundary: None,
        uncertainty: match &written.uncertainty {
            Some(u) => Some(number(checker, u, unit, "the uncertainty")?),
            // The plan's common uncertainty is a length.
            None => decision.uncertainty.filter(|_| unit == "mm"),
        },
    };
    if let Some(what) = class_of_other_side(&made, features) {
        return checker.wrong(&made.class_span, what);
    }
    if decision.rule == Rule::Iso14253 && made.uncertainty.is_none() && decision.noise.is_none() {
        return checker.wrong(whole, without_uncertainty(decision, unit));
    }
    let question = Question { spec: &made, features };
    kind.check(&question).or_else(|refusal| {
        let place = match refusal.key {
            "feature" => Some(written.feature.span.clone()),
            "kind" => Some(written.kind.span.clone()),
            _ => keys(written).into_iter().find(|(key, _)| *key == refusal.key).map(|(_, span)| span),
        };
        checker.wrong(&place.unwrap_or(whole.clone()), format!("{word}: {}", refusal.what))
    })?;
    Ok(made)
}

/// Why a tolerance class is not of the side of the material that its feature has, if so.
fn class_of_other_side(made: &Spec, features: &[Feature]) -> Option<String> {
    let (Some(class), [feature]) = (&made.class, made.features.as_slice()) else { return None };
    let Feature { internal, id, .. } = &features[*feature];
    wrong_side(class, (*internal)?, id)
}

/// What to write in place of a key that a kind does not take.
fn instead(word: &str, key: &str) -> &'static str {
    match (word, key) {
        ("size" | "distance" | "angle", "tolerance") => {
            "; give `upper` and `lower`, deviations from `nominal`, as in upper = 0.1, lower = -0.1"
        }
        ("size" | "distance" | "angle", "basic") => "; give `nominal`",
        (_, "nominal" | "upper" | "lower") => "; give `tolerance`, the width or diameter of the zone",
        _ => "",
    }
}

/// Where the tolerance or the nominal value stands.
fn limits_span(w: &CharacteristicText, whole: &Range<usize>) -> Range<usize> {
    let span = |at: &Option<At<f64>>| at.as_ref().map(|a| a.span.clone());
    span(&w.tolerance).or(span(&w.nominal)).unwrap_or_else(|| whole.clone())
}

/// What is said where `iso14253-1` is to decide and no uncertainty is known.
fn without_uncertainty(decision: &Decision, unit: &str) -> String {
    let rule = "rule \"iso14253-1\" needs the expanded uncertainty";
    match decision.uncertainty {
        Some(_) => format!(
            "{rule} of this in {unit}, and that of [decision] is one of lengths: give `uncertainty` here, or `noise` in [decision]"
        ),
        None => format!("{rule}: give `uncertainty` here or in [decision], or `noise` there"),
    }
}

/// The keys that only some kinds take, where they stand.
fn keys(w: &CharacteristicText) -> Vec<(&'static str, Range<usize>)> {
    fn of<T>(key: &'static str, at: &Option<At<T>>) -> Option<(&'static str, Range<usize>)> {
        at.as_ref().map(|a| (key, a.span.clone()))
    }
    [
        of("tolerance", &w.tolerance),
        of("datums", &w.datums),
        of("datum_method", &w.datum_method),
        of("frame", &w.frame),
        of("basic", &w.basic),
        of("offset", &w.offset),
        of("intersection", &w.intersection),
        of("diametral", &w.diametral),
        of("method", &w.method),
        of("size", &w.size),
        of("nominal", &w.nominal),
        of("upper", &w.upper),
        of("lower", &w.lower),
        of("direction", &w.direction),
        of("parameter", &w.parameter),
        of("class", &w.class),
        of("length", &w.length),
        of("material", &w.material),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn toleranced(checker: &Checker, at: &At<OneOrTwo>, features: &[Feature]) -> Result<Vec<usize>, PlanError> {
    let names = match &at.value {
        OneOrTwo::One(name) => std::slice::from_ref(name),
        OneOrTwo::Two(names) => names.as_slice(),
    };
    if names.is_empty() || names.len() > 2 {
        return checker.wrong(&at.span, "give one feature, or two of a size");
    }
    if let [a, b] = names
        && a == b
    {
        return checker
            .wrong(&at.span, format!("\"{a}\" is named twice; a feature is no distance from itself"));
    }
    names.iter().map(|name| named(checker, name, &at.span, features)).collect()
}

fn frame(checker: &Checker, written: &CharacteristicText) -> Result<Option<Rigid>, PlanError> {
    let Some(at) = &written.frame else { return Ok(None) };
    if written.datums.is_some() {
        return checker.wrong(&at.span, "give datums or a frame, not both");
    }
    let frame = Rigid::into_frame(checker.place(at.value.origin), at.value.z, at.value.x);
    let sound = frame.filter(|f| f.matrix().iter().flatten().all(|x| x.is_finite()));
    sound.map_or_else(
        || checker.wrong(&at.span, "x and z of the frame need lengths and must not be parallel"),
        |f| Ok(Some(f)),
    )
}

fn basic(checker: &Checker, at: Option<&At<BasicText>>) -> Result<Basic, PlanError> {
    let Some(At { value, span }) = at else { return Ok(Basic::default()) };
    let place = [value.x, value.y, value.z].map(|x| x.map(|x| x * checker.unit));
    let angles = [("angle", value.angle), ("turn", value.turn)];
    if place.into_iter().chain(angles.map(|a| a.1)).flatten().any(|x| !x.is_finite()) {
        return checker.wrong(span, "a theoretically exact dimension must be a finite number");
    }
    for (name, angle) in angles {
        if let Some(angle) = angle.filter(|a| !(0.0..=90.0).contains(a)) {
            let folded = angle.rem_euclid(180.0);
            let folded = (folded.min(180.0 - folded) * 1e9).round() / 1e9;
            let what =
                format!("the {name} is {angle}; give degrees from 0 to 90: this one is {folded} there");
            return checker.wrong(span, what);
        }
    }
    let [angle, turn] = angles.map(|a| a.1.map(f64::to_radians));
    Ok(Basic { place, angle, turn, oblique: None })
}

fn offset(checker: &Checker, written: &CharacteristicText) -> Result<ZoneOffset, PlanError> {
    let Some(At { value, span }) = &written.offset else { return Ok(ZoneOffset::None) };
    Ok(match value {
        OffsetText::Free(_) => ZoneOffset::Free,
        OffsetText::Length(x) => {
            ZoneOffset::By(checker.length(&At { value: *x, span: span.clone() }, "the offset")?)
        }
    })
}

fn intersection(checker: &Checker, written: &CharacteristicText) -> Result<Option<Vector>, PlanError> {
    let Some(At { value, span }) = &written.intersection else { return Ok(None) };
    match unit(*value) {
        Some((normal, _)) => Ok(Some(normal)),
        None => checker.wrong(span, "the normal of the intersection planes has no length"),
    }
}
