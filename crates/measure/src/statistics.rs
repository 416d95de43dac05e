//! Statistics and counts of values, as all documents have them.

use trueness_document::{BySide, Histogram, Percentiles, Statistics};
use trueness_geom::stats::histogram::nice_edges;

mod geom {
    pub use trueness_geom::stats::histogram::Histogram;
    pub use trueness_geom::stats::statistics::{Missing, Statistics, Summary};
}

/// The document's form of a set of statistics; `quantile_error` is the relative error of order statistics.
pub fn statistics(s: &geom::Statistics, quantile_error: f64) -> Statistics {
    let both = |found: Result<f64, geom::Missing>| (found.ok(), found.err().map(|e| e.to_string()));
    let (min, min_reason) = both(s.min);
    let (max, max_reason) = both(s.max);
    let (range, range_reason) = both(s.range);
    let (mean, mean_reason) = both(s.mean);
    let (variance, variance_reason) = both(s.variance);
    let (std_dev, std_dev_reason) = both(s.std_dev);
    let (six_sigma, six_sigma_reason) = both(s.six_sigma);
    let (cv, cv_reason) = both(s.cv);
    let (rms, rms_reason) = both(s.rms);
    let (mean_abs, mean_abs_reason) = both(s.mean_abs);
    let (median, median_reason) = both(s.median);
    let (mad, mad_reason) = both(s.mad);
    let (skewness, skewness_reason) = both(s.skewness);
    let (kurtosis, kurtosis_reason) = both(s.kurtosis);
    Statistics {
        count: s.count,
        min,
        min_reason,
        max,
        max_reason,
        range,
        range_reason,
        mean,
        mean_reason,
        variance,
        variance_reason,
        std_dev,
        std_dev_reason,
        six_sigma,
        six_sigma_reason,
        cv,
        cv_reason,
        rms,
        rms_reason,
        mean_abs,
        mean_abs_reason,
        median,
        median_reason,
        mad,
        mad_reason,
        skewness,
        skewness_reason,
        kurtosis,
        kurtosis_reason,
        percentiles: percentiles(s),
        percentile_error: quantile_error,
    }
}

/// The document's form of the statistics of all values and of each side.
pub fn by_side(summary: &geom::Summary) -> BySide {
    let error = summary.quantile_error;
    BySide {
        all: statistics(&summary.all, error),
        positive: statistics(&summary.positive, error),
        negative: statistics(&summary.negative, error),
    }
}

fn percentiles(s: &geom::Statistics) -> Percentiles {
    let [p0_1, p1, p2_5, p5, p25, p50, p75, p95, p97_5, p99, p99_9] = s.percentiles.map(Result::ok);
    Percentiles { p0_1, p1, p2_5, p5, p25, p50, p75, p95, p97_5, p99, p99_9 }
}

/// The document's form of a histogram.
pub fn histogram(h: &geom::Histogram) -> Histogram {
    Histogram { edges: h.edges().to_vec(), counts: h.counts().to_vec(), below: h.below(), above: h.above() }
}

/// Counts of values between round edges; `all` are their statistics. `None` where there is nothing to count.
pub fn counted(all: &geom::Statistics, values: &[f64]) -> Option<Histogram> {
    let mut counted = geom::Histogram::new(nice_edges(all)?).ok()?;
    counted.push(values);
    Some(histogram(&counted))
}
