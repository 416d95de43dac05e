//! The page of a repair: what was changed and where, the mesh before and after, and what it cost.

use crate::headline::{Headline, Tone};
use crate::number::Style;
use crate::page::parts::{
    fact, key_number, listed, not_printed, place_cells, place_heads, row_class, section, swatch,
};
use crate::subject::{Head, Pick, Subject};
use crate::text::word;
use crate::values::{Name, Text};
use crate::views::repair::{GONE, NEW, by_step};
use maud::{Markup, Render, html};
use serde_json::Value;
use std::collections::BTreeSet;
use trueness_document::repair::{Change, Distances, RepairDocument, State};
use trueness_document::scale::palette::category;

/// Rows of a step, at most.
const LISTED: usize = 100;
/// Half of what is brought into view around a change, as a share of the model's diagonal.
const AROUND: f64 = 0.02;

impl Subject for RepairDocument {
    fn head(&self) -> Head<'_> {
        Head { schema: &self.schema, version: &self.version, units: &self.units, inputs: &self.inputs }
    }

    fn headline(&self) -> Headline {
        match (self.sound, self.change_count) {
            (true, 0) => Headline { key: "nothing_to_repair", tone: Tone::Pass },
            (true, _) => Headline { key: "repaired", tone: Tone::Pass },
            (false, _) if self.after.sound && self.effect.changed => {
                Headline { key: "closed_but_changed", tone: Tone::Fail }
            }
            (false, _) => Headline { key: "not_repaired", tone: Tone::Fail },
        }
    }

    fn picture(&self) -> &'static str {
        "picture.repair"
    }

    fn numbers(&self, s: Style) -> Markup {
        // Of the surface that bounds: what goes inside of a body changes no part. The list has both.
        let introduced = self.deviation.as_ref().map(|d| d.added.max.max(d.removed.max));
        let warn = |warn: bool| if warn { "warn" } else { "" };
        html! {
            dl.key-numbers {
                (key_number(s, "changes", "lead", s.count(self.change_count)))
                (key_number(s, "facets.added", "", s.count(self.facets.added)))
                (key_number(s, "facets.removed", "", s.count(self.facets.removed)))
                (key_number(s, "vertices.moved", "", s.count(self.vertices.moved)))
                @if let Some(d) = self.effect.surface.or(introduced) {
                    (key_number(s, "deviation.introduced", "", length(s, d)))
                }
                @if let Some(change) = self.effect.volume_change {
                    (key_number(s, "volume.change", warn(self.effect.changed), html! {
                        (s.number(change, 3).signed()) "\u{a0}mm³"
                    }))
                }
                (key_number(s, "file.written", warn(self.output.sound == Some(false)), html! {
                    @match self.output.sound {
                        Some(true) => { "✓\u{a0}" (s.word("sound.short")) }
                        Some(false) => { "⚠\u{a0}" (s.word("not_sound")) }
                        None => "–",
                    }
                }))
            }
        }
    }

    fn list(&self, s: Style) -> Markup {
        html! {
            (section(s, "changes", changes(s, self)))
            (section(s, "before_after", states(s, self)))
            (section(s, "deviation.introduced", deviation(s, self)))
        }
    }

    fn method(&self, s: Style) -> Markup {
        html! {
            p { (s.word("method.repair.text")) }
            p { (s.word("method.repair.file")) " " (Name(&self.output.path)) }
        }
    }

    fn how(&self, s: Style) -> Markup {
        s.word("method.repair").render()
    }

    fn picks(&self) -> Vec<Pick> {
        let mut first = 0;
        let mut picks = vec![];
        for (_, changes) in by_step(self) {
            let rows = changes.iter().take(LISTED).enumerate();
            // Sizes are lengths, areas or volumes: none says how much to show.
            picks.extend(rows.map(|(n, c)| Pick {
                position: c.position,
                reach: Some(AROUND * self.before.area.max(0.0).sqrt()),
                mark: Some(first + n),
                ..Pick::default()
            }));
            first += changes.len();
        }
        picks
    }

    /// Those of the most facets.
    fn important(&self, picks: &[Pick]) -> Vec<usize> {
        let listed = |(_, changes): (_, Vec<&Change>)| {
            changes.into_iter().take(LISTED).map(|c| c.facets).collect::<Vec<_>>()
        };
        let facets: Vec<u64> = by_step(self).into_iter().flat_map(listed).collect();
        let mut order: Vec<usize> = (0..picks.len().min(facets.len())).collect();
        order.sort_by_key(|n| std::cmp::Reverse(facets[*n]));
        order
    }

    fn json(&self) -> serde_json::Result<Value> {
        serde_json::to_value(self)
    }
}

