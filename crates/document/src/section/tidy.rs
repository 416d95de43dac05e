//! What a drawing of a contour would have, as offers.

use super::dimension::MemberRecord;
use super::found::Section;
use crate::Word;
use crate::word::named;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trueness_section::{Offer, OfferKind, tidy};

named!(OfferKind, "kind of offer", Self::ALL, |kind| kind.name());

/// A relation, or a whole number, that the points allow. The contour does not have it: it is as it was found.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct OfferRecord {
    /// `horizontal` or `vertical` line, lines that are `parallel`, `in_line` or at a `right_angle`, `tangent` segments, `equal_radii` or
    /// `concentric` arcs, or a whole number of steps: `radius`, `diameter`, `length` of a line, `distance` of parallel lines, distance of
    /// `centers`.
    pub kind: Word<OfferKind>,
    /// The segments that it is about.
    pub segments: Vec<MemberRecord>,
    /// The value found: a length, or an angle in radians; of `in_line`, `tangent`, `equal_radii` and `concentric` how far that is missed.
    pub found: f64,
    /// Its standard uncertainty, from the scatter of the points; of `concentric` that along the way from center to center.
    pub std_uncertainty: f64,
    /// The value offered.
    pub offered: f64,
    /// Of a whole number the step that it is a multiple of, millimeters.
    pub step: Option<f64>,
    /// The difference in standard uncertainties. With what is offered the sum of the squared distances grows by its square times the
    /// variance of the points (twice the logarithm of the likelihood ratio is the square).
    pub z: f64,
    /// The probability of a difference as large, if what is offered holds.
    pub p: f64,
    /// The probability that a value which has nothing to do with it would be offered, too.
    pub chance: f64,
}

/// The offers of a contour, or why there are none.
pub(super) type Offers = Result<Vec<OfferRecord>, String>;

/// The offers of each contour, plane after plane: to the contour of their first segment.
pub(super) fn offers(sections: &[Section], rows: &[Vec<[f64; 2]>]) -> Vec<Offers> {
    let mut all: Vec<Offers> = vec![];
    for section in sections {
        let before = all.len();
        let own: Vec<&[[f64; 2]]> =
            rows.iter().skip(before).take(section.contours.len()).map(|r| &r[..]).collect();
        let (offers, why) = tidy(&section.contours, &own);
        all.extend(why.into_iter().map(|why| why.map_or(Ok(vec![]), |why| Err(why.reason().into()))));
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
        kind: Word(offer.kind),
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
