//! Moments of a stream of numbers: one pass, the same bits for any number of threads and any cutting into blocks.
//!
//! The stream is cut into chunks of [`VALUES_PER_CHUNK`] values counted from its start. Each chunk is summed in a fixed order.
//! The chunks' moments are merged in pairs, like the digits of a binary counter. So the tree of additions depends on the count
//! alone and rounding errors grow with its logarithm.
//!
//! Merging: Pébay, Formulas for robust, one-pass parallel computation of covariances and arbitrary-order statistical
//! moments, Sandia SAND2008-6212. Ours carries the mean as two numbers, so that it stays good to the last place
//! where the values lie far from zero.

use crate::num::sum::{Sum, two_sum};

/// Values that one task counts before its counts are added.
pub(super) const VALUES_PER_TASK: usize = 1 << 18;
/// Values that are summed together.
pub const VALUES_PER_CHUNK: usize = 4096;
/// Values of a chunk that are summed side by side.
const VALUES_AT_ONCE: usize = 8;

/// Count, extremes, mean and central sums up to the fourth power.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments {
    /// How many values.
    pub count: u64,
    /// Least value; +∞ where there is none.
    pub min: f64,
    /// Greatest value; −∞ where there is none.
    pub max: f64,
    /// Arithmetic mean; 0 where there is no value.
    pub mean: Sum,
    /// Sums of the second, third and fourth powers of the differences from the mean.
    pub powers: [f64; 3],
}

impl Moments {
    /// The moments of nothing.
    pub const EMPTY: Moments = Moments {
        count: 0,
        min: f64::INFINITY,
        max: f64::NEG_INFINITY,
        mean: Sum { high: 0.0, low: 0.0 },
        powers: [0.0; 3],
    };

    /// Moments of one chunk of finite values.
    pub(crate) fn of(values: &[f64]) -> Moments {
        if values.is_empty() {
            return Moments::EMPTY;
        }
        let count = values.len() as f64;
        let [total] = lane_sums(values, |x| [x]);
        let rough = total / count;
        let [rest] = lane_sums(values, |x| [x - rough]);
        let mean = Sum::of_two(rough, rest / count);
        let powers = lane_sums(values, |x| {
            let d = (x - mean.high) - mean.low;
            let d2 = d * d;
            [d2, d2 * d, d2 * d2]
        });
        let (min, max) = extremes(values);
        Moments { count: values.len() as u64, min, max, mean, powers }
    }

    /// `count` times the same value.
    pub(crate) fn repeated(value: f64, count: u64) -> Moments {
        if count == 0 {
            return Moments::EMPTY;
        }
        Moments { count, min: value, max: value, mean: Sum { high: value, low: 0.0 }, powers: [0.0; 3] }
    }

    /// Moments of both sets together. Exact but for rounding; the order of the two decides the last bits.
    #[must_use]
    pub fn merge(&self, other: &Moments) -> Moments {
        if self.count == 0 || other.count == 0 {
            return if self.count == 0 { *other } else { *self };
        }
        let (a, b) = (self.count as f64, other.count as f64);
        let n = a + b;
        // Weights are divided first: no product of counts can lose digits or overflow.
        let (u, v) = (a / n, b / n);
        let d = (other.mean.high - self.mean.high) + (other.mean.low - self.mean.low);
        let d2 = d * d;
        let ([a2, a3, a4], [b2, b3, b4]) = (self.powers, other.powers);
        Moments {
            count: self.count + other.count,
            min: self.min.min(other.min),
            max: self.max.max(other.max),
            // From the mean of the larger set: the step, and so its rounding, stays below the mean size.
            mean: if u < v { other.mean.plus(-d * u) } else { self.mean.plus(d * v) },
            powers: [
                a2 + b2 + d2 * (u * b),
                a3 + b3 + d2 * d * (u * b) * (u - v) + 3.0 * d * (u * b2 - v * a2),
                a4 + b4
                    + d2 * d2 * (u * b) * (u * u - u * v + v * v)
                    + 6.0 * d2 * (u * u * b2 + v * v * a2)
                    + 4.0 * d * (u * b3 - v * a3),
            ],
        }
    }
}

/// Sums of `terms` over the values, in eight interleaved partial sums: a fixed order that vector units can follow.
fn lane_sums<const N: usize>(values: &[f64], terms: impl Fn(f64) -> [f64; N]) -> [f64; N] {
    let mut lanes = [[0.0; VALUES_AT_ONCE]; N];
    let (groups, rest) = values.as_chunks::<VALUES_AT_ONCE>();
    let mut add = |lane: usize, x: f64| {
        for (sums, term) in lanes.iter_mut().zip(terms(x)) {
            sums[lane] += term;
        }
    };
    for group in groups {
        for (lane, x) in group.iter().enumerate() {
            add(lane, *x);
        }
    }
    rest.iter().enumerate().for_each(|(lane, x)| add(lane, *x));
    lanes.map(|l| {
        let (mut total, mut lost) = (0.0, 0.0);
        for x in l {
            let (sum, error) = two_sum(total, x);
            (total, lost) = (sum, lost + error);
        }
        total + lost
    })
}

fn extremes(values: &[f64]) -> (f64, f64) {
    let mut low = [f64::INFINITY; VALUES_AT_ONCE];
    let mut high = [f64::NEG_INFINITY; VALUES_AT_ONCE];
    let (groups, rest) = values.as_chunks::<VALUES_AT_ONCE>();
    for group in groups {
        for (lane, x) in group.iter().enumerate() {
            low[lane] = if *x < low[lane] { *x } else { low[lane] };
            high[lane] = if *x > high[lane] { *x } else { high[lane] };
        }
    }
    let low = low.iter().chain(rest).fold(f64::INFINITY, |m, x| m.min(*x));
    let high = high.iter().chain(rest).fold(f64::NEG_INFINITY, |m, x| m.max(*x));
    (low, high)
}

/// Chunks' moments, merged in pairs as they come.
#[derive(Clone, Debug, Default)]
pub(crate) struct MomentTree {
    /// Entry `k` stands for 2^k chunks, or is empty: the digits of the number of chunks.
    levels: Vec<Option<Moments>>,
}

impl MomentTree {
    /// Adds the next chunk of the stream.
    pub(crate) fn push(&mut self, chunk: Moments) {
        let mut carry = chunk;
        for level in &mut self.levels {
            match level.take() {
                Some(earlier) => carry = earlier.merge(&carry),
                None => {
                    *level = Some(carry);
                    return;
                }
            }
        }
        self.levels.push(Some(carry));
    }
    /// Moments of everything so far, with the unfinished chunk `last`.
    pub(crate) fn total(&self, last: Moments) -> Moments {
        self.levels.iter().flatten().fold(last, |later, earlier| earlier.merge(&later))
    }
}
