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
use crate::no_solid::genus_reason;
use crate::words::ToWord;
use entities::numbers;
use kinds::DECIDING;
use std::collections::BTreeMap;
use trueness_cad::check::{Fault, FaultKind, faults, place_of_face};
use trueness_cad::measure::Integrals;
use trueness_cad::model::Model;
use trueness_cad::tessellate::Tessellation;
use trueness_cad::trimmed::Trimmed;
use trueness_document::check::{CheckDocument, Defects, Item, SCHEMA, Severity, Tolerances};
use trueness_document::{InputRecord, UNITS, VERSION};
use trueness_geom::check::{DefectKind, Finding, Report, SELF_INTERSECTIONS, Shows};
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
    /// What the check of these facets says.
    pub of_facets: &'a Report,
}

/// The keys of the document whose numbers are those of the facets.
pub const OF_DRAWING: [&str; 6] = ["facets", "vertices", "edges", "shells", "euler_characteristic", "genus"];

/// Facets of one finding at most: of what is larger the first ones show where it is.
const MAX_FACETS_OF_ITEM: usize = 2000;
/// Gaps that count where the file states no uncertainty, as a share of the part: files have some seven digits and more.
const MAX_GAP_SHARE: f64 = 1e-7;

/// The document of a model; at most `limit` faults of each kind are listed.
pub fn document(checked: &Checked, file: InputRecord, limit: usize) -> CheckDocument {
    let Checked { model, shape, integrals, drawn, of_facets } = checked;
    let within = model.uncertainty.unwrap_or_else(|| MAX_GAP_SHARE * drawn.mesh.bounds().diagonal()).max(0.0);
    let defects = all_defects(checked, within, limit);
    // What was not looked through to the end is never sound.
    let is_wrong = |d: &Defects| *d.severity == Severity::Error && (d.at_least || d.count.unwrap_or(0) > 0);
    let precondition =
        !DECIDING.iter().any(|kind| defects.get(kind.name).is_some_and(|d| d.count != Some(0)));
    let extent = shape.bounds();
    let bounds = bounds(&extent);
    let volume = precondition.then(|| volume(shape, integrals)).flatten();
    CheckDocument {
        schema: SCHEMA.into(),
        version: VERSION.into(),
        units: UNITS.into(),
        inputs: vec![file],
        facets: drawn.mesh.faces.len() as u64,
        vertices: of_facets.vertices as u64,
        edges: of_facets.edges as u64,
        shells: of_facets.soundness.shells as u64,
        dimensions: bounds.as_ref().map(|_| minus(extent.max, extent.min)),
        bounds,
        area: area(integrals),
        volume,
        volume_reason: volume.is_none().then(|| {
            "there is no solid, or its faces are open, contradict each other or were not all read".into()
        }),
        volume_note: None,
        center_of_mass: None,
        center_of_mass_reason: Some("it is not computed for CAD models".into()),
        euler_characteristic: of_facets.euler_characteristic,
        genus: of_facets.genus,
        genus_reason: genus_reason(of_facets),
        of_drawing: OF_DRAWING.map(String::from).to_vec(),
        sound: !defects.values().any(is_wrong),
        precondition,
        tolerances: Tolerances { gap: within, sliver_angle: None, island_share: None },
        defects,
    }
}

/// The volume of all solids; `None` where there are none, or one of them has no volume.
fn volume(shape: &Trimmed, integrals: &[Option<Integrals>]) -> Option<f64> {
    let volumes: Option<Vec<f64>> = shape.brep.solids.iter().map(|s| shape.volume(s, integrals)).collect();
    let volumes = volumes.filter(|all| !all.is_empty())?;
    Some(volumes.into_iter().sum::<Sum>().value())
}

/// The faults of all kinds; edges may be `within` this distance of where they should be.
fn all_defects(checked: &Checked, within: f64, limit: usize) -> BTreeMap<String, Defects> {
    let Checked { model, shape, integrals, drawn, .. } = checked;
    let mut found: BTreeMap<&str, Vec<Fault>> = BTreeMap::new();
    for fault in faults(shape, integrals, within) {
        found.entry(kinds::of(fault.kind).name).or_default().push(fault);
    }
    for (face, _) in &drawn.failed {
        let refused = found.entry(kinds::of(FaultKind::RefusedFace).name).or_default();
        if !refused.iter().any(|f| f.faces == [*face]) {
            let (kind, place) = (FaultKind::RefusedFace, place_of_face(shape, *face));
            refused.push(Fault { kind, faces: vec![*face], edges: vec![], place, size: 0.0 });
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
    all
}

/// Faces that cross, as the pairs of facets that do tell.
fn crossing_defects(checked: &Checked, limit: usize) -> Defects {
    let mut crossed = defects(&kinds::CROSSING, 0, vec![]);
    let Some(pairs) = checked.of_facets.found(SELF_INTERSECTIONS) else {
        (crossed.count, crossed.count_reason) = (None, kinds::CROSSING.missing.map(str::to_string));
        return crossed;
    };
    let pair = |f: &Finding| Some([*f.facets.first()?, *f.facets.get(1)?]);
    let known: Vec<[u32; 2]> = pairs.items.iter().filter_map(pair).collect();
    let found = crossing::crossing_faces(&known, checked.drawn, checked.shape);
    crossed.count = Some(found.len() as u64);
    crossed.at_least = pairs.items.len() < pairs.count || pairs.at_least;
    crossed.truncated = found.len() > limit;
    crossed.items = found.into_iter().take(limit).map(|pair| pair.item(checked.shape)).collect();
    crossed
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
