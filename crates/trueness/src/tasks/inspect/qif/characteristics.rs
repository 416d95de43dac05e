//! Characteristics: what was asked for, and what was found.

use super::datums::{Datums, letters_and_modifier};
use super::xml::{Value, Xml, decimal};
use trueness_document::inspect::{CharacteristicRecord, InspectDocument};
use trueness_document::plan::{Class, MaterialWord};
use trueness_document::{Named, Verdict};

/// Numbers of what is said of a characteristic for all parts.
#[derive(Clone, Copy)]
pub struct Ids {
    definition: u32,
    nominal: u32,
    item: u32,
}

impl Ids {
    /// Three new ones.
    pub fn new(x: &mut Xml) -> Ids {
        Ids { definition: x.number(), nominal: x.number(), item: x.number() }
    }
}

/// What QIF calls a kind. User defined is what it does not know, areal texture, and what it wants more of than a result has: of the
/// profile of a line the normal of its plane as numbers.
fn name(document: &InspectDocument, c: &CharacteristicRecord) -> &'static str {
    let shape = document.features.iter().find(|f| f.id == c.feature).map(|f| *f.shape);
    match c.kind.as_str() {
        "straightness" => "Straightness",
        "flatness" => "Flatness",
        "roundness" => "Circularity",
        "cylindricity" => "Cylindricity",
        "surface-profile" => "SurfaceProfile",
        "parallelism" => "Parallelism",
        "perpendicularity" => "Perpendicularity",
        "angularity" => "Angularity",
        "position" => "Position",
        "coaxiality" => "Coaxiality",
        "symmetry" => "Symmetry",
        "circular-runout" => "CircularRunout",
        "total-runout" => "TotalRunout",
        "size" if c.features().len() > 1 || shape == Some(Class::Plane) => "Width",
        "size" if shape == Some(Class::Sphere) => "SphericalDiameter",
        "size" => "Diameter",
        "distance" => "DistanceBetween",
        "angle" => "AngleBetween",
        _ if c.unit == "mm" => "UserDefinedLinear",
        _ => "UserDefinedAttribute",
    }
}

/// Writes what is asked for.
pub fn definition(
    x: &mut Xml,
    document: &InspectDocument,
    c: &CharacteristicRecord,
    ids: Ids,
    datums: &Datums,
) {
    let name = name(document, c);
    let shape = document.features.iter().find(|f| f.id == c.feature).map(|f| *f.shape);
    let id = ("id", ids.definition.to_string());
    x.element(&format!("{name}CharacteristicDefinition"), &[id], |x| {
        x.attributes(&asked(c, name));
        x.leaf("Name", &c.id);
        let frame = datums.frame(&c.datums);
        let zone = |x: &mut Xml, zone: &str| x.element("ZoneShape", &[], |x| x.empty(zone, &[]));
        let diametral = c.diametral();
        match name {
            "Width" | "SphericalDiameter" | "Diameter" | "DistanceBetween" | "AngleBetween" => limits(x, c),
            "UserDefinedLinear" => limits(x, c),
            "UserDefinedAttribute" => {}
            _ => x.leaf("ToleranceValue", &decimal(c.tolerance.unwrap_or(c.upper))),
        }
        if let Some(frame) = frame.filter(|_| framed(name)) {
            x.leaf("DatumReferenceFrameId", &frame.to_string());
        }
        match name {
            "Straightness" => {
                x.leaf("MaterialCondition", material(c));
                zone(x, if diametral { "DiametricalZone" } else { "NonDiametricalZone" });
            }
            "Parallelism" | "Perpendicularity" | "Angularity" => {
                x.leaf("MaterialCondition", material(c));
                zone(x, if diametral { "DiametricalZone" } else { "PlanarZone" });
            }
            "Position" => {
                x.leaf("MaterialCondition", material(c));
                zone(
                    x,
                    match shape {
                        Some(Class::Sphere | Class::Point) if diametral => "SphericalZone",
                        _ if diametral => "DiametricalZone",
                        _ => "NonDiametricalZone",
                    },
                );
            }
            "Coaxiality" => zone(x, if diametral { "DiametricalZone" } else { "NonDiametricalZone" }),
            "UserDefinedLinear" | "UserDefinedAttribute" => {
                x.leaf("WhatToMeasure", &format!("{} {}", c.kind, c.modifiers.join(" ")));
            }
            _ => {}
        }
    });
}

/// Whether a definition refers to a datum reference frame.
fn framed(name: &str) -> bool {
    let framed =
        ["SurfaceProfile", "Parallelism", "Perpendicularity", "Angularity", "Position", "Coaxiality"];
    framed.contains(&name) || ["Symmetry", "CircularRunout", "TotalRunout"].contains(&name)
}

fn limits(x: &mut Xml, c: &CharacteristicRecord) {
    x.element("Tolerance", &[], |x| {
        x.leaf("MaxValue", &decimal(c.upper));
        if let Some(lower) = c.lower {
            x.leaf("MinValue", &decimal(lower));
        }
        x.leaf("DefinedAsLimit", "true");
    });
}

fn material(c: &CharacteristicRecord) -> &'static str {
    match c.requirement().map(|(_, material)| material) {
        Some(MaterialWord::M) => "MAXIMUM",
        Some(MaterialWord::L) => "LEAST",
        None => "NONE",
    }
}

