//! How verdicts are reached.

use super::checker::Checker;
use super::error::PlanError;
use super::text::{DecisionText, PlanText, RuleWord};

/// How verdicts are reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decision {
    /// The rule.
    pub rule: Rule,
    /// Expanded uncertainty of values that have none of their own, millimeters (degrees for angles).
    pub uncertainty: Option<f64>,
    /// The noise of the measured points, from which uncertainties are found.
    pub noise: Option<Noise>,
}

/// The noise of measured points, and how often it is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Standard deviation of each coordinate, millimeters.
    pub deviation: f64,
    /// Length within which points move together, millimeters; 0 where each moves alone.
    pub correlation: f64,
    /// Number of draws.
    pub draws: u32,
}

/// Draws of the noise, where the plan does not say: the standard deviation is then known to 5 %.
const DRAWS: u32 = 200;
/// Draws at most.
const MOST_DRAWS: u32 = 100_000;

/// A decision rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// The value alone decides.
    Simple,
    /// ISO 14253-1:2017: conformity is proven where the value is within the limits by the expanded uncertainty,
    /// non-conformity where it is beyond them by it.
    Iso14253,
}

impl Rule {
    /// The word for it.
    pub fn word(self) -> &'static str {
        match self {
            Rule::Simple => "simple",
            Rule::Iso14253 => "iso14253-1",
        }
    }
}

pub(super) fn decision(checker: &Checker, written: &PlanText) -> Result<Decision, PlanError> {
    let Some(written) = &written.decision else {
        return Ok(Decision { rule: Rule::Simple, uncertainty: None, noise: None });
    };
    let rule = match written.rule.value {
        RuleWord::Simple => Rule::Simple,
        RuleWord::Iso14253 => Rule::Iso14253,
    };
    let uncertainty = match &written.uncertainty {
        Some(u) => Some(checker.not_negative(u, "the uncertainty")?),
        None => None,
    };
    Ok(Decision { rule, uncertainty, noise: noise(checker, written)? })
}

fn noise(checker: &Checker, written: &DecisionText) -> Result<Option<Noise>, PlanError> {
    let Some(deviation) = &written.noise else {
        let alone = written.correlation.as_ref().map(|c| &c.span).or(written.draws.as_ref().map(|d| &d.span));
        return match alone {
            Some(span) => {
                checker.wrong(span, "this belongs to `noise`, the standard deviation of a point; give it")
            }
            None => Ok(None),
        };
    };
    let sigma = checker.not_negative(deviation, "the noise")?;
    let correlation = match &written.correlation {
        Some(length) => checker.not_negative(length, "the correlation length")?,
        None => 0.0,
    };
    let draws = match &written.draws {
        None => DRAWS,
        Some(draws) if (10..=MOST_DRAWS).contains(&draws.value) => draws.value,
        Some(draws) => {
            let what = format!("draws is {}; it is from 10 to {MOST_DRAWS}", draws.value);
            return checker.wrong(&draws.span, what);
        }
    };
    Ok(Some(Noise { deviation: sigma, correlation, draws }))
}
