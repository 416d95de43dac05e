//! Parts of the reference with tolerances of their own, in a plan or in a file for a comparison.

use super::checker::Checker;
use super::feature::named;
use crate::compare::{Extent, RegionRule};
use crate::requirement::Feature;
use std::ops::Range;
use trueness_document::of_percent;
use trueness_document::plan::{At, PlanError, RegionText, RegionsText, ZoneText};
use trueness_document::tolerance::Tolerance;

/// A region of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct ToleranceRegion {
    /// The same for a comparison; of a feature without facets yet.
    pub rule: RegionRule,
    /// Number of the feature whose facets it has.
    pub feature: Option<usize>,
    /// Where its name stands.
    pub span: Range<usize>,
}

/// Most regions: their numbers are kept for each facet.
const MAX_REGIONS: usize = 1000;

/// The regions of a file: `[[region]]` with `id`, `seed` or `between`, `tolerance`, `inside`; lengths in millimeters.
///
/// # Errors
/// The first fault, with line and column, as of plans.
///
/// ```
/// use trueness_measure::compare::Extent;
/// use trueness_measure::plan::regions_of_file;
/// let text = "[[region]]\nid = \"bore\"\nseed = [1, 2, 3]\ntolerance = [-0.02, 0.05]\n";
/// assert_eq!(regions_of_file(text)?[0].extent, Extent::Seed([1.0, 2.0, 3.0]));
/// let error = regions_of_file(&text.replace("seed", "sed")).unwrap_err();
/// assert!(error.to_string().starts_with("line 3, column 1: "), "{error}");
/// let even = regions_of_file(&text.replace("[-0.02, 0.05]", "0.05"))?;
/// assert_eq!((even[0].tolerance.lower, even[0].tolerance.upper), (-0.05, 0.05));
/// # Ok::<(), trueness_document::plan::PlanError>(())
/// ```
pub fn regions_of_file(text: &str) -> Result<Vec<RegionRule>, PlanError> {
    let written: RegionsText = RegionsText::read(text)?;
    let checker = Checker { text, unit: 1.0 };
    if written.region.is_empty() {
        return checker.wrong(&(0..0), "there is no [[region]]");
    }
    let found = regions(&checker, &written.region, &[])?;
    Ok(found.into_iter().map(|r| r.rule).collect())
}

pub(super) fn regions(
    checker: &Checker,
    written: &[At<RegionText>],
    features: &[Feature],
) -> Result<Vec<ToleranceRegion>, PlanError> {
    let mut all: Vec<ToleranceRegion> = vec![];
    for At { value, span } in written {
        if all.len() == MAX_REGIONS {
            return checker.wrong(span, format!("there are more than {MAX_REGIONS} regions"));
        }
        checker.id(&value.id)?;
        if all.iter().any(|r| r.rule.id == value.id.value) {
            return checker.wrong(
                &value.id.span,
                format!("there are two regions \"{}\"; give each its own id", value.id.value),
            );
        }
        all.push(region(checker, value, features)?);
    }
    Ok(all)
}

fn region(
    checker: &Checker,
    written: &RegionText,
    features: &[Feature],
) -> Result<ToleranceRegion, PlanError> {
    let (extent, feature) = extent(checker, written, features)?;
    let required_share = match &written.inside {
        None => 1.0,
        Some(share) => self::share(checker, share, "inside")?,
    };
    let rule = RegionRule {
        id: written.id.value.clone(),
        extent,
        tolerance: zone(checker, &written.tolerance)?,
        required_share,
    };
    Ok(ToleranceRegion { rule, feature, span: written.id.span.clone() })
}

/// A zone as it is written, in millimeters.
pub(super) fn zone(checker: &Checker, written: &At<ZoneText>) -> Result<Tolerance, PlanError> {
    let written_zone = match written.value {
        ZoneText::Even(size) => [-size, size],
        ZoneText::Between(zone) => zone,
    };
    let [lower, upper] = written_zone.map(|x| x * checker.unit);
    if lower.is_finite() && upper.is_finite() && lower <= upper {
        return Ok(Tolerance { lower, upper });
    }
    let what = "the tolerance is [least, greatest] allowed deviation, as in [-0.1, 0.1], or one number from 0 upwards for as much to \
                either side";
    checker.wrong(&written.span, what)
}

/// Percent as a share.
pub(super) fn share(checker: &Checker, written: &At<f64>, key: &str) -> Result<f64, PlanError> {
    match of_percent(written.value) {
        Ok(share) => Ok(share),
        Err(what) => checker.wrong(&written.span, format!("{key} is {}; {what}", written.value)),
    }
}

fn extent(
    checker: &Checker,
    written: &RegionText,
    features: &[Feature],
) -> Result<(Extent, Option<usize>), PlanError> {
    match (&written.seed, &written.between, &written.feature) {
        (Some(seed), None, None) => Ok((Extent::Seed(finite(checker, seed.value, &seed.span)?), None)),
        (None, Some(corners), None) => {
            let [a, b] = corners.value;
            let (a, b) = (finite(checker, a, &corners.span)?, finite(checker, b, &corners.span)?);
            let low = std::array::from_fn(|k| a[k].min(b[k]));
            Ok((Extent::Between(low, std::array::from_fn(|k| a[k].max(b[k]))), None))
        }
        (None, None, Some(name)) => {
            let number = named(checker, &name.value, &name.span, features)?;
            if !features[number].has_nominal() {
                let what = format!("feature \"{}\" has no `nominal`, no `seed` and no `face`", name.value);
                return checker.wrong(&name.span, what);
            }
            Ok((Extent::Facets(vec![]), Some(number)))
        }
        _ => {
            let what = "a region has one of `seed`, `between` and, in a plan, `feature`";
            checker.wrong(&written.id.span, what)
        }
    }
}

fn finite(checker: &Checker, place: [f64; 3], span: &Range<usize>) -> Result<[f64; 3], PlanError> {
    match place.iter().all(|x| x.is_finite()) {
        true => Ok(checker.place(place)),
        false => checker.wrong(span, "a place is three finite numbers"),
    }
}
