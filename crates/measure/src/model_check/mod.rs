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
use trueness_cad::check::{Fault, FaultKind, faults, place_of_face};
use trueness_cad::measure::Integrals;
use trueness_cad::model::Model;
use trueness_cad::tessellate::Tessellation;
use trueness_cad::trimmed::Trimmed;
use trueness_document::check::{CheckDocument, Defects, Item, Severity};
use trueness_geom::check::{DefectKind, Shows};
use trueness_geom::num::sum::Sum;
use trueness_geom::space::{Aabb, Point, minus};

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
    /// Facets that meet where they should not; `None` where they were not looked for.
    pub crossings: Option<CrossingFacets>,
}

/// Facets that meet where they should not.
pub struct CrossingFacets {
    /// Pairs of them.
    pub pairs: Vec<[u32; 2]>,
    /// Whether these are all.
    pub are_all: bool,
}

/// Facets of one finding at most: of what is larger the first ones show where it is.
const MAX_FACETS_OF_ITEM: usize = 2000;
/// Gaps that count where the file states no uncertainty, as a share of the part: files have some seven digits and more.
const MAX_GAP_SHARE: f64 = 1e-7;

/// The document of the facets with the faults of the model in place of theirs; at most `limit` of each kind are listed.
pub fn with_model(mut document: CheckDocument, checked: &Checked, limit: usize) -> CheckDocument {
    let Checked { model, shape, integrals, drawn, .. } = checked;
    let within = model.uncertainty.unwrap_or_else(|| MAX_GAP_SHARE * drawn.mesh.bounds().diagonal()).max(0.0);
    let mut found: BTreeMap<&str, Vec<Fault>> = BTreeMap::new();
    for fault in faults(shape, integrals, within) {
        found.entry(kinds::of(fault.kind).name).or_default().push(fault);
    }
    for (face, _) in &drawn.failed {
        let refused = found.entry(kinds::of(FaultKind::RefusedFace).name).or_default();
        if !refused.iter().any(|f| f.faces == [*face]) {
            let place = place_of_face(shape, *face);
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
    all.insert(kinds::CROSSING.name.to_string(), crossing_defects(checked, limit));
    // What was not looked through to the end is never sound.
    let is_wrong = |d: &Defects| *d.severity == Severity::Error && (d.at_least || d.count.unwrap_or(0) > 0);
    document.sound = !all.values().any(is_wrong);
    let borders =
        [FaultKind::FreeEdge, FaultKind::SharedEdge, FaultKind::OppositeFaces, FaultKind::InsideOutSolid];
    let refused = [kinds::of(FaultKind::RefusedFace).name, kinds::UNREAD.name];
    let mut deciding = borders.into_iter().map(|kind| kinds::of(kind).name).chain(refused);
    document.precondition = !deciding.any(|name| all.get(name).is_some_and(|d| d.count != Some(0)));
    exact_measures(&mut document, shape, integrals);
    document.defects = all;
    document.tolerances.gap = within;
    document
}

/// Faces that cross.
fn crossing_defects(checked: &Checked, limit: usize) -> Defects {
    let mut crossed = defects(&kinds::CROSSING, 0, vec![]);
    match &checked.crossings {
        Some(CrossingFacets { pairs, are_all }) => {
            let found = crossing::crossing_faces(pairs, checked.drawn, checked.shape);
            crossed.count = Some(found.len() as u64);
            crossed.at_least = !are_all;
            crossed.truncated = found.len() > limit;
            crossed.items = found.into_iter().take(limit).map(|pair| pair.item(checked.shape)).collect();
        }
        None => (crossed.count, crossed.count_reason) = (None, kinds::CROSSING.missing.map(str::to_string)),
    }
    crossed
}

/// Box, area and volume of the faces in place of those of their facets.
fn exact_measures(document: &mut CheckDocument, shape: &Trimmed, integrals: &[Option<Integrals>]) {
    let extent = shape.bounds();
    document.bounds = bounds(&extent);
    document.dimensions = document.bounds.as_ref().map(|_| minus(extent.max, extent.min));
    document.area = area(integrals);
    let volumes: Option<Vec<f64>> = shape.brep.solids.iter().map(|s| shape.volume(s, integrals)).collect();
    let volumes = volumes.filter(|all| document.precondition && !all.is_empty());
    let without = volumes.is_none().then(|| {
        "there is no solid, or its faces are open, contradict each other or were not all read".to_string()
    });
    document.volume = volumes.map(|all| all.into_iter().sum::<Sum>().value());
    document.volume_reason = without;
    document.volume_note = None;
    document.center_of_mass = None;
    document.center_of_mass_reason = Some("it is not computed for CAD models".into());
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
            measures: numbers(shape, &fault.faces, &fault.edges),
        }
    }
}
