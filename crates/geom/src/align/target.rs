//! The reference of an alignment.

use crate::closest::{QueryError, Tree};
use crate::mesh::Mesh;
use crate::progress::Progress;
use crate::space::{Aabb, Point, Vector};

/// Exact surfaces that a mesh only draws.
pub trait ExactSurface: Sync {
    /// Their nearest places to points, in the order of these; `None` where there is none.
    ///
    /// # Errors
    /// [`QueryError`], as a search of a mesh has it.
    fn feet(&self, points: &[Point], progress: &dyn Progress) -> Result<Vec<Option<ExactFoot>>, QueryError>;
}

/// The nearest place of exact surfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExactFoot {
    /// The place.
    pub place: Point,
    /// Unit normal there, out of the material.
    pub normal: Vector,
    /// Whether it lies within a face, not on an edge or a corner.
    pub is_within: bool,
    /// Whether the surfaces end there.
    pub is_border: bool,
}

/// The reference: a mesh with its search tree.
#[derive(Clone, Copy)]
pub struct Target<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) tree: &'a Tree,
    pub(super) exact: Option<&'a dyn ExactSurface>,
    pub(super) bounds: Aabb,
}

impl<'a> Target<'a> {
    /// The target for a mesh, millimeters, whose search tree is `tree`. Vertices should be shared by index (weld an STL first).
    pub fn new(mesh: &'a Mesh, tree: &'a Tree) -> Target<'a> {
        let used = mesh.faces.iter().flatten().map(|&v| &mesh.positions[v as usize]);
        Target { mesh, tree, exact: None, bounds: Aabb::of(used) }
    }

    /// The same where the mesh only draws exact surfaces: a best fit ends on these, and its figures are those of distances from them.
    pub fn drawing(self, exact: Option<&'a dyn ExactSurface>) -> Target<'a> {
        Target { exact, ..self }
    }
}
