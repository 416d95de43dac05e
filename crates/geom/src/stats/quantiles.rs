//! Order statistics of many numbers without sorting or copying them.
//!
//! The numbers are mapped to integers of the same order and counted in some 10^5 equal steps between the least and the
//! greatest. Only numbers in the steps that hold a wanted rank are looked at again. Counting is exact, so the result does not
//! depend on threads.

use super::moments::VALUES_PER_TASK;
use crate::parallel::prelude::*;

/// Percentiles that every summary holds.
pub const PERCENTILES: [f64; 11] = [0.1, 1.0, 2.5, 5.0, 25.0, 50.0, 75.0, 95.0, 97.5, 99.0, 99.9];

/// Steps counted at once; the counters of the steps in use fit the nearest caches.
const STEPS_LOG2: u32 = 17;
/// Keys sieved at once.
const KEYS_PER_BATCH: usize = 1024;
/// A step with more than one of so many values is cut into steps again instead of being copied out.
const COPIED_VALUES_DIVISOR: u64 = 128;
/// The key of a value that does not take part; no finite number has it.
pub(crate) const NO_KEY: u64 = u64::MAX;

/// The integer that orders as `f64::total_cmp` does.
pub(crate) fn key_of(x: f64) -> u64 {
    let bits = x.to_bits();
    bits ^ (((bits as i64 >> 63) as u64) | (1 << 63))
}
/// The number behind a key.
pub(crate) fn from_key(key: u64) -> f64 {
    f64::from_bits(if key >> 63 == 1 { key ^ (1 << 63) } else { !key })
}

/// Where percentile `p` of `count` sorted values lies: the rank below it and the way to the next one.
///
/// Linear interpolation at `(count - 1) p / 100` (type 7 of Hyndman and Fan 1996, the default of NumPy).
pub(crate) fn position(count: u64, p: f64) -> (u64, f64) {
    let h = count.saturating_sub(1) as f64 * (p / 100.0);
    let below = h.floor();
    (below as u64, h - below)
}
/// Between `a` and `b`, `t` of the way; exact at both ends and monotonic.
pub(crate) fn interpolate(a: f64, b: f64, t: f64) -> f64 {
    if t < 0.5 { a + (b - a) * t } else { b - (b - a) * (1.0 - t) }
}

/// Values seen as integers of the same order.
pub(crate) struct Keyed<'a, F> {
    /// The values.
    pub(crate) values: &'a [f64],
    /// Key of a value, or [`NO_KEY`].
    pub(crate) key: F,
    /// No key is less.
    pub(crate) low: u64,
    /// No key but [`NO_KEY`] is greater.
    pub(crate) high: u64,
    /// Values that have a key.
    pub(crate) count: u64,
}

/// Keys from `low` to `high`: `before` others are less, `count` lie inside, among them the wanted `ranks`.
#[derive(Clone)]
struct Span {
    low: u64,
    high: u64,
    before: u64,
    count: u64,
    ranks: Vec<u64>,
}

