//! The verdict of a comparison: what its shares, its alignment, the reference and what is covered say together. Table, page, document
//! and exit status read what is decided here.

use super::options::Options;
use trueness_document::align::AlignNoteKind;
use trueness_document::compare::{
    BetweenRecord, Bounds, Comparison, CoverageRecord, ToleranceShares, Warning, WarningKind,
};
use trueness_document::{InputRecord, ReasonKind, Verdict, VerdictReason, judged, percent, percents};
use trueness_geom::space::{minus, norm};

/// Points whose mean distance is no more than this share of their own size lie on the reference: what an alignment is called poor by.
/// Boxes in a ratio of units are then those of a small piece.
const ON_REFERENCE_SIZE_SHARE: f64 = 0.01;

/// Share of the size of a reference from which on a reach covers what no point is near.
const FAR_REACH_SIZE_SHARE: f64 = 0.25;

/// What is known beside the comparison itself.
pub struct Grounds<'a> {
    /// What makes the alignment unreliable.
    pub doubts: &'a [AlignNoteKind],
    /// The reference's file.
    pub reference: Option<&'a InputRecord>,
    /// Box of the measured points.
    pub measured: Option<&'a Bounds>,
}

/// Puts the verdicts into a comparison that has all else.
pub fn judge(c: &mut Comparison, grounds: &Grounds, options: &Options) {
    let doubts = doubts(c, grounds);
    // A doubt about the values is one about those of each region.
    let by_shares = |t: &ToleranceShares| match (t.verdict(), doubts.is_empty()) {
        (None, _) => Verdict::NotMeasured,
        (Some(_), false) => Verdict::Undecided,
        (Some(own), true) => own,
    };
    for r in &mut c.regions {
        r.verdict = by_shares(&r.tolerance);
    }
    // Where all points are of regions, the others have nothing to say.
    let others = c.tolerance.as_ref().filter(|t| c.regions.is_empty() || t.inside.is_some());
    c.others_verdict = others.filter(|_| !c.regions.is_empty()).map(by_shares);
    let parts = c.regions.iter().map(|r| (Some(r.id.as_str()), &r.tolerance));
    let all: Vec<_> = parts.chain(others.map(|t| (None, t))).collect();
    if all.is_empty() {
        // Nothing to judge: what is left to say is that the numbers mean nothing.
        let unreliable: Vec<VerdictReason> = unreliable_alignment(grounds.doubts).into_iter().collect();
        c.verdict = (!unreliable.is_empty()).then_some(Verdict::Undecided);
        c.verdict_reasons = unreliable;
        return;
    }
    let mut reasons: Vec<VerdictReason> = all.iter().filter_map(|(id, t)| share(*id, t)).collect();
    reasons.extend(doubts);
    reasons.extend(c.between_vertices.and_then(|found| between(&found, options.required_share)));
    reasons.extend(covered(c.coverage.as_ref(), grounds.reference, options.min_coverage));
    reasons.sort_by_key(|r| ReasonKind::ALL.iter().position(|k| k == &*r.kind));
    let (verdict, reasons) = judged(&reasons);
    (c.verdict, c.verdict_reasons) = (Some(verdict), reasons);
}

/// What makes all values doubtful.
fn doubts(c: &Comparison, grounds: &Grounds) -> Vec<VerdictReason> {
    let mut all: Vec<VerdictReason> = unreliable_alignment(grounds.doubts).into_iter().collect();
    all.extend(c.warnings.iter().filter(|w| !lies_on_it(c, w, grounds.measured)).map(of_boxes));
    all.extend(grounds.reference.and_then(incomplete));
    all
}

/// That not all of a reference was read.
pub(crate) fn incomplete(reference: &InputRecord) -> Option<VerdictReason> {
    let found = reference.incomplete.as_ref()?;
    Some(VerdictReason::new(ReasonKind::IncompleteReference, found.text.clone()))
}

/// That an alignment with these doubts cannot be relied on.
pub(crate) fn unreliable_alignment(doubts: &[AlignNoteKind]) -> Option<VerdictReason> {
    let mut names: Vec<String> = doubts.iter().map(|kind| kind.name().replace('_', " ")).collect();
    names.dedup();
    let text = || format!("the alignment cannot be relied on ({})", names.join(", "));
    (!names.is_empty()).then(|| VerdictReason::new(ReasonKind::Alignment, text()))
}

