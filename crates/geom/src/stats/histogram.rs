//! Counts of deviations between edges, and below, inside and above two limits.

use super::moments::VALUES_PER_TASK;
use super::sketch::Sketch;
use super::statistics::Statistics;
use crate::parallel::prelude::*;

/// Least bins, where the rule for their width asks for fewer.
const MIN_BINS: f64 = 10.0;
/// Most bins, where it asks for more.
const MAX_BINS: f64 = 200.0;

/// Why there is no histogram.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EdgesError {
    /// One bin has two edges.
    #[error("a histogram needs at least two edges")]
    TooFew,
    /// An edge is NaN, infinite, or not greater than the one before it.
    #[error("edge {0} is not a number greater than the edge before it")]
    NotRising(usize),
}

/// Counts of values in bins.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    edges: Vec<f64>,
    counts: Vec<u64>,
    below: u64,
    above: u64,
}

impl Histogram {
    /// Empty bins between rising edges.
    ///
    /// # Errors
    /// Fewer than two edges, or edges that do not rise.
    pub fn new(edges: Vec<f64>) -> Result<Histogram, EdgesError> {
        if edges.len() < 2 {
            return Err(EdgesError::TooFew);
        }
        let rises = |i: &usize| edges[*i].is_finite() && (*i == 0 || edges[*i] > edges[*i - 1]);
        match (0..edges.len()).find(|i| !rises(i)) {
            Some(i) => Err(EdgesError::NotRising(i)),
            None => Ok(Histogram { counts: vec![0; edges.len() - 1], edges, below: 0, above: 0 }),
        }
    }

    /// Adds values. NaN and infinite ones are passed over. Exact, and the same for any order and number of threads.
    pub fn push(&mut self, values: &[f64]) {
        let count = |mut counts: Vec<u64>, piece: &[f64]| {
            piece.iter().filter(|x| x.is_finite()).for_each(|x| counts[self.place(*x)] += 1);
            counts
        };
        let none = || vec![0; self.edges.len() + 1];
        let counts = values.par_chunks(VALUES_PER_TASK).fold(none, count).reduce(none, |mut a, b| {
            a.iter_mut().zip(b).for_each(|(a, b)| *a += b);
            a
        });
        self.add(&counts);
    }
    /// Adds the counts of another histogram. `false`, and no change, if its edges differ.
    #[must_use]
    pub fn merge(&mut self, other: &Histogram) -> bool {
        let same = self.edges == other.edges;
        if same {
            let counts: Vec<u64> =
                [other.below].into_iter().chain(other.counts.iter().copied()).chain([other.above]).collect();
            self.add(&counts);
        }
        same
    }
    /// Limits of the bins, one more than there are bins. Bin `i` holds `edges[i] <= x < edges[i + 1]`, the last one its
    /// upper edge too.
    pub fn edges(&self) -> &[f64] {
        &self.edges
    }
    /// Values in each bin.
    pub fn counts(&self) -> &[u64] {
        &self.counts
    }
    /// Values below the first edge.
    pub fn below(&self) -> u64 {
        self.below
    }
    /// Values above the last edge.
    pub fn above(&self) -> u64 {
        self.above
    }

    fn add(&mut self, counts: &[u64]) {
        self.below += counts[0];
        self.counts.iter_mut().zip(&counts[1..]).for_each(|(a, b)| *a += b);
        self.above += counts[self.counts.len() + 1];
    }
    /// 0 below, 1 + bin inside, 1 + number of bins above.
    fn place(&self, x: f64) -> usize {
        let (first, last) = (self.edges[0], self.edges[self.edges.len() - 1]);
        let bins = self.counts.len();
        if x < first || x > last {
            return if x < first { 0 } else { bins + 1 };
        }
        // Equal bins are hit at once; the comparison with the edges decides in any case.
        let guess = ((x - first) / (last - first) * bins as f64) as usize;
        let guess = guess.min(bins - 1);
        if self.edges[guess] <= x && x < self.edges[guess + 1] {
            return guess + 1;
        }
        self.edges.partition_point(|e| *e <= x).min(bins)
    }
}

/// Round edges for values with these statistics, or `None` where there is none. They go from the 0.1 to the 99.9 percentile,
/// widened to whole multiples of 1, 2 or 5 times a power of ten.
///
/// The width is that of Freedman and Diaconis (1981), twice the interquartile range over the cube root of the count. It is
/// within 10 to 200 bins, and rounded up.
pub fn nice_edges(statistics: &Statistics) -> Option<Vec<f64>> {
    let (low, high, width) = spread(statistics)?;
    edges(low, high, width)
}

