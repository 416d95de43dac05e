//! From what was found to the result document.

use super::judgement::{Grounds, judge};
use super::reference::{Compared, WorstPlace};
use super::research::{NotTogether, research, together};
use super::{
    AlongRule, Comparisons, Covered, Excluded, Extreme, Facing, Options, Outliers, RegionFound, plausibility,
};
use crate::file_numbers::LeftOut;
use crate::statistics::{by_side, histogram, statistics};
use crate::words::ToWord;
use std::collections::BTreeMap;
use trueness_document::align::{AlignNoteKind, AlignedTo};
use trueness_document::check::Defects;
use trueness_document::compare::*;
use trueness_document::scale::Scale;
use trueness_document::{InputRecord, UNITS, VERSION, Verdict, VerdictReason, Word, worst as worst_of};
use trueness_geom::check::{DefectKind, Found, NOT_FINITE_FACETS};
use trueness_geom::deviation::paper::Differences;
use trueness_geom::deviation::sign_choice::{SignChoice, SignMethod};
use trueness_geom::stats::histogram::Limits;

mod geom {
    pub use trueness_geom::stats::paired::Paired;
}
use trueness_geom::deviation::surface::Disagreement;

/// What the document says about the files, which this crate does not know.
pub struct Inputs {
    /// The measured file, then the references.
    pub files: Vec<InputRecord>,
    /// `points`, `vertices` or `samples`.
    pub kind: MeasuredKind,
    /// The scale to use instead of the default one.
    pub scale: Option<Scale>,
    /// One entry a reference where both directions were asked for.
    pub reverse: Vec<Option<Reverse>>,
    /// How the measured was brought to the first reference.
    pub alignment: Option<AlignedTo>,
    /// What makes an alignment unreliable that the document does not have.
    pub doubts: Vec<AlignNoteKind>,
}

/// Makes the document.
pub fn document(found: &Comparisons, inputs: Inputs, options: &Options) -> CompareDocument {
    let mut files = inputs.files;
    if let Some(measured) = files.first_mut() {
        measured.points = found.count;
        measured.bounds = crate::bounds(&found.bounds);
    }
    let names: Vec<String> = files.iter().skip(1).map(|f| f.path.clone()).collect();
    let ranks = ranks(&found.references);
    let mut reverse = inputs.reverse.into_iter();
    let mut comparisons: Vec<Comparison> = found
        .references
        .iter()
        .zip(names)
        .zip(ranks)
        .map(|((c, name), rank)| comparison(c, name, rank, reverse.next().flatten(), options))
        .collect();
    if options.research {
        for (i, (c, found_for)) in comparisons.iter_mut().zip(&found.references).enumerate() {
            c.research = Some(research(found_for, &found.shown, i, options.seed));
        }
    }
    for (c, file) in comparisons.iter_mut().zip(files.iter().skip(1)) {
        if let (Some(measured), Some(reference)) = (&files[0].bounds, &file.bounds) {
            c.warnings = plausibility::warnings(measured, reference, "--units, --reference-units");
        }
    }
    let of_alignment = inputs.alignment.iter().flat_map(AlignedTo::doubts);
    let doubts: Vec<AlignNoteKind> = of_alignment.chain(inputs.doubts).collect();
    for (n, c) in comparisons.iter_mut().enumerate() {
        let (reference, measured) = (files.get(n + 1), crate::bounds(&found.bounds));
        judge(c, &Grounds { doubts: &doubts, reference, measured: measured.as_ref() }, options);
    }
    let verdict = worst_of(comparisons.iter().filter_map(|c| c.verdict));
    CompareDocument {
        schema: SCHEMA.into(),
        version: VERSION.into(),
        units: UNITS.into(),
        inputs: files,
        measured: Measured {
            kind: Word(inputs.kind),
            count: found.count,
            bounds: crate::bounds(&found.bounds),
        },
        alignment: inputs.alignment,
        method: Word(options.method),
        sign: overall_sign(&comparisons, options),
        max_distance: Some(options.surface.max_distance).filter(|d| d.is_finite()),
        skip_boundary: options.surface.skip_boundary,
        facing: options.facing.as_ref().map(Facing::angle),
        paired: found.paired.iter().map(|(a, b, p)| paired((*a, *b, p), found, options)).collect(),
        scale: inputs.scale.unwrap_or_else(|| scale(found, options)),
        verdict,
        verdict_reasons: reasons(&comparisons, verdict),
        comparisons,
        sampling: None,
        seed: options.seed,
    }
}

