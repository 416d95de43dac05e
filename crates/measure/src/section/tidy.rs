//! What a drawing of a contour would have, as offers.

use super::found::Section;
use crate::words::ToWord;
use trueness_document::section::{MemberRecord, OfferRecord};
use trueness_section::{Offer, Untidied, tidy};

/// The offers of a contour, or why there are none.
pub(super) type Offers = Result<Vec<OfferRecord>, Untidied>;

/// The offers of each contour, plane after plane: to the contour of their first segment.
pub(super) fn offers(sections: &[Section], rows: &[Vec<[f64; 2]>]) -> Vec<Offers> {
    let mut all: Vec<Offers> = vec![];
    for section in sections {
        let before = all.len();
        let own: Vec<&[[f64; 2]]> =
            rows.iter().skip(before).take(section.contours.len()).map(|r| &r[..]).collect();
        let (offers, why) = tidy(&section.contours, &own);
        all.extend(why.into_iter().map(|why| why.map_or(Ok(vec![]), Err)));
        for offer in &offers {
            let own = offer.of.first().and_then(|[c, _]| all.get_mut(before + c)?.as_mut().ok());
            own.into_iter().for_each(|all| all.push(record(offer, before)));
        }
    }
    all
}

fn record(offer: &Offer, before: usize) -> OfferRecord {
    let member = |[c, k]: &[usize; 2]| MemberRecord { contour: (before + c) as u64, segment: *k as u64 };
    OfferRecord {
        kind: offer.kind.word(),
        segments: offer.of.iter().map(member).collect(),
        found: offer.found,
        std_uncertainty: offer.uncertainty,
        offered: offer.offered,
        step: offer.step,
        z: offer.z,
        p: offer.p,
        chance: offer.chance,
    }
}
