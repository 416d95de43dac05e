//! The list beside the stage: ranking, worst places, statistics, what was left out, how far the numbers can be trusted, files.

use super::faces::faces;
use crate::NoValue;
use crate::number::Style;
use crate::page::parts::{badge, fact, file_name, inside, key_number, mm, range, section, series, warning};
use crate::page::table::{self, Row, table};
use crate::pages::align::{Facts, alignment};
use crate::pages::check;
use crate::values::{Name, Text};
use maud::{Markup, Render, html};
use std::iter;
use trueness_document::compare::{
    AlongKind, AlongRecord, BySide, CompareDocument, Comparison, CoverageRecord, OutliersRecord, SignRecord,
    Statistics, ToleranceShares, WarningKind, Worst,
};
use trueness_document::statistics::PAGE_ROWS;
use trueness_document::{Verdict, VerdictReason};
use trueness_measure::check::found;

/// The worst places that have a row and a flag: none where all would read zero.
pub fn listed_worst(c: &Comparison, decimals: usize) -> &[Worst] {
    if c.worst.iter().all(|w| shows_zero(w.deviation, decimals)) { &[] } else { &c.worst }
}

/// Whether a number with so many digits after the point reads zero.
fn shows_zero(value: f64, decimals: usize) -> bool {
    !format!("{value:.decimals$}").bytes().any(|b| (b'1'..=b'9').contains(&b))
}

/// All sections.
pub fn list(s: Style, result: &CompareDocument) -> Markup {
    // Rows lead to the worst places, then to the defects, comparison by comparison.
    let found: Vec<_> = result.comparisons.iter().map(|c| found(&c.soundness.findings)).collect();
    let decimals = result.scale.decimals as usize;
    let starts = result.comparisons.iter().zip(&found).scan(0, |next, (c, found)| {
        let start = *next;
        *next += listed_worst(c, decimals).len() + check::picks(found, 0).len();
        Some(start)
    });
    let several = result.comparisons.len() > 1;
    html! {
        @if several { (ranking(s, result)) }
        @for (n, ((c, found), first)) in result.comparisons.iter().zip(&found).zip(starts).enumerate() {
            div.comparison data-comparison=(n) hidden[n > 0] {
                "\n"
                @if several { p.against { (s.word("reference")) " " (Name(file_name(&c.reference))) } }
                (reasons(s, &c.verdict_reasons))
                (worst(s, c, decimals, first)) (regions(s, c, decimals)) (statistics(s, c, decimals))
                (faces(s, c, decimals)) (trust(s, result, c))
                @if !found.is_empty() {
                    (section(s, "reference.defects", check::kinds(s, found, first + listed_worst(c, decimals).len())))
                }
            }
            "\n"
        }
        @if let Some(a) = &result.alignment {
            (alignment(s, &Facts::of_best_fit(a)))
        }
    }
}

/// Why a verdict is not a pass, in few words, for the head of a page; nothing where there is no reason.
pub fn because(s: Style, reasons: &[VerdictReason]) -> Markup {
    // Several regions may have the same.
    let mut kinds: Vec<_> = reasons.iter().map(|reason| &reason.kind).collect();
    kinds.dedup();
    html! {
        @if !kinds.is_empty() {
            (key_number(s, "because", "warn", html! {
                @for (n, kind) in kinds.into_iter().enumerate() {
                    @if n > 0 { ", " }
                    (s.word(format!("because.{kind}")))
                }
            }))
        }
    }
}

/// The same in sentences, for the list.
pub fn reasons(s: Style, reasons: &[VerdictReason]) -> Markup {
    match reasons {
        [] => Markup::default(),
        all => section(s, "because", html! { @for reason in all { (warning(Text(&reason.text))) } }),
    }
}

/// Several references side by side, the nearest first.
fn ranking(s: Style, result: &CompareDocument) -> Markup {
    let decimals = result.scale.decimals as usize + 1;
    let mut order: Vec<usize> = (0..result.comparisons.len()).collect();
    order.sort_by_key(|i| result.comparisons[*i].rank);
    let rows = order.into_iter().map(|i| {
        let c = &result.comparisons[i];
        let all = &c.deviation.all;
        let rms = s.optional(all.rms, decimals).because(all.rms_reason.as_deref());
        let judged = html! {
            @match (&c.tolerance, c.verdict) {
                (_, Some(v)) if !c.regions.is_empty() => { (badge(s, v.into())) " " (passing(s, c)) }
                (Some(t), Some(v)) => { (badge(s, v.into())) " " (inside(s, t)) }
                _ => "–",
            }
        };
        Row::of(&[&c.rank, &Name(file_name(&c.reference)), &rms, &judged]).choose(i)
    });
    let columns: [&[&str]; 2] = [&["", "reference"], &["rms", "within.short"]];
    section(s, "ranking", html! { (table(s, "choose", columns, rows)) (paired(s, result)) })
}

