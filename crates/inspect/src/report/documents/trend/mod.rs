//! The page of a trend: the course of each characteristic over the parts, its numbers, the parts with their verdicts.

mod axes;
mod chart;
mod facts;
mod gutter;
mod overview;
mod parts;
#[cfg(test)]
mod tests;

use super::super::html::Html;
use super::super::page::blocks::{Headline, Tone, key_number, section};
use super::{Drawn, Head, Pick, Subject};
use crate::report::ViewObject;
use crate::results::Verdict;
use crate::results::trend::TrendDocument;
use serde_json::Value;

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
        self.title.as_deref()
    }

    fn picture(&self) -> &'static str {
        "chart.title"
    }

    fn numbers(&self, h: &mut Html) {
        let count = |v: Verdict| self.parts.iter().filter(|p| p.verdict == v).count() as u64;
        let all = self.parts.len() as u64;
        let mut lead = true;
        h.raw("<dl class=\"key-numbers\">");
        for (key, verdict) in [
            ("verdict.fail", Verdict::Fail),
            ("verdict.undecided", Verdict::Undecided),
            ("verdict.not_measured", Verdict::NotMeasured),
            ("verdict.pass", Verdict::Pass),
        ] {
            let n = count(verdict);
            if n > 0 || verdict == Verdict::Pass {
                let leads = n > 0 && std::mem::take(&mut lead);
                let warn = if verdict == Verdict::Pass { "" } else { "warn" };
                key_number(h, key, if leads { "lead" } else { warn }, |h| {
                    h.count(n).raw(" <small>/\u{a0}").count(all);
                    if all > 1 {
                        h.raw(" ").word("parts.of");
                    }
                    h.raw("</small>");
                });
            }
        }
        let number = self.characteristics.len() as u64;
        let astray = self.characteristics.iter().filter(|c| !c.out_of_control.is_empty()).count() as u64;
        if astray > 0 {
            key_number(h, "verdict.out_of_control", "warn", |h| {
                h.count(astray).raw(" <small>/\u{a0}").count(number).raw("</small>");
            });
        }
        key_number(h, "characteristics", "", |h| {
            h.count(number);
        });
        let known = self.characteristics.iter().filter_map(|c| Some((c.ppk?.value, &c.id)));
        if let Some((least, id)) = known.min_by(|a, b| a.0.total_cmp(&b.0)) {
            key_number(h, "chart.least", "", |h| {
                h.number(least, 2, false).raw(" <small>").name(id).raw("</small>");
            });
        }
        h.raw("</dl>");
    }

    fn list(&self, h: &mut Html) {
        for warning in &self.warnings {
            h.raw("<p class=\"warning\">⚠ ").text(warning).raw("</p>");
        }
        section(h, "parts", |h| parts::parts(h, self));
        parts::results(h, &self.inputs);
    }

    fn method(&self, h: &mut Html) {
        for key in ["method.trend.text", "method.trend.rules", "method.trend.index"] {
            h.raw("<p>").word(key).raw("</p>");
        }
    }

    fn how(&self, h: &mut Html) {
        h.raw("ISO 7870-2 · ISO 22514-2 · ").word("level").raw(" ").percent(self.confidence, 0);
    }

    /// One for each part: a row leads to its place in all charts.
    fn picks(&self) -> Vec<Pick> {
        self.parts.iter().map(|_| Pick::default()).collect()
    }

    fn json(&self) -> serde_json::Result<Value> {
        serde_json::to_value(self)
    }

    fn drawing(&self) -> Option<&dyn Drawn> {
        Some(self)
    }
}

impl Drawn for TrendDocument {
    fn classes(&self) -> [&'static str; 2] {
        ["charted", "charts"]
    }

    fn shown(&self, _: &[ViewObject], _: usize) -> (usize, usize) {
        (0, 0)
    }

    fn draw(&self, h: &mut Html, _: &[ViewObject], _: usize) {
        let rows = self.rows();
        h.raw("<div id=\"charts\">\n");
        legend(h, self);
        if rows.len() > 1 {
            overview::overview(h, self, &rows);
        }
        for n in rows {
            chart::chart(h, self, n, |h, axes| facts::facts(h, self, &self.characteristics[n], axes));
        }
        h.raw("</div>\n");
    }
}

/// What the dots mean, as far as there are such.
fn legend(h: &mut Html, document: &TrendDocument) {
    h.raw("<p class=\"legend\">");
    for verdict in chart::ORDER.into_iter().rev() {
        if document.characteristics.iter().any(|c| c.verdicts.contains(&verdict)) {
            let key = Headline::from(verdict).key;
            let hole = if verdict == Verdict::Undecided { "<path class=\"hole\" d=\"M7 7h0\"/>" } else { "" };
            h.raw(&format!(
                "<span><svg class=\"plot\" width=\"14\" height=\"14\" viewBox=\"0 0 14 14\" aria-hidden=\"true\">\
                 <path class=\"dots {key}\" d=\"M7 7h0\"/>{hole}</svg> "
            ));
            h.word(&format!("verdict.{key}")).raw("</span> ");
        }
    }
    if !document.in_control {
        h.raw(
            "<span><svg class=\"plot\" width=\"14\" height=\"14\" viewBox=\"0 0 14 14\" aria-hidden=\"true\">\
             <path class=\"ring\" d=\"M7 7h0\"/><path class=\"ring-within\" d=\"M7 7h0\"/></svg> ",
        );
        h.word("verdict.out_of_control").raw("</span> ");
    }
    h.raw("</p>\n");
}