fn length(s: Style, x: f64) -> Markup {
    html! { (s.number(x, if x > 0.0 && x < 0.1 { 6 } else { 3 })) "\u{a0}mm" }
}

fn changes(s: Style, d: &RepairDocument) -> Markup {
    let steps = by_step(d);
    // The places of a step have its color, the facets that came and went have their own.
    let came_and_went = [(d.facets.added, NEW, "facets.new"), (d.facets.removed, GONE, "facets.gone")];
    let starts = steps.iter().scan(0, |next, (_, changes)| {
        let start = *next;
        *next += changes.len().min(LISTED);
        Some(start)
    });
    html! {
        @if steps.is_empty() { p { (s.word("changes.none")) } }
        @if came_and_went.iter().any(|(count, ..)| *count > 0) {
            p.note {
                @for (_, color, key) in came_and_went.into_iter().filter(|(count, ..)| *count > 0) {
                    (swatch(color)) " " (s.word(key)) " "
                }
            }
            "\n"
        }
        @for (n, ((of, changes), first)) in steps.iter().zip(starts).enumerate() {
            details.kind open[steps.len() == 1] {
                summary {
                    (swatch(category(n))) span.kind-name { (s.word(format!("step.{}", of.name()))) }
                    strong { (s.len(changes)) }
                }
                "\n" (step(s, changes, first))
            }
            "\n"
        }
        @if d.truncated { (listed(s, "listed.first", d.changes.len(), d.change_count)) }
    }
}

/// The changes of one step; the numbers of their rows begin at `first`.
fn step(s: Style, changes: &[&Change], first: usize) -> Markup {
    let what = changes.first().map_or("", |c| &c.what);
    let same = changes.iter().all(|c| c.what == what);
    html! {
        // What is the same in every row is said once.
        @if same { p.note { (done(s, what)) } }
        table.pick {
            thead { tr { th {} th.r { (s.word("facets.title")) } (place_heads()) } }
            tbody {
                @for (k, change) in changes.iter().take(LISTED).enumerate() {
                    tr data-pick=(first + k) class=[row_class(k)] {
                        td { @if same { (k + 1) } @else { (done(s, &change.what)) } }
                        td.r { (s.count(change.facets)) }
                        (place_cells(s, change.position))
                    }
                }
            }
        }
        (not_printed(s, changes.len().min(LISTED)))
        (listed(s, "listed.first", changes.len().min(LISTED), changes.len() as u64))
    }
}

/// What was done, in the reader's language; as the document says it where the table has no words for it.
fn done(s: Style, what: &str) -> Markup {
    let key = key(what);
    if word(&key, s.language) == key { Text(what).render() } else { s.word(key).render() }
}

/// Key of what was done in the table of words.
fn key(what: &str) -> String {
    format!("done.{}", what.replace(',', "").replace(' ', "_"))
}

