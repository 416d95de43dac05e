//! All characteristics in a few lines, the worst first, each with its course in small.

use super::super::super::html::Html;
use super::super::super::page::blocks::{Headline, badge};
use super::super::super::page::symbols::symbol;
use super::axes::{Axes, WIDTH};
use super::chart::{ORDER, band, course};
use super::facts::index;
use crate::results::Verdict;
use crate::results::trend::{TrendDocument, TrendRecord};
use std::fmt::Write;

/// Height of a small course.
const HEIGHT: f64 = 34.0;

/// Writes the table; `rows` are the numbers of the characteristics.
pub fn overview(h: &mut Html, document: &TrendDocument, rows: &[usize]) {
    h.raw("<table class=\"overview\"><thead><tr><th>").word("characteristic").raw("</th><th>");
    h.word("course").raw("</th><th class=\"r within\">Cpk</th><th class=\"r\">Ppk</th><th>").word("verdict");
    h.raw("</th></tr></thead><tbody>");
    for n in rows {
        let c = &document.characteristics[*n];
        h.raw(&format!("<tr data-of=\"{n}\"><td><a href=\"#course-{n}\">")).name(&c.id).raw("</a> ");
        h.add(symbol(&c.kind));
        h.raw("<small>").word(&format!("kind.{}", c.kind)).raw("</small></td><td class=\"small\">");
        small(h, c);
        h.raw("</td>");
        for (class, i) in [("r within", c.cpk), ("r", c.ppk)] {
            h.raw(&format!("<td class=\"{class}\">"));
            index(h, i, None);
            h.raw("</td>");
        }
        h.raw("<td>");
        badge(h, Headline::from(c.verdict()));
        counts(h, c);
        h.raw("</td></tr>");
    }
    h.raw("</tbody></table>\n");
}

/// How many parts have the worst verdict, and how many are out of control.
fn counts(h: &mut Html, c: &TrendRecord) {
    let worst = c.verdict();
    let have = c.verdicts.iter().filter(|v| **v == worst).count() as u64;
    h.raw(" <small>").count(have).raw("\u{a0}/\u{a0}").count(c.verdicts.len() as u64).raw("</small>");
    let mut out: Vec<u64> = c.out_of_control.iter().map(|o| o.part).collect();
    out.dedup();
    if !out.is_empty() {
        h.raw("<br><small class=\"warning\">◎\u{a0}")
            .count(out.len() as u64)
            .raw(" ")
            .word("verdict.out_of_control");
        h.raw("</small>");
    }
}

fn small(h: &mut Html, c: &TrendRecord) {
    let axes = Axes::of(c);
    h.raw(&format!(
        "<svg class=\"spark\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" preserveAspectRatio=\"none\" data-from=\"{}\" data-to=\"{}\" \
         aria-hidden=\"true\">",
        axes.from, axes.to
    ));
    band(h, c, &axes, HEIGHT);
    course(h, c, &axes, [WIDTH, HEIGHT]);
    // What passes is the line alone; of one part there is no line.
    let lone = c.values.iter().flatten().count() < 2;
    for verdict in ORDER.into_iter().filter(|v| lone || *v != Verdict::Pass) {
        let mut d = String::new();
        for (n, value) in c.values.iter().enumerate() {
            if c.verdicts.get(n) == Some(&verdict) {
                let y = value.map_or(HEIGHT - 3.0, |v| axes.y(v, HEIGHT));
                let _ = write!(d, "M{:.3} {y:.3}h0", axes.x(n, WIDTH));
            }
        }
        if !d.is_empty() {
            h.raw(&format!("<path class=\"dots {}\" d=\"{d}\"/>", Headline::from(verdict).key));
        }
    }
    h.raw("</svg>");
}