/// Whether the points answer what their box asks: a small piece of the part looks like the part in a wrong unit, but lies on it.
fn lies_on_it(c: &Comparison, warning: &Warning, measured: Option<&Bounds>) -> bool {
    let size = measured.map_or(0.0, |b| norm(minus(b.max, b.min)));
    warning.kind == WarningKind::SizeRatio
        && c.deviation.all.mean_abs.is_some_and(|mean| mean <= ON_REFERENCE_SIZE_SHARE * size)
}

fn of_boxes(warning: &Warning) -> VerdictReason {
    let (kind, text) = match warning.kind {
        WarningKind::SizeRatio => {
            (ReasonKind::SizeRatio, "the sizes are in a ratio of units: is a unit wrong?")
        }
        WarningKind::HardlyOverlapping => {
            (ReasonKind::HardlyOverlapping, "measured and reference hardly overlap")
        }
    };
    VerdictReason::new(kind, text)
}

/// Why a share does not conform; nothing where it does.
fn share(region: Option<&str>, t: &ToleranceShares) -> Option<VerdictReason> {
    let of = region.map_or_else(String::new, |id| format!("region \"{id}\": "));
    match (t.verdict(), t.inside) {
        (Some(Verdict::Pass), _) => None,
        (Some(_), Some(inside)) => {
            let (beyond, allowed) = (percent(1.0 - inside), percent(1.0 - t.required));
            let text = match t.required < 1.0 {
                true => format!("{of}{beyond} of the points are out of tolerance, {allowed} may be"),
                false => format!("{of}{beyond} of the points are out of tolerance"),
            };
            Some(VerdictReason::new(ReasonKind::OutOfTolerance, text))
        }
        _ => Some(VerdictReason::new(ReasonKind::NotMeasured, format!("{of}no point counts"))),
    }
}

/// That a mesh is off between its vertices, by more of the places than may be.
fn between(found: &BetweenRecord, required: f64) -> Option<VerdictReason> {
    let share = found.beyond as f64 / found.places as f64;
    let [x, y, z] = found.point;
    let text = format!(
        "between vertices the mesh is off by {:+.4} mm at {x:.1}, {y:.1}, {z:.1}; {} of {} places are out",
        found.deviation, found.beyond, found.places
    );
    (share > 1.0 - required).then(|| VerdictReason::new(ReasonKind::BetweenVertices, text))
}

/// Whether so much of the reference is covered as is asked for. What is less than a whole surface is counted whole: more of it than is covered
/// may be none of the part.
fn covered(
    coverage: Option<&CoverageRecord>,
    reference: Option<&InputRecord>,
    least: f64,
) -> Option<VerdictReason> {
    let share = coverage.and_then(CoverageRecord::covered_share);
    let size = reference.and_then(|r| r.bounds.as_ref()).map(|b| norm(minus(b.max, b.min)));
    let reach = coverage.map_or(0.0, |c| c.reach);
    match share {
        _ if least <= 0.0 => None,
        _ if size.is_some_and(|size| reach > FAR_REACH_SIZE_SHARE * size) => {
            let text = format!(
                "a reach of {reach:.1} mm covers what no point is near: ask for less than a quarter of the part"
            );
            Some(VerdictReason::new(ReasonKind::CoverageUnknown, text))
        }
        Some(share) if share >= least => None,
        Some(share) => {
            let trimmed = reference.and_then(|r| r.trimmed_faces);
            let whole = trimmed.map_or("", |_| ", whose trimmed faces count whole");
            let [share, least] = percents([share, least]);
            let text = format!("the points cover {share} of the reference{whole}; a pass needs {least}");
            Some(VerdictReason::new(ReasonKind::Coverage, text))
        }
        None => {
            let why = coverage.and_then(|c| c.uncovered_share_reason.as_deref());
            let why = why.unwrap_or("it was not looked for");
            let text = format!("what the points cover is not known: {why}");
            Some(VerdictReason::new(ReasonKind::CoverageUnknown, text))
        }
    }
}
