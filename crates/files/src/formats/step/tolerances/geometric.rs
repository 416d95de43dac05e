//! Geometric tolerances.

use super::super::context::{Measure, measure};
use super::super::part21::{Entity, Record, Value, Wrong};
use super::graph::{Graph, list, references, told};
use trueness_cad::tolerances::GeometricTolerance;

/// Keywords of geometric tolerances, before `_TOLERANCE`.
const TOLERANCE_KEYWORDS: [&str; 15] = [
    "ANGULARITY",
    "CIRCULAR_RUNOUT",
    "COAXIALITY",
    "CONCENTRICITY",
    "CYLINDRICITY",
    "FLATNESS",
    "LINE_PROFILE",
    "PARALLELISM",
    "PERPENDICULARITY",
    "POSITION",
    "ROUNDNESS",
    "STRAIGHTNESS",
    "SURFACE_PROFILE",
    "SYMMETRY",
    "TOTAL_RUNOUT",
];

/// The geometric tolerances of a file.
pub(super) fn tolerances(graph: &Graph) -> Vec<GeometricTolerance> {
    graph.file.entities().filter_map(|entity| Some(tolerance(graph, &entity, kind(&entity)?))).collect()
}

/// The kind of a geometric tolerance; `geometric` where the file does not say which.
fn kind(entity: &Entity) -> Option<String> {
    let known = entity.records().find_map(|r| {
        let word = r.keyword.strip_suffix("_TOLERANCE")?;
        TOLERANCE_KEYWORDS.contains(&word).then(|| told(word))
    });
    known.or_else(|| entity.record("GEOMETRIC_TOLERANCE").map(|_| "geometric".into()))
}

fn tolerance(graph: &Graph, entity: &Entity, kind: String) -> GeometricTolerance {
    let base = entity.main(&["GEOMETRIC_TOLERANCE"]);
    let mut made =
        GeometricTolerance { entity: entity.number(), kind, name: base.text(0), ..Default::default() };
    match base.entity(2).and_then(|n| length(graph, n)) {
        Ok(width) => made.width = Some(width),
        Err(wrong) => made.notes.push(format!("its width cannot be read: {wrong}")),
    }
    match base.entity(3) {
        Ok(of) => made.of = graph.target(of),
        Err(wrong) => made.notes.push(wrong.to_string()),
    }
    let list_at = |record: &Record, k: usize| match record.values.get(k) {
        Some(value @ Value::List(_)) => references(record, *value),
        _ => vec![],
    };
    let datums = match entity.record("GEOMETRIC_TOLERANCE_WITH_DATUM_REFERENCE") {
        Some(record) => list_at(&record, if entity.is_simple() { 4 } else { 0 }),
        None => list_at(&base, 4),
    };
    let (datums, mut notes) = graph.datum_references(&datums);
    made.datums = datums;
    made.notes.append(&mut notes);
    for record in entity.records() {
        said(graph, &record, &mut made);
    }
    zone(graph, &mut made);
    for number in list(&graph.tiers, entity.number()) {
        made.notes.extend(tier(graph, *number, entity.number()));
    }
    made
}

fn length(graph: &Graph, number: u64) -> Result<f64, Wrong> {
    match measure(graph.file, number)? {
        Measure::Length(length) => Ok(length),
        Measure::Angle(_) => Err(graph.file.entity(number)?.wrong("is an angle")),
    }
}

/// What a record of a complex instance adds.
fn said(graph: &Graph, record: &Record, made: &mut GeometricTolerance) {
    let own = |k: usize| record.entity(k).and_then(|n| length(graph, n));
    let last = record.values.len().saturating_sub(1);
    let word = |value: &Value| match value {
        Value::Word(word) => Some(told(&String::from_utf8_lossy(word))),
        _ => None,
    };
    match record.keyword {
        "GEOMETRIC_TOLERANCE_WITH_MODIFIERS" => {
            made.modifiers.extend(record.list(last).unwrap_or_default().iter().filter_map(word));
        }
        "MODIFIED_GEOMETRIC_TOLERANCE" => made.modifiers.extend(record.values.get(last).and_then(word)),
        "GEOMETRIC_TOLERANCE_WITH_DEFINED_UNIT" => made.notes.push(match own(last) {
            Ok(length) => format!("per unit of {length} mm"),
            Err(wrong) => format!("per unit: {wrong}"),
        }),
        "GEOMETRIC_TOLERANCE_WITH_DEFINED_AREA_UNIT" => {
            let form = record.values.iter().find_map(word).unwrap_or_default();
            let second =
                own(last).map_or_else(|_| String::new(), |length| format!(", the other side {length} mm"));
            made.notes.push(format!("the unit is an area, {form}{second}"));
        }
        "GEOMETRIC_TOLERANCE_WITH_MAXIMUM_TOLERANCE" => made.notes.push(match own(last) {
            Ok(length) => format!("at most {length} mm"),
            Err(wrong) => format!("at most: {wrong}"),
        }),
        "UNEQUALLY_DISPOSED_GEOMETRIC_TOLERANCE" => made.notes.push(match own(last) {
            Ok(length) => format!("unequally disposed by {length} mm"),
            Err(wrong) => format!("unequally disposed: {wrong}"),
        }),
        _ => {}
    }
}

/// The form of the zone, and what defines it beyond that.
fn zone(graph: &Graph, made: &mut GeometricTolerance) {
    for number in list(&graph.zones, made.entity) {
        let Ok(zone) = graph.file.entity(*number) else { continue };
        let record = zone.main(&["TOLERANCE_ZONE"]);
        let form = record.reference(record.values.len().saturating_sub(1));
        let form = form.and_then(|n| graph.file.entity(n).ok());
        made.zone = made.zone.take().or(form.map(|f| f.main(&["TOLERANCE_ZONE_FORM"]).text(0)));
        for entity in list(&graph.definitions, *number).iter().filter_map(|n| graph.file.entity(*n).ok()) {
            let record = entity.main(&["PROJECTED_ZONE_DEFINITION"]);
            let measured = record.entity(3).and_then(|n| length(graph, n));
            made.notes.push(match (record.keyword, measured) {
                ("PROJECTED_ZONE_DEFINITION", Ok(length)) => format!("projected by {length} mm"),
                (keyword, _) => told(keyword),
            });
        }
    }
}

/// What a relationship of two tolerances says of one of them.
fn tier(graph: &Graph, relationship: u64, own: u64) -> Option<String> {
    let record = graph.file.entity(relationship).ok()?.main(&["GEOMETRIC_TOLERANCE_RELATIONSHIP"]);
    let (upper, lower) = (record.reference(2)?, record.reference(3)?);
    let word = record.text(0);
    Some(match own == upper {
        true => format!("{word} with #{lower} below it"),
        false => format!("{word} with #{upper} above it"),
    })
}
