//! From a repair to the result document.

mod effect;

use crate::words::ToWord;
use std::collections::BTreeMap;
use trueness_document::repair::{
    Change, Deviation, Distances, FacetCounts, OutputRecord, RepairDocument, SCHEMA, State, VertexCounts,
};
use trueness_document::{InputRecord, UNITS, VERSION};
use trueness_geom::check::Report;
use trueness_solid::repair::{self, DeviationError, Holes, Options, Repaired, STEPS};

/// What is known about a repair besides its result.
pub struct Around {
    /// The file read.
    pub file: InputRecord,
    /// Facets of the file that were left out by the reader, for a coordinate that is not finite.
    pub left_out: u64,
    /// The file written.
    pub output: OutputRecord,
    /// How far the surface went.
    pub deviation: Result<repair::Deviation, DeviationError>,
    /// Changes listed at most.
    pub limit: usize,
    /// Share of the diagonal, and of the volume, beyond which the part is another one.
    pub max_change: f64,
}

/// Makes the document.
pub fn document(repaired: &Repaired, options: &Options, around: Around) -> RepairDocument {
    let counts = repaired.counts;
    let facets = repaired.mesh.faces.len() as u64;
    let mut before = state(&repaired.before, counts.facets_kept + counts.facets_removed + around.left_out);
    before.sound &= around.left_out == 0;
    if let Ok(enclosed) = &repaired.effect.enclosed {
        (before.volume, before.volume_reason) = (Some(enclosed.volume), None);
    } else if let Err(reason) = repaired.effect.enclosed {
        (before.volume, before.volume_reason) = (None, Some(reason.to_string()));
    }
    if around.left_out > 0 {
        *before.defects.entry("not_finite_facets".into()).or_default() += around.left_out;
    }
    let after = state(&repaired.after, facets);
    let effect = effect::record(repaired, after.volume, around.deviation.as_ref().ok(), around.max_change);
    let way = |w: repair::Way| Distances { max: w.max, mean: w.mean };
    let steps = STEPS.into_iter().filter(|s| options.steps.contains(s)).map(ToWord::word);
    RepairDocument {
        schema: SCHEMA.into(),
        version: VERSION.into(),
        units: UNITS.into(),
        sound: repaired.after.sound
            && around.output.sound != Some(false)
            && !effect.changed
            && !around.file.lacks_faces(),
        inputs: vec![around.file],
        output: around.output,
        before,
        after,
        vertices: VertexCounts {
            kept: counts.vertices_kept,
            moved: if options.single { 0 } else { repaired.rounded.vertices },
            added: counts.vertices_added,
            removed: counts.vertices_removed,
        },
        facets: FacetCounts {
            kept: counts.facets_kept,
            added: counts.facets_added,
            removed: counts.facets_removed + around.left_out,
        },
        effect,
        deviation: (around.deviation.as_ref().ok())
            .map(|d| Deviation { removed: way(d.there), added: way(d.back) }),
        deviation_reason: around.deviation.err().map(|e| e.to_string()),
        steps: steps.collect(),
        not_united: repaired.not_united.map(|e| e.to_string()),
        taken_back: repaired.taken_back.iter().copied().map(ToWord::word).collect(),
        hole_limit: match options.holes {
            Holes::UpTo(share) => Some(share),
            Holes::All => None,
        },
        rounds: repaired.rounds as u64,
        change_count: repaired.changes.len() as u64,
        changes: repaired.changes.iter().take(around.limit).map(change).collect(),
        truncated: repaired.changes.len() > around.limit,
    }
}

fn change(c: &repair::Change) -> Change {
    Change {
        step: c.step.word(),
        what: c.what.into(),
        position: c.position,
        facets: c.facets as u64,
        size: c.size,
    }
}

fn state(report: &Report, facets: u64) -> State {
    let (p, s) = (&report.properties, &report.soundness);
    let solid = s.closed && s.consistently_oriented;
    State {
        facets,
        vertices: report.vertices as u64,
        shells: s.shells as u64,
        closed: s.closed,
        sound: report.sound,
        area: p.area,
        volume: solid.then_some(p.signed_volume),
        volume_reason: (!solid).then(|| match s.closed {
            true => "neighbors look in different directions".into(),
            false => "the mesh is open".into(),
        }),
        defects: defects(report),
        at_least: at_least(report),
    }
}

/// Number of findings by kind, without the kinds that have none.
pub fn defects(report: &Report) -> BTreeMap<String, u64> {
    let found = report.defects.iter().filter_map(|(kind, f)| Some((kind.name, f.as_ref()?.count)));
    found.filter(|(_, n)| *n > 0).map(|(name, n)| (name.to_string(), n as u64)).collect()
}

/// Kinds of which there are more than were counted.
pub fn at_least(report: &Report) -> Vec<String> {
    let capped = report.defects.iter().filter(|(_, f)| f.as_ref().is_some_and(|f| f.at_least));
    capped.map(|(kind, _)| kind.name.to_string()).collect()
}
