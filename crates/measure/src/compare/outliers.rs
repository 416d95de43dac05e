//! Outliers by a stated rule: their limits are known only when all points have been measured.

use std::fmt;
use std::str::FromStr;
use trueness_geom::stats::SIGMA_OVER_MAD;
use trueness_geom::stats::statistics::{Missing, Statistics};

/// Which deviations are outliers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OutlierRule {
    /// Farther from the mean than so many standard deviations.
    Sigma(f64),
    /// Farther from the median than so many times 1.4826 MAD, which of a normal distribution is its σ. A few wild points move
    /// neither median nor MAD.
    Mad(f64),
}

/// The limits that a rule gives; they belong to what counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutlierLimits {
    /// Mean or median, millimeters.
    pub center: f64,
    /// Standard deviation, or 1.4826 MAD, millimeters.
    pub spread: f64,
    /// Least deviation that counts, millimeters.
    pub lower: f64,
    /// Greatest deviation that counts, millimeters.
    pub upper: f64,
}

/// Why a rule gives no limits.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NoLimits {
    /// The statistics that it rests on do not exist.
    #[error("{0}")]
    Missing(#[from] Missing),
    /// The values have no spread, or more than half of them are equal.
    #[error("the {0} of the deviations is 0, so no point is left out")]
    NoSpread(&'static str),
}

impl OutlierRule {
    /// The limits for deviations of these statistics.
    ///
    /// # Errors
    /// See [`NoLimits`].
    pub fn limits(self, all: &Statistics) -> Result<OutlierLimits, NoLimits> {
        let (center, spread, times, name) = match self {
            OutlierRule::Sigma(times) => (all.mean, all.std_dev, times, "standard deviation"),
            OutlierRule::Mad(times) => (all.median, all.mad.map(|m| SIGMA_OVER_MAD * m), times, "MAD"),
        };
        let (center, spread) = (center?, spread?);
        if spread > 0.0 {
            let reach = times * spread;
            Ok(OutlierLimits { center, spread, lower: center - reach, upper: center + reach })
        } else {
            Err(NoLimits::NoSpread(name))
        }
    }
}

/// A text that is no rule for outliers.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoRule {
    /// It names none.
    #[error(
        "‘{text}’ is no rule for outliers; write mad:5 (from the median, which outliers do not move) or 3sigma (from the mean)"
    )]
    Unknown {
        /// As written.
        text: String,
    },
    /// Its number is none, or not above 0.
    #[error("‘{text}’: how many is a number above 0, as in mad:5 or 3sigma")]
    Number {
        /// As written.
        text: String,
    },
}

/// `mad:K` or `Ksigma`.
///
/// # Errors
/// [`NoRule`], whatever else is written.
///
/// ```
/// use trueness_measure::compare::OutlierRule;
/// assert_eq!("mad:5".parse(), Ok(OutlierRule::Mad(5.0)));
/// assert!("5".parse::<OutlierRule>().is_err());
/// ```
impl FromStr for OutlierRule {
    type Err = NoRule;
    fn from_str(text: &str) -> Result<OutlierRule, NoRule> {
        let lower = text.trim().to_lowercase();
        let rule: fn(f64) -> OutlierRule;
        let number = match (lower.strip_prefix("mad:"), lower.strip_suffix("sigma")) {
            (Some(k), _) => {
                rule = OutlierRule::Mad;
                k
            }
            (None, Some(k)) => {
                rule = OutlierRule::Sigma;
                k
            }
            (None, None) => {
                return Err(NoRule::Unknown { text: text.into() });
            }
        };
        match number.trim().parse::<f64>() {
            Ok(k) if k > 0.0 && k.is_finite() => Ok(rule(k)),
            _ => Err(NoRule::Number { text: text.into() }),
        }
    }
}

impl fmt::Display for OutlierRule {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            OutlierRule::Sigma(k) => write!(f, "{k}sigma"),
            OutlierRule::Mad(k) => write!(f, "mad:{k}"),
        }
    }
}

/// A rule for outliers and its limits, or why it left out nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outliers {
    /// As asked for.
    pub rule: OutlierRule,
    /// What it gave.
    pub limits: Result<OutlierLimits, NoLimits>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_geom::stats::statistics::Summary;

    #[test]
    fn rules_there_and_back() {
        for word in ["3sigma", "2.5sigma", "mad:5", "mad:3.5"] {
            assert_eq!(word.parse::<OutlierRule>().unwrap().to_string(), word);
        }
        for bad in ["", "sigma", "mad", "mad:", "mad:0", "mad:-3", "3", "infsigma", "nansigma", "iqr:1.5"] {
            assert!(bad.parse::<OutlierRule>().is_err(), "{bad}");
        }
    }

    #[test]
    fn limits_in_closed_form() {
        // 0, 1, …, 100: mean and median 50, s² = 101·102/12, MAD 25.
        let values: Vec<f64> = (0..=100).map(f64::from).collect();
        let all = Summary::of(&values).all;
        let sigma = OutlierRule::Sigma(3.0).limits(&all).unwrap();
        let s = (101.0 * 102.0 / 12.0f64).sqrt();
        assert!((sigma.spread - s).abs() < 1e-12 && (sigma.upper - 50.0 - 3.0 * s).abs() < 1e-12);
        let mad = OutlierRule::Mad(2.0).limits(&all).unwrap();
        assert!((mad.spread - 25.0 * 1.482_602_218_505_602).abs() < 1e-12);
        assert!((mad.lower - 50.0 + 50.0 * 1.482_602_218_505_602).abs() < 1e-12);
        // One wild value: the mean's rule moves far, the median's does not.
        let wild = Summary::of(&[&values[..], &[1e6]].concat()).all;
        assert!(OutlierRule::Sigma(3.0).limits(&wild).unwrap().upper > 1e5);
        assert!(OutlierRule::Mad(2.0).limits(&wild).unwrap().upper < 130.0);
        let level = Summary::of(&[1.0, 1.0, 1.0, 7.0]).all;
        assert!(OutlierRule::Mad(3.0).limits(&level).is_err_and(|e| e.to_string().contains("is 0")));
        assert!(OutlierRule::Sigma(3.0).limits(&Summary::of(&[1.0]).all).is_err());
    }
}
