//! The page of a check: sound or not, what the mesh is, and every kind of defect with its places.

use crate::headline::{Headline, Tone};
use crate::number::Style;
use crate::page::parts::{fact, holds, key_number, line, mm, paragraphs, section, series, swatch};
use crate::page::table::{Row, listed, not_printed, places, row_class};
use crate::subject::{Content, Pick, Subject};
use crate::values::Text;
use maud::{Markup, Render, html};
use trueness_document::check::{CheckDocument, Defects, Item, Severity};
use trueness_document::scale::palette::{Rgb, category};
use trueness_geom::check::{DefectKind, Measure};
use trueness_geom::space::{minus, norm};
use trueness_measure::check::found;

/// Rows of a kind at most, the worst first.
const MAX_LISTED_ITEMS: usize = 100;

impl Subject for CheckDocument {
    fn content(&self, s: Style) -> serde_json::Result<Content<'_>> {
        let found = found(&self.defects);
        Ok(Content {
            picture: "picture.check",
            numbers: numbers(s, self),
            list: html! {
                (section(s, "defects", html! { (kinds(s, &found, 0)) (absent(s, self)) }))
                (section(s, "model", model(s, self)))
            },
            method: paragraphs(s, ["method.check.text", "method.check.precondition"]),
            how: line(s, ["method.check"]),
            json: serde_json::to_value(self)?,
            ..Content::of(headline(self), [&self.schema, &self.version, &self.units], &self.inputs)
        })
    }

    fn picks(&self) -> Vec<Pick> {
        picks(&found(&self.defects), 0)
    }

    /// Errors before warnings, the largest first.
    fn important(&self, picks: &[Pick]) -> Vec<usize> {
        let kinds = found(&self.defects);
        let errors = |(_, d): &(&DefectKind, &Defects)| {
            std::iter::repeat_n(*d.severity == Severity::Error, d.items.len().min(MAX_LISTED_ITEMS))
        };
        let errors: Vec<bool> = kinds.iter().flat_map(errors).collect();
        let size = |n: usize| picks[n].reach.unwrap_or(0.0);
        let mut order: Vec<usize> = (0..picks.len().min(errors.len())).collect();
        order.sort_by(|a, b| errors[*b].cmp(&errors[*a]).then(size(*b).total_cmp(&size(*a))));
        order
    }
}

fn headline(d: &CheckDocument) -> Headline {
    let is_warned = found(&d.defects).iter().any(|(_, d)| *d.severity == Severity::Warning);
    match (d.sound, is_warned) {
        (true, false) => Headline { key: "sound", tone: Tone::Pass },
        (true, true) => Headline { key: "sound_warned", tone: Tone::Pass },
        (false, _) => Headline { key: "not_sound", tone: Tone::Fail },
    }
}

fn numbers(s: Style, d: &CheckDocument) -> Markup {
    html! {
        dl.key-numbers {
            (severity(s, d, "errors", Severity::Error, "lead"))
            (severity(s, d, "warnings", Severity::Warning, "warn"))
            (key_number(s, "facets.title", "", s.count(d.facets)))
            (key_number(s, "shells", "", s.count(d.shells)))
            @if let Some(size) = d.dimensions { (key_number(s, "size", "", dimensions(s, size))) }
            (key_number(s, "volume", if d.volume_note.is_some() { "warn" } else { "" }, volume(s, d)))
            (holds(s, "precondition", d.precondition, ["holds", "fails"]))
        }
    }
}

/// The places of all rows of [`kinds`]; their marks are numbered from `first_mark`.
pub fn picks(found: &[(&DefectKind, &Defects)], first_mark: usize) -> Vec<Pick> {
    let mut first = first_mark;
    let mut picks = vec![];
    for (kind, defects) in found {
        picks.extend(rows(kind, defects).into_iter().map(|(n, item)| pick(item, first + n)));
        first += defects.items.len();
    }
    picks
}

/// The items with a row, worst first, and their numbers in the document.
fn rows<'a>(kind: &DefectKind, defects: &'a Defects) -> Vec<(usize, &'a Item)> {
    let mut items: Vec<(usize, &Item)> = defects.items.iter().enumerate().collect();
    let by_size = |a: &(usize, &Item), b: &(usize, &Item)| a.1.size.total_cmp(&b.1.size);
    match kind.measure.less_is_worse() {
        true => items.sort_by(by_size),
        false => items.sort_by(|a, b| by_size(b, a)),
    }
    items.truncate(MAX_LISTED_ITEMS);
    items
}

fn pick(item: &Item, mark: usize) -> Pick {
    let half = item.bounds.as_ref().map_or(0.0, |b| 0.5 * norm(minus(b.max, b.min)));
    Pick { position: item.position, reach: Some(half), mark: Some(mark), ..Pick::default() }
}

/// What the size of an item is: key of its word, and unit.
fn measure(measure: Measure) -> (&'static str, &'static str) {
    match measure {
        Measure::Length => ("length", "mm"),
        Measure::Perimeter => ("perimeter", "mm"),
        Measure::Height => ("height", "mm"),
        Measure::Distance => ("distance", "mm"),
        Measure::Diagonal => ("diagonal", "mm"),
        Measure::Area => ("area", "mm²"),
        Measure::Volume => ("volume", "mm³"),
        Measure::Facets => ("facets", ""),
        Measure::Missing => ("missing", ""),
    }
}

