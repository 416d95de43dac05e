//! What a report draws of a repair: the mesh before and after, what went and what came, and where each change was made.

use crate::{Geometry, Mark, MarkGroup, Marks, ViewObject, ViewRole};
use std::collections::HashSet;
use trueness_document::repair::{Change, RepairDocument, RepairStep};
use trueness_document::scale::palette::{Rgb, category};
use trueness_geom::closest::Tree;
use trueness_geom::mesh::Mesh;
use trueness_geom::space::{Point, Vector, normal};

/// Facets drawn as new or gone, at most.
const MAX_DRAWN_FACETS: usize = 100_000;
/// Color of facets that came.
pub const NEW: Rgb = [0x00, 0x91, 0x3f];
/// Color of facets that went.
pub const GONE: Rgb = [0xc8, 0x1e, 0x1e];

/// A repair prepared for drawing.
pub struct View<'a> {
    name: &'a str,
    before: &'a Mesh,
    after: &'a Mesh,
    /// The listed changes by step, then new facets, then those gone.
    pub marks: Vec<Marks>,
}

/// The listed changes step by step, steps in the order of their first change.
pub fn by_step(document: &RepairDocument) -> Vec<(RepairStep, Vec<&Change>)> {
    let mut steps: Vec<(RepairStep, Vec<&Change>)> = vec![];
    for change in &document.changes {
        match steps.iter_mut().find(|(step, _)| *step == *change.step) {
            Some((_, changes)) => changes.push(change),
            None => steps.push((*change.step, vec![change])),
        }
    }
    steps
}

impl<'a> View<'a> {
    /// Of the repair that the document is of; `name` is shown to the reader.
    pub fn new(document: &RepairDocument, name: &'a str, before: &'a Mesh, after: &'a Mesh) -> View<'a> {
        let surface = MendedMesh { mesh: after, tree: Tree::build(after).ok() };
        let steps = by_step(document).into_iter().enumerate();
        let groups = steps.map(|(n, (step, changes))| MarkGroup {
            key: format!("step.{}", step.name()),
            color: category(n),
            items: changes.into_iter().map(|c| surface.dot(c)).collect(),
        });
        let changes = Marks { role: ViewRole::Changes, comparison: None, groups: groups.collect() };
        let sheet = |role, key: &str, color, facets: Vec<[Point; 3]>| {
            let mark = Mark { triangles: facets, ..Mark::default() };
            Marks {
                role,
                comparison: None,
                groups: vec![MarkGroup { key: key.into(), color, items: vec![mark.finite()] }],
            }
        };
        let came = sheet(ViewRole::After, "facets.new", NEW, only_in(after, before));
        let went = sheet(ViewRole::Before, "facets.gone", GONE, only_in(before, after));
        View { name, before, after, marks: vec![changes, came, went] }
    }

    /// The mesh after, and before.
    pub fn objects(&self) -> Vec<ViewObject<'_>> {
        [(ViewRole::After, self.after), (ViewRole::Before, self.before)]
            .map(|(role, mesh)| {
                let geometry = Geometry::Mesh(mesh);
                ViewObject {
                    role,
                    name: self.name,
                    color: None,
                    comparison: None,
                    geometry,
                    fields: vec![],
                    keep: &[],
                    gathered: None,
                    faces: None,
                }
            })
            .into()
    }
}

/// The mended surface, to tell which way it looks somewhere.
struct MendedMesh<'a> {
    mesh: &'a Mesh,
    tree: Option<Tree>,
}

impl MendedMesh<'_> {
    fn dot(&self, change: &Change) -> Mark {
        let (points, normal) = (vec![change.position], self.normal(&change.position));
        Mark { points, normal, ..Mark::default() }.finite()
    }

    /// Normal of the facet nearest to a place.
    fn normal(&self, place: &Point) -> Option<Vector> {
        let nearest = self.tree.as_ref()?.closest(place, f64::INFINITY).ok()??;
        let corner =
            |k: usize| self.mesh.positions.get(self.mesh.faces.get(nearest.face as usize)?[k] as usize);
        normal([*corner(0)?, *corner(1)?, *corner(2)?])
    }
}

/// Facets of `mesh` whose three places are those of no facet of `other`, whichever way round; not more than can be drawn. Places
/// are compared in single precision: a mesh mended for a format that holds no more is rounded throughout.
fn only_in(mesh: &Mesh, other: &Mesh) -> Vec<[Point; 3]> {
    let corners = |mesh: &Mesh, f: &[u32; 3]| -> Option<[Point; 3]> {
        let [a, b, c] = f.map(|v| mesh.positions.get(v as usize).copied());
        Some([a?, b?, c?])
    };
    // Zero has no sign, and the order of the corners does not matter.
    let key = |t: [Point; 3]| {
        let mut bits = t.map(|p| p.map(|x| (x as f32 + 0.0).to_bits()));
        bits.sort_unstable();
        bits
    };
    let known: HashSet<_> = other.faces.iter().filter_map(|f| corners(other, f)).map(key).collect();
    let new = mesh.faces.iter().filter_map(|f| corners(mesh, f)).filter(|t| !known.contains(&key(*t)));
    new.take(MAX_DRAWN_FACETS).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_came_and_went_is_found_by_place() {
        let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, -0.0], [1.0, 1.0, 0.0]];
        let before = Mesh { positions: positions.clone(), faces: vec![[0, 1, 2], [1, 3, 2]] };
        // The same first facet turned over with other numbers, and another second one.
        let mut turned = positions.clone();
        turned.reverse();
        turned[1][2] = 0.0;
        let after = Mesh { positions: turned, faces: vec![[3, 1, 2], [0, 1, 3]] };
        assert_eq!(only_in(&after, &before), [[[1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.0; 3]]]);
        assert_eq!(only_in(&before, &after), [[[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, -0.0]]]);
        assert_eq!(only_in(&before, &before), Vec::<[Point; 3]>::new());
        let fine = |x: f64| Mesh {
            positions: before.positions.iter().map(|p| p.map(|c| c * x)).collect(),
            ..before.clone()
        };
        let single = |m: Mesh| Mesh {
            positions: m.positions.iter().map(|p| p.map(|c| f64::from(c as f32))).collect(),
            ..m
        };
        assert_eq!(only_in(&single(fine(0.1)), &fine(0.1)), Vec::<[Point; 3]>::new());
    }
}