/// Whether the better reference is better by more than chance.
fn paired(s: Style, result: &CompareDocument) -> Markup {
    let length = |x: f64| s.number(x, result.scale.decimals as usize + 2);
    let name = |i: usize| Name(result.comparisons.get(i).map_or("", |c| file_name(&c.reference)));
    html! {
        @for (p, mean) in result.paired.iter().filter_map(|p| Some((p, p.mean_difference?))) {
            p.note {
                (name(p.better)) " " (s.word("nearer_than")) " " (name(p.other)) " " (s.word("by")) " "
                (mm(length(mean.abs())))
                @if let Some([l, u]) = p.interval { " (95\u{a0}%: " (range(length(-u), length(-l))) ")" }
            }
        }
    }
}

/// The worst places; nothing where there are none.
pub fn worst(s: Style, c: &Comparison, decimals: usize, first_pick: usize) -> Markup {
    let places = listed_worst(c, decimals);
    if places.is_empty() {
        return Markup::default();
    }
    // Each by the tolerance of its own region.
    let outside = |w: &Worst| {
        let region = w.region.as_ref().and_then(|id| c.regions.iter().find(|r| r.id == *id));
        let zone = region.map(|r| &r.tolerance).or(c.tolerance.as_ref());
        zone.is_some_and(|t| w.deviation > t.upper || w.deviation < t.lower)
    };
    let rows = places.iter().enumerate().map(|(n, w)| {
        let row = Row::at(s, &(n + 1), &s.number(w.deviation, decimals).signed(), w.point);
        row.pick(first_pick + n).class(outside(w).then_some("out"))
    });
    section(s, "worst", table::places(s, "deviation", rows))
}

/// Digits after the decimal sign with which a number fits its column: from a thousand on six in all.
fn column_digits(value: Option<f64>, wanted: usize) -> usize {
    match value.map_or(0, |x| x.abs() as u64).checked_ilog10() {
        None | Some(0..=2) => wanted,
        Some(power) => wanted.min(5_usize.saturating_sub(power as usize)),
    }
}

/// How many of the regions pass.
pub fn passing(s: Style, c: &Comparison) -> Markup {
    let pass = c.regions.iter().filter(|r| r.verdict == Verdict::Pass).count();
    html! { (s.count(pass as u64)) " " small { "/\u{a0}" (s.count(c.regions.len() as u64)) } }
}

/// The regions with their tolerances, shares and verdicts, and all other points; nothing where there are none.
pub fn regions(s: Style, c: &Comparison, decimals: usize) -> Markup {
    if c.regions.is_empty() {
        return Markup::default();
    }
    let limit = |x| s.number(x, decimals).signed();
    let row = |name: &dyn Render, t: &ToleranceShares, points: u64, verdict: Option<Verdict>| {
        html! {
            tr {
                th scope="row" { (name) }
                td.r { (limit(t.lower)) br; (limit(t.upper)) }
                td.r { (s.count(points)) }
                td.r { (inside(s, t)) }
                td { @if let Some(verdict) = verdict { (badge(s, verdict.into())) } }
            }
        }
    };
    let rest = c.deviation.all.count - c.regions.iter().map(|r| r.deviation.count).sum::<u64>();
    let body = html! {
        table.statistics {
            thead {
                tr {
                    th { (s.word("region")) } th.r { (s.word("tolerance")) } th.r { (s.word("points")) }
                    th.r { (s.word("within.short")) } th {}
                }
            }
            tbody {
                @for r in &c.regions { (row(&Name(&r.id), &r.tolerance, r.deviation.count, Some(r.verdict))) }
                @if let Some(t) = &c.tolerance { (row(&s.word("regions.others"), t, rest, c.others_verdict)) }
            }
        }
        p.note { (s.word("regions.means")) }
    };
    section(s, "regions", body)
}

