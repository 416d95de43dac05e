//! Fewer triangles over the same vertices.
//!
//! Edges are collapsed (meshoptimizer) in pieces of bounded size: several at a time, and so that a stop is heard between them.
//! A piece keeps its rim; where that leaves too much, other pieces are cut and it is done again.

use super::order;
use meshopt::{SimplifyOptions, VertexDataAdapter};
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Aabb, Point};

/// Triangles of a piece: a few hundredths of a second of work.
const TRIANGLES_PER_PIECE: usize = 40_000;
/// How often pieces are cut anew.
const CUT_ROUNDS: usize = 4;
/// So near the number asked for is near enough.
const NEAR_ENOUGH_FACTOR: f64 = 1.06;

/// Places that triangles are simplified over, in single precision after a corner of their box was taken off.
pub struct Places {
    near: Vec<[f32; 3]>,
    grid: order::Curve,
}

impl Places {
    /// Of the vertices of a mesh.
    pub fn of(positions: &[Point]) -> Places {
        let bounds = Aabb::of(positions);
        let off = |p: &Point| std::array::from_fn(|k| (p[k] - bounds.min[k]) as f32);
        Places { near: positions.par_iter().map(off).collect(), grid: order::Curve::over(&bounds) }
    }

    /// Collapses edges onto existing vertices until about `target` triangles are left. Vertices in `locks` stay. The error is
    /// in millimeters, a bound of the sum over all rounds.
    pub fn simplify(
        &self,
        corners: &[u32],
        locks: &[bool],
        target: usize,
        progress: &dyn Progress,
    ) -> Result<(Vec<u32>, f64), Cancelled> {
        let mut left = corners.to_vec();
        let mut error = 0.0;
        for round in 0..CUT_ROUNDS {
            let count = left.len() / 3;
            if count as f64 <= NEAR_ENOUGH_FACTOR * target as f64 {
                break;
            }
            let whole = count <= 2 * TRIANGLES_PER_PIECE;
            if !whole {
                left = self.grid.sorted(&left, |v| self.near[v as usize], round);
            }
            let size = if whole { left.len() } else { 3 * TRIANGLES_PER_PIECE };
            let share = target as f64 / count as f64;
            let pieces: Vec<(Vec<u32>, f64)> = left
                .par_chunks(size.max(3))
                .map(|piece| match progress.cancelled() {
                    true => Err(Cancelled),
                    false => {
                        Ok(self.collapse(piece, locks, (share * (piece.len() / 3) as f64) as usize, !whole))
                    }
                })
                .collect::<Result<_, _>>()?;
            error += pieces.iter().map(|(_, e)| *e).fold(0.0, f64::max);
            let before = left.len();
            left = pieces.into_iter().flat_map(|(corners, _)| corners).collect();
            if whole || left.len() == before {
                break;
            }
        }
        Ok((left, error))
    }

    fn collapse(&self, corners: &[u32], locks: &[bool], target: usize, rim: bool) -> (Vec<u32>, f64) {
        let Ok(vertices) = VertexDataAdapter::new(meshopt::typed_to_bytes(&self.near), 12, 0) else {
            return (corners.to_vec(), 0.0);
        };
        let mut options = SimplifyOptions::ErrorAbsolute | SimplifyOptions::Sparse;
        if rim {
            options |= SimplifyOptions::LockBorder;
        }
        let mut error = 0.0f32;
        let left = meshopt::simplify_with_locks(
            corners,
            &vertices,
            locks,
            3 * target,
            f32::MAX,
            options,
            Some(&mut error),
        );
        (left, f64::from(error))
    }
}
