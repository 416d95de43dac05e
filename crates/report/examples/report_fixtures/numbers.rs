//! Statistics of the fixtures, written out plainly.

use trueness_document::compare::{Histogram, Percentiles, Statistics};

/// Histogram of sorted numbers between their 0.1 % and 99.9 % quantiles.
pub fn histogram(values: &[f64]) -> Histogram {
    const BINS: usize = 100;
    let (low, high) = (quantile(values, 0.001), quantile(values, 0.999));
    let edges: Vec<f64> = (0..=BINS).map(|i| low + (high - low) * i as f64 / BINS as f64).collect();
    let mut counts = vec![0; BINS];
    for v in values.iter().filter(|v| (low..=high).contains(*v)) {
        let bin = edges.partition_point(|e| e <= v).saturating_sub(1).min(BINS - 1);
        counts[bin] += 1;
    }
    let outside = |keep: &dyn Fn(f64) -> bool| values.iter().filter(|v| keep(**v)).count() as u64;
    Histogram { edges, counts, below: outside(&|v| v < low), above: outside(&|v| v > high) }
}

/// The statistics of sorted numbers that the page shows, by their definitions.
pub fn statistics(values: &[f64]) -> Statistics {
    let n = values.len() as f64;
    if values.is_empty() {
        return Statistics::default();
    }
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0).max(1.0);
    let p = |q: f64| Some(quantile(values, q));
    Statistics {
        count: values.len() as u64,
        min: Some(values[0]),
        max: values.last().copied(),
        range: Some(values[values.len() - 1] - values[0]),
        mean: Some(mean),
        variance: Some(variance),
        std_dev: Some(variance.sqrt()),
        six_sigma: Some(6.0 * variance.sqrt()),
        cv: None,
        cv_reason: Some("the mean is zero to rounding".into()),
        rms: Some((values.iter().map(|v| v * v).sum::<f64>() / n).sqrt()),
        mean_abs: Some(values.iter().map(|v| v.abs()).sum::<f64>() / n),
        median: p(0.5),
        percentiles: Percentiles {
            p2_5: p(0.025),
            p5: p(0.05),
            p95: p(0.95),
            p97_5: p(0.975),
            ..Percentiles::default()
        },
        ..Statistics::default()
    }
}

/// The numbers in ascending order.
pub fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut all: Vec<f64> = values.collect();
    all.sort_by(f64::total_cmp);
    all
}

/// The nearest of the sorted numbers to a quantile; 0 where there are none.
pub fn quantile(sorted: &[f64], q: f64) -> f64 {
    sorted.get((q * (sorted.len().max(1) - 1) as f64).round() as usize).copied().unwrap_or(0.0)
}
