//! Feet on a turned curve.
//!
//! Where the curve lies in a plane with the axis, a foot lies in the plane of the axis and the point, on the side of the point or
//! on the other: there the curve is asked for its nearest places. Where it does not, as for the line that makes a hyperboloid, the curve is
//! tried in many places, and a descent leads on from the best ones: a foot may be missed where the curve winds more finely.

use super::foot::Foot;
use super::kinds::Surface;
use crate::curve::{Curve, CurveFeet};
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, plus, times, unit};
use trueness_geom::spline::surface::descend;

/// The curve of a surface of revolution.
#[derive(Clone, Debug)]
pub(super) struct Profile {
    feet: CurveFeet,
    curve: Curve,
    origin: Point,
    axis: Vector,
    /// From the axis to the curve.
    way: Vector,
    /// How far it is from the plane of the axis and `way`.
    off: f64,
    /// Size of the curve with its coordinates.
    scale: f64,
}

/// Share of its size within which a curve lies in a plane, but for rounding.
const FLAT: f64 = 1e-13;
/// Share within which it was meant to: files have some seven digits and more. A descent corrects what the plane is off.
const NEARLY_FLAT: f64 = 1e-5;
/// Share of size and distance up to which the distance in the plane is that in space.
const ROUNDED_DISTANCE_SHARE: f64 = 1e-12;
/// Places at which each piece of a curve is tried that does not lie in a plane with the axis.
const PLACES_OF_PIECE: usize = 32;
/// How far beyond the point's height an infinite curve is tried, in distances from the axis.
const INFINITE_CURVE_REACH: f64 = 4.0;

impl Profile {
    pub(super) fn new(curve: &Curve, origin: Point, axis: Vector) -> Profile {
        let feet = CurveFeet::new(curve, curve.domain());
        let support = feet.support();
        let flat = |p: &Point| {
            let arm = minus(*p, origin);
            minus(arm, times(dot(arm, axis), axis))
        };
        let farthest = support.iter().map(flat).reduce(|a, b| if norm(b) > norm(a) { b } else { a });
        let (way, size) = farthest.and_then(unit).unwrap_or(([0.0; 3], 0.0));
        let across = cross(axis, way);
        let scale = size + support.iter().map(|p| norm(*p)).fold(0.0, f64::max);
        let off = support.iter().map(|p| dot(flat(p), across).abs()).fold(0.0, f64::max);
        Profile { feet, curve: curve.clone(), origin, axis, way, off, scale }
    }

    pub(super) fn visit(&self, surface: &Surface, p: Point, limit: f64, visit: &mut dyn FnMut(Foot) -> f64) {
        let arm = minus(p, self.origin);
        let height = dot(arm, self.axis);
        let across = cross(self.axis, self.way);
        let [x, y] = [dot(arm, self.way), dot(arm, across)];
        let rho = norm(minus(arm, times(height, self.axis)));
        let mut limit = limit;
        if self.off > NEARLY_FLAT * self.scale {
            return self.search(surface, p, [rho, height], visit);
        }
        for side in [1.0, -1.0] {
            let angle = if rho > 0.0 { libm::atan2(side * y, side * x) } else { 0.0 };
            let turned = plus(self.origin, plus(times(height, self.axis), times(side * rho, self.way)));
            self.feet.candidates(turned, limit + 2.0 * self.off, |foot| {
                if foot.distance
                    > limit + 2.0 * self.off + ROUNDED_DISTANCE_SHARE * (self.scale + foot.distance)
                {
                    return limit + 2.0 * self.off;
                }
                let start = [angle, foot.parameter];
                let foot = if self.off > FLAT * self.scale {
                    self.descent(surface, p, start)
                } else {
                    let place = surface.at(angle, foot.parameter);
                    Foot { parameters: start, place, distance: norm(minus(place, p)) }
                };
                limit = visit(foot);
                limit + 2.0 * self.off
            });
        }
    }

    /// From the best of many places.
    fn search(
        &self,
        surface: &Surface,
        p: Point,
        [rho, height]: [f64; 2],
        visit: &mut dyn FnMut(Foot) -> f64,
    ) {
        let seen = |t: f64| {
            let arm = minus(self.curve.at(t), self.origin);
            let along = dot(arm, self.axis);
            let flat = minus(arm, times(along, self.axis));
            (libm::hypot(norm(flat) - rho, along - height), flat)
        };
        let arm = minus(p, self.origin);
        let across = cross(self.axis, self.way);
        let own = libm::atan2(dot(arm, across), dot(arm, self.way));
        for (_, [low, high]) in self.feet.pieces() {
            let [low, high] = self.finite([low, high], height, rho);
            let at = |i: usize| low + (high - low) * i as f64 / PLACES_OF_PIECE as f64;
            let values: Vec<f64> = (0..=PLACES_OF_PIECE).map(|i| seen(at(i)).0).collect();
            for i in 0..=PLACES_OF_PIECE {
                let around = &values[i.saturating_sub(1)..(i + 2).min(values.len())];
                if around.iter().any(|v| *v < values[i]) {
                    continue;
                }
                let flat = seen(at(i)).1;
                let angle = own - libm::atan2(dot(flat, across), dot(flat, self.way));
                visit(self.descent(surface, p, [angle, at(i)]));
            }
        }
    }

    fn descent(&self, surface: &Surface, p: Point, start: [f64; 2]) -> Foot {
        let domain = [(f64::NEG_INFINITY, f64::INFINITY), self.curve.domain().into()];
        let (foot, _) = descend(|[u, v]| surface.jet(u, v), domain, p, start);
        Foot { parameters: foot.parameters, place: foot.place, distance: foot.distance }
    }

    /// The part of an infinite piece that may be near.
    fn finite(&self, range: [f64; 2], height: f64, rho: f64) -> [f64; 2] {
        if range.iter().all(|t| t.is_finite()) {
            return range;
        }
        let [start, first, _] = self.curve.derivatives(0.0);
        let speed = norm(first).max(f64::MIN_POSITIVE);
        let far = INFINITE_CURVE_REACH * (norm(minus(start, self.origin)) + height.abs() + rho) / speed;
        [range[0].max(-far), range[1].min(far)]
    }
}
