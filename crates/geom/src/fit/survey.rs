//! The distances of all points from a finished element: how large, how far apart, and whose are the extremes.

use super::family::{Element, Family};
use super::lanes::{Lanes, NUMBERS_AT_ONCE, POINTS_PER_GROUP, Sum, group, groups};
use super::normal::Placing;
use super::sample::Sample;
use crate::parallel::prelude::*;
use crate::simd::widest::widest;
use crate::space::Point;

/// Points of one block.
pub(super) const POINTS_PER_SURVEY_BLOCK: usize = 256;

/// Sum of squares and extremes of the distances of one block, in the unit frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Survey {
    pub square: f64,
    pub least: f64,
    pub greatest: f64,
}

/// The distances of the points of a group. Aligned as for the sums.
#[repr(align(64))]
struct Distances(Lanes);

impl Distances {
    /// Takes those of the points given.
    #[inline(always)]
    fn compute<const P: usize, F: Family<P>>(
        &mut self,
        group: &[Point; POINTS_PER_GROUP],
        size: [f64; 2],
        placing: &Placing,
    ) {
        for l in 0..POINTS_PER_GROUP {
            self.0[l] = F::distance(size, placing.local(group[l]));
        }
    }
}

#[inline(always)]
fn block<const P: usize, F: Family<P>>(points: &[Point], size: [f64; 2], placing: &Placing) -> Survey {
    let mut square = Sum::ZERO;
    let (mut least, mut greatest) = ([f64::INFINITY; NUMBERS_AT_ONCE], [f64::NEG_INFINITY; NUMBERS_AT_ONCE]);
    let (mut distances, mut filled) = (Distances([0.0; POINTS_PER_GROUP]), [[0.0; 3]; POINTS_PER_GROUP]);
    for k in 0..groups(points) {
        let (group, count) = group(points, k, &mut filled);
        distances.compute::<P, F>(group, size, placing);
        for first in 0..POINTS_PER_GROUP / NUMBERS_AT_ONCE {
            for l in 0..NUMBERS_AT_ONCE {
                let d = distances.0[NUMBERS_AT_ONCE * first + l];
                least[l] = if d < least[l] { d } else { least[l] };
                greatest[l] = if d > greatest[l] { d } else { greatest[l] };
            }
        }
        distances.0[count..].fill(0.0);
        square.add_products(&distances.0, &distances.0);
    }
    Survey {
        square: square.total(),
        least: least.into_iter().fold(f64::INFINITY, f64::min),
        greatest: greatest.into_iter().fold(f64::NEG_INFINITY, f64::max),
    }
}

widest! {
    fn survey_block [const P: usize, F: Family<P>] [P, F]
    (points: &[Point], size: [f64; 2], placing: &Placing) -> Survey
    = block::<P, F>(points, size, placing)
}

/// The surveys of all blocks, in their order.
pub(super) fn blocks<const P: usize, F: Family<P>>(element: &Element, sample: &Sample) -> Vec<Survey> {
    let placing = Placing::new(element, sample);
    let of = |points: &[Point]| survey_block::<P, F>(points, element.size, &placing);
    if sample.len() <= 64 * POINTS_PER_SURVEY_BLOCK {
        sample.points.chunks(POINTS_PER_SURVEY_BLOCK).map(of).collect()
    } else {
        sample.points.par_chunks(POINTS_PER_SURVEY_BLOCK).with_min_len(32).map(of).collect()
    }
}

/// The first point of block `block` at exactly the distance `distance`, which its survey has told.
pub(super) fn find<const P: usize, F: Family<P>>(
    element: &Element,
    sample: &Sample,
    block: usize,
    distance: f64,
) -> Option<usize> {
    let placing = Placing::new(element, sample);
    let start = block * POINTS_PER_SURVEY_BLOCK;
    let points = sample.points.get(start..(start + POINTS_PER_SURVEY_BLOCK).min(sample.len()))?;
    Some(start + find_block::<P, F>(points, element.size, &placing, distance)?)
}

widest! {
    fn find_block [const P: usize, F: Family<P>] [P, F]
    (points: &[Point], size: [f64; 2], placing: &Placing, distance: f64) -> Option<usize>
    = find_in::<P, F>(points, size, placing, distance)
}

#[inline(always)]
fn find_in<const P: usize, F: Family<P>>(
    points: &[Point],
    size: [f64; 2],
    placing: &Placing,
    distance: f64,
) -> Option<usize> {
    let (mut distances, mut filled) = (Distances([0.0; POINTS_PER_GROUP]), [[0.0; 3]; POINTS_PER_GROUP]);
    for k in 0..groups(points) {
        let (group, _) = group(points, k, &mut filled);
        distances.compute::<P, F>(group, size, placing);
        if let Some(l) = distances.0.iter().position(|&d| d == distance) {
            return Some((k * POINTS_PER_GROUP + l).min(points.len() - 1));
        }
    }
    None
}

/// Sum of squares, and the extremes with the first point that has each: `(distance, index)`.
pub(super) struct Extremes {
    pub square: f64,
    pub least: (f64, usize),
    pub greatest: (f64, usize),
}

/// One pass over the points, and a second look at the two blocks with the extremes.
pub(super) fn extremes<const P: usize, F: Family<P>>(element: &Element, sample: &Sample) -> Extremes {
    let all = blocks::<P, F>(element, sample);
    let square = all.iter().map(|b| b.square).sum();
    let find = |value: fn(&Survey) -> f64, better: fn(f64, f64) -> bool| {
        let mut best = 0;
        for (k, b) in all.iter().enumerate() {
            if better(value(b), value(&all[best])) {
                best = k;
            }
        }
        let extreme = all.get(best).map_or(0.0, value);
        (extreme, self::find::<P, F>(element, sample, best, extreme).unwrap_or(0))
    };
    Extremes { square, least: find(|b| b.least, |a, b| a < b), greatest: find(|b| b.greatest, |a, b| a > b) }
}
