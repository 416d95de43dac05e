//! The parts with their verdicts, the worst first, and the results that were read.

use super::super::super::html::Html;
use super::super::super::page::blocks::{Headline, badge, file_name, not_printed, pick_row, section};
use crate::results::Verdict;
use crate::results::trend::{ResultInput, TrendDocument};

/// Parts that are listed, and characteristics named of one.
const LISTED: usize = 1000;
const NAMED: usize = 40;
/// Results whose files are listed open.
const OPEN: usize = 12;

/// Every part with its verdict and those characteristics that it does not pass.
pub fn parts(h: &mut Html, document: &TrendDocument) {
    let rows = document.worst_parts();
    h.raw("<table class=\"pick parts\"><thead><tr><th class=\"r\"></th><th>").word("part").raw("</th><th>");
    h.word("verdict").raw("</th></tr></thead><tbody>");
    for (row, n) in rows.iter().take(LISTED).enumerate() {
        let part = &document.parts[*n];
        pick_row(h, row, *n);
        h.raw("<td class=\"r\">").count(*n as u64 + 1).raw("</td><td>").name(file_name(&part.name));
        failing(h, document, *n);
        h.raw("</td><td>");
        badge(h, Headline::from(part.verdict));
        h.raw("</td></tr>");
    }
    h.raw("</tbody></table>");
    not_printed(h, rows.len().min(LISTED));
    if rows.len() > LISTED {
        h.raw("<p class=\"note\">+\u{a0}")
            .count((rows.len() - LISTED) as u64)
            .raw(" ")
            .word("chart.more")
            .raw("</p>");
    }
}

/// What of a part does not pass, or is out of control; each leads to its chart.
fn failing(h: &mut Html, document: &TrendDocument, part: usize) {
    let mut named = 0;
    let mut more = 0u64;
    h.raw("<span class=\"of-part\">");
    for verdict in [Verdict::Fail, Verdict::Undecided, Verdict::NotMeasured] {
        for (n, c) in document.characteristics.iter().enumerate() {
            if c.verdicts.get(part) != Some(&verdict) {
                continue;
            }
            named += 1;
            if named > NAMED {
                more += 1;
                continue;
            }
            let Headline { key, tone } = verdict.into();
            h.raw(&format!("<a class=\"v-{}\" href=\"#course-{n}\" data-verdict=\"{key}\">", tone.name()));
            h.raw(tone.icon()).raw("\u{a0}").name(&c.id).raw("</a> ");
        }
    }
    if let Some(verdict) = document.parts[part].deviation.filter(|v| *v != Verdict::Pass) {
        let Headline { tone, .. } = verdict.into();
        h.raw(&format!("<span class=\"v-{}\">{}\u{a0}", tone.name(), tone.icon()))
            .word("deviations")
            .raw("</span> ");
    }
    if more > 0 {
        h.raw("+\u{a0}").count(more).raw(" ");
    }
    for (n, c) in document.characteristics.iter().enumerate() {
        if c.out_of_control.iter().any(|o| o.part == part as u64) && named < NAMED {
            named += 1;
            h.raw(&format!("<a class=\"warning\" href=\"#course-{n}\">◎\u{a0}")).name(&c.id).raw("</a> ");
        }
    }
    h.raw("</span>");
}

/// The results read, with what tells that they are these.
pub fn results(h: &mut Html, inputs: &[ResultInput]) {
    section(h, "files", |h| {
        let open = if inputs.len() <= OPEN { " open" } else { "" };
        h.raw(&format!("<details class=\"kind\"{open}><summary><span class=\"kind-name\">"))
            .word("chart.results");
        h.raw("</span><strong>").count(inputs.len() as u64).raw("</strong></summary>");
        for (n, input) in inputs.iter().enumerate() {
            h.raw("<div class=\"file\"><p>").count(n as u64 + 1).raw(" ").name(&input.path);
            h.raw("</p><p class=\"note\">")
                .text(&input.format)
                .raw(" · ")
                .count(input.bytes)
                .raw("\u{a0}B</p>");
            if let Some(hash) = &input.sha256 {
                h.raw("<p class=\"hash\"><abbr>SHA-256</abbr> <code>").text(hash).raw("</code></p>");
            }
            h.raw("</div>");
        }
        h.raw("</details>");
    });
}
