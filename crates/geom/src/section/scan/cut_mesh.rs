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
    /// What departs from smooth surfaces is its form: it was not drawn of lines and arcs.
    pub(in crate::section) is_free_form: bool,
    /// For each vertex where the list of its neighbors begins, and the lists.
    first: Vec<u32>,
    beside: Vec<u32>,
}

/// Patches of some dozen vertices depart from smooth surfaces by more than this share of the distance between vertices where the form is free: a
/// fifth of it and more on scans of bodies, a thousandth on meshes of parts. What is the same everywhere is noise up to the second share.
const FORM: [f64; 2] = [0.1, 0.5];

impl<'a> CutMesh<'a> {
    /// A mesh whose vertices scatter by this noise, if it is known; of noise that is not the same everywhere ([`Noise::even`]) form is a
    /// part, which no section is told from. Vertices that facets name and that do not exist are passed over.
    pub fn new(mesh: &'a Mesh, noise: Option<Noise>) -> CutMesh<'a> {
        let count = mesh.positions.len();
        let sides = |f: &[u32; 3]| [[0, 1], [1, 2], [2, 0], [1, 0], [2, 1], [0, 2]].map(|e| e.map(|k| f[k]));
        let sound = |[a, b]: &[u32; 2]| a != b && (*a as usize) < count && (*b as usize) < count;
        let (first, beside) = lists(count, mesh.faces.iter().flat_map(sides).filter(sound).collect());
        let greatest =
            mesh.positions.iter().flatten().filter(|x| x.is_finite()).fold(0.0_f64, |m, x| m.max(x.abs()));
        // Four roundings of the greatest coordinate in single precision, as STL holds it.
        let rounding = 4.0 * f64::from(f32::EPSILON) * 0.5 * greatest;
        let is_form = |n: &Noise| n.deviation > FORM[usize::from(n.even().is_ok())] * n.spacing;
        let is_free_form = noise.as_ref().is_some_and(is_form);
        let noise = noise.filter(|n| n.even().is_ok() && !is_form(n));
        CutMesh { mesh, rounding, noise, is_free_form, first, beside }
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
