//! How verdicts are reached.

use super::checker::Checker;
use super::error::PlanError;
use super::text::{PlanText, RuleWord};

/// How verdicts are reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decision {
    /// The rule.
    pub rule: Rule,
    /// Expanded uncertainty of values that have none of their own, millimetres (degrees for angles).
    pub uncertainty: Option<f64>,
}

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
        return Ok(Decision { rule: Rule::Simple, uncertainty: None });
    };
    let rule = match written.rule.value {
        RuleWord::Simple => Rule::Simple,
        RuleWord::Iso14253 => Rule::Iso14253,
    };
    let uncertainty = match &written.uncertainty {
        Some(u) => Some(checker.not_negative(u, "the uncertainty")?),
        None => None,
    };
    Ok(Decision { rule, uncertainty })
}
