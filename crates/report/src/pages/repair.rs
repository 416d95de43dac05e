//! The page of a repair: what was changed and where, the mesh before and after, and what it cost.

use crate::headline::{Headline, Tone};
use crate::number::Style;
use crate::page::parts::{fact, holds, key_number, line, mm, section, swatch};
use crate::page::table::{Row, listed, not_printed, places, row_class, table};
use crate::pages::check::size_decimals;
use crate::subject::{Content, Pick, Subject};
use crate::text::word;
use crate::values::{Name, Text};
use crate::views::repair::{GONE, NEW, by_step};
use maud::{Markup, Render, html};
use std::collections::BTreeSet;
use trueness_document::InputRecord;
use trueness_document::repair::{Change, Distances, RepairDocument, State};
use trueness_document::scale::palette::category;

/// Rows of a step, at most.
const MAX_LISTED_CHANGES: usize = 100;
/// Half of what is brought into view around a change, as a share of the model's diagonal.
const REACH_PER_SIZE: f64 = 0.02;

impl Subject for RepairDocument {
    fn content(&self, s: Style) -> serde_json::Result<Content<'_>> {
        Ok(Content {
            picture: "picture.repair",
            numbers: numbers(s, self),
            list: html! {
                (section(s, "changes", changes(s, self)))
                (section(s, "before_after", states(s, self)))
                (section(s, "deviation.introduced", deviation(s, self)))
            },
            method: html! {
                p { (s.word("method.repair.text")) }
                p { (s.word("method.repair.file")) " " (Name(&self.output.path)) }
            },
            how: line(s, ["method.repair"]),
            json: serde_json::to_value(self)?,
            ..Content::of(headline(self), [&self.schema, &self.version, &self.units], &self.inputs)
        })
    }

    fn picks(&self) -> Vec<Pick> {
        let mut first = 0;
        let mut picks = vec![];
        for (_, changes) in by_step(self) {
            let rows = changes.iter().take(MAX_LISTED_CHANGES).enumerate();
            // Sizes are lengths, areas or volumes: none says how much to show.
            picks.extend(rows.map(|(n, c)| Pick {
                position: c.position,
                reach: Some(REACH_PER_SIZE * self.before.area.max(0.0).sqrt()),
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
            changes.into_iter().take(MAX_LISTED_CHANGES).map(|c| c.facets).collect::<Vec<_>>()
        };
        let facets: Vec<u64> = by_step(self).into_iter().flat_map(listed).collect();
        let mut order: Vec<usize> = (0..picks.len().min(facets.len())).collect();
        order.sort_by_key(|n| std::cmp::Reverse(facets[*n]));
        order
    }
}

fn headline(d: &RepairDocument) -> Headline {
    let (key, tone) = match (d.sound, d.change_count) {
        (true, 0) => ("nothing_to_repair", Tone::Pass),
        (true, _) => ("repaired", Tone::Pass),
        (false, _) if d.after.sound && d.effect.changed => ("closed_but_changed", Tone::Fail),
        (false, _) if d.inputs.iter().any(InputRecord::lacks_faces) => ("incomplete_model", Tone::Fail),
        (false, _) => ("not_repaired", Tone::Fail),
    };
    Headline { key, tone }
}

fn numbers(s: Style, d: &RepairDocument) -> Markup {
    // Of the surface that bounds: what goes inside of a body changes no part. The list has both.
    let introduced = d.deviation.as_ref().map(|d| d.added.max.max(d.removed.max));
    html! {
        dl.key-numbers {
            (key_number(s, "changes", "lead", s.count(d.change_count)))
            (key_number(s, "facets.added", "", s.count(d.facets.added)))
            (key_number(s, "facets.removed", "", s.count(d.facets.removed)))
            (key_number(s, "vertices.moved", "", s.count(d.vertices.moved)))
            @if let Some(d) = d.effect.surface.or(introduced) {
                (key_number(s, "deviation.introduced", "", length(s, d)))
            }
            @if let Some(change) = d.effect.volume_change {
                (key_number(s, "volume.change", if d.effect.changed { "warn" } else { "" }, html! {
                    (s.number(change, 3).signed()) "\u{a0}mm³"
                }))
            }
            @match d.output.sound {
                Some(sound) => (holds(s, "file.written", sound, ["sound.short", "not_sound"])),
                None => (key_number(s, "file.written", "", "–")),
            }
        }
    }
}

fn length(s: Style, x: f64) -> Markup {
    mm(s.number(x, size_decimals(x)))
}

fn changes(s: Style, d: &RepairDocument) -> Markup {
    let steps = by_step(d);
    // The places of a step have its color, the facets that came and went have their own.
    let came_and_went = [(d.facets.added, NEW, "facets.new"), (d.facets.removed, GONE, "facets.gone")];
    let starts = steps.iter().scan(0, |next, (_, changes)| {
        let start = *next;
        *next += changes.len().min(MAX_LISTED_CHANGES);
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
    let shown = changes.len().min(MAX_LISTED_CHANGES);
    let rows = changes.iter().take(shown).enumerate().map(|(k, change)| {
        let name = if same {
            html! { (k + 1) }
        } else {
            done(s, &change.what)
        };
        Row::at(s, &name, &s.count(change.facets), change.position).pick(first + k).class(row_class(k))
    });
    html! {
        // What is the same in every row is said once.
        @if same { p.note { (done(s, what)) } }
        (places(s, "facets.title", rows))
        (not_printed(s, shown))
        (listed(s, "listed.first", shown, changes.len() as u64))
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
        let [before, after] = [&d.before, &d.after].map(cell);
        Row::of(&[&s.word(key), &before, &after]).named()
    };
    let yes = |yes: bool| html! { (if yes { "✓\u{a0}" } else { "✕\u{a0}" }) (s.word(if yes { "yes" } else { "no" })) };
    let bodies = |state| match std::ptr::eq(state, &d.before) {
        true => d.effect.bodies_before,
        false => d.effect.bodies_after,
    };
    let volume = |state: &State| s.optional(state.volume, 2).because(state.volume_reason.as_deref()).render();
    let sizes = [
        row("sound.title", &|state| yes(state.sound)),
        row("closed", &|state| yes(state.closed)),
        row("facets.title", &|state| s.count(state.facets).render()),
        row("vertices.title", &|state| s.count(state.vertices).render()),
        row("shells", &|state| s.count(state.shells).render()),
        row("bodies", &|state| s.count(bodies(state)).render()),
        row("area.mm2", &|state| s.number(state.area, 2).render()),
        row("volume.mm3", &volume),
    ];
    let kinds: BTreeSet<&String> = d.before.defects.keys().chain(d.after.defects.keys()).collect();
    let defects = kinds.into_iter().map(|kind| {
        row(&format!("defect.{kind}"), &|state| {
            let count = s.count(state.defects.get(kind).copied().unwrap_or(0));
            html! { @if state.at_least.contains(kind) { "≥ " } (count) }
        })
    });
    table(s, "states", [&[""], &["before", "after"]], sizes.into_iter().chain(defects))
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
                (fact(s, "file.rounding", html! { "≤\u{a0}" (mm(s.scientific(d.output.rounding, 1))) }))
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