/// Round edges as [`nice_edges`] has them, but not wider than an eighth of a tolerance zone, so that no bin hides what is
/// within. Where that would be more than about 200, they end that far from the zone's middle; values beyond are counted as
/// below or above.
pub fn zone_edges(statistics: &Statistics, [lower, upper]: [f64; 2]) -> Option<Vec<f64>> {
    /// Rounding a width up makes it 2.5 times as large at most.
    const MAX_WIDTH_ROUNDING: f64 = 2.5;
    let (low, high, width) = spread(statistics)?;
    let (usual, widest) = (edges(low, high, width)?, (upper - lower) / 8.0);
    if !(widest > 0.0 && widest < usual[1] - usual[0]) {
        return Some(usual);
    }
    let width = widest / MAX_WIDTH_ROUNDING;
    let (middle, reach) = (0.5 * lower + 0.5 * upper, 0.5 * MAX_BINS * width);
    let near = [low.max(middle - reach), high.min(middle + reach)];
    if near[0] < near[1] { edges(near[0], near[1], width) } else { Some(usual) }
}

/// Where a histogram begins and ends, and how wide its bins should be.
fn spread(statistics: &Statistics) -> Option<(f64, f64, f64)> {
    let at = |i: usize| statistics.percentiles[i].ok();
    let (mut low, mut high) = (at(0)?, at(10)?);
    let quartiles = at(6)? - at(4)?;
    if low == high {
        let pad = (low.abs() / (1u64 << 20) as f64).max(1e-9);
        (low, high) = (low - pad, high + pad);
    }
    let range = high - low;
    let width = 2.0 * quartiles / libm::cbrt(statistics.count as f64);
    Some((low, high, width.clamp(range / MAX_BINS, range / MIN_BINS)))
}

/// Whole multiples of 1, 2 or 5 times a power of ten, not less than `width`, from below `low` to above `high`.
fn edges(low: f64, high: f64, width: f64) -> Option<Vec<f64>> {
    if !(width.is_finite() && width > f64::MIN_POSITIVE && low <= high) {
        return None;
    }
    let mut power = libm::floor(libm::log10(width)) as i32;
    let digit = [1, 2, 5].into_iter().find(|d| multiple(*d, power) >= width * (1.0 - 1e-9));
    let digit = digit.unwrap_or_else(|| {
        power += 1;
        1
    });
    let step = multiple(digit, power);
    let (first, last) = ((low / step).floor() as i64, (high / step).ceil() as i64);
    Some((first..=last.max(first + 1)).map(|k| multiple(k * digit, power)).collect())
}

/// `count` times 10^`power`, the nearest number to it (for the powers that matter).
fn multiple(count: i64, power: i32) -> f64 {
    // Powers of ten up to 22 are exact; dividing by one rounds once, multiplying by a tenth would round twice.
    if power < 0 { count as f64 / 10f64.powi(-power) } else { count as f64 * 10f64.powi(power) }
}

impl Sketch {
    /// The histogram of what was counted, for a stream that has gone by. Edges are moved to the nearest limits of the sketch's
    /// bins, by a relative 2^-14 at most; edges that fall together become one. For the edges it then has, the counts are exact.
    ///
    /// # Errors
    /// The errors of [`Histogram::new`].
    pub fn histogram(&self, edges: &[f64]) -> Result<Histogram, EdgesError> {
        let mut moved: Vec<f64> =
            Histogram::new(edges.to_vec())?.edges.iter().map(|e| Sketch::bin_of(*e).0).collect();
        // The upper edge of the last bin belongs to it: it is the last value before the next sketch bin.
        if let (Some(last), Some(edge)) = (moved.last_mut(), edges.last()) {
            *last = Sketch::bin_of(*edge).1;
        }
        moved.dedup();
        let mut histogram = Histogram::new(moved)?;
        let mut counts = vec![0; histogram.edges.len() + 1];
        self.floors().for_each(|(low, count)| counts[histogram.place(low)] += count);
        histogram.add(&counts);
        Ok(histogram)
    }
}

/// Counts against two limits, both of which belong to the inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Lower limit, millimeters.
    pub lower: f64,
    /// Upper limit, millimeters.
    pub upper: f64,
    /// Values below the lower limit.
    pub below: u64,
    /// Values from the lower to the upper limit.
    pub inside: u64,
    /// Values above the upper limit.
    pub above: u64,
}

