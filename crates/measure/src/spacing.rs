//! How far scattered points on a surface lie apart.

use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{Aabb, Point};

/// Points that a cell holds in the mean, which its side then says how far apart they lie.
const POINTS_PER_CELL: f64 = 4.0;
/// Bits of a cell's number along each side.
const BITS_PER_SIDE: u32 = 20;

/// The distance of points from their neighbors, millimeters: half the side of the cubes that hold four points on average, of
/// those that hold any. Places measured several times, or not at all, hardly change it. 0 for fewer than two places.
/// Cost: `n log n`; does not depend on the order of the points.
pub fn spacing(points: &[Point]) -> f64 {
    let bounds = Aabb::of(points);
    let side = if bounds.is_empty() { 0.0 } else { bounds.sides().into_iter().fold(0.0, f64::max) };
    if !(side > 0.0 && side.is_finite()) {
        return 0.0;
    }
    let cells = f64::from(1u32 << BITS_PER_SIDE) / side;
    let number = |p: &Point| {
        let at = |k: usize| (((p[k] - bounds.min[k]) * cells) as u64).min((1 << BITS_PER_SIDE) - 1);
        let q = [at(0), at(1), at(2)];
        (0..BITS_PER_SIDE).rev().fold(0u64, |key, bit| {
            key << 3 | q.iter().enumerate().fold(0, |digit, (k, x)| digit | (x >> bit & 1) << k)
        })
    };
    let mut keys: Vec<u64> = points.par_iter().map(number).collect();
    keys.par_sort_unstable();
    // Neighbors along the curve that differ first in digit `l` lie in different cells of level `l` and all finer ones.
    let mut borders = [0u64; BITS_PER_SIDE as usize + 1];
    for pair in keys.windows(2) {
        let differ = pair[0] ^ pair[1];
        if differ != 0 {
            borders[(BITS_PER_SIDE - (63 - differ.leading_zeros()) / 3) as usize] += 1;
        }
    }
    let n = points.len() as f64;
    let mut occupied = 1.0;
    let mut coarser = n;
    for (level, more) in borders.iter().enumerate().skip(1) {
        occupied += *more as f64;
        let share = n / occupied;
        if share < POINTS_PER_CELL {
            // Between two levels the count of cells is taken to grow evenly in its logarithm.
            let t = if coarser > POINTS_PER_CELL {
                libm::log2(coarser / POINTS_PER_CELL) / libm::log2(coarser / share)
            } else {
                0.0
            };
            return 0.5 * side * libm::exp2(1.0 - level as f64 - t);
        }
        coarser = share;
    }
    0.5 * side * libm::exp2(-f64::from(BITS_PER_SIDE))
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_geom::num::random::Random;

    #[test]
    fn known_densities() {
        let mut random = Random::new(5);
        for (n, extent) in [(100_000, 1.0), (2000, 1.0), (100_000, 0.05)] {
            // A sloping plate, of which only `extent` was measured.
            let mut points: Vec<Point> = (0..n)
                .map(|_| [extent * 30.0 * random.unit(), 30.0 * random.unit(), 0.0])
                .map(|p| [p[0], 0.8 * p[1], 0.6 * p[1]])
                .collect();
            let even = (extent * 900.0 / n as f64).sqrt();
            let found = spacing(&points);
            assert!((0.6..1.7).contains(&(found / even)), "{n}, {extent}: {found} against {even}");
            points.reverse();
            assert_eq!(spacing(&points), found);
        }
        assert_eq!((spacing(&[]), spacing(&[[1.0; 3]; 5])), (0.0, 0.0));
    }
}
