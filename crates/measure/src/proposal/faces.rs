//! The faces of a model as features of plans: faces on one surface are one feature.

use crate::area::mesh_area;
use crate::cad_faces::{CadFace, CadFaces};
use std::collections::BTreeMap;
use trueness_geom::feature::Nominal;
use trueness_geom::mesh::Mesh;
use trueness_geom::shape::Shape;
use trueness_geom::space::{cross, dot, norm, plus, times};

/// Sine of the angle within which directions are one: 0.001 mm over 100 mm.
pub(super) const MAX_SINE_OF_AXES: f64 = 1e-5;

/// Features of one tolerance, or of a proposal without tolerances, at most.
const MAX_GROUPS: usize = 2000;

/// Faces of one instance that lie on one surface.
#[derive(Clone, Debug)]
pub(super) struct Group {
    /// The surface; the normal of a plane points out of the material.
    pub shape: Shape,
    /// Whether the material is around it; `None` of a plane.
    pub internal: Option<bool>,
    /// Numbers of the faces, in their order.
    pub faces: Vec<u64>,
    /// Their places among the faces of the model.
    own: Vec<u32>,
}

/// The faces of a model by their numbers.
pub(super) struct Faces<'m> {
    cad: &'m CadFaces,
    /// What draws them.
    mesh: &'m Mesh,
    of: BTreeMap<u64, Vec<u32>>,
}

impl<'m> Faces<'m> {
    /// Those of a model where they stand; `mesh` draws them.
    pub fn of(cad: &'m CadFaces, mesh: &'m Mesh) -> Faces<'m> {
        let mut of: BTreeMap<u64, Vec<u32>> = BTreeMap::new();
        for (index, face) in (0u32..).zip(&cad.faces) {
            of.entry(face.entity).or_default().push(index);
        }
        Faces { cad, mesh, of }
    }

    /// The numbers of all faces.
    pub fn numbers(&self) -> impl Iterator<Item = u64> + '_ {
        self.of.keys().copied()
    }

    /// Where the faces of a group stand, and how many instances have them, where any is in several.
    pub fn instance(&self, group: &Group) -> Option<(&str, usize)> {
        let counts = group.faces.iter().filter_map(|face| self.of.get(face)).map(Vec::len);
        let count = counts.max().filter(|count| *count > 1)?;
        let instance = self.face(*group.own.first()?).instance;
        Some((self.cad.instances.get(instance as usize)?, count))
    }

    fn face(&self, index: u32) -> &CadFace {
        &self.cad.faces[index as usize]
    }

    /// The nominal of a group; `None` where its faces have none together.
    pub fn nominal(&self, group: &Group) -> Option<Nominal> {
        self.cad.nominal(&group.own, group.shape.kind(), self.mesh).ok()
    }

    /// The area of the facets of a group, mm².
    pub fn area(&self, group: &Group) -> f64 {
        mesh_area(self.mesh, &self.cad.facets(&group.own))
    }

    /// Features of these faces, each in its first instance, and what of them is none.
    pub fn groups(&self, faces: impl IntoIterator<Item = u64>) -> (Vec<Group>, Vec<String>) {
        let (mut groups, mut none): (Vec<Group>, Vec<String>) = (vec![], vec![]);
        for number in faces {
            let Some(index) = self.of.get(&number).and_then(|all| all.first()).copied() else {
                none.push(format!("face {number} was not read"));
                continue;
            };
            let face = self.face(index);
            let shape = face.shape.filter(|shape| shape.kind().has_nominal());
            let (Some(shape), None) = (shape, &face.missing) else {
                none.push(match &face.missing {
                    Some(why) => format!("face {number} could not be read: {why}"),
                    None => format!("face {number} is {}", name(face.kind_name())),
                });
                continue;
            };
            let is_full = groups.len() == MAX_GROUPS;
            let same = |g: &&mut Group| {
                let first = g.own[0];
                self.face(first).instance == face.instance && self.cad.is_one(first, index)
            };
            match groups.iter_mut().find(same) {
                Some(group) => {
                    group.faces.push(number);
                    group.own.push(index);
                }
                None if !is_full => {
                    let internal = face.inward;
                    groups.push(Group { shape, internal, faces: vec![number], own: vec![index] });
                }
                None => {
                    none.push(format!("the faces from {number} on are more than {MAX_GROUPS} surfaces"));
                    break;
                }
            }
        }
        (groups, none)
    }
}

/// A word with its article.
fn name(word: &str) -> String {
    let article = if word.starts_with(['a', 'e', 'i', 'o']) { "an" } else { "a" };
    format!("{article} {word}")
}

/// The plane amid two planes that face opposite ways, as those of a slot or a block: a point and the normal of the first.
pub(super) fn median(groups: &[Group]) -> Option<Shape> {
    let [a, b] = groups else { return None };
    match (a.shape, b.shape) {
        (Shape::Plane { point: p, normal }, Shape::Plane { point: q, normal: n })
            if dot(normal, n) < 0.0 && norm(cross(normal, n)) < MAX_SINE_OF_AXES =>
        {
            Some(Shape::Plane { point: times(0.5, plus(p, q)), normal })
        }
        _ => None,
    }
}
