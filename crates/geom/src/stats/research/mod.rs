//! The additions of a research report to the standard statistics: intervals, normality, distributions, correlation.
//!
//! | question | where |
//! |---|---|
//! | how sure are mean and σ? | [`bootstrap`](bootstrap::bootstrap) |
//! | … when neighboring deviations go together? | [`blocks`](blocks::mean_of_blocks) |
//! | are they normal? | [`normality`] |
//! | which distribution describes them best? | [`distributions`](distributions::fits) |
//! | do neighboring deviations go together? | [`moran`](moran::autocorrelation) |
//!
//! Whatever draws numbers takes a seed; the results are the same for any number of threads and on every machine.
//! These methods look at a sample where the whole would cost more than it tells; the result says how large it was.

pub mod blocks;
pub mod bootstrap;
pub mod distributions;
pub mod moran;
pub mod normality;

use crate::num::random::Random;

/// At most `size` of the finite values, drawn without replacement, in their order; and their numbers.
fn subsample(values: &[f64], size: usize, seed: u64) -> (Vec<usize>, Vec<f64>) {
    let finite: Vec<usize> = (0..values.len()).filter(|i| values[*i].is_finite()).collect();
    let chosen: Vec<usize> =
        Random::new(seed).choose(size, finite.len()).into_iter().map(|i| finite[i]).collect();
    let drawn = chosen.iter().map(|i| values[*i]).collect();
    (chosen, drawn)
}
