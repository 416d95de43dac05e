//! Relations: directions of lines, right angles, tangents, radii and centers that agree.

use super::offer::{MAX_CHANCE, MIN_PROBABILITY, OFFER_REACH_SIGMAS, Offer, OfferKind, Untidied, Value};
use super::spread::{Shape, Spread, off_tangent, turned, turns_alike};
use crate::model::result::{Continuity, Contour};
use std::f64::consts::{FRAC_PI_2, PI};

/// Lines, and arcs, of a plane whose pairs are looked at.
pub(super) const MAX_PAIR_MEMBERS: usize = 200;

/// A segment with its contour's covariance.
#[derive(Clone, Copy)]
pub(super) struct Member<'a> {
    pub of: [usize; 2],
    pub shape: Shape,
    pub spread: &'a Spread,
}

impl Member<'_> {
    fn angle(&self) -> Option<f64> {
        if let Shape::Line { angle, .. } = self.shape { Some(angle) } else { None }
    }

    pub fn circle(&self) -> Option<([f64; 2], f64)> {
        if let Shape::Arc { center, radius } = self.shape { Some((center, radius)) } else { None }
    }

    /// A value of this segment alone.
    pub fn value(&self, value: &dyn Fn(Shape) -> f64) -> Option<Value> {
        let of_all = |s: &[Shape]| value(s[0]);
        let variance = self.spread.covariance(&[self.of[1]], &of_all, &of_all)?;
        Some(Value { found: value(self.shape), uncertainty: variance.sqrt(), degrees: self.spread.degrees })
    }

    /// A value of this and another segment.
    pub fn with(&self, other: &Member, value: &dyn Fn([Shape; 2]) -> f64) -> Option<Value> {
        let found = value([self.shape, other.shape]);
        let variance = covariance([self, other], value, value)?;
        let degrees = self.spread.degrees.min(other.spread.degrees);
        Some(Value { found, uncertainty: variance.sqrt(), degrees })
    }
}

/// Covariance of two values of two segments, of one contour or of two, which are independent.
pub(super) fn covariance(
    [a, b]: [&Member; 2],
    x: &dyn Fn([Shape; 2]) -> f64,
    y: &dyn Fn([Shape; 2]) -> f64,
) -> Option<f64> {
    if a.of[0] == b.of[0] {
        let pair = |f: &dyn Fn([Shape; 2]) -> f64, s: &[Shape]| f([s[0], s[1]]);
        return a.spread.covariance(&[a.of[1], b.of[1]], &|s| pair(x, s), &|s| pair(y, s));
    }
    let first = a.spread.covariance(&[a.of[1]], &|s| x([s[0], b.shape]), &|s| y([s[0], b.shape]))?;
    let second = b.spread.covariance(&[b.of[1]], &|s| x([a.shape, s[0]]), &|s| y([a.shape, s[0]]))?;
    Some(first + second)
}

/// All segments with an uncertainty.
pub(super) fn members(spreads: &[Result<Spread, Untidied>]) -> Vec<Member<'_>> {
    let known = spreads.iter().enumerate().filter_map(|(c, s)| Some((c, s.as_ref().ok()?)));
    let each = |(c, spread): (usize, &'_ Spread)| -> Vec<(usize, usize, Shape)> {
        spread.shapes.iter().enumerate().filter_map(|(k, s)| s.map(|s| (c, k, s))).collect()
    };
    known
        .flat_map(|(c, spread)| {
            each((c, spread)).into_iter().map(move |(c, k, shape)| Member { of: [c, k], shape, spread })
        })
        .collect()
}

/// The lines, or the arcs, that pairs are made of.
pub(super) fn limited<'a>(all: &[Member<'a>], lines: bool) -> Vec<Member<'a>> {
    all.iter()
        .filter(|m| matches!(m.shape, Shape::Line { .. }) == lines)
        .take(MAX_PAIR_MEMBERS)
        .copied()
        .collect()
}

