//! Quantiles of streams too large to keep: counts per leading bits of the number.
//!
//! A bin holds the numbers with the same sign, exponent and first 14 bits of the mantissa. So a quantile is known to a relative
//! error of 2^-15, whatever the distribution. Only whole numbers are added: the result depends neither on the order of the
//! values nor on how the stream was shared out. Memory: 128 KiB for every power of two that occurs, some 5 MB in practice.

use super::quantiles::{from_key, key_of};
use super::selection::Selection;
use crate::parallel::prelude::*;

/// Greatest relative error of a quantile: half a bin.
pub const RELATIVE_ERROR: f64 = 1.0 / (1u64 << 15) as f64;

/// Bits of the fraction that choose the slot: a bin is 2^-14 of its value wide, twice [`RELATIVE_ERROR`].
const SLOT_BITS: u32 = 14;
/// Slots of a page.
const SLOTS: usize = 1 << SLOT_BITS;
/// Sign and exponent.
const PAGE_BITS: u32 = 12;
/// Bits of the fraction that a bin does not tell apart.
const DROPPED_BITS: u32 = 64 - PAGE_BITS - SLOT_BITS;
/// Values counted by one worker before its counts are added to the rest.
const SKETCHED_VALUES_PER_TASK: usize = 1 << 20;

/// Counts of numbers by their leading bits. Values below 2.3e-308 in size count as zero; NaN is not allowed for.
#[derive(Clone, Debug)]
pub struct Sketch {
    pages: Vec<Option<Box<[u64]>>>,
    count: u64,
}

impl Default for Sketch {
    fn default() -> Sketch {
        Sketch { pages: vec![None; 1 << PAGE_BITS], count: 0 }
    }
}

impl Sketch {
    /// How many values were counted.
    pub fn count(&self) -> u64 {
        self.count
    }
    /// Counts finite values.
    pub fn push(&mut self, values: &[f64]) {
        if values.len() < SKETCHED_VALUES_PER_TASK {
            values.iter().for_each(|x| self.count_one(*x));
            return;
        }
        let counted =
            values.par_chunks(SKETCHED_VALUES_PER_TASK).fold(Sketch::default, |mut sketch, piece| {
                piece.iter().for_each(|x| sketch.count_one(*x));
                sketch
            });
        self.merge(&counted.reduce(Sketch::default, |mut a, b| {
            a.merge(&b);
            a
        }));
    }
    fn count_one(&mut self, x: f64) {
        // -0 becomes 0.
        let key = key_of(x + 0.0);
        let page = &mut self.pages[(key >> (64 - PAGE_BITS)) as usize];
        page.get_or_insert_with(|| vec![0; SLOTS].into_boxed_slice())
            [(key >> DROPPED_BITS) as usize % SLOTS] += 1;
        self.count += 1;
    }
    /// Adds the counts of `other`. The order of merging does not matter.
    pub fn merge(&mut self, other: &Sketch) {
        for (mine, theirs) in self.pages.iter_mut().zip(&other.pages) {
            let Some(theirs) = theirs else { continue };
            match mine {
                Some(mine) => mine.iter_mut().zip(theirs).for_each(|(a, b)| *a += b),
                None => *mine = Some(theirs.clone()),
            }
        }
        self.count += other.count;
    }
    /// The bins that hold something, ascending: value in the middle, count.
    pub fn bins(&self) -> impl Iterator<Item = (f64, u64)> {
        self.used().map(|(page, slot, count)| (middle(page, slot), count))
    }
    /// Page, slot and count of the bins that hold something, ascending.
    fn used(&self) -> impl Iterator<Item = (usize, usize, u64)> {
        let pages = self.pages.iter().enumerate().filter_map(|(p, page)| Some((p, page.as_ref()?)));
        pages.flat_map(|(p, page)| {
            page.iter()
                .enumerate()
                .filter(|(_, count)| **count > 0)
                .map(move |(slot, count)| (p, slot, *count))
        })
    }
    /// The same with the least value of each bin.
    pub(crate) fn floors(&self) -> impl Iterator<Item = (f64, u64)> {
        self.used().map(|(page, slot, count)| (from_key(limits(page, slot).0), count))
    }
    /// The least and the greatest value of the bin that holds `x`.
    pub(crate) fn bin_of(x: f64) -> (f64, f64) {
        let low = key_of(x + 0.0) >> DROPPED_BITS << DROPPED_BITS;
        (from_key(low), from_key(low | ((1 << DROPPED_BITS) - 1)))
    }
    /// Values of the ranks (0 = least), each within [`RELATIVE_ERROR`]. Ranks beyond the last give the greatest;
    /// empty where nothing was counted.
    pub(crate) fn at(&self, ranks: &[u64]) -> Vec<f64> {
        weighted_ranks(self.bins(), ranks)
    }
    /// The same for the distances of a part's values from `center`, each within [`RELATIVE_ERROR`] of the value.
    pub(crate) fn distances_at(&self, part: Selection, center: f64, ranks: &[u64]) -> Vec<f64> {
        let mut distances: Vec<(f64, u64)> = self
            .bins()
            .filter(|(x, _)| part.holds(*x))
            .map(|(x, count)| ((x - center).abs(), count))
            .collect();
        distances.par_sort_by(|a, b| a.0.total_cmp(&b.0));
        weighted_ranks(distances, ranks)
    }
}

