//! Statistics of deviations: all, the positive and the negative ones apart.

use super::moments::{MomentTree, Moments, VALUES_PER_CHUNK};
use super::quantiles::{Keyed, NO_KEY, PERCENTILES, interpolate, key_of, position};
pub use super::selection::Selection;
use super::sketch::Sketch;
use crate::parallel::prelude::*;

/// Why a number does not exist.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Missing {
    /// A statistic of nothing.
    #[error("there are no values")]
    NoValues,
    /// Spread of a single value.
    #[error("one value has no spread; at least two are needed")]
    OneValue,
    /// A method that needs more values.
    #[error("at least {0} values are needed")]
    TooFew(u64),
    /// Shape of a distribution whose values are all equal.
    #[error("all values are equal")]
    NoSpread,
    /// A ratio to the mean, where the mean is zero or cannot be told from it.
    #[error("the mean is zero to rounding")]
    MeanIsZero,
    /// The values are so large that their powers exceed the number format.
    #[error("the values are too large for the number format")]
    Overflow,
}

/// A statistic, or the reason why there is none. Never NaN.
pub type Number = Result<f64, Missing>;

/// The statistics of one set of numbers (millimeters; variance in square millimeters).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    /// How many.
    pub count: u64,
    /// Least.
    pub min: Number,
    /// Greatest.
    pub max: Number,
    /// `max - min`.
    pub range: Number,
    /// Arithmetic mean.
    pub mean: Number,
    /// Sample variance: the sum of squared differences from the mean, over `count - 1`.
    pub variance: Number,
    /// Square root of the variance.
    pub std_dev: Number,
    /// Coefficient of variation: `std_dev / |mean|`.
    pub cv: Number,
    /// Root of the mean square (of the values themselves, not of their differences from the mean).
    pub rms: Number,
    /// Mean of the absolute values.
    pub mean_abs: Number,
    /// Half of the values are below.
    pub median: Number,
    /// Median of the absolute differences from the median; not scaled to σ.
    pub mad: Number,
    /// Third standardized moment, of the values as a population (g1).
    pub skewness: Number,
    /// Fourth standardized moment less 3, of the values as a population (g2); 0 for the normal distribution.
    pub kurtosis: Number,
    /// Six standard deviations.
    pub six_sigma: Number,
    /// Values at [`PERCENTILES`]: linear interpolation between ranks at `(count - 1) p / 100` (Hyndman and Fan's
    /// type 7, NumPy's default).
    pub percentiles: [Number; PERCENTILES.len()],
}

/// The mean that rounding of the values and of the sums may make of a true zero, relative to the mean size.
const MEAN_ROUNDING: f64 = 4.0 * f64::EPSILON;

impl Statistics {
    /// The value that `percent` of all are below; `None` where `percent` is not one of [`PERCENTILES`].
    ///
    /// ```
    /// use trueness_geom::stats::statistics::Summary;
    /// let summary = Summary::of(&[1.0, 2.0, 3.0, 4.0, 5.0]);
    /// assert_eq!(summary.all.percentile(75.0), Some(Ok(4.0)));
    /// assert_eq!(summary.all.percentile(33.0), None);
    /// ```
    pub fn percentile(&self, percent: f64) -> Option<Number> {
        PERCENTILES.iter().position(|p| *p == percent).map(|i| self.percentiles[i])
    }

    /// Greatest absolute value.
    pub fn max_abs(&self) -> Number {
        Ok(self.min?.abs().max(self.max?.abs()))
    }

    fn new(moments: &Moments, mean_abs: f64, ordered: Option<Ordered>) -> Statistics {
        let n = moments.count as f64;
        let known = |x: f64| match moments.count {
            0 => Err(Missing::NoValues),
            _ if !x.is_finite() => Err(Missing::Overflow),
            _ => Ok(x),
        };
        let spread = |x: f64| if moments.count == 1 { Err(Missing::OneValue) } else { known(x) };
        let [m2, m3, m4] = moments.powers;
        let shape = |x: f64| if moments.count > 0 && m2 == 0.0 { Err(Missing::NoSpread) } else { known(x) };
        let mean = moments.mean.value();
        let std_dev = spread((m2 / (n - 1.0)).sqrt());
        let zero_mean = mean.abs() <= MEAN_ROUNDING * mean_abs;
        let ordered_number = |pick: fn(&Ordered) -> f64| ordered.as_ref().map(pick).ok_or(Missing::NoValues);
        Statistics {
            count: moments.count,
            min: known(moments.min),
            max: known(moments.max),
            range: known(moments.max - moments.min),
            mean: known(mean),
            variance: spread(m2 / (n - 1.0)),
            std_dev,
            cv: if zero_mean && std_dev.is_ok() {
                Err(Missing::MeanIsZero)
            } else {
                std_dev.map(|s| s / mean.abs())
            },
            rms: known((mean * mean + m2 / n).sqrt()),
            mean_abs: known(mean_abs),
            median: ordered_number(|o| o.percentiles[5]),
            mad: ordered_number(|o| o.mad),
            skewness: shape(m3 / n / (m2 / n * (m2 / n).sqrt())),
            kurtosis: shape(m4 / n / (m2 / n).powi(2) - 3.0),
            six_sigma: std_dev.map(|s| 6.0 * s),
            percentiles: std::array::from_fn(|i| {
                ordered.as_ref().map(|o| o.percentiles[i]).ok_or(Missing::NoValues)
            }),
        }
    }
}

