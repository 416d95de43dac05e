//! Meshes that planes cut.

use crate::mesh::Mesh;
use crate::noise::Noise;
use crate::spatial::lists::lists;

/// A mesh that planes cut, and what is known about its vertices.
pub struct CutMesh<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    rounding: f64,
    pub(super) noise: Option<Noise>,
    /// For each vertex where the list of its neighbors begins, and the lists.
    first: Vec<u32>,
    beside: Vec<u32>,
}

impl<'a> CutMesh<'a> {
    /// A mesh whose vertices scatter by this noise, if it is known. Vertices that facets name and that do not exist are passed over.
    pub fn new(mesh: &'a Mesh, noise: Option<Noise>) -> CutMesh<'a> {
        let count = mesh.positions.len();
        let sides = |f: &[u32; 3]| [[0, 1], [1, 2], [2, 0], [1, 0], [2, 1], [0, 2]].map(|e| e.map(|k| f[k]));
        let sound = |[a, b]: &[u32; 2]| a != b && (*a as usize) < count && (*b as usize) < count;
        let (first, beside) = lists(count, mesh.faces.iter().flat_map(sides).filter(sound).collect());
        let greatest =
            mesh.positions.iter().flatten().filter(|x| x.is_finite()).fold(0.0_f64, |m, x| m.max(x.abs()));
        // Four roundings of the greatest coordinate in single precision, as STL holds it.
        let rounding = 4.0 * f64::from(f32::EPSILON) * 0.5 * greatest;
        CutMesh { mesh, rounding, noise, first, beside }
    }

    /// The distance up to which coordinates are uncertain by the rounding of files.
    pub fn rounding(&self) -> f64 {
        self.rounding
    }

    /// Whether vertices scatter by more than rounding: they were measured.
    pub(in crate::section) fn scatters(&self) -> bool {
        /// Roundings that noise is more than.
        const ROUNDINGS: f64 = 3.0;
        self.noise.is_some_and(|n| n.deviation > ROUNDINGS * self.rounding)
    }

    pub(super) fn beside(&self, vertex: u32) -> &[u32] {
        &self.beside[self.first[vertex as usize] as usize..self.first[vertex as usize + 1] as usize]
    }
}