fn comparison(
    c: &Compared,
    reference: String,
    rank: u32,
    reverse: Option<Reverse>,
    options: &Options,
) -> Comparison {
    let tolerance = c.limits.as_ref().map(|l| shares(l, options.required_share));
    let regions: Vec<RegionRecord> = c.regions.iter().map(region).collect();
    Comparison {
        reference,
        rank,
        warnings: vec![],
        surfaces: c.surfaces.map(|s| SurfacesRecord {
            count: s.surfaces as u64,
            uncertain: s.uncertain,
            drawn_within: s.drawn_within,
        }),
        faces: c.faces.clone(),
        along: c.along.map(along),
        sign: sign(&c.sign, c.disagreement.as_ref()),
        soundness: soundness(c),
        deviation: by_side(&c.summary),
        excluded: c.excluded.iter().map(|(e, n)| (e.name().to_string(), *n)).collect::<BTreeMap<_, _>>(),
        outliers: c.outliers.map(|o| outliers(&o, c)),
        coverage: c.covered.as_ref().map(|found| coverage(found, c.between.count, options)),
        between_vertices: c.between.worst.map(|worst| BetweenRecord {
            places: c.between.count,
            beyond: c.between.beyond,
            deviation: worst.deviation,
            point: worst.point,
        }),
        verdict: None,
        verdict_reasons: vec![],
        others_verdict: None,
        tolerance,
        regions,
        histogram: c.histogram.as_ref().map(histogram),
        lowest: c.extremes.lowest.map(extreme),
        highest: c.extremes.highest.map(extreme),
        worst: c.worst.iter().map(|w| worst(w, &c.regions)).collect(),
        reverse,
        paper_vs_exact: c.paper_vs_exact.as_ref().map(paper_vs_exact),
        research: None,
    }
}

fn along(rule: AlongRule) -> AlongRecord {
    let (kind, direction) = match rule {
        AlongRule::Direction(d) => (AlongKind::Direction, Some(d)),
        AlongRule::Reference => (AlongKind::Reference, None),
        AlongRule::Measured => (AlongKind::Measured, None),
    };
    AlongRecord { kind: Word(kind), direction }
}

fn outliers(found: &Outliers, c: &Compared) -> OutliersRecord {
    let limits = found.limits.ok();
    OutliersRecord {
        rule: found.rule.to_string(),
        center: limits.map(|l| l.center),
        spread: limits.map(|l| l.spread),
        lower: limits.map(|l| l.lower),
        upper: limits.map(|l| l.upper),
        limits_reason: found.limits.err().map(|e| e.to_string()),
        count: c.excluded.iter().filter(|(e, _)| *e == Excluded::Outlier).map(|(_, n)| n).sum(),
    }
}

/// The reasons of the comparisons that have the verdict: what all references share once, the others with the reference that they are of.
fn reasons(comparisons: &[Comparison], verdict: Option<Verdict>) -> Vec<VerdictReason> {
    let mut all: Vec<VerdictReason> = vec![];
    for c in comparisons.iter().filter(|c| c.verdict == verdict) {
        for reason in &c.verdict_reasons {
            let text = match comparisons.iter().all(|c| c.verdict_reasons.contains(reason)) {
                true => reason.text.clone(),
                false => format!(
                    "{}: {}",
                    c.reference.rsplit(['/', '\\']).next().unwrap_or(&c.reference),
                    reason.text
                ),
            };
            let told = VerdictReason { text, ..reason.clone() };
            if !all.contains(&told) {
                all.push(told);
            }
        }
    }
    all
}

