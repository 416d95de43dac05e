//! Meshes that planes cut.

use crate::mesh::Mesh;
use crate::noise::Noise;
use crate::space::{Point, cross, dot, minus, norm, unit};
use crate::spatial::lists::lists;

/// A mesh that planes cut, and what is known about its vertices.
pub struct CutMesh<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    rounding: f64,
    pub(super) noise: Option<Noise>,
    /// Standard deviation of its vertices from smooth surfaces where that is its form: it was not drawn of lines and arcs.
    pub(in crate::section) free_form: Option<f64>,
    /// Vertices scatter by more than rounding: they were measured.
    pub(in crate::section) scatters: bool,
    /// For each vertex where the list of its neighbors begins, and the lists.
    first: Vec<u32>,
    beside: Vec<u32>,
}

/// Patches of some dozen vertices depart from smooth surfaces by more than this share of the distance between vertices where the form is free: a
/// fifth of it and more on scans of bodies, a thousandth on meshes of parts. What is the same everywhere is noise up to the second share.
const FORM: [f64; 2] = [0.1, 0.5];

/// Roundings that noise is more than, and that flat places of a mesh without noise depart from a plane by.
const ROUNDINGS: f64 = 3.0;
/// Vertices that are looked at for flat places, neighbors that they need, and the share of flat ones that no noise leaves.
const LOOKED_AT: usize = 1000;
const NEIGHBORS: usize = 5;
const FLATS: f64 = 0.05;

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
        let mut cut = CutMesh { mesh, rounding, noise, free_form: None, scatters: false, first, beside };
        let is_exact = cut.has_flats();
        cut.scatters = !is_exact && noise.is_some_and(|n| n.deviation > ROUNDINGS * rounding);
        cut.free_form = noise.filter(|n| cut.scatters && is_form(n)).map(|n| n.deviation);
        cut.noise = match noise {
            // However rounding differs from place to place, it is none of form.
            Some(n) if !cut.scatters => Some(Noise { deviation: n.deviation.min(rounding), reach: 0.0, ..n }),
            noise => noise.filter(|n| n.even().is_ok() && !is_form(n)),
        };
        cut
    }

    /// The distance up to which coordinates are uncertain by the rounding of files.
    pub fn rounding(&self) -> f64 {
        self.rounding
    }

    /// Whether its vertices were looked at and scatter by no more than rounding.
    pub(in crate::section) fn is_quiet(&self) -> bool {
        self.noise.is_some() && !self.scatters
    }

    /// Whether more vertices than noise leaves lie in one plane with all their neighbors, to rounding.
    fn has_flats(&self) -> bool {
        let count = self.mesh.positions.len();
        let all = (0..count).step_by(count.div_ceil(LOOKED_AT).max(1)).map(|v| v as u32);
        let around: Vec<u32> = all.filter(|v| self.beside(*v).len() >= NEIGHBORS).collect();
        let flat = around.iter().filter(|v| self.is_flat(**v)).count();
        flat as f64 > FLATS * around.len() as f64
    }

    fn is_flat(&self, vertex: u32) -> bool {
        let at = |v: u32| self.mesh.positions[v as usize];
        let ways: Vec<Point> = self.beside(vertex).iter().map(|v| minus(at(*v), at(vertex))).collect();
        let normals = ways.iter().map(|way| cross(ways[0], *way));
        let Some((normal, _)) = normals.max_by(|a, b| norm(*a).total_cmp(&norm(*b))).and_then(unit) else {
            return false;
        };
        ways.iter().all(|way| dot(normal, *way).abs() <= ROUNDINGS * self.rounding)
    }

    pub(super) fn beside(&self, vertex: u32) -> &[u32] {
        &self.beside[self.first[vertex as usize] as usize..self.first[vertex as usize + 1] as usize]
    }
}
