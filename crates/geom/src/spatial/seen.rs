//! Facets that a ray through one of some places may pass. Seen along an axis, they cover a square in which such a place lies.
//!
//! Where few places are asked about, hardly any facet is left to be ordered for the rays.

use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::space::{Aabb, Point};

/// Squares for each place, about.
const SQUARES_PER_PLACE: usize = 64;
/// Most squares, about.
const MAX_SQUARES: usize = 1 << 20;

/// The squares of a grid, and how many places lie in those below and left of each line.
struct Squares {
    sides: [usize; 2],
    count: usize,
    low: [f64; 2],
    scale: [f64; 2],
    /// For each crossing of lines, row by row.
    sums: Vec<u32>,
}

impl Squares {
    fn new(axis: usize, places: &[Point]) -> Squares {
        let sides = [(axis + 1) % 3, (axis + 2) % 3];
        let bounds = Aabb::of(places);
        let count = ((SQUARES_PER_PLACE * places.len()).min(MAX_SQUARES) as f64).sqrt() as usize + 1;
        let low = sides.map(|k| bounds.min[k]);
        let scale = sides.map(|k| count as f64 / (bounds.max[k] - bounds.min[k]));
        let mut squares = Squares { sides, count, low, scale, sums: vec![0; (count + 1) * (count + 1)] };
        for p in places {
            let [i, j] = squares.of(sides.map(|k| p[k]));
            squares.sums[(i + 1) * (count + 1) + j + 1] += 1;
        }
        for i in 1..=count {
            let mut row = 0;
            for j in 1..=count {
                row += squares.sums[i * (count + 1) + j];
                squares.sums[i * (count + 1) + j] = row + squares.sums[(i - 1) * (count + 1) + j];
            }
        }
        squares
    }

    /// The square nearest to a place, given by its two coordinates. Each operation keeps the order of its operands, rounded or
    /// not, so no square between those of two places is missed. Where the places have no extent all is in one square.
    fn of(&self, p: [f64; 2]) -> [usize; 2] {
        let square = |i: usize| (p[i] - self.low[i]) * self.scale[i];
        [0, 1].map(|i| (square(i) as usize).min(self.count - 1))
    }

    /// Whether a place lies in one of the squares that the box of a triangle covers.
    fn holds(&self, corners: [Point; 3]) -> bool {
        let [a, b, c] = corners.map(|p| self.sides.map(|k| p[k]));
        let [i, j] = self.of([0, 1].map(|k| a[k].min(b[k]).min(c[k])));
        let [k, l] = self.of([0, 1].map(|k| a[k].max(b[k]).max(c[k])));
        let sum = |i: usize, j: usize| self.sums[i * (self.count + 1) + j];
        sum(k + 1, l + 1) + sum(i, j) != sum(i, l + 1) + sum(k + 1, j)
    }
}

/// All of these facets, which must have finite corners, whose boxes a line along `axis` through one of the places meets; others
/// too. Linear.
pub(crate) fn seen(mesh: &Mesh, facets: &[u32], axis: usize, places: &[Point]) -> Vec<u32> {
    let squares = Squares::new(axis, places);
    let near = |f: &&u32| squares.holds(mesh.corners(**f));
    facets.par_iter().filter(near).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    /// By brute force, whatever the extent of the places.
    #[test]
    fn no_facet_below_a_place_is_missed() {
        let random = &mut Random::new(7);
        let mut mesh = Mesh::default();
        for i in 0..4000u32 {
            let size = if i % 100 == 0 { 4.0 } else { 0.1 };
            let at: Point = std::array::from_fn(|_| 10.0 * random.unit());
            let mut corner = || -> Point { std::array::from_fn(|k| at[k] + size * random.unit()) };
            mesh.positions.extend([at, corner(), corner()]);
            mesh.faces.push([3 * i, 3 * i + 1, 3 * i + 2]);
        }
        let all: Vec<u32> = (0..4000).collect();
        for (axis, count, extent) in [(0, 1, 1.0), (1, 30, 3.0), (2, 30, 0.0), (0, 0, 1.0), (1, 40, 30.0)] {
            let mut places: Vec<Point> =
                (0..count).map(|_| std::array::from_fn(|_| 5.0 + extent * (random.unit() - 0.5))).collect();
            places.extend(mesh.positions.iter().copied().filter(|p| count > 1 && p[0] < 0.1 * extent));
            let found = seen(&mesh, &all, axis, &places);
            assert!(found.is_sorted() && found.len() < 3000, "{}", found.len());
            let meets = |f: u32| {
                let b = Aabb::of(&mesh.corners(f));
                let inside = |p: &Point, k: usize| b.min[k] <= p[k] && p[k] <= b.max[k];
                places.iter().any(|p| inside(p, (axis + 1) % 3) && inside(p, (axis + 2) % 3))
            };
            for f in all.iter().filter(|f| meets(**f)) {
                assert!(found.binary_search(f).is_ok(), "{axis}: {f}");
            }
        }
    }
}
