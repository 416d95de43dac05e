//! What is in a CAD model.

use std::collections::BTreeMap;
use trueness_cad::brep::Brep;
use trueness_cad::measure::Integrals;
use trueness_cad::model::Model;
use trueness_cad::surface::SurfaceKind;
use trueness_cad::tolerances::Tolerances;
use trueness_cad::trimmed::Trimmed;
use trueness_document::Word;
use trueness_document::info::{
    CadRecord, CadSurface, PartRecord, PlacementRecord, RefusedRecord, TolerancesRecord, UnreadRecord,
};
use trueness_geom::num::sum::Sum;

/// What documents tell of a model: `shape` are all of its parts where they stand, `integrals` those of its faces.
pub fn record(model: &Model, shape: &Trimmed, integrals: &[Option<Integrals>]) -> CadRecord {
    let brep = &shape.brep;
    let volumes: Vec<Option<f64>> = brep.solids.iter().map(|s| shape.volume(s, integrals)).collect();
    let lost = volumes.iter().filter(|v| v.is_none()).count();
    let missing = model.unread.iter().filter(|u| u.holds_faces).count();
    let volume_reason = match (volumes.len(), lost, missing) {
        (0, ..) => Some("the model has no solid".to_string()),
        (_, 0, 0) => None,
        (_, 0, unread) => {
            Some(format!("solids may lack faces that could not be read, in entities: {unread}"))
        }
        (n, lost, _) => {
            Some(format!("{lost} of {n} solids have faces without a border that can be followed"))
        }
    };
    let volume = volume_reason.is_none().then(|| volumes.iter().flatten().copied().sum::<Sum>().value());
    CadRecord {
        faces: kinds(brep),
        edges: brep.edges.len() as u64,
        vertices: brep.vertices.len() as u64,
        shells: brep.shells.len() as u64,
        solids: brep.solids.len() as u64,
        volume,
        volume_reason,
        volumes: if missing == 0 { volumes } else { vec![None; volumes.len()] },
        parts: parts(model),
        instances: model.instances.len() as u64,
        depth: model.depth,
        placements: model
            .instances
            .iter()
            .map(|i| PlacementRecord { path: i.path.join("/"), part: i.part, matrix: i.placement.matrix() })
            .collect(),
        coloured_faces: brep.faces.iter().filter(|f| f.color.is_some()).count() as u64,
        uncertainty: model.uncertainty,
        tolerances: tolerances(&model.tolerances),
        refused: refused(model, shape),
        unread: unread(model),
    }
}

/// The area of all faces that have a trim, mm².
pub fn area(integrals: &[Option<Integrals>]) -> f64 {
    integrals.iter().flatten().map(|i| i.area).sum::<Sum>().value()
}

fn kinds(brep: &Brep) -> BTreeMap<Word<CadSurface>, u64> {
    let mut all = BTreeMap::new();
    for face in &brep.faces {
        *all.entry(Word(word(face.surface.kind()))).or_insert(0) += 1;
    }
    all
}

/// What documents call a kind of surface.
pub(crate) fn word(kind: SurfaceKind) -> CadSurface {
    match kind {
        SurfaceKind::Plane => CadSurface::Plane,
        SurfaceKind::Cylinder => CadSurface::Cylinder,
        SurfaceKind::Cone => CadSurface::Cone,
        SurfaceKind::Sphere => CadSurface::Sphere,
        SurfaceKind::Torus => CadSurface::Torus,
        SurfaceKind::Spline => CadSurface::Spline,
        SurfaceKind::Extrusion => CadSurface::Extrusion,
        SurfaceKind::Revolution => CadSurface::Revolution,
        SurfaceKind::Offset => CadSurface::Offset,
    }
}

fn tolerances(of: &Tolerances) -> Option<TolerancesRecord> {
    let mut geometric = BTreeMap::new();
    for tolerance in &of.geometric {
        *geometric.entry(tolerance.kind.clone()).or_insert(0) += 1;
    }
    let (datums, dimensions) = (of.datums.len() as u64, of.dimensions.len() as u64);
    (!of.is_empty()).then_some(TolerancesRecord { datums, dimensions, geometric })
}

fn parts(model: &Model) -> Vec<PartRecord> {
    let mut counts = vec![0; model.parts.len()];
    for instance in &model.instances {
        if let Some(count) = counts.get_mut(instance.part as usize) {
            *count += 1;
        }
    }
    let record = |(part, instances): (&trueness_cad::model::Part, u64)| PartRecord {
        name: part.name.clone(),
        instances,
        faces: part.brep.faces.len() as u64,
        solids: part.brep.solids.len() as u64,
        wires: part.wires,
    };
    model.parts.iter().zip(counts).map(record).collect()
}

/// Faces that could not be read, then those whose border contradicts itself; a part that stands several times is told once.
fn refused(model: &Model, shape: &Trimmed) -> Vec<RefusedRecord> {
    let unread = model.unread.iter().filter(|u| u.holds_faces).map(|u| RefusedRecord {
        face: u.entity,
        keyword: u.keyword.clone(),
        why: u.reason.clone(),
    });
    let mut without: BTreeMap<u64, RefusedRecord> = BTreeMap::new();
    for (face, trim) in shape.brep.faces.iter().zip(&shape.trims) {
        if let Err(error) = trim {
            without.entry(face.entity).or_insert_with(|| RefusedRecord {
                face: face.entity,
                keyword: "ADVANCED_FACE".into(),
                why: error.to_string(),
            });
        }
    }
    unread.chain(without.into_values()).collect()
}

fn unread(model: &Model) -> Vec<UnreadRecord> {
    let mut counts: BTreeMap<(&str, &str), u64> = BTreeMap::new();
    for u in model.unread.iter().filter(|u| !u.holds_faces) {
        *counts.entry((&u.keyword, &u.reason)).or_insert(0) += 1;
    }
    let record = |((keyword, why), count): ((&str, &str), u64)| UnreadRecord {
        keyword: keyword.into(),
        count,
        why: why.into(),
    };
    counts.into_iter().map(record).collect()
}
