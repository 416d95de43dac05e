//! Meshes that planes cut.

use trueness_geom::mesh::Mesh;
use trueness_geom::noise::Noise;
use trueness_geom::space::{Vector, cross, dot, minus, norm, plus, unit};
use trueness_geom::spatial::lists::lists;

/// A mesh that planes cut, and the facts known about its vertices.
pub struct CutMesh<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    rounding: f64,
    pub(super) noise: Option<Noise>,
    /// Standard deviation of its vertices from smooth surfaces where that is its form: it was not drawn of lines and arcs.
    pub(crate) free_form: Option<f64>,
    /// Vertices scatter by more than rounding: they were measured.
    pub(crate) scatters: bool,
    /// For each vertex the direction in which the facets about it look, or nothing.
    facing: Vec<Vector>,
    /// For each vertex where the list of its neighbors begins, and the lists.
    first: Vec<u32>,
    neighbors_of: Vec<u32>,
}

/// Patches of some dozen vertices depart from smooth surfaces by more than the first share of the distance between vertices where
/// the form is free. On scans of bodies they do by a fifth of it and more, on meshes of parts by a thousandth. Departures that are
/// the same everywhere are noise up to the second share.
const MAX_NOISE_OF_MESH_SPACINGS: [f64; 2] = [0.1, 0.5];

/// Noise is more than so many roundings; facets of a flat face depart from one plane by no more.
const MIN_NOISE_ROUNDINGS: f64 = 3.0;
/// Vertices whose edges are looked at for flat faces.
const VERTICES_LOOKED_AT: usize = 1000;
/// The facets of so large a share of all edges lie in one plane where faces are flat.
const MIN_FLAT_SHARE: f64 = 0.05;
/// No more than this many times as many edges lie three times as near: by chance three times as many do.
const MAX_FLAT_RATIO: f64 = 1.5;

impl<'a> CutMesh<'a> {
    /// A mesh whose vertices scatter by this noise, if it is known. Noise that is not the same everywhere
    /// ([`Noise::even`]) has a part of form, which no section is told from. Vertices that facets name and that do not
    /// exist are passed over.
    pub fn new(mesh: &'a Mesh, noise: Option<Noise>) -> CutMesh<'a> {
        let count = mesh.positions.len();
        let sides = |f: &[u32; 3]| [[0, 1], [1, 2], [2, 0], [1, 0], [2, 1], [0, 2]].map(|e| e.map(|k| f[k]));
        let sound = |[a, b]: &[u32; 2]| a != b && (*a as usize) < count && (*b as usize) < count;
        let (first, neighbors_of) = lists(count, mesh.faces.iter().flat_map(sides).filter(sound).collect());
        let greatest =
            mesh.positions.iter().flatten().filter(|x| x.is_finite()).fold(0.0_f64, |m, x| m.max(x.abs()));
        // Four roundings of the greatest coordinate in single precision, as STL holds it.
        let rounding = 4.0 * f64::from(f32::EPSILON) * 0.5 * greatest;
        let is_form =
            |n: &Noise| n.deviation > MAX_NOISE_OF_MESH_SPACINGS[usize::from(n.even().is_ok())] * n.spacing;
        let facing = facing(mesh);
        let mut cut =
            CutMesh { mesh, rounding, noise, free_form: None, scatters: false, facing, first, neighbors_of };
        let is_exact = cut.has_flats();
        cut.scatters = !is_exact && noise.is_some_and(|n| n.deviation > MIN_NOISE_ROUNDINGS * rounding);
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
    pub(crate) fn is_quiet(&self) -> bool {
        self.noise.is_some() && !self.scatters
    }

    /// Whether facets lie in planes, to rounding, that chance would not leave there: noise leaves as many a little farther off.
    fn has_flats(&self) -> bool {
        let count = self.mesh.positions.len();
        let looked_at = (0..count).step_by(count.div_ceil(VERTICES_LOOKED_AT).max(1)).map(|v| v as u32);
        let edges = looked_at.flat_map(|v| self.neighbors_of(v).iter().map(move |w| [v, *w]));
        let off: Vec<f64> = edges.filter_map(|edge| self.off_plane(edge)).collect();
        let within = |reach: f64| off.iter().filter(|off| **off <= reach * self.rounding).count() as f64;
        let [flat, near] = [within(MIN_NOISE_ROUNDINGS), within(3.0 * MIN_NOISE_ROUNDINGS)];
        flat > MIN_FLAT_SHARE * off.len() as f64 && near <= MAX_FLAT_RATIO * flat
    }

    /// How far the two facets at an edge are from one plane. It is the distance of the smaller one's far corner from
    /// the plane of the larger one.
    fn off_plane(&self, [v, w]: [u32; 2]) -> Option<f64> {
        let mut both = self.neighbors_of(v).iter().filter(|n| self.neighbors_of(w).binary_search(n).is_ok());
        let (a, b) = (*both.next()?, *both.next()?);
        if both.next().is_some() {
            return None;
        }
        let at = |n: u32| self.mesh.positions[n as usize];
        let along = minus(at(w), at(v));
        let [a, b] = [a, b].map(|n| minus(at(n), at(v)));
        let [p, q] = [cross(along, a), cross(along, b)];
        let (plane, far) = if norm(p) >= norm(q) { (p, b) } else { (q, a) };
        let (normal, _) = unit(plane)?;
        Some(dot(normal, far).abs())
    }

    /// The direction in which the facets about a vertex look; 0 where they have none.
    pub(super) fn facing(&self, vertex: u32) -> Vector {
        self.facing[vertex as usize]
    }

    pub(super) fn neighbors_of(&self, vertex: u32) -> &[u32] {
        &self.neighbors_of[self.first[vertex as usize] as usize..self.first[vertex as usize + 1] as usize]
    }
}

/// Unit sums of the vector areas of the facets about each vertex.
fn facing(mesh: &Mesh) -> Vec<Vector> {
    let mut sums = vec![[0.0; 3]; mesh.positions.len()];
    for face in &mesh.faces {
        let [Some(a), Some(b), Some(c)] = face.map(|v| mesh.positions.get(v as usize)) else { continue };
        let area = cross(minus(*b, *a), minus(*c, *a));
        face.iter().for_each(|v| sums[*v as usize] = plus(sums[*v as usize], area));
    }
    sums.into_iter().map(|sum| unit(sum).map_or([0.0; 3], |(direction, _)| direction)).collect()
}
