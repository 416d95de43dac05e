//! What a drawing of a contour would have, for people.

use crate::console;
use crate::number::{fixed, scientific};
use std::fmt::Write;
use trueness_document::section::{ContourRecord, OfferRecord};

/// Offers of a contour that are shown.
const MAX_OFFER_ROWS: usize = 40;

/// The offers of a contour; nothing where they were not asked for.
pub fn offers(contour: &ContourRecord) -> String {
    let mut out = String::new();
    if let Some(reason) = &contour.tidy_reason {
        let _ = writeln!(out, "no offers: {reason}");
    }
    let Some(all) = &contour.tidy else { return out };
    if all.is_empty() {
        out.push_str("no offers: the points allow no relation or whole number that chance would not\n");
        return out;
    }
    let head = ["offer", "of", "found", "± standard uncertainty", "offered", "z", "p"];
    let mut rows = vec![head.map(String::from).to_vec()];
    rows.extend(all.iter().take(MAX_OFFER_ROWS).map(row));
    out.push_str(&console::columns(&rows));
    if all.len() > MAX_OFFER_ROWS {
        let _ = writeln!(out, "… and {} more", all.len() - MAX_OFFER_ROWS);
    }
    out
}

fn row(offer: &OfferRecord) -> Vec<String> {
    let angle = offer.kind.is_angle();
    let shown = |x: f64| if angle { x.to_degrees() } else { x };
    let unit = if angle { "°" } else { "" };
    let of = offer.segments.iter().map(|m| format!("{}.{}", m.contour + 1, m.segment + 1));
    vec![
        offer.kind.name().replace('_', " "),
        of.collect::<Vec<_>>().join(" "),
        format!("{}{unit}", fixed(shown(offer.found), 6)),
        scientific(shown(offer.std_uncertainty), 2),
        format!("{}{unit}", fixed(shown(offer.offered), 4)),
        fixed(offer.z, 2),
        fixed(offer.p, 2),
    ]
}
