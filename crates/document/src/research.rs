//! What `--research` adds to a comparison: intervals, tests, models, correlation.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A finding, or the reason why there is none.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Finding<T> {
    /// Found.
    Found(T),
    /// Not to be had from these deviations.
    Missing {
        /// Why.
        reason: String,
    },
}

/// Everything together.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Research {
    /// Bootstrap intervals of mean and σ, as if the points were independent.
    pub bootstrap: Finding<Bootstrap>,
    /// The mean with an interval that allows for correlation within cubes of space.
    pub block_mean: Finding<BlockMean>,
    /// Tests for a normal distribution.
    pub normality: Normality,
    /// Fitted distributions, the best by BIC first.
    pub distributions: Finding<Vec<Distribution>>,
    /// Spatial autocorrelation.
    pub moran: Finding<Moran>,
}

/// Bootstrap intervals (BCa for few points, see `geom::stats::research::bootstrap`).
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Bootstrap {
    /// Interval of the mean.
    pub mean: [f64; 2],
    /// Interval of the standard deviation.
    pub std_dev: [f64; 2],
    /// Share of such intervals that hold the true value.
    pub confidence: f64,
    /// Resamples.
    pub replicates: usize,
    /// Deviations behind them.
    pub count: u64,
}

/// Mean with a cluster-robust interval (Liang & Zeger 1986).
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct BlockMean {
    /// Side of the cubes, millimeters: a twentieth of the reference's diagonal.
    pub block_size: f64,
    /// The mean of the sample.
    pub mean: f64,
    /// Its 95 % interval.
    pub interval: [f64; 2],
    /// Independent values that would give the same uncertainty.
    pub effective_count: f64,
    /// Cubes that hold points.
    pub blocks: u64,
    /// Points of the sample.
    pub count: u64,
}

/// Tests for a normal distribution; small p values speak against it.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Normality {
    /// D'Agostino and Pearson's K², of all deviations.
    pub d_agostino: Finding<Test>,
    /// Anderson and Darling's A², of a sample.
    pub anderson_darling: Finding<Test>,
}

/// A test.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Test {
    /// The statistic.
    pub statistic: f64,
    /// Chance of one as large, were the deviations normal.
    pub p_value: f64,
    /// Deviations looked at.
    pub count: u64,
}

/// A fitted distribution.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Distribution {
    /// `normal`, `laplace`, `logistic`, `student-t`, `half-normal`, `exponential` or `log-normal`.
    pub family: String,
    /// Where its middle lies.
    pub location: f64,
    /// Its scale.
    pub scale: f64,
    /// Degrees of freedom of Student's t.
    pub shape: Option<f64>,
    /// Akaike's criterion.
    pub aic: f64,
    /// Schwarz's criterion.
    pub bic: f64,
    /// Greatest difference between observed and fitted shares (Kolmogorov–Smirnov).
    pub ks_distance: f64,
}

/// Moran's I on a graph of nearest neighbors.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Moran {
    /// 1: neighbors deviate alike; about 0: independently.
    pub i: f64,
    /// What chance gives on average.
    pub expected: f64,
    /// Two-sided p value of chance.
    pub p_value: f64,
    /// Points looked at.
    pub count: u64,
    /// Mean distance of the neighbors, millimeters.
    #[serde(rename = "neighbour_distance")]
    pub neighbor_distance: f64,
}
