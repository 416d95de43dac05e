//! The list beside the stage: ranking, worst places, statistics, what was left out, how far the numbers can be trusted, files.

use super::super::super::html::Html;
use super::super::super::page::blocks::{badge, fact, file_name, place_cells, section};
use super::super::alignment::{Facts, alignment};
use super::super::check;
use super::words::{headline, in_words, sign_key, warning_key};
use crate::results::Verdict;
use crate::results::check::found;
use crate::results::compare::{
    AlongRecord, BySide, CompareDocument, Comparison, CoverageRecord, OutliersRecord, SignRecord, Statistics,
    ToleranceShares,
};

/// Writes all sections.
pub fn list(h: &mut Html, result: &CompareDocument) {
    if result.comparisons.len() > 1 {
        ranking(h, result);
    }
    let mut first_pick = 0;
    for (n, c) in result.comparisons.iter().enumerate() {
        let hidden = if n == 0 { "" } else { " hidden" };
        h.raw(&format!("<div class=\"comparison\" data-comparison=\"{n}\"{hidden}>\n"));
        if result.comparisons.len() > 1 {
            h.raw("<p class=\"against\">")
                .word("reference")
                .raw(" ")
                .name(file_name(&c.reference))
                .raw("</p>");
        }
        worst(h, c, result.scale.decimals as usize, first_pick);
        first_pick += c.worst.len();
        regions(h, c, result.scale.decimals as usize);
        statistics(h, c, result.scale.decimals as usize);
        trust(h, result, c);
        let found = found(&c.soundness.findings);
        if !found.is_empty() {
            section(h, "reference.defects", |h| check::kinds(h, &found, first_pick));
            first_pick += check::picks(&found, 0).len();
        }
        h.raw("</div>\n");
    }
    if let Some(a) = &result.alignment {
        let (rms, left_out) = (Some(a.rms), Some(a.left_out));
        alignment(h, &Facts { method: "best-fit", rms, greatest: None, left_out, warnings: &a.warnings });
    }
}

/// Several references side by side, the nearest first.
fn ranking(h: &mut Html, result: &CompareDocument) {
    let decimals = result.scale.decimals as usize + 1;
    let mut order: Vec<usize> = (0..result.comparisons.len()).collect();
    order.sort_by_key(|i| result.comparisons[*i].rank);
    section(h, "ranking", |h| {
        h.raw("<table class=\"choose\"><thead><tr><th></th><th>")
            .word("reference")
            .raw("</th><th class=\"r\">")
            .word("rms");
        h.raw("</th><th class=\"r\">").word("within.short").raw("</th></tr></thead><tbody>");
        for i in order {
            let c = &result.comparisons[i];
            let current = if i == 0 { "true" } else { "false" };
            h.raw(&format!("<tr data-choose=\"{i}\" aria-selected=\"{current}\"><td>{}</td><td>", c.rank));
            h.name(file_name(&c.reference)).raw("</td><td class=\"r\">");
            h.optional(c.deviation.all.rms, c.deviation.all.rms_reason.as_deref(), decimals, false)
                .raw("</td><td class=\"r\">");
            match (&c.tolerance, c.verdict) {
                (_, Some(v)) if !c.regions.is_empty() => {
                    badge(h, headline(Some(v)));
                    h.raw(" ");
                    passing(h, c);
                }
                (Some(t), Some(v)) => {
                    badge(h, headline(Some(v)));
                    h.raw(" ").optional_percent(t.inside, t.inside_reason.as_deref(), 2);
                }
                _ => {
                    h.raw("–");
                }
            }
            h.raw("</td></tr>");
        }
        h.raw("</tbody></table>");
        paired(h, result);
    });
}

/// Whether the better reference is better by more than chance.
fn paired(h: &mut Html, result: &CompareDocument) {
    let decimals = result.scale.decimals as usize + 2;
    let name = |i: usize| result.comparisons.get(i).map_or("", |c| file_name(&c.reference));
    for p in &result.paired {
        let Some(mean) = p.mean_difference else { continue };
        h.raw("<p class=\"note\">")
            .name(name(p.better))
            .raw(" ")
            .word("nearer_than")
            .raw(" ")
            .name(name(p.other));
        h.raw(" ").word("by").raw(" ").number(mean.abs(), decimals, false).raw("\u{a0}mm");
        if let Some([l, u]) = p.interval {
            h.raw(" (95\u{a0}%: ").number(l.abs().min(u.abs()), decimals, false).raw("\u{2009}…\u{2009}");
            h.number(l.abs().max(u.abs()), decimals, false).raw(")");
        }
        h.raw("</p>");
    }
}

