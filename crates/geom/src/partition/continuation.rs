//! Where the surface of a face goes on near its border, by the sure points around.

use super::best::Candidate;
use super::faces::{Face, Seat};
use super::placed::Placed;
use super::terms::EXPLAINED_SIGMAS;
use crate::num::median::median;
use crate::num::random::Random;
use crate::parallel::prelude::*;
use crate::shape::axes_along;
use crate::space::{Point, Vector, dot, minus};
use crate::spatial::neighbors::PointTree;

/// Points around that tell how the surface goes on.
const PLANE_NEIGHBORS: usize = 16;
/// Places of a face where the noise is looked at.
const NOISE_PLACES: usize = 60;
const PLANE_UNKNOWNS: usize = 3;

/// The sure points of a face.
pub(super) struct Sure<'a> {
    face: &'a Face,
    pub(super) placed: &'a Placed,
    places: Vec<Point>,
    normals: Vec<Vector>,
    offs: Vec<f64>,
    tree: PointTree,
}

/// The surface at a place as the points around continue it.
struct Continuation {
    /// How far it lies off the face where that really is.
    off: f64,
    /// Variance of that over that of a point.
    share: f64,
    /// Deviation of the points around.
    deviation: f64,
}

impl<'a> Sure<'a> {
    pub(super) fn new(face: &'a Face, placed: &'a Placed, points: &[Point], sure: &[Candidate]) -> Sure<'a> {
        // Points that the face does not explain, such as a wall that stands on it, tell nothing of it.
        let (mut places, mut normals, mut offs) = (vec![], vec![], vec![]);
        for c in sure {
            let p = points[c.point as usize];
            let off = placed.off(face, p, c.seat);
            if off.abs() <= EXPLAINED_SIGMAS * placed.deviation {
                places.push(p);
                normals.push(c.seat.normal());
                offs.push(off);
            }
        }
        Sure { face, placed, tree: PointTree::new(&places), places, normals, offs }
    }

    /// How many deviations a point lies off the surface that the points around tell; `None` beyond the reach.
    pub(super) fn off_over(&self, p: Point, seat: Seat, reach: f64, noise: f64) -> Option<f64> {
        let off = self.placed.off(self.face, p, seat);
        let over = || match self.continuation(p, seat.normal()) {
            Some(continuation) => {
                (off - continuation.off).abs()
                    / ((1.0 + continuation.share).sqrt() * continuation.deviation.max(noise))
            }
            None => off.abs() / self.placed.deviation.max(noise),
        };
        (off.abs() <= reach).then(over)
    }

    fn continuation(&self, p: Point, normal: Vector) -> Option<Continuation> {
        if self.places.len() <= PLANE_NEIGHBORS {
            return None;
        }
        let near = self.tree.k_nearest(&p, PLANE_NEIGHBORS, None);
        let axes = axes_along(normal);
        let reach = near.last()?.0.sqrt().max(f64::MIN_POSITIVE);
        let rows: Vec<([f64; PLANE_UNKNOWNS], f64)> = near
            .iter()
            .map(|n| {
                let q = minus(self.places[n.1 as usize], p);
                ([1.0, dot(q, axes[0]) / reach, dot(q, axes[1]) / reach], self.offs[n.1 as usize])
            })
            .collect();
        let mut normal_matrix = [[0.0; PLANE_UNKNOWNS]; PLANE_UNKNOWNS];
        let mut right = [0.0; PLANE_UNKNOWNS];
        for (row, off) in &rows {
            for i in 0..PLANE_UNKNOWNS {
                right[i] += row[i] * off;
                (0..PLANE_UNKNOWNS).for_each(|j| normal_matrix[i][j] += row[i] * row[j]);
            }
        }
        let inverse = inverted(normal_matrix)?;
        let solution: [f64; PLANE_UNKNOWNS] =
            std::array::from_fn(|i| (0..PLANE_UNKNOWNS).map(|j| inverse[i][j] * right[j]).sum());
        let left = |(row, off): &([f64; PLANE_UNKNOWNS], f64)| {
            off - (0..PLANE_UNKNOWNS).map(|i| row[i] * solution[i]).sum::<f64>()
        };
        let squares: f64 = rows.iter().map(|r| left(r).powi(2)).sum();
        Some(Continuation {
            off: solution[0],
            share: inverse[0][0].max(0.0),
            deviation: (squares / (rows.len() - PLANE_UNKNOWNS) as f64).sqrt(),
        })
    }
}

/// The inverse of a symmetric matrix, `None` where it has none.
fn inverted(m: [[f64; PLANE_UNKNOWNS]; PLANE_UNKNOWNS]) -> Option<[[f64; PLANE_UNKNOWNS]; PLANE_UNKNOWNS]> {
    let minor = |i: usize, j: usize| {
        let [a, b] = [(i + 1) % 3, (i + 2) % 3];
        let [c, d] = [(j + 1) % 3, (j + 2) % 3];
        m[a][c] * m[b][d] - m[a][d] * m[b][c]
    };
    let determinant: f64 = (0..3).map(|j| m[0][j] * minor(0, j)).sum();
    let greatest = m[0][0] * m[1][1] * m[2][2];
    (determinant > 1e-9 * greatest)
        .then(|| std::array::from_fn(|i| std::array::from_fn(|j| minor(j, i) / determinant)))
}

/// The scatter of points about the surface that their neighbors tell: the median over some places of all faces.
pub(super) fn noise(all: &[Sure], seed: u64) -> f64 {
    let mut found: Vec<f64> = (all.par_iter())
        .flat_map_iter(|sure| {
            let chosen = Random::new(seed).choose(NOISE_PLACES, sure.places.len());
            let continuation = |i: usize| sure.continuation(sure.places[i], sure.normals[i]);
            chosen.into_iter().filter_map(move |i| continuation(i).map(|t| t.deviation))
        })
        .collect();
    median(&mut found).unwrap_or(0.0)
}
