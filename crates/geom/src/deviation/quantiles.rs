//! Order statistics of many numbers without sorting or copying them.
//!
//! The numbers are mapped to integers of the same order and counted in some 10^5 equal steps between the least and
//! the greatest; only those in the steps that hold a wanted rank are looked at again. Counting is exact, so the
//! result does not depend on threads.

use rayon::prelude::*;

/// Percentiles that every summary holds.
pub const PERCENTILES: [f64; 11] = [0.1, 1.0, 2.5, 5.0, 25.0, 50.0, 75.0, 95.0, 97.5, 99.0, 99.9];

/// Steps counted at once; the counters of the steps in use fit the nearest caches.
const STEPS_LOG2: u32 = 17;
/// Values per parallel piece of work.
const PIECE: usize = 1 << 18;
/// A step with more values than this share of all is cut into steps again instead of being copied out.
const COPY_SHARE: u64 = 64;

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

/// The values of the given ranks (0 = least) among the keys that `key` finds for `values`; `None` passes over.
/// Ranks beyond the last give the greatest. Empty where no value has a key.
pub(crate) fn select(values: &[f64], key: impl Fn(f64) -> Option<u64> + Sync, ranks: &[u64]) -> Vec<f64> {
    let (low, high, count) = key_range(values, &key);
    if count == 0 {
        return Vec::new();
    }
    let mut wanted: Vec<u64> = ranks.iter().map(|r| (*r).min(count - 1)).collect();
    wanted.sort_unstable();
    wanted.dedup();
    let mut spans = Vec::new();
    narrow(values, &key, Span { low, high, before: 0, ranks: wanted.clone() }, count, &mut spans);
    let found = pick(values, &key, &spans);
    ranks.iter().map(|r| found[wanted.partition_point(|w| w < &(*r).min(count - 1))]).collect()
}

/// Keys from `low` to `high`, of which `before` come earlier, and the wanted ranks among them.
struct Span {
    low: u64,
    high: u64,
    before: u64,
    ranks: Vec<u64>,
}

fn key_range(values: &[f64], key: &(impl Fn(f64) -> Option<u64> + Sync)) -> (u64, u64, u64) {
    let piece = |piece: &[f64]| {
        piece
            .iter()
            .filter_map(|x| key(*x))
            .fold((u64::MAX, 0, 0), |(l, h, n), k| (k.min(l), k.max(h), n + 1))
    };
    values
        .par_chunks(PIECE)
        .map(piece)
        .reduce(|| (u64::MAX, 0, 0), |a, b| (a.0.min(b.0), a.1.max(b.1), a.2 + b.2))
}

/// Cuts `span` into steps until every step with a wanted rank is small or a single key.
fn narrow(
    values: &[f64],
    key: &(impl Fn(f64) -> Option<u64> + Sync),
    span: Span,
    count: u64,
    spans: &mut Vec<Span>,
) {
    let width = span.high - span.low;
    let shift = (u64::BITS - width.leading_zeros()).saturating_sub(STEPS_LOG2);
    let steps = (width >> shift) as usize + 1;
    let counts = count_steps(values, key, &span, shift, steps);
    let mut before = span.before;
    let mut ranks = &span.ranks[..];
    for (step, inside) in counts.into_iter().enumerate() {
        let (here, later) = ranks.split_at(ranks.partition_point(|r| *r < before + inside));
        if !here.is_empty() {
            let low = span.low + ((step as u64) << shift);
            let part = Span {
                low,
                high: low.saturating_add((1 << shift) - 1).min(span.high),
                before,
                ranks: here.to_vec(),
            };
            if shift > 0 && inside > (count / COPY_SHARE).max(PIECE as u64) {
                narrow(values, key, part, count, spans);
            } else {
                spans.push(part);
            }
        }
        before += inside;
        ranks = later;
        if ranks.is_empty() {
            break;
        }
    }
}

fn count_steps(
    values: &[f64],
    key: &(impl Fn(f64) -> Option<u64> + Sync),
    span: &Span,
    shift: u32,
    steps: usize,
) -> Vec<u64> {
    let tally = |mut counts: Vec<u64>, piece: &[f64]| {
        for k in piece.iter().filter_map(|x| key(*x)) {
            // Keys below `low` wrap around to large steps and are passed over with those above `high`.
            if let Some(count) = counts.get_mut((k.wrapping_sub(span.low) >> shift) as usize) {
                *count += 1;
            }
        }
        counts
    };
    let add = |mut a: Vec<u64>, b: Vec<u64>| {
        a.iter_mut().zip(b).for_each(|(a, b)| *a += b);
        a
    };
    values
        .par_chunks(PIECE)
        .with_min_len(values.len() / PIECE / (4 * rayon::current_num_threads()) + 1)
        .fold(|| vec![0; steps], tally)
        .reduce(|| vec![0; steps], add)
}

/// The keys of the wanted ranks, in ascending order of rank: one pass copies out the keys inside `spans`.
fn pick(values: &[f64], key: &(impl Fn(f64) -> Option<u64> + Sync), spans: &[Span]) -> Vec<f64> {
    let (Some(first), Some(last)) = (spans.first(), spans.last()) else { return Vec::new() };
    let shift = (u64::BITS - (last.high - first.low).leading_zeros()).saturating_sub(STEPS_LOG2);
    let step_of = |k: u64| (k.wrapping_sub(first.low) >> shift) as usize;
    // Most keys lie in no span: one look at this table passes them over.
    let mut touched = vec![false; step_of(last.high) + 1];
    for span in spans.iter().filter(|s| s.low < s.high) {
        touched[step_of(span.low)..=step_of(span.high)].fill(true);
    }
    let copy = |piece: &[f64]| -> Vec<u64> {
        let inside = |k: &u64| {
            touched.get(step_of(*k)).is_some_and(|t| *t)
                && spans
                    .get(spans.partition_point(|s| s.high < *k))
                    .is_some_and(|s| s.low <= *k && s.low < s.high)
        };
        piece.iter().filter_map(|x| key(*x)).filter(inside).collect()
    };
    let mut keys: Vec<u64> = values.par_chunks(PIECE).flat_map_iter(copy).collect();
    keys.par_sort_unstable();
    let mut found = Vec::new();
    for span in spans {
        let start = keys.partition_point(|k| *k < span.low);
        for rank in &span.ranks {
            let key =
                if span.low == span.high { span.low } else { keys[start + (rank - span.before) as usize] };
            found.push(from_key(key));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    fn some_key(x: f64) -> Option<u64> {
        Some(key_of(x))
    }
    fn check(values: &[f64]) {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let n = values.len() as u64;
        let ranks = [n - 1, 0, n / 2, n / 2, n / 3, n / 1000, n + 7];
        let found = select(values, some_key, &ranks);
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
        let positive = |x: f64| (x > 0.0).then(|| key_of(x));
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
