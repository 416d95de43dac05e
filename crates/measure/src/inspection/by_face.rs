//! Features that are faces of a CAD model, and the model as the partition takes it.

use super::nominals::OwnFaces;
use super::parted::mesh_area;
use super::stop::Stop;
use crate::cad_faces::CadFaces;
use crate::plan::Plan;
use crate::requirement::{Feature, Source};
use std::collections::BTreeMap;
use std::sync::Arc;
use trueness_document::face::FaceRecord;
use trueness_document::plan::Class;
use trueness_geom::closest::Tree;
use trueness_geom::feature::Nominal;
use trueness_geom::mesh::Mesh;
use trueness_geom::partition::Faces;
use trueness_geom::shape::Kind;
use trueness_geom::space::Point;

/// What a feature is that is named by a place or by faces of the reference.
pub(super) struct Located {
    pub nominal: Nominal,
    /// Area of its facets, mm².
    pub area: f64,
    /// Its faces, where they are known.
    pub own: Option<OwnFaces>,
}

/// A CAD model as a reference.
pub(super) struct Model {
    pub faces: Arc<CadFaces>,
    /// Of each face of the partition, the faces of the file that are one surface there.
    pub members: Vec<Vec<u32>>,
}

impl Model {
    /// The model, and its faces for a partition: those of the file that are one surface together.
    pub fn new(faces: Arc<CadFaces>, reference: &Mesh) -> (Model, Faces) {
        let surfaces = faces.surfaces();
        let mut facets: Vec<Vec<u32>> = vec![vec![]; faces.faces.len()];
        for (facet, face) in (0u32..).zip(&faces.of_facets) {
            facets[*face as usize].push(facet);
        }
        let piece = |own: &Vec<u32>| {
            let mut all: Vec<u32> = own.iter().flat_map(|f| std::mem::take(&mut facets[*f as usize])).collect();
            all.sort_unstable();
            (all, own.first().and_then(|f| faces.faces[*f as usize].shape))
        };
        let (known, places) = Faces::known(reference, surfaces.iter().map(piece).collect());
        let members = places.into_iter().map(|place| surfaces[place].clone()).collect();
        (Model { faces, members }, known)
    }

    /// What documents say of the faces of the file that a feature is.
    pub fn records(&self, own: &OwnFaces) -> Vec<FaceRecord> {
        let mut all: Vec<u32> = match &own.part {
            Some(part) => part.faces.clone(),
            None => own.faces.iter().filter_map(|f| self.members.get(*f as usize)).flatten().copied().collect(),
        };
        all.sort_unstable();
        all.into_iter().map(|face| self.faces.record(face)).collect()
    }
}

/// Some faces of the file out of those that are one surface with them.
pub(super) struct PartOfFaces {
    /// Their numbers, ascending.
    faces: Vec<u32>,
    /// The facets of all of the surface, and which of them are theirs.
    tree: Tree,
    is_own: Vec<bool>,
}

impl PartOfFaces {
    /// Whether a place is nearer to them than to the others.
    pub fn holds(&self, p: &Point) -> bool {
        let nearest = self.tree.closest(p, f64::INFINITY).ok().flatten();
        nearest.is_some_and(|hit| self.is_own.get(hit.face as usize) == Some(&true))
    }
}

/// The features that are named by faces, by their numbers.
pub(super) fn chosen(
    plan: &Plan,
    reference: &Mesh,
    (faces, model): (&Faces, Option<&Model>),
) -> Result<BTreeMap<usize, Located>, Stop> {
    let mut all = BTreeMap::new();
    for (number, feature) in plan.features.iter().enumerate() {
        let Source::Faces(choice) = &feature.source else { continue };
        let wrong = |what: String| Stop::Plan {
            span: choice.span.clone(),
            what: format!("feature \"{}\": {what}", feature.id),
        };
        let Some(model) = model else {
            let what = "the reference is a mesh, whose facets have no faces with numbers or names; give a CAD model (STEP), or a `seed` or \
                        `nominal`";
            return Err(wrong(what.into()));
        };
        let own = model.faces.chosen(&choice.value).map_err(|e| wrong(e.to_string()))?;
        let kind = kind_of(feature.class).ok_or_else(|| wrong("faces have no such shape".into()))?;
        let nominal = model.faces.nominal(&own, kind, reference).map_err(|e| wrong(e.to_string()))?;
        let inward = own.first().and_then(|face| model.faces.faces[*face as usize].inward);
        contradicted(feature, inward).map_err(wrong)?;
        let area = mesh_area(reference, &model.faces.facets(&own));
        let own = own_faces(model, reference, faces, own).map_err(wrong)?;
        let own = Some(OwnFaces { inward, ..own });
        all.insert(number, Located { nominal, area, own });
    }
    Ok(all)
}

/// Refuses a bore that the model has as a shaft, and a shaft that it has as a bore.
fn contradicted(feature: &Feature, inward: Option<bool>) -> Result<(), String> {
    match (feature.internal, inward) {
        (Some(internal), Some(inward)) if internal != inward => Err(format!(
            "`internal` is {internal}, but the material of the reference is {} the face there",
            if inward { "around" } else { "within" }
        )),
        _ => Ok(()),
    }
}

/// The faces of the partition that have some faces of the file.
fn own_faces(model: &Model, reference: &Mesh, faces: &Faces, own: Vec<u32>) -> Result<OwnFaces, String> {
    let has_some = |members: &Vec<u32>| members.iter().any(|m| own.binary_search(m).is_ok());
    let with_some: Vec<u32> = (0..).zip(&model.members).filter(|(_, m)| has_some(m)).map(|(n, _)| n).collect();
    let whole: usize = with_some.iter().map(|n| model.members[*n as usize].len()).sum();
    let part = match whole > own.len() {
        false => None,
        true => {
            let facets = with_some.iter().flat_map(|n| &faces.all[*n as usize].facets);
            let facets: Vec<u32> = facets.copied().collect();
            let is_own = |f: &u32| own.binary_search(&model.faces.of_facets[*f as usize]).is_ok();
            let is_own = facets.iter().map(is_own).collect();
            let corners = facets.iter().map(|f| reference.faces[*f as usize]).collect();
            let mesh = Mesh { positions: reference.positions.clone(), faces: corners };
            let tree = Tree::build(&mesh).map_err(|e| e.to_string())?;
            Some(PartOfFaces { faces: own, tree, is_own })
        }
    };
    Ok(OwnFaces { faces: with_some, inward: None, is_over: true, part })
}

/// The kind of element that a feature may have on a reference.
pub(super) fn kind_of(class: Class) -> Option<Kind> {
    match class {
        Class::Plane => Some(Kind::Plane),
        Class::Cylinder => Some(Kind::Cylinder),
        Class::Cone => Some(Kind::Cone),
        Class::Sphere => Some(Kind::Sphere),
        Class::Point | Class::Line | Class::Circle | Class::Torus => None,
    }
}