/// The map in one sentence, for those who cannot see it.
fn in_words(s: Style, c: &Comparison) -> Markup {
    let tolerance = c.tolerance.as_ref().filter(|_| c.regions.is_empty());
    let shares = tolerance.and_then(|t| Some([t.inside?, t.above?, t.below?]));
    html! {
        @if let Some(shares) = shares {
            p.words {
                @for (n, (key, share)) in ["within", "above", "below"].into_iter().zip(shares).enumerate() {
                    @if n > 0 { " · " } (s.word(key)) " " (s.percent(share, 2))
                }
            }
        }
    }
}

/// The deviations in words and numbers.
pub fn statistics(s: Style, c: &Comparison, decimals: usize) -> Markup {
    section(s, "statistics", html! { (in_words(s, c)) (by_side(s, &c.deviation, decimals, OUTSIDE)) })
}

/// With more decimals than this three numbers fill the column.
const MAX_DECIMALS_BESIDE_NAMES: usize = 4;

/// Words for the sides of a surface.
pub const OUTSIDE: [&str; 2] = ["plus", "minus"];

/// The statistics of all deviations and of each side, as a table.
pub fn by_side(s: Style, deviation: &BySide, decimals: usize, [plus, minus]: [&str; 2]) -> Markup {
    let sides = [&deviation.all, &deviation.positive, &deviation.negative];
    let row = |key: &'static str, cell: &dyn Fn(&Statistics) -> Markup| {
        let [all, above, below] = sides.map(cell);
        Row::of(&[&s.word(key), &all, &above, &below]).named()
    };
    let points = row("points", &|side| s.count(side.count).render());
    let others = PAGE_ROWS.map(|(key, more, signed, of)| {
        row(key, &|side| {
            let (value, reason) = of(side);
            let value = s.optional(value, column_digits(value, decimals + more)).with_sign(signed);
            value.because(reason).render()
        })
    });
    // Names stand above three numbers that fill the column.
    let class = if decimals > MAX_DECIMALS_BESIDE_NAMES { "statistics quantities" } else { "statistics" };
    table(s, class, [&[""], &["all", plus, minus]], iter::once(points).chain(others))
}

/// What the numbers rest on: the points left out, the sign, the reference's soundness.
fn trust(s: Style, result: &CompareDocument, c: &Comparison) -> Markup {
    let body = html! {
        dl.facts {
            (fact(s, "excluded", html! {
                (excluded(s, c, result.measured.count))
                @if let Some(d) = result.max_distance { " (> " (mm(s.number(d, 1))) ")" }
            }))
            @if let Some(angle) = result.facing {
                (fact(s, "facing", html! { "≤\u{a0}" (s.number(angle.to_degrees(), 1)) "°" }))
            }
            (rules(s, c, result.scale.decimals as usize))
            @for warning in &c.warnings {
                (fact(s, warning_key(warning.kind), html! {
                    strong.warning { "⚠ " (s.number(warning.value, 3)) } br; small { (Text(&warning.text)) }
                }))
            }
            (fact(s, "sign.method", sign(s, &c.sign)))
            @if c.surfaces.is_none() { (fact(s, "soundness", soundness(s, c))) }
            @if let Some(p) = &c.paper_vs_exact {
                (fact(s, "paper_differs", html! {
                    (s.count(p.differing)) " / " (s.count(p.count)) ", ≤ " (mm(s.number(p.max_difference, 4)))
                }))
            }
        }
    };
    section(s, "trust", body)
}

/// Key of how the sign was found, in a few words.
pub fn sign_key(sign: &SignRecord) -> String {
    format!("sign.by.{}", sign.method)
}

/// Key of a warning in a few words.
pub fn warning_key(kind: WarningKind) -> &'static str {
    match kind {
        WarningKind::SizeRatio => "warning.size_ratio",
        WarningKind::HardlyOverlapping => "warning.hardly_overlapping",
    }
}

/// How many of `all` points are left out, by reason.
pub fn excluded(s: Style, c: &Comparison, all: u64) -> Markup {
    html! {
        (s.count(c.excluded.values().sum())) " / " (s.count(all))
        @for (reason, count) in c.excluded.iter().filter(|(_, count)| **count > 0) {
            br; (s.word(format!("reason.{}", known(reason)))) ": " (s.count(*count))
        }
    }
}

