//! The page of a trend: the course of each characteristic over the parts, its numbers, the parts with their verdicts.

mod axes;
mod chart;
mod facts;
mod gutter;
mod map;
mod overview;
mod parts;
#[cfg(test)]
mod tests;

use crate::headline::{Headline, Tone};
use crate::number::Style;
use crate::page::parts::{file_name, key_number, section};
use crate::subject::{Drawn, Head, Pick, Subject};
use crate::values::{Name, Text, leaf};
use crate::{Up, ViewObject};
use axes::Axes;
pub use map::MapPage;
use maud::{Markup, html};
use serde_json::Value;
use trueness_document::Verdict;
use trueness_document::trend::TrendDocument;

impl Subject for TrendDocument {
    fn head(&self) -> Head<'_> {
        Head { schema: &self.schema, version: &self.version, units: &self.units, inputs: &[] }
    }

    fn headline(&self) -> Headline {
        match self.verdict {
            // Every part passes, but the process does not stand still.
            Verdict::Pass if !self.in_control => Headline { key: "out_of_control", tone: Tone::Undecided },
            verdict => verdict.into(),
        }
    }

    fn title(&self) -> Option<&str> {
        self.title.as_deref().or(self.inputs.first().map(|result| file_name(&result.path)))
    }

    fn picture(&self) -> &'static str {
        "chart.title"
    }

    fn numbers(&self, s: Style) -> Markup {
        let (all, number) = (self.parts.len() as u64, self.characteristics.len() as u64);
        let astray = self.characteristics.iter().filter(|c| !c.out_of_control.is_empty()).count() as u64;
        let known = self.characteristics.iter().filter_map(|c| Some((c.ppk?.value, &c.id)));
        let least = known.min_by(|a, b| a.0.total_cmp(&b.0));
        html! {
            dl.key-numbers {
                @for (key, class, count) in counts(self) {
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

    fn list(&self, s: Style) -> Markup {
        html! {
            @for warning in &self.warnings { p.warning { "⚠ " (Text(warning)) } }
            (section(s, "parts", parts::parts(s, self)))
            (section(s, "files", parts::results(s, &self.inputs)))
        }
    }

    fn method(&self, s: Style) -> Markup {
        let keys = ["method.trend.text", "method.trend.rules", "method.trend.index"];
        html! { @for key in keys { p { (s.word(key)) } } }
    }

    fn how(&self, s: Style) -> Markup {
        html! {
            "ISO 7870-2 · ISO 22514-2 · " (s.word("level")) " " (s.percent(self.confidence, 0))
        }
    }

    /// One for each part: a row leads to its place in all charts.
    fn picks(&self) -> Vec<Pick> {
        self.parts.iter().map(|_| Pick::default()).collect()
    }

    fn json(&self) -> serde_json::Result<Value> {
        parts::stripped(self)
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

/// How many parts have each verdict, the worst first, with the class of that number; the worst of all leads.
fn counts(document: &TrendDocument) -> Vec<(&'static str, &'static str, u64)> {
    let mut lead = true;
    let of = |(key, verdict): (&'static str, Verdict)| {
        let n = document.parts.iter().filter(|p| p.verdict == verdict).count() as u64;
        let leads = n > 0 && std::mem::take(&mut lead);
        let class = match (leads, verdict) {
            (true, _) => "lead",
            (false, Verdict::Pass) => "",
            (false, _) => "warn",
        };
        (n > 0 || verdict == Verdict::Pass).then_some((key, class, n))
    };
    let all = [
        ("verdict.fail", Verdict::Fail),
        ("verdict.undecided", Verdict::Undecided),
        ("verdict.not_measured", Verdict::NotMeasured),
        ("verdict.pass", Verdict::Pass),
    ];
    all.into_iter().filter_map(of).collect()
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
