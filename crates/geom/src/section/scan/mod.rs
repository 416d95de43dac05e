//! The crossings of a scan's edges with a plane, as points of its surface.
//!
//! A crossing is no vertex: it lies on the chord between two, and its noise is theirs. So each is moved onto the surface that the
//! chord stands for, weighs as many independent points as the noise that its neighbors share leaves it, and where an edge of the mesh
//! passes by a corner of the part it tells nothing.
//!
//! | file | what |
//! |---|---|
//! | `weights` | what the crossings tell, by the covariances of the vertices |
//! | `lift` | crossings moved onto the surface |

mod lift;
mod weights;

use super::cut::{Chain, PlaneFrame};
use super::prior::Known;
use super::start::{Penalty, noise, partition_with_gaps};
use crate::mesh::Mesh;
use crate::noise::Noise;
use crate::spatial::lists::lists;

/// A mesh that planes cut, and what is known about its vertices.
pub struct CutMesh<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    rounding: f64,
    noise: Option<Noise>,
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

    fn beside(&self, vertex: u32) -> &[u32] {
        &self.beside[self.first[vertex as usize] as usize..self.first[vertex as usize + 1] as usize]
    }
}

/// The crossings of a chain that tell where the surface is.
pub(super) struct ScanRow {
    /// Their numbers in the chain.
    pub kept: Vec<usize>,
    /// Their places on the surface.
    pub points: Vec<[f64; 2]>,
    /// How many independent points each tells as much as.
    pub weights: Vec<f64>,
    pub noise: Option<Known>,
}

/// Places at which a line or arc of the first partition may start.
const PLACES: usize = 1200;
/// Fewest crossings of one.
const FEWEST: usize = 4;
/// Crossings in succession that a corner may take from the mesh: edges of facets that pass it by.
const BEVEL: usize = 4;

/// Of the ways by which crossings are moved this share may be lost.
const LOST: f64 = 0.03;
/// What lies beside the end of a part, no farther off than so many standard deviations, belongs to it.
const WITHIN: f64 = 2.5;

impl ScanRow {
    /// The crossings of a chain, with these places in the plane.
    pub fn of(cut: &CutMesh, chain: &Chain, frame: &PlaneFrame, closed: bool) -> ScanRow {
        let crossings: Vec<[f64; 2]> = chain.points.iter().map(|p| frame.flat(*p)).collect();
        let count = cut.mesh.positions.len();
        let is_of_mesh = chain.edges.len() == crossings.len()
            && chain.edges.iter().flatten().all(|v| (*v as usize) < count);
        if !is_of_mesh || crossings.len() < FEWEST {
            let weights = vec![1.0; crossings.len()];
            return ScanRow { kept: (0..crossings.len()).collect(), points: crossings, weights, noise: None };
        }
        let scatter = weights::scatter(cut, chain);
        let points = lift::on_surface(cut, chain, frame, &crossings, closed);
        let lifts = points.iter().zip(&crossings).map(|(p, q)| (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2));
        let lost = LOST * (lifts.sum::<f64>() / points.len() as f64).sqrt();
        let count: f64 = scatter.weights.iter().sum();
        let deviation = cut.noise.map(|n| libm::hypot(n.deviation * scatter.share, lost));
        let level = deviation.unwrap_or_else(|| noise(&points, closed).0.max(lost)).max(cut.rounding);
        let log = libm::log(count.max(2.0));
        let penalty =
            Penalty { line: 3.0 * log, arc: 4.0 * log, noise: level, fewest: FEWEST, places: PLACES };
        let mut parts = partition_with_gaps(&points, &scatter.weights, &penalty, BEVEL);
        lift::lengthen(&mut parts, &points, WITHIN * level);
        let kept: Vec<usize> = parts.iter().flat_map(|p| p.from..p.to).collect();
        let moved = kept.iter().map(|i| points[*i]).collect();
        let weights = kept.iter().map(|i| scatter.weights[*i]).collect();
        let noise = cut.noise.zip(deviation);
        let noise = noise.map(|(n, deviation)| Known { deviation, degrees: n.patches as f64 });
        ScanRow { kept, points: moved, weights, noise }
    }
}

#[cfg(test)]
mod tests;