/// Along what the deviations are, and what the rules for outliers and coverage gave, where they were asked.
pub fn rules(s: Style, c: &Comparison, decimals: usize) -> Markup {
    html! {
        @if let Some(a) = &c.along { (fact(s, "along", along(s, a))) }
        @if let Some(o) = &c.outliers { (fact(s, "outliers", outliers(s, o, decimals))) }
        @if let Some(covered) = &c.coverage { (fact(s, "uncovered", uncovered(s, covered))) }
    }
}

/// Along what lines deviations are.
fn along(s: Style, a: &AlongRecord) -> Markup {
    html! {
        @match *a.kind {
            AlongKind::Direction => { @if let Some(direction) = a.direction { (series(s, direction, "; ", 4)) } }
            AlongKind::Reference => { (s.word("along.reference")) }
            AlongKind::Measured => { (s.word("along.measured")) }
        }
        br; small { (s.word("along.means")) }
    }
}

/// A rule for outliers, and the limits that it gave.
fn outliers(s: Style, o: &OutliersRecord, decimals: usize) -> Markup {
    let limit = |x| s.number(x, decimals + 1).signed();
    html! {
        (Text(&o.rule)) ": " (s.count(o.count))
        @match (o.lower, o.upper) {
            (Some(lower), Some(upper)) => { " (< " (limit(lower)) ", > " (mm(limit(upper))) ")" }
            _ => { br; small { (Text(o.limits_reason.as_deref().unwrap_or_default())) } }
        }
    }
}

/// What part of the reference no point covers: gray in the map.
fn uncovered(s: Style, c: &CoverageRecord) -> Markup {
    html! {
        (s.optional_percent(c.uncovered_share, 2).because(c.uncovered_share_reason.as_deref()))
        " (" (s.number(c.uncovered, 1)) " / " (s.number(c.area, 1)) "\u{a0}mm²)"
        br; small { (s.word("reason.not_measured")) " (≤\u{a0}" (mm(s.number(c.reach, 2))) ")" }
    }
}

/// The reasons that the table of words knows.
fn known(reason: &str) -> &str {
    let known = NoValue::ALL.iter().any(|known| known.name() == reason);
    if known { reason } else { NoValue::Unknown.name() }
}

fn sign(s: Style, sign: &SignRecord) -> Markup {
    html! {
        (s.word(sign_key(sign))) br; small { (Text(&sign.reason)) }
        @if let Some(share) = sign.disagreement {
            br; small { (s.word("disagreement")) ": " (s.percent(share, 3)) }
        }
    }
}

fn soundness(s: Style, c: &Comparison) -> Markup {
    let found = &c.soundness;
    if found.sound {
        return html! { "✓ " (s.word("sound")) };
    }
    let counts = [
        ("boundary_edges", found.boundary_edges),
        ("non_manifold_edges", found.non_manifold_edges),
        ("non_manifold_vertices", found.non_manifold_vertices),
        ("duplicate_facets", found.duplicate_facets),
        ("degenerate_facets", found.degenerate_facets),
        ("inconsistent_edges", found.inconsistent_edges),
    ];
    html! {
        strong.warning { "⚠ " (s.word("not_sound")) }
        @for (key, count) in counts.into_iter().filter(|(_, count)| *count > 0) {
            br; (s.word(key)) ": " (s.count(count))
        }
        br; small { (s.word("not_sound.means")) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_fit_their_column() {
        let digits = |x| column_digits(Some(x), 4);
        assert_eq!([0.0, 0.5, 999.99, f64::NAN].map(digits), [4; 4]);
        assert_eq!([1e3, -9999.9, 1e4, 99_999.0, 1e5, 1e30].map(digits), [2, 2, 1, 1, 0, 0]);
        assert_eq!((column_digits(None, 3), column_digits(Some(2e3), 1)), (3, 1));
    }

    #[test]
    fn zero_is_what_reads_zero() {
        let zero = [(0.0, 3), (-0.0, 3), (3.2e-18, 3), (-0.00049, 3), (0.4, 0)];
        let other = [(0.00051, 3), (-0.001, 3), (0.6, 0), (10.0, 0), (1e-7, 7)];
        assert!(zero.into_iter().all(|(value, decimals)| shows_zero(value, decimals)));
        assert!(!other.into_iter().any(|(value, decimals)| shows_zero(value, decimals)));
    }
}