/// The least and the greatest key of a bin.
fn limits(page: usize, slot: usize) -> (u64, u64) {
    let low = ((page as u64) << (64 - PAGE_BITS)) | ((slot as u64) << DROPPED_BITS);
    (low, low | ((1 << DROPPED_BITS) - 1))
}
/// The number in the middle of a bin.
fn middle(page: usize, slot: usize) -> f64 {
    let (low, high) = limits(page, slot);
    let middle = from_key(low) / 2.0 + from_key(high) / 2.0;
    if middle.abs() < f64::MIN_POSITIVE { 0.0 } else { middle }
}

fn weighted_ranks(sorted: impl IntoIterator<Item = (f64, u64)>, ranks: &[u64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..ranks.len()).collect();
    order.sort_unstable_by_key(|i| ranks[*i]);
    let mut found = Vec::new();
    let (mut value, mut passed) = (None, 0);
    let mut bins = sorted.into_iter();
    for i in order {
        while passed <= ranks[i] {
            let Some((x, count)) = bins.next() else { break };
            value = Some(x);
            passed += count;
        }
        found.extend(value.map(|x| (i, x)));
    }
    found.sort_unstable_by_key(|(i, _)| *i);
    found.into_iter().map(|(_, x)| x).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    #[test]
    fn a_bin_stands_for_its_values() {
        let mut random = Random::new(3);
        for _ in 0..20_000 {
            let x = (random.unit() - 0.5) * 2f64.powf(600.0 * random.unit() - 300.0);
            let key = key_of(x);
            let bin = middle((key >> (64 - PAGE_BITS)) as usize, (key >> DROPPED_BITS) as usize % SLOTS);
            assert!((bin - x).abs() <= RELATIVE_ERROR * x.abs(), "{x} became {bin}");
        }
        for x in [0.0, -0.0, 5e-324] {
            let mut sketch = Sketch::default();
            sketch.push(&[x]);
            assert_eq!(sketch.at(&[0]), [0.0]);
        }
    }

    #[test]
    fn merging_in_any_order_gives_the_same() {
        let mut random = Random::new(4);
        let values: Vec<f64> = (0..30_000).map(|_| random.unit() - 0.5).collect();
        let sketch_of = |v: &[f64]| {
            let mut sketch = Sketch::default();
            sketch.push(v);
            sketch
        };
        let whole = sketch_of(&values);
        let mut parts: Vec<Sketch> = values.chunks(7_000).map(sketch_of).collect();
        parts.reverse();
        let mut merged = Sketch::default();
        parts.iter().for_each(|p| merged.merge(p));
        assert_eq!(merged.count(), 30_000);
        assert!(merged.bins().eq(whole.bins()));
        assert_eq!(merged.at(&[40_000]), merged.at(&[29_999]));
        assert!(Sketch::default().at(&[0]).is_empty());
    }
}
