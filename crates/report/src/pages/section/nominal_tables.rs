//! How the points differ from the nominal, in tables: where they are farthest off, and what was not measured.

use super::fitted;
use crate::number::{Style, decimals};
use crate::page::parts::{fact, file_name, warning};
use crate::page::table::{Row, listed, row_class, table};
use crate::pages::compare::{OUTSIDE, by_side};
use crate::values::Text;
use crate::views::section::pieces::{drawn_pieces, lacking, sign};
use maud::{Markup, Render, html};
use trueness_document::section::{NominalRecord, Positive, SectionDocument};

/// The section of the list.
pub fn nominal(s: Style, document: &SectionDocument, found: &NominalRecord) -> Markup {
    let digits = decimals(found.deviation.all.std_dev, 4);
    let sides = if *found.positive == Positive::Outside { OUTSIDE } else { ["side.plus", "side.minus"] };
    html! {
        p.note {
            (Text(file_name(&found.path))) ": " (s.word(format!("nominal.{}", found.outline))) " · "
            (s.word(sign(*found.positive)))
        }
        @for doubt in &found.warnings { (warning(Text(&doubt.text))) }
        (fitted::verdict(s, found))
        (fitted::fits(s, document, found))
        (by_side(s, &found.deviation, digits, sides))
        dl.facts.pairs {
            @for (reason, count) in &found.excluded { (fact(s, &format!("nominal.{reason}"), s.count(*count))) }
        }
        @if !found.worst.is_empty() { (worst(s, document, found, digits)) }
        (outlines(s, document, found))
    }
}

/// The points farthest off on both sides.
fn worst(s: Style, document: &SectionDocument, found: &NominalRecord, digits: usize) -> Markup {
    let first = drawn_pieces(document);
    let several = document.planes.len() > 1;
    let plane = |contour: u64| document.contours.get(contour as usize)?.plane.filter(|_| several);
    let rows = found.worst.iter().enumerate().map(|(n, w)| {
        let side = if w.deviation > 0.0 { "▲" } else { "▼" };
        let [x, y] = w.point.map(|x| s.number(x, 4));
        let contour = html! {
            (w.contour + 1)
            @if let Some(plane) = plane(w.contour) { " · " (s.word("plane")) "\u{a0}" (plane + 1) }
        };
        let row = Row::of(&[&"", &side, &s.number(w.deviation, digits).signed(), &x, &y, &contour]);
        row.pick(first + n).contour(w.contour)
    });
    let columns: [&[&str]; 2] = [&["", ""], &["deviation", "x", "y", "contour"]];
    html! { div.wide { (table(s, "pick farthest", columns, rows)) } }
}

/// The outlines that were not measured as a whole, or that there are none.
fn outlines(s: Style, document: &SectionDocument, found: &NominalRecord) -> Markup {
    let all = lacking(document);
    let total = found.outlines.iter().filter(|o| o.lacks()).count() as u64;
    let first = drawn_pieces(document) + found.worst.len();
    let several = document.planes.len() > 1;
    let rows = all.iter().enumerate().map(|(row, n)| {
        let o = &found.outlines[*n];
        let called = html! {
            (s.word(if o.hole { "nominal.hole" } else { "contour" }))
            @if let Some(plane) = o.plane.filter(|_| several) { " · " (s.word("plane")) "\u{a0}" (plane + 1) }
        };
        let covered = match o.covered > 0.0 {
            true => s.percent(o.covered, 0).render(),
            false => s.word("verdict.not_measured").render(),
        };
        let [width, height] = o.size.map(|x| s.number(x, 2));
        let size = html! { (width) "\u{2009}×\u{2009}" (height) };
        let [x, y] = o.center.map(|x| s.number(x, 2));
        Row::of(&[&(n + 1), &called, &covered, &size, &x, &y]).pick(first + row).class(row_class(row))
    });
    html! {
        @if all.is_empty() {
            dl.facts.pairs { (fact(s, "nominal.whole", s.len(&found.outlines))) }
        } @else {
            (warning(s.word("nominal.lacking")))
            div.wide { (table(s, "pick outlines", [&["", ""], &["nominal.covered", "size", "x", "y"]], rows)) }
            (listed(s, "listed.first", all.len(), total))
        }
    }
}