impl Limits {
    /// Nothing counted yet.
    pub fn new(lower: f64, upper: f64) -> Limits {
        Limits { lower, upper, below: 0, inside: 0, above: 0 }
    }
    /// Adds values. NaN is passed over; infinite values are outside.
    pub fn push(&mut self, values: &[f64]) {
        let count = |piece: &[f64]| {
            piece.iter().fold((0, 0, 0), |(below, inside, above), x| {
                let (b, a) = (u64::from(*x < self.lower), u64::from(*x > self.upper));
                (below + b, inside + (1 - (a | b)) * u64::from(!x.is_nan()), above + a)
            })
        };
        let add = |a: (u64, u64, u64), b: (u64, u64, u64)| (a.0 + b.0, a.1 + b.1, a.2 + b.2);
        let (below, inside, above) = values.par_chunks(VALUES_PER_TASK).map(count).reduce(|| (0, 0, 0), add);
        self.below += below;
        self.inside += inside;
        self.above += above;
    }
    /// Shares below, inside and above; `None` where nothing was counted.
    pub fn shares(&self) -> Option<[f64; 3]> {
        let total = self.below + self.inside + self.above;
        (total > 0).then(|| [self.below, self.inside, self.above].map(|n| n as f64 / total as f64))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;
    use crate::stats::statistics::{Accumulator, Summary};

    #[test]
    fn bins_hold_their_lower_edge() {
        let mut histogram = Histogram::new(vec![0.0, 0.1, 0.2, 0.30000000000000004]).unwrap();
        histogram.push(&[
            -0.1,
            0.0,
            0.1,
            0.1 - 1e-17,
            0.2,
            0.3,
            0.30000000000000004,
            0.31,
            f64::NAN,
            f64::INFINITY,
        ]);
        assert_eq!(histogram.counts(), [2, 1, 3]);
        assert_eq!((histogram.below(), histogram.above()), (1, 1));
        let mut uneven = Histogram::new(vec![-8.0, 0.0, 0.5, 100.0]).unwrap();
        uneven.push(&[-8.0, -1e-300, 0.0, 0.49, 0.5, 99.0, 100.0]);
        assert_eq!(uneven.counts(), [2, 2, 3]);
        assert!(!uneven.merge(&histogram));
        assert!(uneven.merge(&uneven.clone()));
        assert_eq!(uneven.counts(), [4, 4, 6]);
        assert_eq!(Histogram::new(vec![1.0]), Err(EdgesError::TooFew));
        assert_eq!(Histogram::new(vec![1.0, 2.0, 2.0]), Err(EdgesError::NotRising(2)));
    }

    #[test]
    fn round_edges_cover_nearly_all() {
        let mut random = Random::new(12);
        for (size, shift) in [(1.0, 0.0), (3e-5, 0.02), (700.0, -1e4), (1.0, 1e6)] {
            let values: Vec<f64> =
                (0..30_000).map(|_| shift + size * (random.unit() + random.unit() - 1.0)).collect();
            let summary = Summary::of(&values);
            let edges = nice_edges(&summary.all).unwrap();
            assert!((10..=203).contains(&edges.len()), "{}", edges.len());
            let mut histogram = Histogram::new(edges.clone()).unwrap();
            histogram.push(&values);
            assert!(histogram.below() <= 30 && histogram.above() <= 30);
            let inside: u64 = histogram.counts().iter().sum();
            assert_eq!(inside + histogram.below() + histogram.above(), 30_000);
            // Round: the shortest decimal form is short.
            assert!(edges.iter().all(|e| format!("{e}").len() <= 10), "{edges:?}");
            let mut accumulator = Accumulator::new();
            accumulator.push(&values);
            let sketched = accumulator.sketch().histogram(&edges).unwrap();
            let mut again = Histogram::new(sketched.edges().to_vec()).unwrap();
            again.push(&values);
            assert_eq!(sketched, again);
        }
        assert_eq!(nice_edges(&Summary::of(&[]).all), None);
        let one = nice_edges(&Summary::of(&[0.25, 0.25]).all).unwrap();
        assert!(one[0] < 0.25 && 0.25 < one[one.len() - 1]);
    }

    /// A few values far off widen no bin beyond the zone: nearly all values are told to be within.
    #[test]
    fn bins_are_finer_than_the_zone() {
        let mut random = Random::new(13);
        let mut values: Vec<f64> = (0..10_000).map(|_| 0.02 * random.unit() - 0.01).collect();
        values.extend((0..300).map(|k| 1000.0 + f64::from(k)));
        let all = Summary::of(&values).all;
        assert!(nice_edges(&all).unwrap().windows(2).all(|e| e[1] - e[0] >= 5.0));
        for zone in [[-0.05, 0.05], [0.0, 0.02], [-0.5, 0.1]] {
            let edges = zone_edges(&all, zone).unwrap();
            assert!(edges.len() <= 203 && edges.windows(2).all(|e| e[1] - e[0] <= (zone[1] - zone[0]) / 8.0));
            let mut histogram = Histogram::new(edges).unwrap();
            histogram.push(&values);
            let inside: u64 = histogram.counts().iter().sum();
            assert_eq!((inside, histogram.above()), (10_000, 300));
        }
        // Far from everything, or without an end, a zone changes nothing.
        for zone in [[-2e9, -1e9], [f64::NEG_INFINITY, 0.1], [0.0, 0.0]] {
            assert_eq!(zone_edges(&all, zone), nice_edges(&all), "{zone:?}");
        }
    }

    #[test]
    fn limits_belong_to_the_inside() {
        let mut limits = Limits::new(-0.1, 0.2);
        assert_eq!(limits.shares(), None);
        limits.push(&[-0.1, 0.2, 0.0, 0.21, f64::NAN, -0.11, f64::INFINITY]);
        assert_eq!((limits.below, limits.inside, limits.above), (1, 3, 2));
        assert_eq!(limits.shares(), Some([1.0 / 6.0, 0.5, 2.0 / 6.0]));
    }
}