impl<F: Fn(f64) -> u64 + Sync> Keyed<'_, F> {
    /// The values behind the keys of the given ranks (0 = least). Ranks beyond the last give the greatest; empty
    /// where no value has a key.
    pub(crate) fn at(&self, ranks: &[u64]) -> Vec<f64> {
        if self.count == 0 {
            return Vec::new();
        }
        let mut wanted: Vec<u64> = ranks.iter().map(|r| (*r).min(self.count - 1)).collect();
        wanted.sort_unstable();
        wanted.dedup();
        let mut found = vec![0; wanted.len()];
        let mut put = |rank: u64, key: u64| found[wanted.partition_point(|w| *w < rank)] = key;
        let mut spans = vec![Span {
            low: self.low,
            high: self.high,
            before: 0,
            count: self.count,
            ranks: wanted.clone(),
        }];
        while !spans.is_empty() {
            spans = self.cut(&spans);
            spans = self.narrow(spans, &mut put);
        }
        ranks
            .iter()
            .map(|r| from_key(found[wanted.partition_point(|w| *w < (*r).min(self.count - 1))]))
            .collect()
    }

    /// One pass: the steps of `spans` that hold a wanted rank.
    fn cut(&self, spans: &[Span]) -> Vec<Span> {
        let finder = Finder::new(spans);
        let shifts: Vec<u32> = spans.iter().map(|s| shift_of(s.high - s.low)).collect();
        let firsts: Vec<usize> = spans
            .iter()
            .zip(&shifts)
            .scan(0, |next, (s, shift)| {
                let first = *next;
                *next += ((s.high - s.low) >> shift) as usize + 1;
                Some(first)
            })
            .collect();
        let steps = spans.len() << STEPS_LOG2;
        let tally = |mut counts: Vec<u64>, piece: &[f64]| {
            if let [span] = spans {
                // Branchless: keys outside the span, above or (wrapped around) below, fall into the last counter.
                let (low, shift, last) = (span.low, shifts[0], counts.len() - 1);
                let (table, key) = (&mut counts[..], &self.key);
                for x in piece {
                    table[((key(*x).wrapping_sub(low) >> shift) as usize).min(last)] += 1;
                }
            } else {
                for key in piece.iter().map(|x| (self.key)(*x)) {
                    if let Some(s) = finder.find(key) {
                        counts[firsts[s] + ((key - spans[s].low) >> shifts[s]) as usize] += 1;
                    }
                }
            }
            counts
        };
        let counts = self.parallel(
            || vec![0; steps + 1],
            tally,
            |mut a, b| {
                a.iter_mut().zip(b).for_each(|(a, b)| *a += b);
                a
            },
        );
        spans
            .iter()
            .zip(shifts)
            .zip(firsts)
            .flat_map(|((s, shift), first)| s.steps(shift, &counts[first..]))
            .collect()
    }

    /// One pass: copies out the small spans and stores their ranks; returns the large ones, trimmed to their keys.
    fn narrow(&self, spans: Vec<Span>, put: &mut impl FnMut(u64, u64)) -> Vec<Span> {
        let (known, open): (Vec<Span>, Vec<Span>) = spans.into_iter().partition(|s| s.low == s.high);
        known.iter().for_each(|s| s.ranks.iter().for_each(|r| put(*r, s.low)));
        if open.is_empty() {
            return open;
        }
        let finder = Finder::new(&open);
        let small = (self.count / COPIED_VALUES_DIVISOR).max(VALUES_PER_TASK as u64);
        let none = || (Vec::new(), vec![(u64::MAX, 0); open.len()]);
        let look = |(mut copied, mut extents): (Vec<u64>, Vec<(u64, u64)>), piece: &[f64]| {
            let mut near = [0; KEYS_PER_BATCH + 1];
            for batch in piece.chunks(KEYS_PER_BATCH) {
                for key in finder.near(batch.iter().map(|x| (self.key)(*x)), &mut near) {
                    match finder.find(*key) {
                        Some(s) if open[s].count <= small => copied.push(*key),
                        Some(s) => extents[s] = (extents[s].0.min(*key), extents[s].1.max(*key)),
                        None => {}
                    }
                }
            }
            (copied, extents)
        };
        let (mut copied, extents) = self.parallel(none, look, |(mut copied, mut extents), (c, e)| {
            copied.extend(c);
            extents.iter_mut().zip(e).for_each(|(a, b)| *a = (a.0.min(b.0), a.1.max(b.1)));
            (copied, extents)
        });
        copied.par_sort_unstable();
        for span in open.iter().filter(|s| s.count <= small) {
            let start = copied.partition_point(|k| *k < span.low);
            span.ranks.iter().for_each(|r| put(*r, copied[start + (r - span.before) as usize]));
        }
        let large = open.into_iter().zip(extents).filter(|(s, _)| s.count > small);
        large.map(|(span, (low, high))| Span { low, high, ..span }).collect()
    }

    /// Folds pieces of the values, few enough that large accumulators do not matter.
    fn parallel<A: Send>(
        &self,
        new: impl Fn() -> A + Sync + Send,
        fold: impl Fn(A, &[f64]) -> A + Sync + Send,
        join: impl Fn(A, A) -> A + Sync + Send,
    ) -> A {
        let fewest = self.values.len() / VALUES_PER_TASK / (4 * rayon::current_num_threads()) + 1;
        self.values.par_chunks(VALUES_PER_TASK).with_min_len(fewest).fold(&new, fold).reduce(&new, join)
    }
}

impl Span {
    /// The steps of 2^`shift` keys, counted in `counts`, that hold a wanted rank.
    fn steps(&self, shift: u32, counts: &[u64]) -> Vec<Span> {
        let mut steps = Vec::new();
        let (mut before, mut ranks) = (self.before, &self.ranks[..]);
        for (step, count) in counts.iter().enumerate() {
            if ranks.is_empty() {
                break;
            }
            let (here, later) = ranks.split_at(ranks.partition_point(|r| *r < before + count));
            if !here.is_empty() {
                let low = self.low + ((step as u64) << shift);
                let high = low.saturating_add((1 << shift) - 1).min(self.high);
                steps.push(Span { low, high, before, count: *count, ranks: here.to_vec() });
            }
            before += count;
            ranks = later;
        }
        steps
    }
}

