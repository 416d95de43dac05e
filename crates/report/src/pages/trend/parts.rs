//! The parts with their verdicts, the worst first, and the results that were read.

use crate::headline::{Headline, Tone};
use crate::number::Style;
use crate::page::parts::{badge, file_name};
use crate::page::table::{not_printed, row_class};
use crate::subject::Content;
use crate::values::{Name, Text};
use maud::{Markup, html};
use serde_json::Value;
use trueness_document::Verdict;
use trueness_document::trend::{ResultInput, TrendDocument, TrendRecord};

/// Parts that are listed, and characteristics named of one.
const MAX_LISTED_PARTS: usize = 1000;
const MAX_NAMED_CHARACTERISTICS: usize = 40;
/// Results whose files are listed open.
const MAX_OPEN_RESULTS: usize = 12;

/// Every part with its verdict and those characteristics that it does not pass.
pub fn parts(s: Style, document: &TrendDocument) -> Markup {
    let rows = document.worst_parts();
    let shown = rows.len().min(MAX_LISTED_PARTS);
    html! {
        table.pick.parts {
            thead { tr { th.r {} th { (s.word("part")) } th { (s.word("verdict")) } } }
            tbody {
                @for (row, n) in rows.iter().take(shown).enumerate() {
                    @let part = &document.parts[*n];
                    tr data-pick=(n) class=[row_class(row)] {
                        td.r { (s.count(*n as u64 + 1)) }
                        td { (Name(file_name(&part.name))) (failing(s, document, *n)) }
                        td { (badge(s, Headline::from(part.verdict))) }
                    }
                }
            }
        }
        (not_printed(s, shown))
        @if rows.len() > shown {
            p.note { "+\u{a0}" (s.count((rows.len() - shown) as u64)) " " (s.word("chart.more")) }
        }
    }
}

/// What of a part does not pass, or is out of control; each leads to its chart.
fn failing(s: Style, document: &TrendDocument, part: usize) -> Markup {
    let all = || document.characteristics.iter().enumerate();
    let bad: Vec<(Verdict, usize, &TrendRecord)> = [Verdict::Fail, Verdict::Undecided, Verdict::NotMeasured]
        .into_iter()
        .flat_map(|verdict| {
            let have = all().filter(move |(_, c)| c.verdicts.get(part) == Some(&verdict));
            have.map(move |(n, c)| (verdict, n, c))
        })
        .collect();
    let room = MAX_NAMED_CHARACTERISTICS.saturating_sub(bad.len());
    let astray = all().filter(|(_, c)| c.out_of_control.iter().any(|o| o.part == part as u64)).take(room);
    let deviation = document.parts[part].deviation.filter(|v| *v != Verdict::Pass);
    html! {
        span.of-part {
            @for (verdict, n, c) in bad.iter().take(MAX_NAMED_CHARACTERISTICS) {
                @let Headline { key, tone } = Headline::from(*verdict);
                a class={ "v-" (tone.name()) } href={ "#course-" (n) } data-verdict=(key) {
                    (tone.icon()) "\u{a0}" (Name(&c.id))
                }
                " "
            }
            @if let Some(verdict) = deviation {
                @let Headline { tone, .. } = Headline::from(verdict);
                span class={ "v-" (tone.name()) } { (tone.icon()) "\u{a0}" (s.word("deviations")) } " "
            }
            @if bad.len() > MAX_NAMED_CHARACTERISTICS { "+\u{a0}" (s.count((bad.len() - MAX_NAMED_CHARACTERISTICS) as u64)) " " }
            @for (n, c) in astray { a.warning href={ "#course-" (n) } { "◎\u{a0}" (Name(&c.id)) } " " }
        }
    }
}

/// The results read, with what tells that they are these.
pub fn results(s: Style, inputs: &[ResultInput]) -> Markup {
    html! {
        details.kind open[inputs.len() <= MAX_OPEN_RESULTS] {
            summary { span.kind-name { (s.word("chart.results")) } strong { (s.len(inputs)) } }
            @for (n, input) in inputs.iter().enumerate() {
                div.file {
                    p { (s.count(n as u64 + 1)) " " (Name(&input.path)) }
                    p.note { (Text(&input.format)) " · " (s.count(input.bytes)) "\u{a0}B" }
                    @if let Some(hash) = &input.sha256 {
                        p.hash { abbr { "SHA-256" } " " code { (Text(hash)) } }
                    }
                }
            }
        }
    }
}

/// What both pages of a trend have in common.
pub fn common(d: &TrendDocument) -> serde_json::Result<Content<'_>> {
    let headline = match d.verdict {
        // Every part passes, but the process does not stand still.
        Verdict::Pass if !d.in_control => Headline { key: "out_of_control", tone: Tone::Undecided },
        verdict => verdict.into(),
    };
    // Its files are no inputs of a measurement; its page lists them itself.
    Ok(Content {
        title: d.title.as_deref().or(d.inputs.first().map(|result| file_name(&result.path))),
        json: stripped(d)?,
        ..Content::of(headline, [&d.schema, &d.version, &d.units], &[])
    })
}

/// The document without the lists of its places, which a page has no use for and no room.
fn stripped(document: &TrendDocument) -> serde_json::Result<Value> {
    let mut value = serde_json::to_value(document)?;
    if let Some(map) = value.get_mut("map").and_then(Value::as_object_mut) {
        map.retain(|_, v| !v.is_array());
    }
    Ok(value)
}
