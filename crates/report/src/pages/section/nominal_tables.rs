//! How the points differ from the nominal, in tables: where they are farthest off, and what was not measured.

use super::fitted;
use super::head::head;
use super::pieces::{drawn_pieces, lacking};
use crate::number::{Style, decimals};
use crate::page::parts::{fact, file_name, listed, row_class};
use crate::pages::compare::{OUTSIDE, by_side};
use crate::values::Text;
use maud::{Markup, html};
use trueness_document::section::{NominalRecord, Positive, SectionDocument};

/// The word for where deviations are positive.
pub fn sign(positive: Positive) -> &'static str {
    match positive {
        Positive::Outside => "nominal.outside",
        Positive::Left => "nominal.left",
        Positive::Both => "nominal.outside_or_left",
    }
}

/// The section of the list.
pub fn nominal(s: Style, document: &SectionDocument, found: &NominalRecord) -> Markup {
    let digits = decimals(found.deviation.all.std_dev, 4);
    let sides = if *found.positive == Positive::Outside { OUTSIDE } else { ["side.plus", "side.minus"] };
    html! {
        p.note {
            (Text(file_name(&found.path))) ": " (s.word(format!("nominal.{}", found.outline))) " · "
            (s.word(sign(*found.positive)))
        }
        @for warning in &found.warnings { p.note { strong.warning { "⚠" } " " (Text(&warning.text)) } }
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
    html! {
        div.wide {
            table.pick.farthest {
                (head(s, &["deviation", "x", "y", "contour"]))
                tbody {
                    @for (n, w) in found.worst.iter().enumerate() {
                        tr data-pick=(first + n) data-contour=(w.contour) {
                            td {}
                            td { @if w.deviation > 0.0 { "▲" } @else { "▼" } }
                            td.r { (s.number(w.deviation, digits).signed()) }
                            @for x in w.point { td.r { (s.number(x, 4)) } }
                            td.r {
                                (w.contour + 1)
                                @if let Some(plane) = plane(w.contour) { " · " (s.word("plane")) "\u{a0}" (plane + 1) }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// The outlines that were not measured as a whole, or that there are none.
fn outlines(s: Style, document: &SectionDocument, found: &NominalRecord) -> Markup {
    let all = lacking(document);
    let total = found.outlines.iter().filter(|o| o.lacks()).count() as u64;
    let first = drawn_pieces(document) + found.worst.len();
    let several = document.planes.len() > 1;
    html! {
        @if all.is_empty() {
            dl.facts.pairs { (fact(s, "nominal.whole", s.len(&found.outlines))) }
        } @else {
            p.note { strong.warning { "⚠" } " " (s.word("nominal.lacking")) }
            div.wide {
                table.pick.outlines {
                    (head(s, &["nominal.covered", "size", "x", "y"]))
                    tbody {
                        @for (row, n) in all.iter().enumerate() {
                            @let o = &found.outlines[*n];
                            tr data-pick=(first + row) class=[row_class(row)] {
                                td { (n + 1) }
                                td {
                                    @if o.hole { (s.word("nominal.hole")) } @else { (s.word("contour")) }
                                    @if let Some(plane) = o.plane.filter(|_| several) {
                                        " · " (s.word("plane")) "\u{a0}" (plane + 1)
                                    }
                                }
                                td.r {
                                    @if o.covered > 0.0 { (s.percent(o.covered, 0)) } @else { (s.word("verdict.not_measured")) }
                                }
                                td.r { (s.number(o.size[0], 2)) "\u{2009}×\u{2009}" (s.number(o.size[1], 2)) }
                                @for x in o.center { td.r { (s.number(x, 2)) } }
                            }
                        }
                    }
                }
            }
            (listed(s, "listed.first", all.len(), total))
        }
    }
}
