//! A process seen through the values of its parts, in their order: control limits and capability.
//!
//! Individuals and moving ranges of two (ISO 7870-2:2013). The spread within is the mean moving range over `d₂ = 2/√π`, and the
//! limits lie three of it from the mean. Capability (ISO 22514-2:2017): the tolerance over six spreads, by the spread within
//! (Cp, Cpk) and by the standard deviation of all values (Pp, Ppk).

use crate::num::special::{chi_square_quantile, normal_quantile};
use std::f64::consts::{FRAC_2_SQRT_PI, PI};

/// Mean range of two normal values of standard deviation 1: d₂ of the control charts.
const MEAN_RANGE_OF_TWO: f64 = FRAC_2_SQRT_PI;
/// Values in a row on one side of the mean that are no chance.
const MIN_RUN: usize = 9;
/// Values in a row, each above (below) the one before, that are no chance.
const MIN_TREND: usize = 6;

/// A series of values as a control chart shows it.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlChart {
    /// Number of values.
    pub count: usize,
    /// Their mean.
    pub mean: f64,
    /// Least value.
    pub min: f64,
    /// Greatest value.
    pub max: f64,
    /// Standard deviation of all values.
    pub std_dev: f64,
    /// Mean of the differences of neighbors, without their signs.
    pub moving_range: f64,
    /// Standard deviation by the moving ranges: what is left of slow changes.
    pub within: f64,
    /// Lower and upper control limit of values.
    pub limits: [f64; 2],
    /// Upper control limit of moving ranges.
    pub range_limit: f64,
    /// Values that are out of control, in their order.
    pub signals: Vec<Signal>,
}

/// A value that is out of control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Signal {
    /// Index of the value.
    pub index: usize,
    /// By which rule.
    pub rule: Rule,
}

/// Events that chance seldom makes (ISO 7870-2:2013; L. S. Nelson, Journal of Quality Technology 16, 1984, tests 1 to 3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// The value is beyond a control limit.
    Beyond,
    /// Its distance from the value before is beyond the limit of moving ranges.
    Range,
    /// It is the ninth or a later one in a row on one side of the mean.
    Run,
    /// It is the sixth or a later one in a row of rising, or of falling values.
    Steady,
}

/// An index of capability with the limits of its two-sided confidence interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Index {
    /// The estimate.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// Share of the greatest value up to which values that differ by less do not vary: their last digits tell rounding.
const EQUAL_VALUES_SHARE: f64 = 1e-9;

/// Capability of a process; `None` where limits are missing, or nothing varies.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Capability {
    /// Tolerance over six spreads within; of two limits only.
    pub cp: Option<Index>,
    /// Distance of the mean from the nearer limit over three spreads within.
    pub cpk: Option<Index>,
    /// As `cp`, by the standard deviation of all values.
    pub pp: Option<Index>,
    /// As `cpk`, by the standard deviation of all values.
    pub ppk: Option<Index>,
}

