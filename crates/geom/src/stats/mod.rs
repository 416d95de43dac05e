//! Statistics of numbers with a sign, which know nothing of what was measured.
//!
//! | task | where |
//! |---|---|
//! | all of them at once, from a stream | [`statistics`] |
//! | mean, variance, skewness, kurtosis | [`moments`] |
//! | percentiles, of numbers held and of a stream | [`quantiles`], [`sketch`] |
//! | histogram | [`histogram`] |
//! | control limits and capability of a series | [`process`] |
//! | which of two series is the smaller | [`paired`] |
//! | bootstrap, normality, distributions, spatial autocorrelation | [`research`] |

/// σ of a normal distribution over the median magnitude of its numbers, or over its MAD: 1/Φ⁻¹(3/4).
pub const SIGMA_OVER_MAD: f64 = 1.482_602_218_505_602;

pub mod histogram;
pub mod moments;
pub mod paired;
pub mod process;
pub mod quantiles;
pub mod research;
mod selection;
pub mod sketch;
pub mod statistics;
