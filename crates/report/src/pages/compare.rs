//! The page of a comparison: deviations, worst places, statistics.

pub mod faces;
mod list;

pub use list::{
    OUTSIDE, because, by_side, excluded, listed_worst, passing, reasons, regions, rules, statistics, worst,
};

use crate::headline::{Headline, Tone};
use crate::number::Style;
use crate::page::parts::{extent, holds, inside, key_number, most, paragraphs, range};
use crate::pages::align::{Facts, chip};
use crate::pages::check;
use crate::subject::{Content, Map, Pick, Subject};
use list::{sign_key, warning_key};
use maud::{Markup, html};
use trueness_document::ReasonKind;
use trueness_document::align::AlignedTo;
use trueness_document::compare::{CompareDocument, Comparison, MeasuredKind, Method, Worst};
use trueness_document::scale::Scale;
use trueness_measure::check::found;

impl Subject for CompareDocument {
    fn content(&self, s: Style) -> serde_json::Result<Content<'_>> {
        let (digits, aligned) = (self.scale.decimals as usize, self.alignment.as_ref());
        let all = self.comparisons.iter().enumerate();
        // Without a tolerance there is no verdict.
        let headline = Headline { key: "not_judged", tone: Tone::Neutral };
        let headline = self.verdict.map_or(headline, Headline::from);
        let is_paper = *self.method == Method::Paper;
        let text = if is_paper { "method.paper.text" } else { "method.exact.text" };
        // The map is one of points, if they were not a mesh's own vertices.
        let points = (*self.measured.kind != MeasuredKind::Vertices).then_some("method.points.text");
        Ok(Content {
            convention: Some("sign.short"),
            picture: "picture.alt",
            numbers: html! { @for (n, c) in all { (numbers(s, (c, n), digits, aligned)) } },
            list: list::list(s, self),
            method: paragraphs(s, [text, "method.sign.text", "method.map.text"].into_iter().chain(points)),
            how: html! {
                (s.word(if is_paper { "method.paper" } else { "method.exact" })) " · "
                (s.word("sign.method")) ": " (s.word(sign_key(&self.sign)))
            },
            points: Some(self.measured.count),
            seed: Some(self.seed),
            json: serde_json::to_value(self)?,
            ..Content::of(headline, [&self.schema, &self.version, &self.units], &self.inputs)
        })
    }

    fn scale(&self) -> Option<&Scale> {
        Some(&self.scale)
    }

    fn maps(&self) -> Vec<Map<'_>> {
        self.comparisons.iter().map(map).collect()
    }

    fn picks(&self) -> Vec<Pick> {
        let decimals = self.scale.decimals as usize;
        let mut first_mark = 0;
        let mut picks = vec![];
        for (n, c) in self.comparisons.iter().enumerate() {
            let map = Some(n);
            picks.extend(listed_worst(c, decimals).iter().map(|w| pick(w, n)));
            let found = found(&c.soundness.findings);
            picks.extend(check::picks(&found, first_mark).into_iter().map(|p| Pick { map, ..p }));
            first_mark += found.iter().map(|(_, d)| d.items.len()).sum::<usize>();
        }
        picks
    }
}

/// The map of a comparison.
pub fn map(c: &Comparison) -> Map<'_> {
    let all = &c.deviation.all;
    // Where several tolerances hold, no band of the map shows what is within them.
    let tolerance = c.tolerance.clone().filter(|_| c.regions.is_empty());
    let histogram = c.histogram.as_ref();
    Map { name: &c.reference, count: all.count, mean: all.mean, tolerance, histogram, ..Map::default() }
}

/// One of the worst places of comparison `n`.
pub fn pick(w: &Worst, n: usize) -> Pick {
    let (value, surface) = (Some(w.deviation), Some(w.nearest));
    Pick { position: w.point, surface, normal: w.normal, map: Some(n), value, ..Pick::default() }
}

/// The line of key numbers for one comparison; the script shows the one chosen.
fn numbers(s: Style, (c, n): (&Comparison, usize), decimals: usize, aligned: Option<&AlignedTo>) -> Markup {
    let all = &c.deviation.all;
    let excluded: u64 = c.excluded.values().sum();
    html! {
        dl.key-numbers data-comparison=(n) hidden[n > 0] {
            (lead(s, c, decimals))
            (because(s, &c.verdict_reasons))
            @if let Some((covered, required)) = c.coverage.as_ref().and_then(|k| Some((k, k.required?))) {
                @let short = c.verdict_reasons.iter().any(|r| r.kind.0 == ReasonKind::Coverage);
                (key_number(s, "coverage", if short { "warn" } else { "" }, html! {
                    (s.optional_percent(covered.covered_share(), 1).because(covered.uncovered_share_reason.as_deref()))
                    @if required > 0.0 { " " small { "(≥\u{a0}" (s.percent(required, 0)) ")" } }
                }))
            }
            (key_number(s, "range", "", extent(s, all, decimals)))
            (key_number(s, "mean", "", s.optional(all.mean, decimals + 1).signed().because(all.mean_reason.as_deref())))
            (key_number(s, "std_dev", "", s.optional(all.std_dev, decimals + 1).because(all.std_dev_reason.as_deref())))
            (key_number(s, "points", "", s.count(all.count)))
            (key_number(s, "excluded", if excluded > 0 { "warn" } else { "" }, s.count(excluded)))
            (key_number(s, "sign.method", "", s.word(sign_key(&c.sign))))
            (holds(s, "soundness", c.soundness.sound, ["sound.short", "not_sound"]))
            @if let Some(chip) = aligned.and_then(|a| chip(s, &Facts::of_best_fit(a), decimals + 1)) { (chip) }
            @for warning in &c.warnings {
                (key_number(s, warning_key(warning.kind), "warn", html! { "⚠\u{a0}" (s.number(warning.value, 3)) }))
            }
        }
    }
}

/// How many points keep to the tolerance; without one, between what most of them lie.
fn lead(s: Style, c: &Comparison, decimals: usize) -> Markup {
    let limit = |x| s.number(x, decimals).signed();
    html! {
        @match &c.tolerance {
            _ if !c.regions.is_empty() => (key_number(s, "regions.pass", "lead", passing(s, c))),
            Some(t) => {
                (key_number(s, "within", "lead", inside(s, t)))
                (key_number(s, "tolerance", "", range(limit(t.lower), limit(t.upper))))
                @if t.required < 1.0 {
                    (key_number(s, "required", "", html! { "≥\u{a0}" (s.percent(t.required, 2)) }))
                }
            }
            None => (key_number(s, "most_within", "lead", most(s, &c.deviation.all, decimals, true))),
        }
    }
}
