//! The verdict on the profile of a line: what shares, fit, file and coverage say together.

use super::doubts::NominalWarningKind;
use super::nominal::NominalRecord;
use super::outline::OutlineRecord;
use super::profile::{ProfileRecord, WorstRecord};
use crate::compare::ToleranceShares;
use crate::tolerance::{Tolerance, badness};
use crate::{InputRecord, ReasonKind, Verdict, VerdictReason, judged, percent, percents};

/// What a section must keep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfileRule {
    /// The zone of deviations.
    pub tolerance: Tolerance,
    /// Share of the points that must lie within it (0 to 1).
    pub required_share: f64,
    /// Share of the nominal's length that must be measured, and of the points that must have a counterpart (0 to 1).
    pub min_coverage: f64,
}

impl NominalRecord {
    /// The same, judged by a rule; `reference` is the nominal's file.
    pub fn judge(&mut self, rule: &ProfileRule, reference: &InputRecord) {
        let profile = self.profile(rule);
        let mut reasons = self.doubts(rule, reference);
        reasons.extend(beyond(&profile.shares));
        if profile.covered < rule.min_coverage {
            let [covered, least] = percents([profile.covered, rule.min_coverage]);
            let text = format!("the points cover {covered} of the nominal; a pass needs {least}");
            reasons.push(VerdictReason::new(ReasonKind::Coverage, text));
        } else if let Some(outline) = self.outlines.iter().find(|o| o.closed && o.covered <= 0.0)
            && rule.min_coverage > 0.0
        {
            reasons.push(VerdictReason::new(ReasonKind::Coverage, not_measured(outline)));
        }
        if profile.counterparts < rule.min_coverage {
            let [counterparts, least] = percents([profile.counterparts, rule.min_coverage]);
            let text = format!(
                "{counterparts} of the points have a counterpart on the nominal; a pass needs {least}"
            );
            reasons.push(VerdictReason::new(ReasonKind::Coverage, text));
        }
        reasons.sort_by_key(|r| ReasonKind::ALL.iter().position(|k| k == &*r.kind));
        let (verdict, reasons) = judged(&reasons);
        (self.profile, self.verdict, self.verdict_reasons) = (Some(profile), Some(verdict), reasons);
    }

    fn profile(&self, rule: &ProfileRule) -> ProfileRecord {
        let Tolerance { lower, upper } = rule.tolerance;
        let values = || self.deviations.iter().flatten().flatten();
        let count = values().count();
        let share = |is: &dyn Fn(f64) -> bool| {
            (count > 0).then(|| values().filter(|d| is(**d)).count() as f64 / count as f64)
        };
        let reason = (count == 0).then(|| "no point has a counterpart".to_string());
        let length = self.outlines.iter().map(|o| o.length).sum::<f64>();
        let covered = self.outlines.iter().map(|o| o.covered * o.length).sum::<f64>();
        let all = self.deviations.iter().map(Vec::len).sum::<usize>();
        let bad = |w: &WorstRecord| badness(w.deviation, Some([lower, upper]));
        ProfileRecord {
            shares: ToleranceShares {
                lower,
                upper,
                inside: share(&|d| (lower..=upper).contains(&d)),
                inside_reason: reason.clone(),
                above: share(&|d| d > upper),
                above_reason: reason.clone(),
                below: share(&|d| d < lower),
                below_reason: reason,
                required: rule.required_share,
            },
            zone_width: upper - lower,
            worst: self.extremes.iter().copied().max_by(|a, b| bad(a).total_cmp(&bad(b))),
            covered: if length > 0.0 { (covered / length).min(1.0) } else { 0.0 },
            counterparts: if all > 0 { count as f64 / all as f64 } else { 0.0 },
            min_coverage: rule.min_coverage,
        }
    }

    /// What makes all deviations doubtful.
    fn doubts(&self, rule: &ProfileRule, reference: &InputRecord) -> Vec<VerdictReason> {
        let mut all = vec![];
        if self.fits.iter().any(|f| !f.converged) {
            let text = "the best fit did not come to rest: the pose cannot be relied on";
            all.push(VerdictReason::new(ReasonKind::Alignment, text));
        }
        let even = rule.tolerance.lower == -rule.tolerance.upper;
        for warning in &self.warnings {
            let (kind, text) = match warning.kind {
                NominalWarningKind::SizeRatio => {
                    (ReasonKind::SizeRatio, "the sizes are in a ratio of units: is a unit wrong?".into())
                }
                NominalWarningKind::HardlyOverlapping => {
                    (ReasonKind::HardlyOverlapping, "measured and nominal hardly overlap".into())
                }
                // Which side is outside says which limit holds.
                NominalWarningKind::NearlyClosed if !even => {
                    (ReasonKind::IncompleteReference, warning.text.clone())
                }
                _ => continue,
            };
            all.push(VerdictReason::new(kind, text));
        }
        let incomplete = reference.incomplete.as_ref().map(|found| found.text.clone());
        let blocks = reference.warnings.iter().find(|w| w.contains("passed over") && w.contains(" INSERT"));
        all.extend(
            incomplete
                .or(blocks.cloned())
                .map(|text| VerdictReason::new(ReasonKind::IncompleteReference, text)),
        );
        all
    }
}

/// That nothing of an outline was measured.
fn not_measured(outline: &OutlineRecord) -> String {
    let kind = if outline.hole { "hole" } else { "outline" };
    let ([x, y], [width, height]) = (outline.center, outline.size);
    let plane = outline.plane.map_or(String::new(), |n| format!(" in plane {}", n + 1));
    format!(
        "no points run along the {kind} of {width:.4} by {height:.4} about ({x:.4}, {y:.4}){plane}: it was not measured"
    )
}

/// Why the share inside does not conform; nothing where it does.
fn beyond(t: &ToleranceShares) -> Option<VerdictReason> {
    match (t.verdict(), t.inside) {
        (Some(Verdict::Pass), _) => None,
        (Some(_), Some(inside)) => {
            let (beyond, allowed) = (percent(1.0 - inside), percent(1.0 - t.required));
            let may = if t.required < 1.0 { format!(", {allowed} may be") } else { String::new() };
            let text = format!("{beyond} of the points are out of tolerance{may}");
            Some(VerdictReason::new(ReasonKind::OutOfTolerance, text))
        }
        _ => Some(VerdictReason::new(ReasonKind::NotMeasured, "no point counts")),
    }
}