/// Size and defects in two columns.
fn states(s: Style, d: &RepairDocument) -> Markup {
    let row = |key: &str, cell: &dyn Fn(&State) -> Markup| {
        html! {
            tr {
                th scope="row" { (s.word(key)) }
                @for state in [&d.before, &d.after] { td.r { (cell(state)) } }
            }
        }
    };
    let yes = |yes: bool| html! { (if yes { "✓\u{a0}" } else { "✕\u{a0}" }) (s.word(if yes { "yes" } else { "no" })) };
    let bodies = |state| match std::ptr::eq(state, &d.before) {
        true => d.effect.bodies_before,
        false => d.effect.bodies_after,
    };
    let kinds: BTreeSet<&String> = d.before.defects.keys().chain(d.after.defects.keys()).collect();
    html! {
        table.states {
            thead { tr { th {} th.r { (s.word("before")) } th.r { (s.word("after")) } } }
            tbody {
                (row("sound.title", &|state| yes(state.sound)))
                (row("closed", &|state| yes(state.closed)))
                (row("facets.title", &|state| s.count(state.facets).render()))
                (row("vertices.title", &|state| s.count(state.vertices).render()))
                (row("shells", &|state| s.count(state.shells).render()))
                (row("bodies", &|state| s.count(bodies(state)).render()))
                (row("area.mm2", &|state| s.number(state.area, 2).render()))
                (row("volume.mm3", &|state| {
                    s.optional(state.volume, 2).because(state.volume_reason.as_deref()).render()
                }))
                @for kind in kinds {
                    (row(&format!("defect.{kind}"), &|state| html! {
                        @if state.at_least.contains(kind) { "≥ " }
                        (s.count(state.defects.get(kind).copied().unwrap_or(0)))
                    }))
                }
            }
        }
    }
}

/// How far the surface went: what is missing, what was added.
fn deviation(s: Style, d: &RepairDocument) -> Markup {
    let Some(found) = &d.deviation else {
        return html! { p { "–\u{a0}" (Text(d.deviation_reason.as_deref().unwrap_or(""))) } };
    };
    let at_most = |Distances { max, mean }| {
        html! { "≤\u{a0}" (length(s, max)) br; small { (s.word("mean")) " " (length(s, mean)) } }
    };
    html! {
        dl.facts.pairs {
            (fact(s, "surface.added", at_most(found.added)))
            (fact(s, "surface.removed", at_most(found.removed)))
            @if let Some(surface) = d.effect.surface {
                (fact(s, "surface.bounding", html! { "≤\u{a0}" (length(s, surface)) }))
            }
            (fact(s, "change.limit", html! {
                (length(s, d.effect.surface_limit))
                @if let Some(limit) = d.effect.volume_limit { ", " (s.number(limit, 3)) "\u{a0}mm³" }
            }))
            @if d.output.rounded_vertices > 0 {
                (fact(s, "file.rounding", html! { "≤\u{a0}" (s.scientific(d.output.rounding, 1)) "\u{a0}mm" }))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::Language;
    use std::path::{Path, PathBuf};
    use trueness_solid::repair::STEPS;

    fn sources(folder: &Path) -> Vec<PathBuf> {
        let all = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path());
        all.flat_map(|p| if p.is_dir() { sources(&p) } else { vec![p] }).collect()
    }

    /// What the steps log: the text in each call of `log`, and in the branches that such a text is chosen from.
    fn logged() -> Vec<String> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../solid/src/repair");
        let mut all = vec![];
        for file in sources(&folder).iter().filter(|p| !p.ends_with("tests.rs")) {
            let text = std::fs::read_to_string(file).unwrap();
            for call in text.split(".log(").skip(1).chain(text.split("let what = match").skip(1)) {
                let statement = &call[..call.find(';').unwrap_or(call.len())];
                all.extend(statement.split('"').skip(1).step_by(2).map(str::to_string));
            }
        }
        all
    }

    #[test]
    fn every_step_and_what_it_does_has_words_in_every_language() {
        let phrases = logged();
        assert!(phrases.len() >= 20 && phrases.iter().any(|p| p == "facets inside the material removed"));
        let steps = STEPS.iter().map(|s| format!("step.{}", s.name));
        for key in steps.chain(phrases.iter().map(|p| key(p))) {
            for language in Language::ALL {
                assert_ne!(word(&key, language), key, "{language:?}");
            }
        }
    }
}