pub fn worst(h: &mut Html, c: &Comparison, decimals: usize, first_pick: usize) {
    if c.worst.is_empty() {
        return;
    }
    section(h, "worst", |h| {
        h.raw("<table class=\"pick\"><thead><tr><th></th><th class=\"r\">").word("deviation").raw(
            "</th><th class=\"r\">x</th><th class=\"r\">y</th><th class=\"r\">z</th></tr></thead><tbody>",
        );
        for (n, w) in c.worst.iter().enumerate() {
            let region = w.region.as_ref().and_then(|id| c.regions.iter().find(|r| r.id == *id));
            let zone = region.map(|r| &r.tolerance).or(c.tolerance.as_ref());
            let outside = zone.is_some_and(|t| w.deviation > t.upper || w.deviation < t.lower);
            let class = if outside { " class=\"out\"" } else { "" };
            h.raw(&format!("<tr data-pick=\"{}\"{class}><td>{}</td><td class=\"r\">", first_pick + n, n + 1));
            h.number(w.deviation, decimals, true).raw("</td>");
            place_cells(h, w.point);
            h.raw("</tr>");
        }
        h.raw("</tbody></table>");
    });
}

/// A row of the table of statistics: key in the table of words, digits beyond the scale's, signed, number and reason.
type Row = (&'static str, usize, bool, fn(&Statistics) -> (Option<f64>, Option<&str>));

const ROWS: [Row; 14] = [
    ("mean", 1, true, |s| (s.mean, s.mean_reason.as_deref())),
    ("std_dev", 1, false, |s| (s.std_dev, s.std_dev_reason.as_deref())),
    ("rms", 1, false, |s| (s.rms, s.rms_reason.as_deref())),
    ("mean_abs", 1, false, |s| (s.mean_abs, s.mean_abs_reason.as_deref())),
    ("min", 0, true, |s| (s.min, s.min_reason.as_deref())),
    ("max", 0, true, |s| (s.max, s.max_reason.as_deref())),
    ("range_width", 0, false, |s| (s.range, s.range_reason.as_deref())),
    ("median", 1, true, |s| (s.median, s.median_reason.as_deref())),
    ("p5", 0, true, |s| (s.percentiles.p5, None)),
    ("p95", 0, true, |s| (s.percentiles.p95, None)),
    ("six_sigma", 1, false, |s| (s.six_sigma, s.six_sigma_reason.as_deref())),
    ("cv", 0, false, |s| (s.cv, s.cv_reason.as_deref())),
    ("skewness", 0, true, |s| (s.skewness, s.skewness_reason.as_deref())),
    ("kurtosis", 0, true, |s| (s.kurtosis, s.kurtosis_reason.as_deref())),
];

/// Digits after the decimal sign with which a number fits its column: from a thousand on six in all.
fn column_digits(value: Option<f64>, wanted: usize) -> usize {
    match value.map_or(0.0, f64::abs) {
        size if size < 1e3 => wanted,
        size if size < 1e4 => wanted.min(2),
        size if size < 1e5 => wanted.min(1),
        _ => 0,
    }
}

/// How many of the regions pass.
pub fn passing(h: &mut Html, c: &Comparison) {
    let pass = c.regions.iter().filter(|r| r.verdict == Verdict::Pass).count();
    h.count(pass as u64).raw(" <small>/\u{a0}").count(c.regions.len() as u64).raw("</small>");
}

/// The regions with their tolerances, shares and verdicts, and all other points.
pub fn regions(h: &mut Html, c: &Comparison, decimals: usize) {
    if c.regions.is_empty() {
        return;
    }
    section(h, "regions", |h| {
        h.raw("<table class=\"statistics\"><thead><tr><th>").word("region").raw("</th><th class=\"r\">");
        h.word("tolerance").raw("</th><th class=\"r\">").word("points").raw("</th><th class=\"r\">");
        h.word("within.short").raw("</th><th></th></tr></thead><tbody>");
        let mut row = |name: Option<&str>, t: &ToleranceShares, points: u64, verdict: Option<Verdict>| {
            h.raw("<tr><th scope=\"row\">");
            match name {
                Some(name) => h.name(name),
                None => h.word("regions.others"),
            };
            h.raw("</th><td class=\"r\">").number(t.lower, decimals, true).raw("\u{2009}…\u{2009}");
            h.number(t.upper, decimals, true).raw("</td><td class=\"r\">").count(points);
            h.raw("</td><td class=\"r\">").optional_percent(t.inside, t.inside_reason.as_deref(), 2);
            h.raw("</td><td>");
            if let Some(verdict) = verdict {
                badge(h, verdict.into());
            }
            h.raw("</td></tr>");
        };
        for r in &c.regions {
            row(Some(&r.id), &r.tolerance, r.deviation.count, Some(r.verdict));
        }
        if let Some(t) = &c.tolerance {
            let rest = c.deviation.all.count - c.regions.iter().map(|r| r.deviation.count).sum::<u64>();
            let of = |share| if share >= t.required { Verdict::Pass } else { Verdict::Fail };
            row(None, t, rest, t.inside.map(of));
        }
        h.raw("</tbody></table><p class=\"note\">").word("regions.means").raw("</p>");
    });
}

pub fn statistics(h: &mut Html, c: &Comparison, decimals: usize) {
    section(h, "statistics", |h| {
        in_words(h, c);
        by_side(h, &c.deviation, decimals);
    });
}

/// The statistics of all deviations and of each side, as a table.
pub fn by_side(h: &mut Html, deviation: &BySide, decimals: usize) {
    let sides = [&deviation.all, &deviation.positive, &deviation.negative];
    h.raw("<table class=\"statistics\"><thead><tr><th></th><th class=\"r\">").word("all");
    h.raw("</th><th class=\"r\">")
        .word("plus")
        .raw("</th><th class=\"r\">")
        .word("minus")
        .raw("</th></tr></thead><tbody>");
    h.raw("<tr><th scope=\"row\">").word("points").raw("</th>");
    for s in sides {
        h.raw("<td class=\"r\">").count(s.count).raw("</td>");
    }
    h.raw("</tr>");
    for (key, more, signed, of) in ROWS {
        h.raw("<tr><th scope=\"row\">").word(key).raw("</th>");
        for s in sides {
            let (value, reason) = of(s);
            let digits = column_digits(value, decimals + more);
            h.raw("<td class=\"r\">").optional(value, reason, digits, signed).raw("</td>");
        }
        h.raw("</tr>");
    }
    h.raw("</tbody></table>");
}

/// What the numbers rest on: the points left out, the sign, the reference's soundness.
fn trust(h: &mut Html, result: &CompareDocument, c: &Comparison) {
    section(h, "trust", |h| {
        h.raw("<dl class=\"facts\">");
        fact(h, "excluded", |h| {
            excluded(h, c, result.measured.count);
            if let Some(d) = result.max_distance {
                h.raw(" (> ").number(d, 1, false).raw("\u{a0}mm)");
            }
        });
        if let Some(angle) = result.facing {
            fact(h, "facing", |h| {
                h.raw("≤\u{a0}").number(angle.to_degrees(), 1, false).raw("°");
            });
        }
        rules(h, c, result.scale.decimals as usize);
        for warning in &c.warnings {
            fact(h, warning_key(warning.kind), |h| {
                h.raw("<strong class=\"warning\">⚠ ")
                    .number(warning.value, 3, false)
                    .raw("</strong><br><small>");
                h.text(&warning.text).raw("</small>");
            });
        }
        fact(h, "sign.method", |h| sign(h, &c.sign));
        if c.surfaces.is_none() {
            fact(h, "soundness", |h| soundness(h, c));
        }
        if let Some(p) = &c.paper_vs_exact {
            fact(h, "paper_differs", |h| {
                h.count(p.differing)
                    .raw(" / ")
                    .count(p.count)
                    .raw(", ≤ ")
                    .number(p.max_difference, 4, false)
                    .raw("\u{a0}mm");
            });
        }
        h.raw("</dl>");
    });
}

/// How many of `all` points are left out, by reason.
pub fn excluded(h: &mut Html, c: &Comparison, all: u64) {
    h.count(c.excluded.values().sum()).raw(" / ").count(all);
    for (reason, count) in c.excluded.iter().filter(|(_, count)| **count > 0) {
        h.raw("<br>").word(&format!("reason.{}", known(reason))).raw(": ").count(*count);
    }
}

/// Along what the deviations are, and what the rules for outliers and coverage gave, where they were asked.
pub fn rules(h: &mut Html, c: &Comparison, decimals: usize) {
    if let Some(a) = &c.along {
        fact(h, "along", |h| along(h, a));
    }
    if let Some(o) = &c.outliers {
        fact(h, "outliers", |h| outliers(h, o, decimals));
    }
    if let Some(covered) = &c.coverage {
        fact(h, "uncovered", |h| uncovered(h, covered));
    }
}

/// Along what lines deviations are.
fn along(h: &mut Html, a: &AlongRecord) {
    match a.direction {
        Some(d) => {
            for (n, x) in d.into_iter().enumerate() {
                h.raw(if n > 0 { "; " } else { "" }).number(x, 4, false);
            }
        }
        None => {
            let key = if a.kind == "reference" { "along.reference" } else { "along.measured" };
            h.word(key);
        }
    }
    h.raw("<br><small>").word("along.means").raw("</small>");
}

/// A rule for outliers, and the limits that it gave.
fn outliers(h: &mut Html, o: &OutliersRecord, decimals: usize) {
    h.text(&o.rule).raw(": ").count(o.count);
    match (o.lower, o.upper) {
        (Some(lower), Some(upper)) => {
            h.raw(" (< ").number(lower, decimals + 1, true).raw(", > ").number(upper, decimals + 1, true);
            h.raw("\u{a0}mm)");
        }
        _ => {
            h.raw("<br><small>").text(o.limits_reason.as_deref().unwrap_or_default()).raw("</small>");
        }
    }
}

/// What part of the reference no point covers: grey in the map.
fn uncovered(h: &mut Html, c: &CoverageRecord) {
    h.optional_percent(c.uncovered_share, c.uncovered_share_reason.as_deref(), 2).raw(" (");
    h.number(c.uncovered, 1, false).raw(" / ").number(c.area, 1, false).raw("\u{a0}mm²)<br><small>");
    h.word("reason.not_measured").raw(" (≤\u{a0}").number(c.reach, 2, false).raw("\u{a0}mm)</small>");
}

const REASONS: [&str; 7] =
    ["max_distance", "free_edge", "not_measured", "facing", "outlier", "no_crossing", "no_direction"];

/// The reasons that the table of words knows.
fn known(reason: &str) -> &str {
    if REASONS.contains(&reason) { reason } else { "excluded" }
}

fn sign(h: &mut Html, s: &SignRecord) {
    h.word(&sign_key(s)).raw("<br><small>").text(&s.reason).raw("</small>");
    if let Some(share) = s.disagreement {
        h.raw("<br><small>").word("disagreement").raw(": ").percent(share, 3).raw("</small>");
    }
}

fn soundness(h: &mut Html, c: &Comparison) {
    let s = &c.soundness;
    if s.sound {
        h.raw("✓ ").word("sound");
        return;
    }
    h.raw("<strong class=\"warning\">⚠ ").word("not_sound").raw("</strong>");
    let counts = [
        ("boundary_edges", s.boundary_edges),
        ("non_manifold_edges", s.non_manifold_edges),
        ("non_manifold_vertices", s.non_manifold_vertices),
        ("duplicate_facets", s.duplicate_facets),
        ("degenerate_facets", s.degenerate_facets),
        ("inconsistent_edges", s.inconsistent_edges),
    ];
    for (key, count) in counts.into_iter().filter(|(_, count)| *count > 0) {
        h.raw("<br>").word(key).raw(": ").count(count);
    }
    h.raw("<br><small>").word("not_sound.means").raw("</small>");
}