/// All relations.
pub(super) fn all(contours: &[Contour], spreads: &[Result<Spread, Untidied>]) -> Vec<Offer> {
    let all = members(spreads);
    let (lines, arcs) = (limited(&all, true), limited(&all, false));
    let mut offers: Vec<Offer> = lines.iter().filter_map(along_axis).collect();
    for (n, line) in lines.iter().enumerate() {
        offers.extend(first_of(&lines[..n], |other, chance| parallel(other, line, chance)));
        offers.extend(first_of(&lines[..n], |other, chance| in_line(contours, other, line, chance)));
    }
    for (n, arc) in arcs.iter().enumerate() {
        offers.extend(first_of(&arcs[..n], |other, chance| equal_radii(other, arc, chance)));
        offers.extend(first_of(&arcs[..n], |other, chance| concentric(other, arc, chance)));
    }
    for a in &all {
        let next = |k: usize| (k + 1) % contours[a.of[0]].segments.len();
        let find = |k: usize| all.iter().find(|m| m.of == [a.of[0], k] && m.of != a.of);
        let last = |k: usize| !contours[a.of[0]].closed && k + 1 >= contours[a.of[0]].segments.len();
        if last(a.of[1]) {
            continue;
        }
        let neighbor = find(next(a.of[1]));
        offers.extend(neighbor.and_then(|b| tangent(&contours[a.of[0]], a, b)));
        // Over one arc, as a rounded corner, too.
        let over =
            neighbor.filter(|b| b.circle().is_some() && !last(b.of[1])).and_then(|b| find(next(b.of[1])));
        offers.extend([neighbor, over].into_iter().flatten().filter_map(|b| right_angle(a, b)).next());
    }
    offers
}

/// The offer of the first of the earlier segments that has one; the chance grows with their number.
fn first_of<'a>(earlier: &[Member<'a>], offer: impl Fn(&Member<'a>, f64) -> Option<Offer>) -> Option<Offer> {
    earlier.iter().find_map(|other| offer(other, earlier.len() as f64))
}

fn along_axis(line: &Member) -> Option<Offer> {
    let angle = line.angle()?;
    let horizontal = turned(angle, PI).abs() < 0.25 * PI;
    let (kind, offered) =
        if horizontal { (OfferKind::Horizontal, 0.0) } else { (OfferKind::Vertical, FRAC_PI_2) };
    let value = line.value(&|s| match s {
        Shape::Line { angle, .. } => offered + turned(angle - offered, PI),
        Shape::Arc { .. } => 0.0,
    })?;
    value.offer(kind, &[line.of], offered, 2.0 * OFFER_REACH_SIGMAS * value.uncertainty / FRAC_PI_2)
}

/// The angle of two lines, which have no direction, about `near`.
fn between(of: [Shape; 2], near: f64) -> f64 {
    match of {
        [Shape::Line { angle: a, .. }, Shape::Line { angle: b, .. }] => near + turned(b - a - near, PI),
        _ => 0.0,
    }
}

pub(super) fn parallel(a: &Member, b: &Member, others: f64) -> Option<Offer> {
    let value = a.with(b, &|s| between(s, 0.0))?;
    let chance = others * 2.0 * OFFER_REACH_SIGMAS * value.uncertainty / PI;
    value.offer(OfferKind::Parallel, &[a.of, b.of], 0.0, chance)
}

fn right_angle(a: &Member, b: &Member) -> Option<Offer> {
    a.angle().zip(b.angle())?;
    let value = a.with(b, &|s| between(s, FRAC_PI_2))?;
    value.offer(
        OfferKind::RightAngle,
        &[a.of, b.of],
        FRAC_PI_2,
        2.0 * OFFER_REACH_SIGMAS * value.uncertainty / PI,
    )
}

fn in_line(contours: &[Contour], a: &Member, b: &Member, others: f64) -> Option<Offer> {
    parallel(a, b, others)?;
    let at = between_them(contours, a, b);
    let value = a.with(b, &|s| across(s, at))?;
    let length = |m: &Member| contours[m.of[0]].segments[m.of[1]].length;
    let chance = others * 2.0 * OFFER_REACH_SIGMAS * value.uncertainty / length(a).max(length(b));
    value.offer(OfferKind::InLine, &[a.of, b.of], 0.0, chance)
}