/// How many kinds of defects of a severity there are, at how many places.
fn severity(s: Style, d: &CheckDocument, key: &str, severity: Severity, class: &str) -> Markup {
    let kinds = found(&d.defects).iter().filter(|(_, d)| *d.severity == severity).count() as u64;
    let of = d.defects.values().filter(|d| *d.severity == severity);
    let places: u64 = of.filter_map(|d| d.count).sum();
    let value = html! {
        (s.count(kinds))
        @if places > 0 {
            " " small {
                (s.word(if kinds == 1 { "kinds.one" } else { "kinds" })) " · " (s.count(places)) " "
                (s.word(if places == 1 { "places.one" } else { "places" }))
            }
        }
    };
    key_number(s, key, if places > 0 || class == "lead" { class } else { "" }, value)
}

/// The kinds found, each with its places; the rows' numbers begin at `first_pick`.
pub fn kinds(s: Style, found: &[(&DefectKind, &Defects)], first_pick: usize) -> Markup {
    let mut first = first_pick;
    let parts = found.iter().enumerate().map(|(n, (of, defects))| {
        let from = first;
        first += defects.items.len().min(MAX_LISTED_ITEMS);
        // All kinds are seen at once; a single one needs no click.
        kind(s, (of, defects), category(n), from, found.len() == 1)
    });
    html! { @for part in parts { (part) } }
}

/// A kind with its places, whose rows begin at `first`.
fn kind(s: Style, (kind, defects): (&DefectKind, &Defects), color: Rgb, first: usize, open: bool) -> Markup {
    let rows = rows(kind, defects);
    let count = defects.count.unwrap_or(0);
    html! {
        details class={ "kind k-" (defects.severity) } open[open] {
            summary {
                (swatch(color)) span.kind-name { (s.word(format!("defect.{}", kind.name))) }
                span.severity {
                    (s.word(format!("severity.{}", defects.severity)))
                }
                strong { @if defects.at_least { "≥ " } (s.count(count)) }
            }
            "\n" p.note { (s.word(format!("about.{}", kind.name))) }
            (items(s, kind, &rows, first)) (listed(s, "listed", rows.len(), count))
        }
        "\n"
    }
}

/// Digits after the point of the size of a defect or a change, which may be small.
pub fn size_decimals(size: f64) -> usize {
    if size > 0.0 && size < 0.1 { 6 } else { 3 }
}

fn items(s: Style, kind: &DefectKind, all: &[(usize, &Item)], first: usize) -> Markup {
    if all.is_empty() {
        return Markup::default();
    }
    let (word, unit) = measure(kind.measure);
    let decimals = |size: f64| if unit.is_empty() { 0 } else { size_decimals(size) };
    let row = |(n, (_, item)): (usize, &(usize, &Item))| {
        let size = s.number(item.size, decimals(item.size));
        let size = html! { (size) @if !unit.is_empty() { "\u{a0}" (unit) } };
        Row::at(s, &(n + 1), &size, item.position).pick(first + n).class(row_class(n))
    };
    html! { (places(s, word, all.iter().enumerate().map(row))) (not_printed(s, all.len())) }
}

/// What was looked for and not found, and what was not looked for.
fn absent(s: Style, d: &CheckDocument) -> Markup {
    let with = |count: Option<u64>| d.defects.iter().filter(move |(_, x)| x.count == count).enumerate();
    html! {
        @if with(Some(0)).next().is_some() {
            p.absent {
                span.v-pass { "✓\u{a0}" } (s.word("none_of")) " "
                @for (n, (kind, _)) in with(Some(0)) { @if n > 0 { ", " } (s.word(format!("defect.{kind}"))) }
            }
        }
        @for (_, (kind, defects)) in with(None) {
            p.absent {
                "–\u{a0}" (s.word(format!("defect.{kind}"))) ": "
                (Text(defects.count_reason.as_deref().unwrap_or("")))
            }
        }
    }
}

fn model(s: Style, d: &CheckDocument) -> Markup {
    let counts = [
        ("facets.title", d.facets),
        ("vertices.title", d.vertices),
        ("edges", d.edges),
        ("shells", d.shells),
    ];
    let or_why = |reason: &Option<String>| html! { (Text(reason.as_deref().unwrap_or("–"))) };
    html! {
        dl.facts.pairs {
            @for (key, count) in counts { (fact(s, key, s.count(count))) }
            @if let Some(size) = d.dimensions { (fact(s, "size", dimensions(s, size))) }
            (fact(s, "area.title", html! { (s.number(d.area, 3)) "\u{a0}mm²" }))
            (fact(s, "volume", html! {
                (volume(s, d)) @if d.volume_note.is_some() { " (" (s.word("volume.overlaps")) ")" }
            }))
            (fact(s, "centre_of_mass", match d.center_of_mass {
                Some(place) => series(s, place, ", ", 3),
                None => or_why(&d.center_of_mass_reason),
            }))
            (fact(s, "euler", s.number(d.euler_characteristic as f64, 0)))
            (fact(s, "genus", match d.genus {
                Some(genus) => s.number(genus as f64, 0).render(),
                None => or_why(&d.genus_reason),
            }))
            (fact(s, "gap", mm(s.scientific(d.tolerances.gap, 2))))
        }
        @if !d.of_drawing.is_empty() { p.note { (s.word("of_drawing")) } }
    }
}

fn dimensions(s: Style, size: [f64; 3]) -> Markup {
    mm(series(s, size, "\u{2009}×\u{2009}", 2))
}

fn volume(s: Style, d: &CheckDocument) -> Markup {
    html! {
        (s.optional(d.volume, 2).because(d.volume_reason.as_deref()))
        @if d.volume.is_some() { "\u{a0}mm³" }
    }
}
