//! From the faults of a CAD model to the document of a check.
//!
//! Facets and vertices of a finding are those that draw its faces and edges; `face` and `edge` are the numbers of their entities in the
//! file.

mod crossing;
mod entities;
mod kinds;

pub use kinds::MODEL_KINDS;

use crate::bounds::bounds;
use crate::cad::area;
use crate::words::ToWord;
use entities::numbers;
use std::collections::BTreeMap;
use trueness_cad::check::{Fault, FaultKind, faults};
use trueness_cad::measure::Integrals;
use trueness_cad::model::Model;
use trueness_cad::tessellate::Tessellation;
use trueness_cad::trimmed::Trimmed;
use trueness_document::check::{CheckDocument, Defects, Item, Severity};
use trueness_geom::check::{DefectKind, Shows};
use trueness_geom::num::sum::Sum;
use trueness_geom::space::{Aabb, Point};

/// A model with what was made of it.
pub struct Checked<'a> {
    /// What the file holds.
    pub model: &'a Model,
    /// Its parts where they stand.
    pub shape: &'a Trimmed,
    /// The integrals of its faces.
    pub integrals: &'a [Option<Integrals>],
    /// Its facets.
    pub drawn: &'a Tessellation,
    /// Pairs of facets that meet where they should not; `None` where they were not looked for.
    pub crossings: Option<Vec<[u32; 2]>>,
}

/// Facets of one finding at most: of what is larger the first ones show where it is.
const MAX_FACETS_OF_ITEM: usize = 2000;
/// Gaps that count where the file states no uncertainty, as a share of the part: files have some seven digits and more.
const MAX_GAP_SHARE: f64 = 1e-7;

/// The document of the facets with the faults of the model in place of theirs; at most `limit` of each kind are listed.
pub fn with_model(mut document: CheckDocument, checked: &Checked, limit: usize) -> CheckDocument {
    let Checked { model, shape, integrals, drawn, crossings } = checked;
    let within = model.uncertainty.unwrap_or_else(|| MAX_GAP_SHARE * drawn.mesh.bounds().diagonal()).max(0.0);
    let mut found: BTreeMap<&str, Vec<Fault>> = BTreeMap::new();
    for fault in faults(shape, integrals, within) {
        found.entry(kinds::of(fault.kind).name).or_default().push(fault);
    }
    for (face, _) in &drawn.failed {
        let refused = found.entry(kinds::of(FaultKind::RefusedFace).name).or_default();
        if !refused.iter().any(|f| f.faces == [*face]) {
            let place = [0.0; 3];
            refused.push(Fault {
                kind: FaultKind::RefusedFace,
                faces: vec![*face],
                edges: vec![],
                place,
                size: 0.0,
            });
        }
    }
    let facets = Facets { drawn };
    let mut all = BTreeMap::new();
    for kind in MODEL_KINDS {
        let own = found.remove(kind.name).unwrap_or_default();
        let items = own.iter().take(limit).map(|fault| facets.item(shape, kind, fault)).collect();
        all.insert(kind.name.to_string(), defects(kind, own.len(), items));
    }
    let unread = model.unread.iter().filter(|u| u.holds_faces).count();
    all.insert(kinds::UNREAD.name.to_string(), defects(&kinds::UNREAD, unread, vec![]));
    let crossing = crossings.as_ref().map(|pairs| crossing::crossing_faces(pairs, drawn, shape));
    let mut crossed = defects(&kinds::CROSSING, 0, vec![]);
    match crossing {
        Some(pairs) => {
            crossed.count = Some(pairs.len() as u64);
            crossed.truncated = pairs.len() > limit;
            crossed.items = pairs.into_iter().take(limit).map(|pair| pair.item(shape)).collect();
        }
        None => (crossed.count, crossed.count_reason) = (None, kinds::CROSSING.missing.map(str::to_string)),
    }
    all.insert(kinds::CROSSING.name.to_string(), crossed);
    let is_wrong = |d: &Defects| *d.severity == Severity::Error && d.count.unwrap_or(0) > 0;
    document.sound = !all.values().any(is_wrong);
    document.area = area(integrals);
    let volumes: Option<Vec<f64>> = shape.brep.solids.iter().map(|s| shape.volume(s, integrals)).collect();
    if let (Some(volume), Some(volumes)) = (&mut document.volume, volumes.filter(|all| !all.is_empty())) {
        *volume = volumes.into_iter().sum::<Sum>().value();
    }
    document.defects = all;
    document.tolerances.gap = within;
    document
}

fn defects(kind: &DefectKind, count: usize, items: Vec<Item>) -> Defects {
    Defects {
        severity: kind.severity.word(),
        count: Some(count as u64),
        at_least: false,
        count_reason: None,
        size: kind.size.into(),
        truncated: items.len() < count,
        items,
    }
}

/// What draws faces and edges.
struct Facets<'a> {
    drawn: &'a Tessellation,
}

impl Facets<'_> {
    /// The facets of a face, the first ones.
    fn of(&self, face: u32) -> impl Iterator<Item = u32> + '_ {
        // Facets stand face by face.
        let first = self.drawn.faces.partition_point(|f| *f < face);
        let own = self.drawn.faces[first..].iter().take_while(move |f| **f == face);
        (first as u32..).zip(own).map(|(facet, _)| facet)
    }

    fn item(&self, shape: &Trimmed, kind: &DefectKind, fault: &Fault) -> Item {
        let lines = fault.edges.iter().filter_map(|e| self.drawn.edges.get(*e as usize));
        let (facets, vertices): (Vec<u32>, Vec<u32>) = match kind.shows {
            Shows::Facets => {
                (fault.faces.iter().flat_map(|f| self.of(*f)).take(MAX_FACETS_OF_ITEM).collect(), vec![])
            }
            _ => (vec![], lines.flat_map(|line| line.vertices.iter().copied()).collect()),
        };
        let mesh = &self.drawn.mesh;
        let own = facets.iter().flat_map(|f| mesh.faces[*f as usize]).chain(vertices.iter().copied());
        let places: Vec<Point> = own.map(|v| mesh.positions[v as usize]).chain([fault.place]).collect();
        Item {
            facets,
            vertices,
            position: fault.place,
            bounds: bounds(&Aabb::of(&places)),
            size: fault.size,
            measures: numbers(shape, &fault.faces, if fault.faces.len() > 1 { &[] } else { &fault.edges }),
        }
    }
}
