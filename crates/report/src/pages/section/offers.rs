//! What a drawing of a contour would have, in a table.

use super::head::head;
use crate::number::{Style, decimals};
use crate::page::parts::not_printed;
use crate::values::Text;
use maud::{Markup, html};
use trueness_document::section::{ContourRecord, OfferRecord};

/// Offers of a contour that are listed.
const LISTED: usize = 60;

/// The offers of a contour; nothing where they were not asked for.
pub fn offers(s: Style, contour: &ContourRecord) -> Markup {
    html! {
        @if let Some(reason) = &contour.tidy_reason { p.note { (s.word("offers.none")) ": " (Text(reason)) } }
        @if let Some(all) = &contour.tidy {
            @if all.is_empty() {
                p.note { (s.word("offers.none")) }
            } @else {
                div.wide {
                    table.offers {
                        (head(s, &["offers.of", "offers.found", "uncertainty", "offers.offered", "z", "p"]))
                        tbody { @for (n, offer) in all.iter().take(LISTED).enumerate() { (row(s, n, offer)) } }
                    }
                    (not_printed(s, all.len().min(LISTED)))
                }
                p.note { (s.word("offers.text")) }
            }
        }
    }
}

fn row(s: Style, number: usize, offer: &OfferRecord) -> Markup {
    let angle = offer.kind.is_angle();
    let shown = |x: f64| if angle { x.to_degrees() } else { x };
    let unit = if angle { "°" } else { "" };
    let u = shown(offer.std_uncertainty);
    let of: Vec<String> =
        offer.segments.iter().map(|m| format!("{}.{}", m.contour + 1, m.segment + 1)).collect();
    html! {
        tr {
            td { (number + 1) }
            td { (s.word(format!("offer.{}", offer.kind))) }
            td.r { (of.join(" – ")) }
            td.r { (s.number(shown(offer.found), decimals(Some(u), 4))) (unit) }
            td.r { (s.small(u)) (unit) }
            td.r { (s.number(shown(offer.offered), 4)) (unit) }
            td.r { (s.number(offer.z, 2).signed()) }
            td.r { (s.number(offer.p, 2)) }
        }
    }
}
