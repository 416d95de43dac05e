//! The faces of the reference that features are.

use crate::cad_faces::CadFaces;
use std::sync::Arc;
use trueness_document::face::FaceRecord;
use trueness_document::plan::Class;
use trueness_geom::closest::Tree;
use trueness_geom::feature::Nominal;
use trueness_geom::mesh::Mesh;
use trueness_geom::partition::Faces;
use trueness_geom::shape::Kind;
use trueness_geom::space::Point;

/// The faces of the reference that a feature is.
pub(super) struct OwnFaces {
    /// Their numbers, ascending.
    pub faces: Vec<u32>,
    /// Of a cylinder, cone or sphere, whether they face its axis or center.
    pub inward: Option<bool>,
    /// Whether places of the nominal lie over them.
    pub is_over: bool,
    /// Which part of these faces it is, where it is not all of them.
    pub part: Option<PartOfFaces>,
}

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
        for (facet, face) in (0u32..).zip(&faces.drawn.of_facet) {
            facets[*face as usize].push(facet);
        }
        let piece = |own: &Vec<u32>| {
            let mut all: Vec<u32> =
                own.iter().flat_map(|f| std::mem::take(&mut facets[*f as usize])).collect();
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
            None => {
                own.faces.iter().filter_map(|f| self.members.get(*f as usize)).flatten().copied().collect()
            }
        };
        all.sort_unstable();
        all.into_iter().map(|face| self.faces.record(face)).collect()
    }
}

/// Some faces of the file out of those that are one surface with them.
pub(super) struct PartOfFaces {
    /// Their numbers, ascending.
    pub faces: Vec<u32>,
    /// The facets of all of the surface, and which of them are theirs.
    pub tree: Tree,
    pub is_own: Vec<bool>,
}

impl PartOfFaces {
    /// Whether a place is nearer to them than to the others.
    pub fn holds(&self, p: &Point) -> bool {
        let nearest = self.tree.closest(p, f64::INFINITY).ok().flatten();
        nearest.is_some_and(|hit| self.is_own.get(hit.face as usize) == Some(&true))
    }
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
