//! The distances of all points from a finished element: how large, how far apart, and whose are the extremes.

use super::family::{Element, Family};
use super::normal::{Placing, lanes, widest};
use super::sample::Sample;
use super::scalar::{LANES, Lane, Scalar};
use crate::space::Point;
use rayon::prelude::*;

/// Points of one block.
pub(super) const BLOCK: usize = 256;

/// Sum of squares and extremes of the distances of one block, in the unit frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Survey {
    pub square: f64,
    pub least: f64,
    pub greatest: f64,
}

#[inline(always)]
fn block<const P: usize, F: Family<P>>(points: &[Point], size: [f64; 2], placing: &Placing) -> Survey {
    let (fours, rest) = points.as_chunks::<LANES>();
    let mut square = Lane::of(0.0);
    let (mut least, mut greatest) = (Lane::of(f64::INFINITY), Lane::of(f64::NEG_INFINITY));
    for four in fours {
        let d = F::distance(size, placing.local(lanes(four)));
        square = square + d * d;
        least = least.zip(d, |a, b| if b < a { b } else { a });
        greatest = greatest.at_least(d);
    }
    let fold = |start: f64, lane: Lane, f: fn(f64, f64) -> f64| lane.0.iter().fold(start, |a, &b| f(a, b));
    let mut all = Survey {
        square: square.sum(),
        least: fold(f64::INFINITY, least, f64::min),
        greatest: fold(f64::NEG_INFINITY, greatest, f64::max),
    };
    for &p in rest {
        let d = F::distance(size, placing.local(p));
        all.square += d * d;
        all.least = all.least.min(d);
        all.greatest = all.greatest.max(d);
    }
    all
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
    if sample.len() <= 64 * BLOCK {
        sample.points.chunks(BLOCK).map(of).collect()
    } else {
        sample.points.par_chunks(BLOCK).with_min_len(32).map(of).collect()
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
    let start = block * BLOCK;
    let points = sample.points.get(start..(start + BLOCK).min(sample.len()))?;
    let within =
        points.iter().position(|&p| F::distance::<f64>(element.size, placing.local(p)) == distance)?;
    Some(start + within)
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
