//! Points a group at a time: loops of a fixed length over arrays, which the compiler turns into wide registers. (Not in
//! closures: one that is not inlined is compiled for any processor.)
//!
//! Only operations that IEEE 754 rounds alike everywhere are used, and sums are kept in four parts that are added in one order.
//! The results are the same bits with wide registers and without. Products are added fused, with one rounding, which a
//! processor without such an instruction (x86 before 2013) takes its time for.

use crate::space::Point;

/// Points of one group: few enough that their rows stay in the nearest cache.
pub(super) const POINTS_PER_GROUP: usize = 32;
/// Numbers that are summed, or compared, side by side.
pub(super) const NUMBERS_AT_ONCE: usize = 4;

/// One number of each point of a group.
pub(super) type Lanes = [f64; POINTS_PER_GROUP];

/// A sum in four parts.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(super) struct Sum([f64; NUMBERS_AT_ONCE]);

impl Sum {
    pub(super) const ZERO: Sum = Sum([0.0; NUMBERS_AT_ONCE]);

    /// Adds Σ aᵢ·bᵢ.
    #[inline(always)]
    pub(super) fn add_products(&mut self, a: &Lanes, b: &Lanes) {
        let mut sum = self.0;
        for first in 0..POINTS_PER_GROUP / NUMBERS_AT_ONCE {
            for l in 0..NUMBERS_AT_ONCE {
                sum[l] = a[NUMBERS_AT_ONCE * first + l].mul_add(b[NUMBERS_AT_ONCE * first + l], sum[l]);
            }
        }
        self.0 = sum;
    }
    /// The parts added up.
    #[inline(always)]
    pub(super) fn total(self) -> f64 {
        (self.0[0] + self.0[1]) + (self.0[2] + self.0[3])
    }
}

/// Number of groups of so many points.
#[inline(always)]
pub(super) fn groups(points: &[Point]) -> usize {
    points.len().div_ceil(POINTS_PER_GROUP)
}

/// Group `k` of the points, and how many of them count: the last group is filled up, in `filled`, with its last point.
#[inline(always)]
pub(super) fn group<'a>(
    points: &'a [Point],
    k: usize,
    filled: &'a mut [Point; POINTS_PER_GROUP],
) -> (&'a [Point; POINTS_PER_GROUP], usize) {
    let rest = &points[k * POINTS_PER_GROUP..];
    if let Some(whole) = rest.first_chunk() {
        return (whole, POINTS_PER_GROUP);
    }
    for l in 0..POINTS_PER_GROUP {
        filled[l] = rest[l.min(rest.len() - 1)];
    }
    (filled, rest.len())
}