/// Writes the nominal.
pub fn nominal(x: &mut Xml, document: &InspectDocument, c: &CharacteristicRecord, ids: Ids) {
    let name = name(document, c);
    let id = ("id", ids.nominal.to_string());
    x.element(&format!("{name}CharacteristicNominal"), &[id], |x| {
        x.leaf("CharacteristicDefinitionId", &ids.definition.to_string());
        x.leaf("Name", &c.id);
        let dimension = ["Width", "SphericalDiameter", "Diameter", "DistanceBetween", "AngleBetween"];
        if let Some(target) = c.nominal.filter(|_| dimension.contains(&name)) {
            x.leaf("TargetValue", &decimal(target));
        }
        if matches!(name, "DistanceBetween" | "AngleBetween") {
            x.leaf("AnalysisMode", "THREEDIMENSIONAL");
        }
    });
}

/// Writes the item: the characteristic of the plan.
pub fn item(x: &mut Xml, document: &InspectDocument, c: &CharacteristicRecord, ids: Ids) {
    let name = name(document, c);
    let id = ("id", ids.item.to_string());
    x.element(&format!("{name}CharacteristicItem"), &[id], |x| {
        x.attributes(&[("id", c.id.as_str().into())]);
        x.leaf("Name", &c.id);
        x.leaf("CharacteristicNominalId", &ids.nominal.to_string());
    });
}

/// Writes what was found on the part `component`, whose features have the numbers `feature`.
pub fn measured(
    x: &mut Xml,
    document: &InspectDocument,
    c: &CharacteristicRecord,
    ids: Ids,
    component: u32,
    feature: impl Fn(&str) -> Option<u32>,
) {
    let name = name(document, c);
    let id = ("id", x.number().to_string());
    x.element(&format!("{name}CharacteristicMeasurement"), &[id], |x| {
        x.attributes(&found(c));
        status(x, c.verdict);
        x.leaf("CharacteristicItemId", &ids.item.to_string());
        let mut of: Vec<u32> = c.features().into_iter().filter_map(&feature).collect();
        if matches!(name, "DistanceBetween" | "AngleBetween") {
            let datums = c.datums.iter().flat_map(|d| letters_and_modifier(document, d).0);
            of.extend(datums.filter_map(&feature));
        }
        of.dedup();
        x.references("FeatureMeasurementIds", &of);
        x.leaf("ActualComponentId", &component.to_string());
        let Some(value) = c.value else { return };
        // QIF wants the standard uncertainty; the document has the expanded one.
        let u = c.uncertainty.filter(|_| name != "UserDefinedAttribute");
        let u: Vec<(&str, String)> =
            u.map(|u| ("combinedUncertainty", decimal(0.5 * u))).into_iter().collect();
        x.leaf_with("Value", &u, &decimal(value));
        if let Some((tolerance, _)) = c.requirement().filter(|_| material(c) != "NONE" && bonus(name)) {
            x.leaf("Bonus", &decimal(c.upper - tolerance));
        }
    });
}

fn bonus(name: &str) -> bool {
    ["Straightness", "Parallelism", "Perpendicularity", "Angularity", "Position"].contains(&name)
}

/// The verdict as QIF has it.
pub fn status(x: &mut Xml, verdict: Verdict) {
    x.element("Status", &[], |x| {
        let word = match verdict {
            Verdict::Pass => "PASS",
            Verdict::Fail => "FAIL",
            Verdict::Undecided => "INDETERMINATE",
            Verdict::NotMeasured => "NOT_ANALYZED",
        };
        x.leaf("CharacteristicStatusEnum", word);
    });
}

/// What is asked for beside what QIF has elements for.
fn asked(c: &CharacteristicRecord, name: &str) -> Vec<(&'static str, Value)> {
    let mut all: Vec<(&'static str, Value)> = vec![
        ("kind", c.kind.as_str().into()),
        ("feature", c.feature.as_str().into()),
        ("standard", c.standard.as_str().into()),
        ("zone", c.zone.name().into()),
    ];
    for (name, words) in [("datums", &c.datums), ("modifiers", &c.modifiers)] {
        if !words.is_empty() {
            all.push((name, words.join(" | ").into()));
        }
    }
    if name == "UserDefinedAttribute" {
        all.extend(c.lower.map(|lower| ("lower", lower.into())));
        all.push(("upper", c.upper.into()));
    }
    all
}

/// What was found beside what QIF has elements for; numbers with all digits.
fn found(c: &CharacteristicRecord) -> Vec<(&'static str, Value)> {
    let mut all: Vec<(&'static str, Value)> = vec![
        ("id", c.id.as_str().into()),
        ("verdict", c.verdict.word().into()),
        ("unit", c.unit.as_str().into()),
        ("decision_rule", c.decision_rule.as_str().into()),
    ];
    let numbers = [
        ("value", c.value),
        ("nominal", c.nominal),
        ("tolerance", c.tolerance),
        ("lower", c.lower),
        ("upper", Some(c.upper)),
        ("expanded_uncertainty", c.uncertainty),
        ("noise_bias", c.noise_bias),
        ("interval_from", c.interval.map(|i| i[0])),
        ("interval_to", c.interval.map(|i| i[1])),
        ("utilisation", c.utilization),
        ("value_with_others", c.value_with_others),
    ];
    all.extend(numbers.into_iter().filter_map(|(name, x)| Some((name, x?.into()))));
    let texts = [("uncertainty_source", &c.uncertainty_source), ("reason", &c.reason)];
    all.extend(texts.into_iter().filter_map(|(name, t)| Some((name, t.as_deref()?.into()))));
    all.extend(c.notes.iter().map(|note| ("note", note.as_str().into())));
    if !c.parts.is_empty() {
        all.push(("parts", serde_json::to_string(&c.parts).unwrap_or_default().into()));
    }
    all
}