/// Where the distance of two lines is taken: at the middle of where they face each other, or of the gap between them.
pub(super) fn between_them(contours: &[Contour], a: &Member, b: &Member) -> [f64; 2] {
    let [s, t] = [a, b].map(|m| &contours[m.of[0]].segments[m.of[1]]);
    let (Shape::Line { place, angle }, true) = (a.shape, s.length > 0.0) else { return s.start };
    let (sin, cos) = libm::sincos(angle);
    let far = |p: [f64; 2]| cos * (p[0] - place[0]) + sin * (p[1] - place[1]);
    let mut ends = [s.start, s.end, t.start, t.end].map(far);
    ends.sort_by(f64::total_cmp);
    let middle = 0.5 * (ends[1] + ends[2]);
    [place[0] + middle * cos, place[1] + middle * sin]
}

/// Distance of two nearly parallel lines, at the foot of a place on both, across the first.
pub(super) fn across(of: [Shape; 2], at: [f64; 2]) -> f64 {
    let [Shape::Line { place: p, angle: a }, Shape::Line { place: q, angle: b }] = of else { return 0.0 };
    let off = |place: [f64; 2], angle: f64| {
        let (sin, cos) = libm::sincos(angle);
        cos * (at[1] - place[1]) - sin * (at[0] - place[0])
    };
    // The second with the direction of the first.
    off(p, a) - off(q, a + turned(b - a, PI))
}

fn tangent(contour: &Contour, a: &Member, b: &Member) -> Option<Offer> {
    let join = contour.joins.get(a.of[1])?;
    if join.continuity != Continuity::G0 {
        return None;
    }
    let alike = turns_alike(contour, a.of[1], b.of[1]);
    let value = a.with(b, &|s| off_tangent(s, alike))?;
    let radii = [a, b].map(|m| m.circle().map_or(f64::INFINITY, |(_, r)| r));
    let scale = radii[0].min(radii[1]);
    // Two lines that join straight on are one line in two pieces.
    (scale.is_finite()).then_some(())?;
    value.offer(OfferKind::Tangent, &[a.of, b.of], 0.0, 2.0 * OFFER_REACH_SIGMAS * value.uncertainty / scale)
}

fn radius(shape: Shape) -> f64 {
    if let Shape::Arc { radius, .. } = shape { radius } else { 0.0 }
}

fn equal_radii(a: &Member, b: &Member, others: f64) -> Option<Offer> {
    let value = a.with(b, &|[s, t]| radius(t) - radius(s))?;
    let chance = others * 2.0 * OFFER_REACH_SIGMAS * value.uncertainty / radius(a.shape).max(radius(b.shape));
    value.offer(OfferKind::EqualRadii, &[a.of, b.of], 0.0, chance)
}

/// Two conditions at once: the difference is one of two coordinates.
fn concentric(a: &Member, b: &Member, others: f64) -> Option<Offer> {
    let ((c, r), (d, s)) = (a.circle()?, b.circle()?);
    let off = |k: usize| {
        move |[s, t]: [Shape; 2]| match (s, t) {
            (Shape::Arc { center: c, .. }, Shape::Arc { center: d, .. }) => d[k] - c[k],
            _ => 0.0,
        }
    };
    let of = |i: usize, j: usize| covariance([a, b], &off(i), &off(j));
    let (xx, xy, yy) = (of(0, 0)?, of(0, 1)?, of(1, 1)?);
    let area = xx * yy - xy * xy;
    let way = [d[0] - c[0], d[1] - c[1]];
    let growth = (yy * way[0] * way[0] - 2.0 * xy * way[0] * way[1] + xx * way[1] * way[1]) / area;
    let degrees = a.spread.degrees.min(b.spread.degrees);
    // The upper tail of Fisher's distribution with two degrees of freedom above.
    let p = libm::pow(1.0 + growth / degrees, -0.5 * degrees);
    let chance = others * ELLIPSE_AREA_FACTOR * area.sqrt() / (r.max(s) * r.max(s));
    let found = libm::hypot(way[0], way[1]);
    (area > 0.0 && p >= MIN_PROBABILITY && chance <= MAX_CHANCE).then(|| Offer {
        kind: OfferKind::Concentric,
        of: vec![a.of, b.of],
        found,
        uncertainty: if growth > 0.0 { found / growth.sqrt() } else { xx.max(yy).sqrt() },
        offered: 0.0,
        step: None,
        z: growth.sqrt(),
        p,
        chance,
    })
}

/// Area of the ellipse that holds 95 % over that of the standard one's square, `−2 ln 0.0455`. For a circle it is over
/// its square of radius.
const ELLIPSE_AREA_FACTOR: f64 = 6.18;
