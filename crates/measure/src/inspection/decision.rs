//! From a value and its limits to a verdict.

use crate::plan::Rule;
use crate::requirement::Limits;
use trueness_document::Verdict;

/// The verdict on `value`, where the true one lies no more than `u` below and above it.
///
/// `simple`: the limits belong to what is allowed, the uncertainty is not looked at. `iso14253-1` (ISO 14253-1:2017, 5):
/// conformity is proven where all of that interval lies within the limits, non-conformity where all of it lies beyond
/// one; between them nothing is decided, nor is anything where `u` is not known. Where the interval does not hold the value (`u` is
/// negative to one side), the value must be on the same side of the limits: no value beyond a limit passes, and none within them fails.
pub fn verdict(value: f64, limits: &Limits, rule: Rule, u: Option<[f64; 2]>) -> Verdict {
    let (lower, upper) = limits.range();
    let [from_lower, to_upper] = [lower.map_or(f64::INFINITY, |l| value - l), upper - value];
    let [below, above] = match rule {
        Rule::Simple => [0.0; 2],
        Rule::Iso14253 => u.map_or([f64::INFINITY; 2], |sides| sides.map(|s| s.max(0.0))),
    };
    if from_lower >= below && to_upper >= above {
        Verdict::Pass
    } else if from_lower < -above || to_upper < -below {
        Verdict::Fail
    } else {
        Verdict::Undecided
    }
}

/// Share of what is allowed that the value takes up: 1 at a limit.
pub fn utilization(value: f64, limits: &Limits) -> Option<f64> {
    let share = match *limits {
        // A bonus below zero may leave nothing: then there is no share of it.
        Limits::Greatest(t) if t < 0.0 => f64::INFINITY,
        Limits::Greatest(t) => value / t,
        Limits::Between { nominal, lower, upper } => {
            let middle = nominal + 0.5 * (lower + upper);
            (value - middle).abs() / (0.5 * (upper - lower))
        }
    };
    share.is_finite().then_some(share)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_known_decides_nothing() {
        let limits = Limits::Greatest(0.05);
        for value in [0.0, 0.05, 1e9] {
            assert_eq!(verdict(value, &limits, Rule::Iso14253, None), Verdict::Undecided);
            assert_eq!(verdict(value, &limits, Rule::Iso14253, Some([f64::INFINITY; 2])), Verdict::Undecided);
        }
        assert_eq!(verdict(0.04, &limits, Rule::Iso14253, Some([0.01; 2])), Verdict::Pass);
    }

    #[test]
    fn a_limit_belongs_to_what_is_allowed() {
        let limits = Limits::Greatest(0.05);
        let simple = |v| verdict(v, &limits, Rule::Simple, Some([1.0; 2]));
        assert_eq!(
            [simple(0.0), simple(0.05), simple(0.0501)],
            [Verdict::Pass, Verdict::Pass, Verdict::Fail]
        );
        let size = Limits::Between { nominal: 12.0, lower: -0.1, upper: 0.2 };
        let simple = |v| verdict(v, &size, Rule::Simple, None);
        assert_eq!(
            [simple(11.95), simple(12.2), simple(11.8)],
            [Verdict::Pass, Verdict::Pass, Verdict::Fail]
        );
        assert_eq!(utilization(12.2, &size).map(|u| (u * 1e9).round()), Some(1e9));
        assert_eq!(utilization(0.0, &Limits::Greatest(0.0)), None);
    }

    #[test]
    fn near_a_limit_nothing_is_decided() {
        let limits = Limits::Between { nominal: 10.0, lower: -0.5, upper: 0.5 };
        let at = |v| verdict(v, &limits, Rule::Iso14253, Some([0.125; 2]));
        use Verdict::{Fail, Pass, Undecided};
        assert_eq!([at(10.375), at(10.4), at(10.625), at(10.626)], [Pass, Undecided, Undecided, Fail]);
        assert_eq!([at(9.625), at(9.6), at(9.375), at(9.374)], [Pass, Undecided, Undecided, Fail]);
    }

    #[test]
    fn each_side_has_its_own_uncertainty() {
        use Verdict::{Fail, Pass, Undecided};
        let form = |v| verdict(v, &Limits::Greatest(1.0), Rule::Iso14253, Some([0.5, 0.125]));
        assert_eq!([form(0.875), form(0.9), form(1.5), form(1.51)], [Pass, Undecided, Undecided, Fail]);
        // The true value is known to lie below the measured one: that one has to keep the limit as well.
        let below = |v| verdict(v, &Limits::Greatest(1.0), Rule::Iso14253, Some([0.5, -0.25]));
        assert_eq!([below(0.99), below(1.0), below(1.2), below(1.51)], [Pass, Pass, Undecided, Fail]);
        let limits = Limits::Between { nominal: 10.0, lower: -1.0, upper: 1.0 };
        let bore = |v| verdict(v, &limits, Rule::Iso14253, Some([0.125, 0.5]));
        assert_eq!([bore(10.5), bore(10.6), bore(11.125), bore(11.2)], [Pass, Undecided, Undecided, Fail]);
        assert_eq!([bore(9.125), bore(9.1), bore(8.5), bore(8.4)], [Pass, Undecided, Undecided, Fail]);
    }
}