/// The shift that leaves [`STEPS_LOG2`] bits of `width`.
fn shift_of(width: u64) -> u32 {
    (u64::BITS - width.leading_zeros()).saturating_sub(STEPS_LOG2)
}

/// Finds the span of a key: a table by leading bits passes over most keys that lie in none.
struct Finder<'a> {
    spans: &'a [Span],
    low: u64,
    shift: u32,
    /// For each step from `low` on, whether a span reaches into it; the last entry is for keys beyond, `false`.
    near: Vec<bool>,
}

impl Finder<'_> {
    /// `spans`: ascending, disjoint, not empty.
    fn new(spans: &[Span]) -> Finder<'_> {
        let (low, high) = (spans[0].low, spans[spans.len() - 1].high);
        let shift = shift_of(high - low);
        let mut near = vec![false; ((high - low) >> shift) as usize + 2];
        for span in spans {
            near[((span.low - low) >> shift) as usize..=((span.high - low) >> shift) as usize].fill(true);
        }
        Finder { spans, low, shift, near }
    }
    /// The keys, out of at most [`KEYS_PER_BATCH`], that may lie in a span, without a branch that could be mispredicted.
    fn near<'b>(
        &self,
        keys: impl Iterator<Item = u64>,
        kept: &'b mut [u64; KEYS_PER_BATCH + 1],
    ) -> &'b [u64] {
        let (near, low, shift) = (&self.near[..], self.low, self.shift);
        let last = near.len() - 1;
        let mut count = 0;
        for key in keys {
            kept[count] = key;
            count += usize::from(near[((key.wrapping_sub(low) >> shift) as usize).min(last)]);
        }
        &kept[..count]
    }
    /// The span that holds the key.
    fn find(&self, key: u64) -> Option<usize> {
        let i = self.spans.partition_point(|s| s.high < key);
        (self.spans.get(i)?.low <= key).then_some(i)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    fn select(values: &[f64], key: fn(f64) -> u64, ranks: &[u64]) -> Vec<f64> {
        let keys = || values.iter().map(|x| key(*x)).filter(|k| *k != NO_KEY);
        let (low, high) = (keys().min().unwrap_or(0), keys().max().unwrap_or(0));
        Keyed { values, key, low, high, count: keys().count() as u64 }.at(ranks)
    }
    fn check(values: &[f64]) {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let n = values.len() as u64;
        let ranks = [n - 1, 0, n / 2, n / 2, n / 3, n / 1000, n + 7];
        let found = select(values, key_of, &ranks);
        for (rank, x) in ranks.iter().zip(found) {
            let expected = sorted[(*rank).min(n - 1) as usize];
            assert_eq!(x.to_bits(), expected.to_bits(), "rank {rank} of {n}");
        }
    }

    #[test]
    fn selection_equals_sorting() {
        let mut random = Random::new(1);
        let count = 600_000;
        let spread: Vec<f64> = (0..count).map(|_| (random.unit() - 0.5) / (random.unit() + 1e-9)).collect();
        check(&spread);
        check(&spread[..1]);
        check(&spread[..9]);
        // Far from zero, with one value elsewhere: nearly everything falls into one step.
        let mut far: Vec<f64> = spread.iter().map(|x| 1e6 + 1e-9 * x).collect();
        far[77] = -3.0;
        check(&far);
        // Few different values, both zeros, the extremes of the format.
        let coarse: Vec<f64> = spread.iter().map(|x| x.trunc()).collect();
        check(&coarse);
        check(&[0.0, -0.0, f64::MAX, f64::MIN, f64::MIN_POSITIVE, 5e-324, -5e-324]);
        check(&vec![0.1; count]);
    }

    #[test]
    fn values_without_a_key_do_not_count() {
        let positive = |x: f64| if x > 0.0 { key_of(x) } else { NO_KEY };
        assert_eq!(select(&[3.0, -1.0, 1.0, 0.0, 2.0], positive, &[0, 1, 2]), [1.0, 2.0, 3.0]);
        assert!(select(&[-1.0], positive, &[0]).is_empty());
    }

    #[test]
    fn percentiles_lie_between_ranks_as_in_numpy() {
        // numpy.percentile([1, 2, 4, 8], [0, 25, 50, 90, 100])
        let sorted = [1.0, 2.0, 4.0, 8.0, 8.0];
        let percentile = |p| {
            let (below, t) = position(4, p);
            interpolate(sorted[below as usize], sorted[below as usize + 1], t)
        };
        assert_eq!([0.0, 25.0, 50.0, 90.0, 100.0].map(percentile), [1.0, 1.75, 3.0, 6.800000000000001, 8.0]);
    }
}
