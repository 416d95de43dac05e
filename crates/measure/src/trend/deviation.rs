//! The course of the deviations from the reference: the share of the points within tolerance, of each region and of all others.

use trueness_document::Verdict;
use trueness_document::compare::ToleranceShares;
use trueness_document::inspect::{Counts, InspectDocument};
use trueness_document::trend::{TrendError, TrendRecord};

/// What the records of deviations are called, and their kind.
pub(super) const DEVIATION: &str = "deviation";

/// Why they have no control limits and no indices.
const NOT_NORMAL: &str = "shares of points are not normal: there are no control limits and no indices";

/// A share of one part.
struct Share<'a> {
    id: String,
    tolerance: &'a ToleranceShares,
    verdict: Verdict,
}

/// The shares of a part: of each region, then of the points in none. Those of the latter may be of no point at all.
fn shares(document: &InspectDocument) -> Vec<Share<'_>> {
    let Some(deviation) = &document.deviation else { return vec![] };
    let regions = deviation.regions.iter().map(|r| Share {
        id: format!("{DEVIATION} {}", r.id),
        tolerance: &r.tolerance,
        verdict: r.verdict,
    });
    let rest = deviation.tolerance.as_ref().map(|t| Share {
        id: DEVIATION.into(),
        tolerance: t,
        verdict: match (deviation.regions.is_empty(), t.inside) {
            (true, _) => deviation.verdict,
            (false, None) => Some(Verdict::NotMeasured),
            (false, Some(_)) => deviation.others_verdict,
        }
        .or(t.verdict())
        .unwrap_or(Verdict::NotMeasured),
    });
    regions.chain(rest).collect()
}

/// One record for each share, of the parts in their order; none where deviations are not judged.
///
/// # Errors
/// A result that judges other regions, or by other limits, than the first one.
pub(super) fn records(results: &[InspectDocument]) -> Result<Vec<TrendRecord>, TrendError> {
    let all: Vec<Vec<Share>> = results.iter().map(shares).collect();
    let Some(first) = all.first() else { return Ok(vec![]) };
    let asked = |s: &Share| (s.id.clone(), [s.tolerance.lower, s.tolerance.upper, s.tolerance.required]);
    for (index, own) in all.iter().enumerate() {
        if !own.iter().map(asked).eq(first.iter().map(asked)) {
            let what = "its regions and tolerances of deviations are not those of the first result".into();
            return Err(TrendError::Different { index, what });
        }
    }
    let of = (0..first.len()).map(|n| record(&all.iter().map(|own| &own[n]).collect::<Vec<_>>()));
    // Where regions are all of the reference there are no other points.
    Ok(of.filter(|r| r.measured > 0 || r.id != DEVIATION || first.len() == 1).collect())
}

fn record(of: &[&Share]) -> TrendRecord {
    let values: Vec<Option<f64>> = of.iter().map(|s| s.tolerance.inside.map(|share| 100.0 * share)).collect();
    let there: Vec<f64> = values.iter().flatten().copied().collect();
    let count = |verdict| of.iter().filter(|s| s.verdict == verdict).count() as u64;
    let mean = there.iter().sum::<f64>() / there.len() as f64;
    let squares: f64 = there.iter().map(|v| (v - mean) * (v - mean)).sum();
    TrendRecord {
        id: of[0].id.clone(),
        kind: DEVIATION.into(),
        symbol: String::new(),
        feature: String::new(),
        datums: vec![],
        unit: "%".into(),
        nominal: None,
        lower: Some(100.0 * of[0].tolerance.required),
        upper: Some(100.0),
        verdicts: of.iter().map(|s| s.verdict).collect(),
        uncertainties: None,
        intervals: None,
        own_upper: None,
        counts: Counts {
            pass: count(Verdict::Pass),
            fail: count(Verdict::Fail),
            undecided: count(Verdict::Undecided),
            not_measured: count(Verdict::NotMeasured),
        },
        measured: there.len() as u64,
        mean: Some(mean).filter(|m| m.is_finite()),
        min: there.iter().copied().reduce(f64::min),
        max: there.iter().copied().reduce(f64::max),
        std_dev: (there.len() > 1).then(|| (squares / (there.len() - 1) as f64).sqrt()),
        std_dev_within: None,
        control: None,
        course_reason: Some(NOT_NORMAL.into()),
        out_of_control: vec![],
        cp: None,
        cpk: None,
        pp: None,
        ppk: None,
        capability_reason: Some(NOT_NORMAL.into()),
        values,
    }
}
