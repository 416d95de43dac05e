//! Whole numbers: radii, diameters, lengths, distances of parallel lines and of centers.

use super::offer::{MAX_CHANCE, OFFER_REACH_SIGMAS, Offer, OfferKind, Untidied, Value};
use super::relation::{Member, across, between_them, limited, members, parallel};
use super::spread::{Shape, Spread};
use crate::model::result::{Contour, Geometry};
use std::f64::consts::TAU;

/// The coarsest step, millimeters; the next ones are its half, fifth of that, and so on.
const COARSEST_STEP: f64 = 1.0;
/// From this share of a turn on an arc is drawn with its diameter.
const MIN_TURN_WITH_DIAMETER: f64 = 0.75;

impl Value {
    /// The coarsest multiple of a step of 1, 0.5, 0.1, 0.05 … that the points allow, as long as chance seldom does.
    fn whole(self, kind: OfferKind, of: &[[usize; 2]]) -> Option<Offer> {
        let mut divisor = 1.0;
        for finer in [2.0, 5.0].into_iter().cycle() {
            let step = COARSEST_STEP / divisor;
            let chance = 2.0 * OFFER_REACH_SIGMAS * self.uncertainty / step;
            if chance.is_nan() || chance > MAX_CHANCE || step < FINEST_STEP {
                return None;
            }
            let offered = (self.found * divisor / COARSEST_STEP).round() / divisor * COARSEST_STEP;
            if let Some(offer) = self.offer(kind, of, offered, chance).filter(|_| offered > 0.0) {
                return Some(Offer { step: Some(step), ..offer });
            }
            divisor *= finer;
        }
        None
    }
}

#[cfg(test)]
impl Value {
    pub(super) fn whole_of(self, kind: OfferKind) -> Option<Offer> {
        self.whole(kind, &[[0, 0]])
    }
}

/// The finest step.
const FINEST_STEP: f64 = 1e-4;

/// All whole numbers.
pub(super) fn all(contours: &[Contour], spreads: &[Result<Spread, Untidied>]) -> Vec<Offer> {
    let all = members(spreads);
    let (lines, arcs) = (limited(&all, true), limited(&all, false));
    let mut offers: Vec<Offer> = all.iter().filter_map(|m| own(contours, m)).collect();
    for (n, a) in lines.iter().enumerate() {
        offers.extend(lines[n + 1..].iter().filter_map(|b| distance(contours, a, b)));
    }
    for (n, a) in arcs.iter().enumerate() {
        offers.extend(arcs[n + 1..].iter().filter_map(|b| centers(a, b)));
    }
    offers
}

/// Radius, diameter or length of a segment.
fn own(contours: &[Contour], m: &Member) -> Option<Offer> {
    let segment = &contours[m.of[0]].segments[m.of[1]];
    let Geometry::Arc { sweep, .. } = segment.geometry else {
        let (found, uncertainty) = (segment.length, segment.length_uncertainty?);
        return Value { found, uncertainty, degrees: m.spread.degrees }.whole(OfferKind::Length, &[m.of]);
    };
    let (kind, times) = match sweep.abs() >= MIN_TURN_WITH_DIAMETER * TAU {
        true => (OfferKind::Diameter, 2.0),
        false => (OfferKind::Radius, 1.0),
    };
    let of = |s: Shape| if let Shape::Arc { radius, .. } = s { times * radius } else { 0.0 };
    m.value(&of)?.whole(kind, &[m.of])
}

/// Distance of two lines that are parallel as far as their points tell.
fn distance(contours: &[Contour], a: &Member, b: &Member) -> Option<Offer> {
    parallel(a, b, 1.0)?;
    let at = between_them(contours, a, b);
    let value = a.with(b, &|s| across(s, at))?;
    let found = value.found.abs();
    (found > OFFER_REACH_SIGMAS * value.uncertainty).then_some(())?;
    Value { found, ..value }.whole(OfferKind::Distance, &[a.of, b.of])
}

fn centers(a: &Member, b: &Member) -> Option<Offer> {
    let ((c, _), (d, _)) = (a.circle()?, b.circle()?);
    let apart = |c: [f64; 2], d: [f64; 2]| libm::hypot(d[0] - c[0], d[1] - c[1]);
    let way = apart(c, d);
    let value = a.with(b, &|[s, t]| match (s, t) {
        (Shape::Arc { center: c, .. }, Shape::Arc { center: d, .. }) => apart(c, d),
        _ => 0.0,
    })?;
    (way > OFFER_REACH_SIGMAS * value.uncertainty)
        .then(|| value.whole(OfferKind::Centers, &[a.of, b.of]))
        .flatten()
}
