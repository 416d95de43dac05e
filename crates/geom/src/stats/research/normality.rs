//! Are the deviations normally distributed?
//!
//! With the many points of a scan every real distribution is found not to be normal. The size of skewness and kurtosis tells
//! more than the p value.

use super::super::statistics::{Missing, Statistics, Summary};
use crate::num::special::normal_below;

/// A test statistic and the chance of one at least as large, were the values normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Test {
    /// The statistic.
    pub statistic: f64,
    /// p value.
    pub p: f64,
    /// Values looked at.
    pub count: u64,
}

/// Fewest values for which the approximations hold.
const MIN_TESTED_VALUES: u64 = 20;

/// D'Agostino and Pearson's K²: skewness and kurtosis together, from the statistics of any number of values.
///
/// D'Agostino (1970) for the skewness, Anscombe and Glynn (1983) for the kurtosis.
///
/// # Errors
/// Fewer than 20 values, or all equal.
pub fn d_agostino(statistics: &Statistics) -> Result<Test, Missing> {
    if statistics.count < MIN_TESTED_VALUES {
        return Err(Missing::TooFew(MIN_TESTED_VALUES));
    }
    let n = statistics.count as f64;
    let (a, b) = (skewness_score(statistics.skewness?, n), kurtosis_score(statistics.kurtosis?, n));
    let statistic = a * a + b * b;
    Ok(Test { statistic, p: libm::exp(-0.5 * statistic), count: statistics.count })
}

fn skewness_score(skewness: f64, n: f64) -> f64 {
    let y = skewness * ((n + 1.0) * (n + 3.0) / (6.0 * (n - 2.0))).sqrt();
    let beta = 3.0 * (n * n + 27.0 * n - 70.0) / ((n - 2.0) * (n + 5.0)) * ((n + 1.0) * (n + 3.0))
        / ((n + 7.0) * (n + 9.0));
    let w2 = (2.0 * (beta - 1.0)).sqrt() - 1.0;
    libm::asinh(y / (2.0 / (w2 - 1.0)).sqrt()) / (0.5 * libm::log(w2)).sqrt()
}

fn kurtosis_score(excess: f64, n: f64) -> f64 {
    let expected = 3.0 * (n - 1.0) / (n + 1.0);
    let variance = 24.0 * n / (n + 1.0) * ((n - 2.0) / (n + 1.0)) * ((n - 3.0) / ((n + 3.0) * (n + 5.0)));
    let x = (excess + 3.0 - expected) / variance.sqrt();
    let skew = 6.0 * (n * n - 5.0 * n + 2.0) / ((n + 7.0) * (n + 9.0))
        * (6.0 * (n + 3.0) / n * (n + 5.0) / ((n - 2.0) * (n - 3.0))).sqrt();
    let a = 6.0 + 8.0 / skew * (2.0 / skew + (1.0 + 4.0 / (skew * skew)).sqrt());
    let spread = 1.0 + x * (2.0 / (a - 4.0)).sqrt();
    let root = libm::cbrt((1.0 - 2.0 / a) / spread);
    (1.0 - 2.0 / (9.0 * a) - root) / (2.0 / (9.0 * a)).sqrt()
}

/// Anderson and Darling's test for a normal distribution of unknown mean and spread, on at most `size` of the values.
///
/// p value by D'Agostino and Stephens, Goodness-of-fit techniques (1986), table 4.9; 0 where it is below 10^-30.
///
/// # Errors
/// Fewer than 20 values, or all equal.
pub fn anderson_darling(values: &[f64], size: usize, seed: u64) -> Result<Test, Missing> {
    let (_, mut sample) = super::subsample(values, size, seed);
    if sample.len() < MIN_TESTED_VALUES as usize {
        return Err(Missing::TooFew(MIN_TESTED_VALUES));
    }
    let statistics = Summary::of(&sample).all;
    let (mean, std_dev) = (statistics.mean?, statistics.std_dev?);
    if std_dev == 0.0 {
        return Err(Missing::NoSpread);
    }
    sample.sort_unstable_by(f64::total_cmp);
    let n = sample.len() as f64;
    // Beyond 37 σ the share underflows; there the statistic is far past any doubt.
    let log_below = |z: f64| libm::log(normal_below(z).max(f64::MIN_POSITIVE));
    let terms = sample.iter().zip(sample.iter().rev()).enumerate().map(|(i, (low, high))| {
        (2 * i + 1) as f64 * (log_below((low - mean) / std_dev) + log_below((mean - high) / std_dev))
    });
    let statistic = -n - terms.sum::<f64>() / n;
    let a = statistic * (1.0 + 0.75 / n + 2.25 / (n * n));
    let p = match a {
        _ if a >= 13.0 => 0.0,
        _ if a >= 0.6 => libm::exp(1.2937 - 5.709 * a + 0.0186 * a * a),
        _ if a >= 0.34 => libm::exp(0.9177 - 4.279 * a - 1.38 * a * a),
        _ if a >= 0.2 => 1.0 - libm::exp(-8.318 + 42.796 * a - 59.938 * a * a),
        _ => 1.0 - libm::exp(-13.436 + 101.14 * a - 223.73 * a * a),
    };
    Ok(Test { statistic, p, count: sample.len() as u64 })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Expected: SciPy 1.17 `normaltest`, `anderson`; statsmodels `normal_ad` for its p value.
    #[test]
    fn equals_scipy() {
        let logistic: Vec<f64> = (0..400)
            .map(|i| {
                let u = (f64::from(i) + 0.5) / 400.0;
                0.5 * (u / (1.0 - u)).ln() + 0.1
            })
            .collect();
        let uniform: Vec<f64> = (0..1000).map(|i| f64::from((i * 7919) % 10007) / 1000.0 - 3.3).collect();
        let expected = [
            (logistic, 8.244004827091393, 0.016212018751951024, 0.5759081788217486, 0.13389462719443881),
            (uniform, 730.2896783017451, 2.6279146822043225e-159, 11.056747776730049, 1.307031496748761e-26),
        ];
        for (values, k2, k2_p, a2, a2_p) in expected {
            let found = d_agostino(&Summary::of(&values).all).unwrap();
            assert!(
                (found.statistic / k2 - 1.0).abs() < 1e-11 && (found.p / k2_p - 1.0).abs() < 1e-8,
                "{found:?}"
            );
            let found = anderson_darling(&values, 5000, 1).unwrap();
            assert!(
                (found.statistic / a2 - 1.0).abs() < 1e-11 && (found.p / a2_p - 1.0).abs() < 1e-9,
                "{found:?}"
            );
        }
    }

    #[test]
    fn needs_values_with_a_spread() {
        let few = d_agostino(&Summary::of(&[1.0, 2.0]).all);
        assert_eq!(few, Err(Missing::TooFew(20)));
        assert_eq!(anderson_darling(&[1.0; 30], 100, 1), Err(Missing::NoSpread));
        assert_eq!(anderson_darling(&[f64::NAN; 30], 100, 1), Err(Missing::TooFew(20)));
        let mut far = vec![0.0; 100];
        far.extend([1.0, -1.0, 1e9]);
        assert_eq!(anderson_darling(&far, 1000, 1).unwrap().p, 0.0);
        assert_eq!(
            anderson_darling(&far, 50, 3).map(|t| t.count),
            anderson_darling(&far, 50, 3).map(|t| t.count)
        );
    }
}
