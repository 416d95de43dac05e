//! How verdicts are reached.

use super::checker::Checker;
use crate::noise::{NoSharedNoise, NoiseOrReason};
use trueness_document::plan::{At, DecisionText, NoiseText, NoiseWord, PlanError, PlanText, RuleWord};

/// How verdicts are reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decision {
    /// The rule.
    pub rule: Rule,
    /// Expanded uncertainty of values that have none of their own, millimeters (degrees for angles).
    pub uncertainty: Option<f64>,
    /// The noise of the measured points, from which uncertainties are found.
    pub noise: Option<NoiseSource>,
}

/// Where the noise of measured points comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoiseSource {
    /// The plan states it.
    Stated(Noise),
    /// It is found in what was measured.
    Measured {
        /// Number of draws.
        draws: u32,
    },
}

impl NoiseSource {
    /// The noise, where this was found in what was measured.
    ///
    /// # Errors
    /// Why nothing was found there.
    pub fn noise<'a>(&self, found: &'a NoiseOrReason) -> Result<Noise, &'a NoSharedNoise> {
        match (self, found) {
            (NoiseSource::Stated(noise), _) => Ok(*noise),
            (NoiseSource::Measured { draws }, Ok(found)) => Ok(Noise {
                deviation: found.deviation,
                correlation: CELL_PER_REACH * found.reach,
                white: found.white,
                draws: *draws,
            }),
            (NoiseSource::Measured { .. }, Err(why)) => Err(why),
        }
    }
}

/// The noise of measured points, and how often it is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Standard deviation of each coordinate, millimeters.
    pub deviation: f64,
    /// Length within which points move together, millimeters; 0 where each moves alone.
    pub correlation: f64,
    /// Share of the variance that each point has alone nevertheless.
    pub white: f64,
    /// Number of draws.
    pub draws: u32,
}

/// Draws of the noise, where the plan does not say: the standard deviation is then known to 5 %.
const DEFAULT_DRAWS: u32 = 200;
/// Cells of noise that is interpolated between their corners, in reaches of the noise found: along planes of any attitude their correlations then
/// add up to those found, within a tenth.
const CELL_PER_REACH: f64 = 0.43;
/// Draws at most.
const MAX_DRAWS: u32 = 100_000;

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

fn noise(checker: &Checker, written: &DecisionText) -> Result<Option<NoiseSource>, PlanError> {
    let Some(deviation) = &written.noise else {
        let alone = written.correlation.as_ref().map(|c| &c.span).or(written.draws.as_ref().map(|d| &d.span));
        return match alone {
            Some(span) => {
                checker.wrong(span, "this belongs to `noise`, the standard deviation of a point; give it")
            }
            None => Ok(None),
        };
    };
    let draws = match &written.draws {
        None => DEFAULT_DRAWS,
        Some(draws) if (10..=MAX_DRAWS).contains(&draws.value) => draws.value,
        Some(draws) => {
            let what = format!("draws is {}; it is from 10 to {MAX_DRAWS}", draws.value);
            return checker.wrong(&draws.span, what);
        }
    };
    let sigma = match (&deviation.value, &written.correlation) {
        (NoiseText::Deviation(sigma), _) => At { value: *sigma, span: deviation.span.clone() },
        (NoiseText::Word(NoiseWord::Measured), None) => return Ok(Some(NoiseSource::Measured { draws })),
        (NoiseText::Word(NoiseWord::Measured), Some(length)) => {
            return checker.wrong(
                &length.span,
                "the noise is measured, and how far points move together with it; remove this",
            );
        }
    };
    let deviation = checker.not_negative(&sigma, "the noise")?;
    let correlation = match &written.correlation {
        Some(length) => checker.not_negative(length, "the correlation length")?,
        None => 0.0,
    };
    Ok(Some(NoiseSource::Stated(Noise { deviation, correlation, white: 0.0, draws })))
}
