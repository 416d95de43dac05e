//! The reference of an alignment.

use crate::closest::Tree;
use crate::mesh::Mesh;
use crate::space::Aabb;

/// The reference: a mesh with its search tree.
#[derive(Clone, Copy)]
pub struct Target<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) tree: &'a Tree,
    pub(super) bounds: Aabb,
}

impl<'a> Target<'a> {
    /// The target for a mesh, millimeters, whose search tree is `tree`. Vertices should be shared by index (weld an STL first).
    pub fn new(mesh: &'a Mesh, tree: &'a Tree) -> Target<'a> {
        let used = mesh.faces.iter().flatten().map(|&v| &mesh.positions[v as usize]);
        Target { mesh, tree, bounds: Aabb::of(used) }
    }
}