fn coverage(map: &Covered, between: u64, options: &Options) -> CoverageRecord {
    // Sums of many areas: rounding may carry one beyond the other.
    let share = (map.area > 0.0).then(|| (map.uncovered / map.area).clamp(0.0, 1.0));
    CoverageRecord {
        area: map.area,
        uncovered: map.uncovered,
        uncovered_share: share,
        uncovered_share_reason: share.is_none().then(|| "the reference has no area".into()),
        required: options.judges().then_some(options.min_coverage),
        reach: map.reach,
        spacing: map.spacing,
        between,
    }
}

/// Rank 1 is the least root mean square; equal values share a rank, a reference without deviations comes last.
fn ranks(references: &[Compared]) -> Vec<u32> {
    let rms: Vec<f64> = references.iter().map(|c| c.summary.all.rms.unwrap_or(f64::INFINITY)).collect();
    rms.iter().map(|x| 1 + rms.iter().filter(|y| y.total_cmp(x).is_lt()).count() as u32).collect()
}

fn sign(choice: &SignChoice, disagreement: Option<&Disagreement>) -> SignRecord {
    let share = disagreement.filter(|d| d.sample > 0).map(|d| d.differing as f64 / d.sample as f64);
    SignRecord {
        requested: choice.requested.name().into(),
        method: choice.method.word(),
        reason: choice.to_string(),
        disagreement: share,
        disagreement_reason: share.is_none().then(|| match disagreement {
            None if choice.method == SignMethod::Normal => "there is no other method for surfaces".into(),
            None => "distances are unsigned".into(),
            Some(_) => "all points looked at lie on the surface".into(),
        }),
        sample: disagreement.map_or(0, |d| d.sample),
    }
}

/// What holds for all references: their common method, their greatest disagreement.
fn overall_sign(comparisons: &[Comparison], options: &Options) -> SignRecord {
    let first = comparisons.first().map(|c| c.sign.clone());
    let signs = || comparisons.windows(2).map(|w| (&w[0].sign, &w[1].sign));
    let mut out = first.unwrap_or_else(|| SignRecord {
        requested: options.surface.sign.name().into(),
        method: Word(SignBy::None),
        reason: "there is no reference".into(),
        disagreement: None,
        disagreement_reason: Some("there is no reference".into()),
        sample: 0,
    });
    if signs().any(|(a, b)| a.method != b.method) {
        out.method = Word(SignBy::Several);
    }
    if signs().any(|(a, b)| a.reason != b.reason) {
        out.reason = "see each comparison".into();
    }
    out.disagreement = comparisons.iter().filter_map(|c| c.sign.disagreement).reduce(f64::max);
    out
}

fn soundness(c: &Compared) -> Soundness {
    let (s, left_out) = (&c.precondition.soundness, LeftOut(&c.left_out));
    Soundness {
        sound: s.sound && left_out.count() == 0,
        closed: s.closed,
        consistently_oriented: s.consistently_oriented,
        outward: s.outward,
        shells: s.shells as u64,
        boundary_edges: s.boundary_edges as u64,
        non_manifold_edges: s.non_manifold_edges as u64,
        non_manifold_vertices: s.non_manifold_vertices as u64,
        duplicate_facets: s.duplicate_facets as u64,
        degenerate_facets: s.degenerate_facets as u64,
        not_finite_facets: s.not_finite_facets as u64 + left_out.count(),
        inconsistent_edges: s.inconsistent_edges as u64,
        findings: findings(c, left_out),
    }
}

