//! What a plan asks of the deviations from the reference.

use super::checker::Checker;
use super::tolerance_region::{ToleranceRegion, regions, share, zone};
use crate::compare::{AlongRule, Coverage, MIN_COVERAGE, NoDirection, NoRule, OutlierRule};
use crate::requirement::Feature;
use trueness_document::plan::{AlongText, CoverageText, DeviationText, PlanError, PlanText};
use trueness_document::tolerance::{Tolerance, cannot_fail};

/// What is asked of the deviations. Lengths in millimeters.
#[derive(Clone, Debug, PartialEq)]
pub struct Deviation {
    /// The zone that they must keep; without it they are told and not judged.
    pub tolerance: Option<Tolerance>,
    /// Parts of the reference with tolerances of their own.
    pub regions: Vec<ToleranceRegion>,
    /// Share of the points that must lie within it, 0 to 1.
    pub required_share: f64,
    /// Points farther away are left out; infinite without a limit.
    pub max_distance: f64,
    /// Whether points nearest to a boundary edge of the reference are left out.
    pub skip_boundary: bool,
    /// Along what lines they are measured; to the nearest place without.
    pub along: Option<AlongRule>,
    /// Points whose normals turn away from the reference's by more than this are left out, radians.
    pub facing: Option<f64>,
    /// Which points are outliers, and left out.
    pub outliers: Option<OutlierRule>,
    /// Within what distance a point covers the reference, where that is asked.
    pub coverage: Option<Coverage>,
    /// Share of the reference that the points must cover for a pass, 0 to 1.
    pub min_coverage: f64,
}

impl Deviation {
    /// The key that needs the normals of the measured points, if one does.
    pub fn needs_normals(&self) -> Option<&'static str> {
        match (self.facing, self.along) {
            (Some(_), _) => Some("`facing`"),
            (_, Some(AlongRule::Measured)) => Some("`along`"),
            _ => None,
        }
    }
}

pub(super) fn deviation(
    checker: &Checker,
    plan: &PlanText,
    features: &[Feature],
) -> Result<Option<Deviation>, PlanError> {
    let Some(at) = &plan.deviation else { return Ok(None) };
    if plan.measured.is_none() || plan.reference.is_none() {
        return checker.wrong(&at.span, "[deviation] needs `measured` and `reference`");
    }
    let written = &at.value;
    let tolerance = match &written.tolerance {
        None => None,
        Some(written) => Some(zone(checker, written)?),
    };
    let required_share = match (&written.inside, tolerance) {
        (None, _) => 1.0,
        (Some(share), None) => {
            return checker
                .wrong(&share.span, "`inside` says how many points must keep a `tolerance`; give one");
        }
        (Some(written), _) => share(checker, written, "inside")?,
    };
    let max_distance = match &written.max_distance {
        None => f64::INFINITY,
        Some(d) => checker.not_negative(d, "max_distance")?,
    };
    let regions = regions(checker, &written.region, features)?;
    if let Some(d) = &written.max_distance {
        let zones = tolerance.into_iter().chain(regions.iter().map(|r| r.rule.tolerance));
        if let Some(why) = cannot_fail(max_distance, zones) {
            return checker.wrong(&d.span, format!("max_distance is {}: {why}", d.value));
        }
    }
    Ok(Some(Deviation {
        tolerance,
        regions,
        required_share,
        max_distance,
        skip_boundary: written.skip_boundary,
        along: along(checker, written)?,
        facing: facing(checker, written)?,
        outliers: match &written.outliers {
            None => None,
            Some(rule) => match rule.value.parse() {
                Ok(parsed) => Some(parsed),
                Err(e) => return checker.wrong(&rule.span, NoRule::to_string(&e)),
            },
        },
        coverage: coverage(checker, written)?,
        min_coverage: match &written.min_coverage {
            None => MIN_COVERAGE,
            Some(written) => share(checker, written, "min_coverage")?,
        },
    }))
}

fn along(checker: &Checker, written: &DeviationText) -> Result<Option<AlongRule>, PlanError> {
    let Some(at) = &written.along else { return Ok(None) };
    let found = match &at.value {
        AlongText::Direction(d) => AlongRule::direction(*d),
        AlongText::Word(word) => match word.as_str() {
            "reference" => Ok(AlongRule::Reference),
            "measured" => Ok(AlongRule::Measured),
            _ => Err(NoDirection),
        },
    };
    match found {
        Ok(rule) => Ok(Some(rule)),
        Err(_) => {
            let what = "along is a direction other than 0, as in [0, 0, 1], or \"reference\" or \"measured\"";
            checker.wrong(&at.span, what)
        }
    }
}

fn facing(checker: &Checker, written: &DeviationText) -> Result<Option<f64>, PlanError> {
    match &written.facing {
        None => Ok(None),
        Some(angle) if angle.value > 0.0 && angle.value <= 180.0 => Ok(Some(angle.value.to_radians())),
        Some(angle) => {
            let what = format!(
                "facing is {}; an angle between normals is above 0 and up to 180 degrees",
                angle.value
            );
            checker.wrong(&angle.span, what)
        }
    }
}

fn coverage(checker: &Checker, written: &DeviationText) -> Result<Option<Coverage>, PlanError> {
    let Some(at) = &written.coverage else { return Ok(None) };
    let found = match &at.value {
        CoverageText::Reach(reach) => {
            let reach = reach * checker.unit;
            (reach > 0.0 && reach.is_finite()).then_some(Coverage::Within(reach))
        }
        CoverageText::Word(word) => word.parse().ok().filter(|c| *c == Coverage::Auto),
    };
    match found {
        None => checker.wrong(&at.span, "coverage is \"auto\" or a length above 0"),
        found => Ok(found),
    }
}
