//! The page of a trend: the course of each characteristic over the parts, its numbers, the parts with their verdicts.

mod facts;
mod map;
mod overview;
mod parts;

use crate::headline::Headline;
use crate::number::Style;
use crate::page::parts::{key_number, paragraphs, section, verdicts};
use crate::subject::{Content, Drawn, Pick, Subject};
use crate::values::{Name, Text, leaf};
use crate::views::trend::axes::Axes;
use crate::views::trend::chart;
use crate::{Up, ViewObject};
pub use map::MapPage;
use maud::{Markup, html};
use trueness_document::Verdict;
use trueness_document::trend::TrendDocument;

impl Subject for TrendDocument {
    fn content(&self, s: Style) -> serde_json::Result<Content<'_>> {
        Ok(Content {
            picture: "chart.title",
            numbers: numbers(s, self),
            list: html! {
                @for warning in &self.warnings { p.warning { "⚠ " (Text(warning)) } }
                (section(s, "parts", parts::parts(s, self)))
                (section(s, "files", parts::results(s, &self.inputs)))
            },
            method: paragraphs(s, ["method.trend.text", "method.trend.rules", "method.trend.index"]),
            how: html! {
                "ISO 7870-2 · ISO 22514-2 · " (s.word("level")) " " (s.percent(self.confidence, 0))
            },
            ..parts::common(self)?
        })
    }

    /// One for each part: a row leads to its place in all charts.
    fn picks(&self) -> Vec<Pick> {
        self.parts.iter().map(|_| Pick::default()).collect()
    }

    fn drawing(&self) -> Option<&dyn Drawn> {
        Some(self)
    }
}

impl Drawn for TrendDocument {
    fn classes(&self) -> [&'static str; 2] {
        ["charted", "charts"]
    }

    fn shown(&self, _: &[ViewObject], _: Up, _: usize) -> (usize, usize) {
        (0, 0)
    }

    fn draw(&self, s: Style, _: &[ViewObject], _: Up, _: usize) -> Markup {
        let rows = self.rows();
        html! {
            div id="charts" {
                "\n" (legend(s, self))
                @if rows.len() > 1 { (overview::overview(s, self, &rows)) }
                @for n in rows {
                    @let axes = Axes::of(&self.characteristics[n]);
                    (chart::chart(s, self, n, &axes, facts::facts(s, self, &self.characteristics[n], &axes)))
                }
            }
            "\n"
        }
    }
}

fn numbers(s: Style, d: &TrendDocument) -> Markup {
    let (all, number) = (d.parts.len() as u64, d.characteristics.len() as u64);
    let astray = d.characteristics.iter().filter(|c| !c.out_of_control.is_empty()).count() as u64;
    let known = d.characteristics.iter().filter_map(|c| Some((c.ppk?.value, &c.id)));
    let least = known.min_by(|a, b| a.0.total_cmp(&b.0));
    let counts = [Verdict::Fail, Verdict::Undecided, Verdict::NotMeasured, Verdict::Pass]
        .map(|verdict| d.parts.iter().filter(|p| p.verdict == verdict).count() as u64);
    html! {
        dl.key-numbers {
            @for (key, class, count) in verdicts(counts, true) {
                (key_number(s, key, class, html! {
                    (s.count(count)) " "
                    small { "/\u{a0}" (s.count(all)) @if all > 1 { " " (s.word("parts.of")) } }
                }))
            }
            @if astray > 0 {
                (key_number(s, "verdict.out_of_control", "warn", html! {
                    (s.count(astray)) " " small { "/\u{a0}" (s.count(number)) }
                }))
            }
            (key_number(s, "characteristics", "", s.count(number)))
            @if let Some((least, id)) = least {
                (key_number(s, "chart.least", "", html! { (s.number(least, 2)) " " small { (Name(id)) } }))
            }
        }
    }
}

/// What the dots mean, as far as there are such.
fn legend(s: Style, document: &TrendDocument) -> Markup {
    let dot = |classes: &[&str]| {
        html! {
            svg.plot width="14" height="14" viewBox="0 0 14 14" aria-hidden="true" {
                @for class in classes { (leaf("path", &[("class", class), ("d", &"M7 7h0")])) }
            }
        }
    };
    let seen = |v: &Verdict| document.characteristics.iter().any(|c| c.verdicts.contains(v));
    html! {
        p.legend {
            @for verdict in chart::ORDER.into_iter().rev().filter(seen) {
                @let key = Headline::from(verdict).key;
                @let dots = format!("dots {key}");
                span {
                    @if verdict == Verdict::Undecided { (dot(&[&dots, "hole"])) } @else { (dot(&[&dots])) }
                    " " (s.word(format!("verdict.{key}")))
                }
                " "
            }
            @if !document.in_control {
                span { (dot(&["ring", "ring-within"])) " " (s.word("verdict.out_of_control")) } " "
            }
        }
        "\n"
    }
}