/// Statistics of all deviations and of both signs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    /// All finite values.
    pub all: Statistics,
    /// The deviations above zero.
    pub positive: Statistics,
    /// The deviations below zero.
    pub negative: Statistics,
    /// 95 % of the absolute values are no greater; the range of a color scale.
    pub p95_abs: Number,
    /// Values that are exactly zero: in `all`, in neither of the others.
    pub zeros: u64,
    /// NaN and infinite values: left out everywhere.
    pub not_finite: u64,
    /// Greatest relative error of the percentiles, median and MAD. It is 0 where all values were at hand,
    /// [`super::sketch::RELATIVE_ERROR`] where they came as a stream. For the MAD it is relative to the values, not to their
    /// distances from the median.
    pub quantile_error: f64,
}

impl Summary {
    /// Statistics of values that are all in memory; percentiles are exact.
    ///
    /// Deterministic for any number of threads. Cost: some ten passes over the values, extra memory for about a
    /// tenth of them.
    pub fn of(values: &[f64]) -> Summary {
        let mut moments = SignedMoments::default();
        moments.push(values);
        moments.summary(0.0, &Exact(values))
    }
}

/// Statistics of values that arrive block by block.
///
/// The result is the same for any number of threads and for any cutting of the stream into blocks. The order of the values
/// decides the last bits of the moments. Memory: some 5 MB, whatever the count.
#[derive(Clone, Debug, Default)]
pub struct Accumulator {
    moments: SignedMoments,
    sketch: Sketch,
}

impl Accumulator {
    /// Nothing yet.
    pub fn new() -> Accumulator {
        Accumulator::default()
    }
    /// Adds the next values of the stream. NaN and infinite ones are counted and left out.
    pub fn push(&mut self, values: &[f64]) {
        self.moments.push(values);
        if values.par_iter().all(|x| x.is_finite()) {
            self.sketch.push(values);
        } else {
            self.sketch.push(&values.iter().copied().filter(|x| x.is_finite()).collect::<Vec<f64>>());
        }
    }
    /// Counts of the values by their leading bits.
    pub fn sketch(&self) -> &Sketch {
        &self.sketch
    }
    /// Statistics of everything so far; percentiles to a relative error of 2^-15.
    pub fn summary(&self) -> Summary {
        self.moments.summary(super::sketch::RELATIVE_ERROR, &self.sketch)
    }
}

/// Moments of the positive and of the negative values of a stream.
#[derive(Clone, Debug, Default)]
struct SignedMoments {
    chunks: Chunks,
    /// The unfinished chunk: fewer than [`VALUES_PER_CHUNK`] values.
    pending: Vec<f64>,
}

/// The moments of all finished chunks.
#[derive(Clone, Debug, Default)]
struct Chunks {
    positive: MomentTree,
    negative: MomentTree,
    zeros: u64,
    not_finite: u64,
}

struct Chunk {
    positive: Moments,
    negative: Moments,
    zeros: u64,
    not_finite: u64,
}

impl Chunk {
    fn of(values: &[f64]) -> Chunk {
        // One place more than values: the next place is always there to be written.
        let (mut positive, mut negative) = ([0.0; VALUES_PER_CHUNK + 1], [0.0; VALUES_PER_CHUNK + 1]);
        let (mut p, mut n, mut zeros) = (0, 0, 0);
        for x in values {
            // Writing always and counting sometimes spares a branch that scattered signs would mispredict.
            positive[p] = *x;
            negative[n] = *x;
            p += usize::from(*x > 0.0 && *x < f64::INFINITY);
            n += usize::from(*x < 0.0 && *x > f64::NEG_INFINITY);
            zeros += usize::from(*x == 0.0);
        }
        Chunk {
            positive: Moments::of(&positive[..p]),
            negative: Moments::of(&negative[..n]),
            zeros: zeros as u64,
            not_finite: (values.len() - p - n - zeros) as u64,
        }
    }
}

impl SignedMoments {
    fn push(&mut self, values: &[f64]) {
        let missing = (VALUES_PER_CHUNK - self.pending.len()) % VALUES_PER_CHUNK;
        let (head, rest) = values.split_at(missing.min(values.len()));
        self.pending.extend_from_slice(head);
        if self.pending.len() == VALUES_PER_CHUNK {
            self.chunks.push(Chunk::of(&self.pending));
            self.pending.clear();
        }
        let (whole, tail) = rest.split_at(rest.len() / VALUES_PER_CHUNK * VALUES_PER_CHUNK);
        let chunks: Vec<Chunk> = whole.par_chunks(VALUES_PER_CHUNK).map(Chunk::of).collect();
        chunks.into_iter().for_each(|chunk| self.chunks.push(chunk));
        self.pending.extend_from_slice(tail);
    }