/// Where the mesh is not sound. Facets that the reader left out are counted among those that are not finite.
fn findings(c: &Compared, left_out: LeftOut) -> BTreeMap<String, Defects> {
    let (not_read, mut found) = (Found::default(), BTreeMap::new());
    let mut add = |kind: &DefectKind, items| {
        found.insert(kind.name.to_string(), crate::check::defects(kind, Some(items), left_out));
    };
    if left_out.count() > 0 {
        add(NOT_FINITE_FACETS, &not_read);
    }
    c.precondition.findings.iter().for_each(|(kind, items)| add(kind, items));
    found
}

/// Shares of the points against the tolerance; none where there is no point.
fn shares(limits: &Limits, required: f64) -> ToleranceShares {
    let [below, inside, above] =
        limits.shares().map_or([None; 3], |[below, inside, above]| [Some(below), Some(inside), Some(above)]);
    let reason = inside.is_none().then(|| "all points are excluded".to_string());
    ToleranceShares {
        lower: limits.lower,
        upper: limits.upper,
        inside,
        inside_reason: reason.clone(),
        above,
        above_reason: reason.clone(),
        below,
        below_reason: reason,
        required,
    }
}

fn region(found: &RegionFound) -> RegionRecord {
    let tolerance = shares(&found.limits, found.rule.required_share);
    RegionRecord {
        id: found.rule.id.clone(),
        deviation: statistics(&found.summary.all, found.summary.quantile_error),
        verdict: Verdict::NotMeasured,
        tolerance,
    }
}

fn extreme(e: Extreme) -> ExtremeRecord {
    ExtremeRecord { index: e.index, point: e.point, deviation: e.deviation }
}

fn worst(w: &WorstPlace, regions: &[RegionFound]) -> Worst {
    Worst {
        sign: if w.place.deviation > 0.0 { 1 } else { -1 },
        region: usize::from(w.place.region)
            .checked_sub(1)
            .and_then(|n| Some(regions.get(n)?.rule.id.clone())),
        index: w.place.index,
        point: w.place.point,
        nearest: w.nearest,
        normal: w.normal,
        deviation: w.place.deviation,
    }
}

/// The better reference first; the sign of the difference follows.
fn paired(
    (first, second, p): (usize, usize, &geom::Paired),
    found: &Comparisons,
    options: &Options,
) -> Paired {
    let together = match options.independent {
        true => Err(NotTogether::Independent),
        false => together(found, first, second),
    };
    let c = p.comparison(together.as_ref().ok());
    let swap = c.mean.is_ok_and(|m| m > 0.0);
    let turn = |x: f64| if swap { -x } else { x };
    Paired {
        better: if swap { second } else { first },
        other: if swap { first } else { second },
        count: c.count,
        points_per_independent: together.is_ok().then_some(c.points_per_independent),
        points_per_independent_reason: together.err().map(|e| e.to_string()),
        mean_difference: c.mean.ok().map(turn),
        interval: c.interval.ok().map(|[a, b]| if swap { [-b, -a] } else { [a, b] }),
        std_dev: c.std_dev.ok(),
        p_value: c.t_test.ok(),
        wilcoxon_p_value: c.wilcoxon.ok(),
        reason: c.t_test.err().map(|e| e.to_string()),
    }
}

fn paper_vs_exact(p: &Differences) -> PaperVsExact {
    PaperVsExact {
        count: p.count,
        differing: p.differing,
        too_small: p.too_small,
        max_difference: p.max_difference,
        median_difference: p.median_difference(),
    }
}

/// The scale that all comparisons share: by the tolerance, else by the first reference's 95th percentile of |d|.
fn scale(found: &Comparisons, options: &Options) -> Scale {
    let p95 = found.references.first().and_then(|c| c.summary.p95_abs.ok()).unwrap_or(0.0);
    // Where several tolerances hold, no color can say what is within them.
    let tolerance = options.tolerance.filter(|_| options.regions.is_empty());
    Scale::for_deviations(p95, tolerance.map(|t| [t.lower, t.upper]))
}
