//! What a plan asks of the deviations from the reference.

use super::checker::Checker;
use super::error::PlanError;
use super::text::PlanText;
use crate::tolerance::Tolerance;

/// What is asked of the deviations. Lengths in millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// The zone that they must keep; without it they are told and not judged.
    pub tolerance: Option<Tolerance>,
    /// Share of the points that must lie within it, 0 to 1.
    pub required_share: f64,
    /// Points farther away are left out; infinite without a limit.
    pub max_distance: f64,
    /// Whether points nearest to a free edge of the reference are left out.
    pub skip_boundary: bool,
}

pub(super) fn deviation(checker: &Checker, plan: &PlanText) -> Result<Option<Deviation>, PlanError> {
    let Some(at) = &plan.deviation else { return Ok(None) };
    if plan.measured.is_none() || plan.reference.is_none() {
        return checker.wrong(&at.span, "[deviation] needs `measured` and `reference`");
    }
    let written = &at.value;
    let tolerance = match &written.tolerance {
        None => None,
        Some(zone) => {
            let [lower, upper] = zone.value.map(|x| x * checker.unit);
            if !(lower.is_finite() && upper.is_finite() && lower <= upper) {
                let what = "the tolerance is [least, greatest] allowed deviation, as in [-0.1, 0.1]";
                return checker.wrong(&zone.span, what);
            }
            Some(Tolerance { lower, upper })
        }
    };
    let required_share = match (&written.inside, tolerance) {
        (None, _) => 1.0,
        (Some(share), None) => {
            return checker
                .wrong(&share.span, "`inside` says how many points must keep a `tolerance`; give one");
        }
        (Some(share), _) if !(0.0..=100.0).contains(&share.value) => {
            return checker
                .wrong(&share.span, format!("inside is {}; a share is from 0 to 100 percent", share.value));
        }
        (Some(share), _) => share.value / 100.0,
    };
    let max_distance = match &written.max_distance {
        None => f64::INFINITY,
        Some(d) => checker.not_negative(d, "max_distance")?,
    };
    Ok(Some(Deviation { tolerance, required_share, max_distance, skip_boundary: written.skip_boundary }))
}
