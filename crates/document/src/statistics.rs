//! Statistics and counts of values, as all documents have them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Statistics of all deviations and of each side.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct BySide {
    /// All.
    pub all: Statistics,
    /// Above zero: outside, too much material.
    pub positive: Statistics,
    /// Below zero: inside, missing material.
    pub negative: Statistics,
}

/// Declares the statistics document: each number beside the reason why it may be missing.
macro_rules! statistics {
    ($($(#[$doc:meta])* $name:ident $reason:ident,)*) => {
        /// Statistics of a set of deviations, millimeters (skewness and kurtosis have no unit, the variance is in mm²).
        /// A number that does not exist is `null`, and `<name>_reason` says why.
        #[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
        pub struct Statistics {
            /// Number of deviations.
            pub count: u64,
            $(
                $(#[$doc])*
                pub $name: Option<f64>,
                /// Why the number above is missing.
                #[serde(skip_serializing_if = "Option::is_none", default)]
                pub $reason: Option<String>,
            )*
            /// Percentiles; all missing when `count` is 0.
            pub percentiles: Percentiles,
            /// Largest relative error of median, mad and percentiles; 0 when they are exact.
            pub percentile_error: f64,
        }
    };
}

statistics! {
    /// Least.
    min min_reason,
    /// Greatest.
    max max_reason,
    /// `max - min`.
    range range_reason,
    /// Arithmetic mean.
    mean mean_reason,
    /// Sample variance, divided by `count - 1`.
    variance variance_reason,
    /// Square root of the variance.
    std_dev std_dev_reason,
    /// Six standard deviations.
    six_sigma six_sigma_reason,
    /// Coefficient of variation: standard deviation over the mean's size.
    cv cv_reason,
    /// Root mean square.
    rms rms_reason,
    /// Mean of the absolute deviations.
    mean_abs mean_abs_reason,
    /// Middle value.
    median median_reason,
    /// Median of the distances from the median.
    mad mad_reason,
    /// Third standardized moment.
    skewness skewness_reason,
    /// Fourth standardized moment less 3.
    kurtosis kurtosis_reason,
}

/// A statistic in a table for people: what it is called, and its value.
pub type TableRow = (&'static str, fn(&Statistics) -> Option<f64>);

/// The statistics of a table for people, in its order.
pub const TABLE_ROWS: &[TableRow] = &[
    ("mean", |s| s.mean),
    ("standard deviation σ", |s| s.std_dev),
    ("6 σ", |s| s.six_sigma),
    ("variance", |s| s.variance),
    ("coefficient of variation", |s| s.cv),
    ("root mean square", |s| s.rms),
    ("mean of |d|", |s| s.mean_abs),
    ("median", |s| s.median),
    ("MAD", |s| s.mad),
    ("min", |s| s.min),
    ("max", |s| s.max),
    ("range", |s| s.range),
    ("skewness", |s| s.skewness),
    ("excess kurtosis", |s| s.kurtosis),
    ("0.1 %", |s| s.percentiles.p0_1),
    ("1 %", |s| s.percentiles.p1),
    ("2.5 %", |s| s.percentiles.p2_5),
    ("5 %", |s| s.percentiles.p5),
    ("25 %", |s| s.percentiles.p25),
    ("75 %", |s| s.percentiles.p75),
    ("95 %", |s| s.percentiles.p95),
    ("97.5 %", |s| s.percentiles.p97_5),
    ("99 %", |s| s.percentiles.p99),
    ("99.9 %", |s| s.percentiles.p99_9),
];

/// A statistic on a page: key in the table of words, digits beyond the scale's, whether it is signed, number and reason.
pub type PageRow = (&'static str, usize, bool, fn(&Statistics) -> (Option<f64>, Option<&str>));

/// The statistics of a page, in its order.
pub const PAGE_ROWS: [PageRow; 14] = [
    ("mean", 1, true, |s| (s.mean, s.mean_reason.as_deref())),
    ("std_dev", 1, false, |s| (s.std_dev, s.std_dev_reason.as_deref())),
    ("rms", 1, false, |s| (s.rms, s.rms_reason.as_deref())),
    ("mean_abs", 1, false, |s| (s.mean_abs, s.mean_abs_reason.as_deref())),
    ("min", 0, true, |s| (s.min, s.min_reason.as_deref())),
    ("max", 0, true, |s| (s.max, s.max_reason.as_deref())),
    ("range_width", 0, false, |s| (s.range, s.range_reason.as_deref())),
    ("median", 1, true, |s| (s.median, s.median_reason.as_deref())),
    ("p5", 0, true, |s| (s.percentiles.p5, None)),
    ("p95", 0, true, |s| (s.percentiles.p95, None)),
    ("six_sigma", 1, false, |s| (s.six_sigma, s.six_sigma_reason.as_deref())),
    ("cv", 0, false, |s| (s.cv, s.cv_reason.as_deref())),
    ("skewness", 0, true, |s| (s.skewness, s.skewness_reason.as_deref())),
    ("kurtosis", 0, true, |s| (s.kurtosis, s.kurtosis_reason.as_deref())),
];

/// Percentiles, linearly interpolated between order statistics (Hyndman & Fan's type 7, as NumPy's default).
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Percentiles {
    #[serde(rename = "0.1")]
    pub p0_1: Option<f64>,
    #[serde(rename = "1")]
    pub p1: Option<f64>,
    #[serde(rename = "2.5")]
    pub p2_5: Option<f64>,
    #[serde(rename = "5")]
    pub p5: Option<f64>,
    #[serde(rename = "25")]
    pub p25: Option<f64>,
    #[serde(rename = "50")]
    pub p50: Option<f64>,
    #[serde(rename = "75")]
    pub p75: Option<f64>,
    #[serde(rename = "95")]
    pub p95: Option<f64>,
    #[serde(rename = "97.5")]
    pub p97_5: Option<f64>,
    #[serde(rename = "99")]
    pub p99: Option<f64>,
    #[serde(rename = "99.9")]
    pub p99_9: Option<f64>,
}

/// Counts of deviations between edges; bin `i` holds `edges[i] <= d < edges[i + 1]`, the last one its upper edge too.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Histogram {
    /// `n + 1` limits, rising.
    pub edges: Vec<f64>,
    /// `n` counts.
    pub counts: Vec<u64>,
    /// Deviations below the first edge.
    pub below: u64,
    /// Deviations above the last edge.
    pub above: u64,
}