    fn summary(&self, quantile_error: f64, values: &impl Order) -> Summary {
        let last = Chunk::of(&self.pending);
        let zeros = self.chunks.zeros + last.zeros;
        let not_finite = self.chunks.not_finite + last.not_finite;
        let negative = self.chunks.negative.total(last.negative);
        let positive = self.chunks.positive.total(last.positive);
        let all = negative.merge(&Moments::repeated(0.0, zeros)).merge(&positive);
        let shares =
            [&positive, &negative].map(|m| m.mean.value().abs() * (m.count as f64 / all.count as f64));
        let [of_all, of_positive, of_negative] =
            ordered(values, [&all, &positive, &negative], negative.count + zeros);
        let sizes = values.distances_at(Selection::All, &all, 0.0, &neighbors(0, all.count, 95.0));
        Summary {
            p95_abs: match sizes[..] {
                [a, b] => Ok(interpolate(a, b, position(all.count, 95.0).1)),
                _ => Err(Missing::NoValues),
            },
            all: Statistics::new(&all, shares[0] + shares[1], of_all),
            positive: Statistics::new(&positive, positive.mean.value(), of_positive),
            negative: Statistics::new(&negative, -negative.mean.value(), of_negative),
            zeros,
            not_finite,
            quantile_error,
        }
    }
}

impl Chunks {
    fn push(&mut self, chunk: Chunk) {
        self.positive.push(chunk.positive);
        self.negative.push(chunk.negative);
        self.zeros += chunk.zeros;
        self.not_finite += chunk.not_finite;
    }
}

/// Numbers that can be asked for their values in order.
trait Order {
    /// The values of these ranks among all finite values, whose moments are known.
    fn at(&self, all: &Moments, ranks: &[u64]) -> Vec<f64>;
    /// The same for the distances of a part's values from `center`.
    fn distances_at(&self, part: Selection, moments: &Moments, center: f64, ranks: &[u64]) -> Vec<f64>;
}

/// Values in memory. The moments' extremes bound what is searched.
struct Exact<'a>(&'a [f64]);

impl Order for Exact<'_> {
    fn at(&self, all: &Moments, ranks: &[u64]) -> Vec<f64> {
        let key = |x: f64| if x.is_finite() { key_of(x) } else { NO_KEY };
        // Zeros of both signs are equal as extremes, but not as keys.
        let low = if all.min == 0.0 { -0.0 } else { all.min };
        let high = if all.max == 0.0 { 0.0 } else { all.max };
        Keyed { values: self.0, key, low: key_of(low), high: key_of(high), count: all.count }.at(ranks)
    }
    fn distances_at(&self, part: Selection, moments: &Moments, center: f64, ranks: &[u64]) -> Vec<f64> {
        let (above, below) = part.limits();
        // No branch: scattered signs would mispredict it.
        let key =
            move |x: f64| key_of((x - center).abs()) | (NO_KEY * u64::from(!((x > above) & (x < below))));
        let farthest = (moments.min - center).abs().max((moments.max - center).abs());
        Keyed { values: self.0, key, low: key_of(0.0), high: key_of(farthest), count: moments.count }
            .at(ranks)
    }
}

impl Order for Sketch {
    fn at(&self, _: &Moments, ranks: &[u64]) -> Vec<f64> {
        self.at(ranks)
    }
    fn distances_at(&self, part: Selection, _: &Moments, center: f64, ranks: &[u64]) -> Vec<f64> {
        self.distances_at(part, center, ranks)
    }
}

struct Ordered {
    percentiles: [f64; PERCENTILES.len()],
    mad: f64,
}

/// Percentiles and MAD of all values, the positive ones (from rank `first_positive` on) and the negative ones.
fn ordered(values: &impl Order, moments: [&Moments; 3], first_positive: u64) -> [Option<Ordered>; 3] {
    let parts = [(Selection::All, 0), (Selection::Positive, first_positive), (Selection::Negative, 0)];
    let ranks: Vec<u64> = std::iter::zip(parts, moments)
        .flat_map(|((_, first), m)| PERCENTILES.iter().flat_map(move |p| neighbors(first, m.count, *p)))
        .collect();
    let found = values.at(moments[0], &ranks);
    std::array::from_fn(|i| {
        let (part, count) = (parts[i].0, moments[i].count);
        let of_part = found.get(i * 2 * PERCENTILES.len()..)?;
        if count == 0 {
            return None;
        }
        let percentiles = std::array::from_fn(|k| {
            interpolate(of_part[2 * k], of_part[2 * k + 1], position(count, PERCENTILES[k]).1)
        });
        let distances = values.distances_at(part, moments[i], percentiles[5], &neighbors(0, count, 50.0));
        let [a, b] = distances[..] else { return None };
        Some(Ordered { percentiles, mad: interpolate(a, b, position(count, 50.0).1) })
    })
}

/// The two ranks that a percentile lies between.
fn neighbors(first: u64, count: u64, p: f64) -> [u64; 2] {
    let (below, _) = position(count, p);
    [first + below, first + (below + 1).min(count.saturating_sub(1))]
}

#[cfg(test)]
mod tests;
