//! What a drawing of a contour would have, in a table.

use crate::number::{Style, decimals};
use crate::page::table::{Row, not_printed, table};
use crate::values::Text;
use maud::{Markup, Render, html};
use trueness_document::section::{ContourRecord, MemberRecord, OfferRecord};

/// Offers of a contour that are listed.
const MAX_LISTED_OFFERS: usize = 60;

/// The offers of a contour; nothing where they were not asked for.
pub fn offers(s: Style, contour: &ContourRecord) -> Markup {
    let columns: [&[&str]; 2] =
        [&["", ""], &["offers.of", "offers.found", "uncertainty", "offers.offered", "z", "p"]];
    html! {
        @if let Some(reason) = &contour.tidy_reason { p.note { (s.word("offers.none")) ": " (Text(reason)) } }
        @match contour.tidy.as_deref() {
            None => {}
            Some([]) => p.note { (s.word("offers.none")) },
            Some(all) => {
                @let rows = all.iter().take(MAX_LISTED_OFFERS).enumerate().map(|(n, offer)| row(s, n, offer));
                div.wide { (table(s, "offers", columns, rows)) (not_printed(s, all.len().min(MAX_LISTED_OFFERS))) }
                p.note { (s.word("offers.text")) }
            }
        }
    }
}

fn row(s: Style, number: usize, offer: &OfferRecord) -> Row {
    let angle = offer.kind.is_angle();
    let shown = |x: f64| if angle { x.to_degrees() } else { x };
    let with_unit = |x: &dyn Render| html! { (x) @if angle { "°" } };
    let u = shown(offer.std_uncertainty);
    Row::of(&[
        &(number + 1),
        &s.word(format!("offer.{}", offer.kind)),
        &between(&offer.segments),
        &with_unit(&s.number(shown(offer.found), decimals(Some(u), 4))),
        &with_unit(&s.small(u)),
        &with_unit(&s.number(shown(offer.offered), 4)),
        &s.number(offer.z, 2).signed(),
        &s.number(offer.p, 2),
    ])
}

/// The members of a dimension or an offer, counted from 1.
pub fn between(members: &[MemberRecord]) -> String {
    let all: Vec<String> = members.iter().map(|m| format!("{}.{}", m.contour + 1, m.segment + 1)).collect();
    all.join(" – ")
}
