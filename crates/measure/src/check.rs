//! From the findings of a check to the result document.

use crate::bounds::bounds;
use crate::file_numbers::LeftOut;
use crate::model_check::MODEL_KINDS;
use crate::no_solid::{genus_reason, why_no_solid};
use crate::words::ToWord;
use std::collections::BTreeMap;
use trueness_document::check::{CheckDocument, Defects, Item, SCHEMA, Tolerances};
use trueness_document::{InputRecord, UNITS, VERSION};
use trueness_geom::check::{
    DefectKind, Finding, Found, INSIDE_OUT_SHELLS, KINDS, NOT_FINITE_FACETS, Options, Report,
    SELF_INTERSECTIONS,
};

/// Makes the document. The facets `left_out` of the file were not handed to the check, for a coordinate that is not finite.
pub fn document(
    report: &Report,
    file: InputRecord,
    facets: u64,
    left_out: LeftOut,
    options: &Options,
) -> CheckDocument {
    let (p, s) = (&report.properties, &report.soundness);
    let solid = s.closed && s.consistently_oriented;
    let why_not = || why_no_solid(report);
    let center = p.center_of_mass.filter(|_| solid);
    let defects = report
        .defects
        .iter()
        .map(|(kind, found)| (kind.name.to_string(), self::defects(kind, found.as_ref(), left_out)));
    CheckDocument {
        schema: SCHEMA.into(),
        version: VERSION.into(),
        units: UNITS.into(),
        inputs: vec![file],
        facets: facets + left_out.count(),
        vertices: report.vertices as u64,
        edges: report.edges as u64,
        shells: s.shells as u64,
        bounds: bounds(&p.bounds),
        dimensions: bounds(&p.bounds).map(|_| p.bounds.sides()),
        area: p.area,
        volume: solid.then_some(p.signed_volume),
        volume_reason: (!solid).then(why_not),
        volume_note: (solid && overlaps(report)).then(|| OVERLAPS_NOTE.into()),
        center_of_mass: center,
        center_of_mass_reason: center
            .is_none()
            .then(|| if solid { "the volume is zero".into() } else { why_not() }),
        euler_characteristic: report.euler_characteristic,
        genus: report.genus,
        genus_reason: genus_reason(report),
        of_drawing: vec![],
        sound: report.sound && left_out.count() == 0,
        precondition: s.sound && left_out.count() == 0,
        tolerances: Tolerances {
            gap: report.gap,
            sliver_angle: Some(options.sliver_angle),
            island_share: Some(options.island_share),
        },
        defects: defects.collect(),
    }
}

/// What the volume of bodies that cross or lie in each other is.
const OVERLAPS_NOTE: &str = "what crossing bodies have in common counts as often as there are bodies";

/// Whether bodies were found to cross or to lie in each other the same way round.
fn overlaps(report: &Report) -> bool {
    [SELF_INTERSECTIONS, INSIDE_OUT_SHELLS].into_iter().any(|kind| report.count(kind) > 0)
}

/// The findings of a kind as the documents have them, by the numbers of the file; `None` where they were not looked for.
pub(crate) fn defects(kind: &DefectKind, found: Option<&Found>, left_out: LeftOut) -> Defects {
    let mut defects = Defects {
        severity: kind.severity.word(),
        count: found.map(|f| f.count as u64),
        at_least: found.is_some_and(|f| f.at_least),
        count_reason: found.map_or(kind.missing, |_| None).map(str::to_string),
        size: kind.size.into(),
        items: found.map_or(vec![], |f| f.items.iter().map(item).collect()),
        truncated: found.is_some_and(|f| f.items.len() < f.count),
    };
    let numbers = defects.items.iter_mut().flat_map(|item| &mut item.facets);
    numbers.for_each(|facet| *facet = left_out.in_file(*facet));
    if kind == NOT_FINITE_FACETS {
        defects.count = defects.count.map(|n| n + left_out.count());
        defects.truncated |= left_out.count() > 0;
    }
    defects
}

fn item(finding: &Finding) -> Item {
    Item {
        facets: finding.facets.clone(),
        vertices: finding.vertices.clone(),
        position: finding.position,
        bounds: bounds(&finding.bounds),
        size: finding.size,
        measures: finding.measures.iter().map(|(name, x)| (name.to_string(), *x)).collect(),
    }
}

/// Kinds of which there are any: errors first, what only follows from holes and cracks after these, else in the order in
/// which the check tells them.
pub fn found(defects: &BTreeMap<String, Defects>) -> Vec<(&'static DefectKind, &Defects)> {
    let all = KINDS.into_iter().chain(MODEL_KINDS).filter_map(|kind| Some((kind, defects.get(kind.name)?)));
    let mut found: Vec<_> = all.filter(|(_, d)| d.count.is_some_and(|n| n > 0)).collect();
    found.sort_by_key(|(kind, d)| (d.severity.0, kind.follows));
    found
}