impl ControlChart {
    /// The chart of `values` in the order of their making; `None` of fewer than two, or where one is not finite.
    ///
    /// ```
    /// use trueness_geom::stats::process::ControlChart;
    /// let chart = ControlChart::of(&[1.0, 3.0, 2.0, 2.0]).unwrap();
    /// assert_eq!((chart.mean, chart.moving_range), (2.0, 1.0));
    /// // Three spreads within, each √π/2 of the mean moving range.
    /// assert!((chart.limits[1] - 2.0 - 1.5 * std::f64::consts::PI.sqrt()).abs() < 1e-15);
    /// ```
    pub fn of(values: &[f64]) -> Option<ControlChart> {
        if values.len() < 2 || values.iter().any(|x| !x.is_finite()) {
            return None;
        }
        let n = values.len() as f64;
        let greatest = values.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let all_alike = vec![values[0]; values.len()];
        let alike = values.iter().all(|x| (x - values[0]).abs() <= EQUAL_VALUES_SHARE * greatest);
        let values = if alike { &all_alike[..] } else { values };
        // From the first value on: no digit is lost where all are alike.
        let first = values[0];
        let mean = first + values.iter().map(|x| x - first).sum::<f64>() / n;
        let std_dev = (values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0)).sqrt();
        let ranges: Vec<f64> = values.windows(2).map(|w| (w[1] - w[0]).abs()).collect();
        let moving_range = ranges.iter().sum::<f64>() / (n - 1.0);
        let within = moving_range / MEAN_RANGE_OF_TWO;
        // The standard deviation of a range of two is √(2 − 4/π).
        let range_limit = moving_range * (1.0 + 3.0 * (2.0 - 4.0 / PI).sqrt() / MEAN_RANGE_OF_TWO);
        let mut chart = ControlChart {
            count: values.len(),
            mean,
            min: values.iter().copied().fold(f64::INFINITY, f64::min),
            max: values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            std_dev,
            moving_range,
            within,
            limits: [mean - 3.0 * within, mean + 3.0 * within],
            range_limit,
            signals: vec![],
        };
        chart.signals = chart.signaled(values, &ranges);
        Some(chart)
    }

    fn signaled(&self, values: &[f64], ranges: &[f64]) -> Vec<Signal> {
        let mut signals = Vec::new();
        let (mut run, mut steady) = ((0.0, 0), (0.0, 1));
        let extended = |row: (f64, usize), way: f64| if way != 0.0 && way == row.0 { row.1 + 1 } else { 1 };
        let sign = |x: f64| if x == 0.0 { 0.0 } else { x.signum() };
        for (index, x) in values.iter().enumerate() {
            let side = sign(x - self.mean);
            run = (side, if side == 0.0 { 0 } else { extended(run, side) });
            if index > 0 {
                let way = sign(x - values[index - 1]);
                // Two values make the first rise.
                steady = (way, if way == 0.0 { 1 } else { extended(steady, way).max(2) });
            }
            let rules = [
                (Rule::Beyond, *x < self.limits[0] || *x > self.limits[1]),
                (Rule::Range, index > 0 && ranges[index - 1] > self.range_limit),
                (Rule::Run, run.1 >= MIN_RUN),
                (Rule::Steady, steady.1 >= MIN_TREND),
            ];
            signals.extend(rules.into_iter().filter(|r| r.1).map(|(rule, _)| Signal { index, rule }));
        }
        signals
    }

    /// Its capability against limits, with intervals of this confidence (0.95: 95 %).
    ///
    /// The intervals take the values for normal and independent. The intervals of Cp and Pp are exact for the variance's χ²
    /// distribution (ISO 22514-2:2017). The spread within counts for 0.605 of its degrees of freedom (J. D. Cryer and T. P.
    /// Ryan, Journal of Quality Technology 22, 1990). The intervals of Cpk and Ppk are the normal approximation of A. F.
    /// Bissell (Applied Statistics 39, 1990).
    pub fn capability(&self, lower: Option<f64>, upper: Option<f64>, confidence: f64) -> Capability {
        let freedom = self.count as f64 - 1.0;
        let by = |spread: f64, freedom: f64| -> (Option<Index>, Option<Index>) {
            let spread = Some(spread).filter(|s| *s > 0.0);
            let both = lower.zip(upper).map(|(l, u)| u - l);
            let nearest = [lower.map(|l| self.mean - l), upper.map(|u| u - self.mean)];
            let nearest = nearest.into_iter().flatten().min_by(f64::total_cmp);
            let wide = both.zip(spread).map(|(width, s)| wide(width / (6.0 * s), freedom, confidence));
            let near = nearest
                .zip(spread)
                .map(|(room, s)| index_of_mean(room / (3.0 * s), self.count, freedom, confidence));
            (wide, near)
        };
        let ((cp, cpk), (pp, ppk)) = (by(self.within, 0.605 * freedom), by(self.std_dev, freedom));
        Capability { cp, cpk, pp, ppk }
    }
}

/// An index of the spread alone.
fn wide(value: f64, freedom: f64, confidence: f64) -> Index {
    let part = |share: f64| (chi_square_quantile(share, freedom) / freedom).sqrt();
    let tail = 0.5 * (1.0 - confidence);
    Index { value, low: value * part(tail), high: value * part(1.0 - tail) }
}

/// An index of spread and mean.
fn index_of_mean(value: f64, count: usize, freedom: f64, confidence: f64) -> Index {
    let z = normal_quantile(0.5 + 0.5 * confidence);
    let half = z * (1.0 / (9.0 * count as f64) + value * value / (2.0 * freedom)).sqrt();
    Index { value, low: value - half, high: value + half }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Digits that rounding alone makes differ are no spread: nothing is out of control, and there are no indices of it.
    #[test]
    fn rounding_is_no_spread() {
        let value: f64 = 17.007302258104104;
        let chart = ControlChart::of(&[value, value, value.next_up(), value.next_down()]).unwrap();
        assert_eq!((chart.std_dev, chart.within, chart.mean), (0.0, 0.0, value));
        assert!(chart.signals.is_empty());
        assert!(ControlChart::of(&[17.0, 17.0 + 1e-6]).unwrap().std_dev > 0.0);
    }
}
