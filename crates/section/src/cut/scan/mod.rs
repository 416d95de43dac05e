//! The crossings of a scan's edges with a plane, as points of its surface.
//!
//! A crossing is no vertex: it lies on the chord between two, and its noise is theirs. So each is moved onto the
//! surface that the chord stands for. It weighs as many independent points as the noise that its neighbors share leaves
//! it. Where an edge of the mesh passes by a corner of the part it tells nothing.
//!
//! | file | what |
//! |---|---|
//! | `cut_mesh` | meshes that planes cut |
//! | `weights` | what the crossings tell, by the covariances of the vertices |
//! | `lift` | crossings moved onto the surface |

mod cut_mesh;
mod lift;
mod weights;

use super::plane::Chain;
use crate::model::flat::distance;
use crate::model::prior::KnownNoise;
use crate::search::partition::{MAX_PART_STARTS, Penalty, partition_with_gaps};
use crate::search::parts::noise;
pub use cut_mesh::CutMesh;
use trueness_geom::plane::PlaneFrame;

/// The crossings of a chain that tell where the surface is.
pub(super) struct ScanRow {
    /// Their numbers in the chain.
    pub kept: Vec<usize>,
    /// Their places on the surface.
    pub points: Vec<[f64; 2]>,
    /// How many independent points each tells as much as.
    pub weights: Vec<f64>,
    pub noise: Option<KnownNoise>,
}

/// Fewest crossings of one.
const MIN_CROSSINGS_PER_PART: usize = 4;
/// Crossings in succession that a corner may take from the mesh: edges of facets that pass it by.
const MAX_CROSSINGS_AT_CORNER: usize = 4;

/// This share of the ways by which crossings are moved may be lost.
const MAX_LOST_LIFT_SHARE: f64 = 0.08;
/// The share is taken of a way that is longer than so many percent.
const LONG_LIFT_PERCENTILE: usize = 95;
/// A crossing beside the end of a part, no farther off than so many standard deviations, belongs to it.
const PART_END_SIGMAS: f64 = 2.5;

/// Crossings stay that would scatter more by this factor on the surface than where they are: facets so large do not tell the
/// surface.
const MAX_ROUGHNESS_RATIO: f64 = 1.2;

fn smoother(moved: Vec<[f64; 2]>, crossings: &[[f64; 2]], closed: bool) -> Vec<[f64; 2]> {
    let [there, here] = [&moved[..], crossings].map(|points| noise(points, closed).0);
    if there > MAX_ROUGHNESS_RATIO * here { crossings.to_vec() } else { moved }
}

/// A plane within rounding of a vertex cuts several of its edges at one place. Crossings no farther apart than rounding
/// are one, with the weight of all.
fn gather_at_vertices(
    crossings: &[[f64; 2]],
    rounding: f64,
    closed: bool,
    points: &mut [[f64; 2]],
    weights: &mut [f64],
) {
    let n = crossings.len();
    let mut join = |i: usize, first: usize| {
        points[i] = points[first];
        weights[first] = (weights[first] + weights[i]).min(1.0);
    };
    let near = |i: usize, j: usize| distance(crossings[i], crossings[j]) <= rounding;
    let over_seam = if closed { (1..n).rev().take_while(|i| near(*i, 0)).count() } else { 0 };
    (n - over_seam..n).for_each(|i| join(i, 0));
    let mut first = 0;
    for i in 1..n - over_seam {
        if near(i, first) {
            join(i, first);
        } else {
            first = i;
        }
    }
}

impl ScanRow {
    /// Whether the crossings with these numbers, moved onto the surface, scatter less than where they are, `at`. Chords
    /// of a drawing would not tell that the surface lies beyond them.
    pub fn is_smoother_than(&self, at: &[[f64; 2]], numbers: &[usize], closed: bool) -> bool {
        let mut moved = at.to_vec();
        self.kept.iter().zip(&self.points).for_each(|(i, p)| moved[*i] = *p);
        let [there, here] = [&moved[..], at].map(|all| {
            let own: Vec<[f64; 2]> = numbers.iter().map(|i| all[*i]).collect();
            noise(&own, closed).0
        });
        here > MAX_ROUGHNESS_RATIO * there
    }

    /// The crossings of a chain, with these places in the plane.
    pub fn of(cut: &CutMesh, chain: &Chain, frame: &PlaneFrame, closed: bool) -> ScanRow {
        let crossings: Vec<[f64; 2]> = chain.points.iter().map(|p| frame.flat(*p)).collect();
        let count = cut.mesh.positions.len();
        let is_of_mesh = chain.edges.len() == crossings.len()
            && chain.edges.iter().flatten().all(|v| (*v as usize) < count);
        if !is_of_mesh || crossings.len() < MIN_CROSSINGS_PER_PART {
            let weights = vec![1.0; crossings.len()];
            return ScanRow { kept: (0..crossings.len()).collect(), points: crossings, weights, noise: None };
        }
        let mut scatter = weights::scatter(cut, chain);
        let mut points =
            smoother(lift::on_surface(cut, chain, frame, &crossings, closed), &crossings, closed);
        gather_at_vertices(&crossings, cut.rounding(), closed, &mut points, &mut scatter.weights);
        if cut.free_form.is_some() {
            let kept = (0..points.len()).collect();
            return ScanRow { kept, points, weights: scatter.weights, noise: None };
        }
        let mut lifts: Vec<f64> =
            points.iter().zip(&crossings).map(|(p, q)| libm::hypot(p[0] - q[0], p[1] - q[1])).collect();
        lifts.sort_by(f64::total_cmp);
        let lost = MAX_LOST_LIFT_SHARE * lifts[LONG_LIFT_PERCENTILE * (lifts.len() - 1) / 100];
        let count: f64 = scatter.weights.iter().sum();
        let deviation = cut.noise.map(|n| libm::hypot(n.deviation * scatter.share, lost));
        let level = deviation.unwrap_or_else(|| noise(&points, closed).0.max(lost)).max(cut.rounding());
        let log = libm::log(count.max(2.0));
        let penalty = Penalty {
            line: 3.0 * log,
            arc: 4.0 * log,
            noise: level,
            fewest: MIN_CROSSINGS_PER_PART,
            places: MAX_PART_STARTS,
        };
        let mut parts = partition_with_gaps(&points, &scatter.weights, &penalty, MAX_CROSSINGS_AT_CORNER);
        lift::lengthen(&mut parts, &points, PART_END_SIGMAS * level);
        let kept: Vec<usize> = parts.iter().flat_map(|p| p.from..p.to).collect();
        let moved = kept.iter().map(|i| points[*i]).collect();
        let weights = kept.iter().map(|i| scatter.weights[*i]).collect();
        let noise = cut.noise.zip(deviation);
        let noise = noise.map(|(n, deviation)| KnownNoise { deviation, degrees: n.patches as f64 });
        ScanRow { kept, points: moved, weights, noise }
    }
}

#[cfg(test)]
mod tests;
