//! Where a surface repeats, and where it shrinks to a place.

use super::kinds::Surface;
use crate::curve::{Curve, CurveFeet};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use trueness_geom::space::{Aabb, Point, dot, minus, norm, plus, times};
use trueness_geom::spline::rational::Rational;
use trueness_geom::spline::surface::{Direction, Nurbs};

/// A line of equal `u`, or of equal `v`, that is a single place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pole {
    /// The parameter that is held: 0 for `u`, 1 for `v`.
    pub held: usize,
    /// What it is there.
    pub at: f64,
    /// The place.
    pub place: Point,
}

/// Share of a surface's size below which two places of its border are one: what is left of coordinates written with ten digits.
pub(super) const ROUNDED_PLACE_SHARE: f64 = 1e-9;

impl Surface {
    /// After how much each parameter repeats: a turn where the surface is turned, the length of the domain where a spline or a curve
    /// closes; `None` where it does not.
    pub fn periods(&self) -> [Option<f64>; 2] {
        match self {
            Surface::Plane(_) => [None, None],
            Surface::Cylinder { .. } | Surface::Cone { .. } | Surface::Sphere { .. } => [Some(TAU), None],
            Surface::Torus { major, minor, .. } => [Some(TAU), (major >= minor).then_some(TAU)],
            Surface::Spline(nurbs) => [Direction::U, Direction::V].map(|held| {
                let (from, to) = nurbs.knots()[held as usize].domain();
                let [first, last] = [from, to].map(|t| border(nurbs, held, t));
                let size =
                    Aabb::of(&nurbs.control_points().into_iter().map(|p| p.0).collect::<Vec<_>>()).diagonal();
                let is_same = |(a, b): (&Point, &Point)| norm(minus(*a, *b)) <= ROUNDED_PLACE_SHARE * size;
                let is_closed =
                    first.iter().zip(&last).all(is_same) && !is_one(&first, ROUNDED_PLACE_SHARE * size);
                is_closed.then_some(to - from)
            }),
            Surface::Extrusion { curve, .. } => [turn(curve), None],
            Surface::Revolution { curve, .. } => [Some(TAU), turn(curve)],
            Surface::Offset { basis, .. } => basis.periods(),
        }
    }

    /// The lines that are single places: poles of spheres, apexes, places where a torus meets its axis, sides of splines without a
    /// length, ends of profiles on the axis.
    pub fn poles(&self) -> Vec<Pole> {
        let along = |at: f64| Pole { held: 1, at, place: self.at(0.0, at) };
        match self {
            Surface::Plane(_) | Surface::Cylinder { .. } | Surface::Extrusion { .. } => vec![],
            Surface::Cone { radius, half_angle, .. } => {
                let at = -radius / libm::tan(*half_angle);
                if at.is_finite() { vec![along(at)] } else { vec![] }
            }
            Surface::Sphere { .. } => [-FRAC_PI_2, FRAC_PI_2].map(along).to_vec(),
            Surface::Torus { major, minor, .. } if major == minor => vec![along(PI)],
            Surface::Torus { major, minor, .. } if major < minor => self.domain()[1].map(along).to_vec(),
            Surface::Torus { .. } => vec![],
            Surface::Spline(nurbs) => spline_poles(nurbs),
            Surface::Revolution { curve, origin, axis } => profile_poles(curve, *origin, *axis),
            Surface::Offset { basis, distance } => {
                // The normal is the same all along the line only where the basis is smooth there.
                let moved = |pole: Pole| {
                    let [from, to] = basis.domain()[1 - pole.held];
                    let at = |share: f64| {
                        let other = from + share * (to - from);
                        let [u, v] = if pole.held == 0 { [pole.at, other] } else { [other, pole.at] };
                        self.near_pole([u, v], pole.held)
                    };
                    let places = [0.0, 0.3, 0.7].map(at);
                    let near = ROUNDED_PLACE_SHARE.sqrt() * (distance.abs() + norm(pole.place));
                    (is_one(&places, near)).then_some(Pole { place: places[0], ..pole })
                };
                basis.poles().into_iter().filter_map(moved).collect()
            }
        }
    }

    /// The place a little beside a pole, where there is a normal.
    fn near_pole(&self, [u, v]: [f64; 2], held: usize) -> Point {
        let [from, to] = self.domain()[held];
        let step = if from.is_finite() && to.is_finite() {
            ROUNDED_PLACE_SHARE * (to - from)
        } else {
            ROUNDED_PLACE_SHARE
        };
        let middle = if from.is_finite() && to.is_finite() { 0.5 * (from + to) } else { 0.0 };
        let inward = |x: f64| if x > middle { x - step } else { x + step };
        if held == 0 { self.at(inward(u), v) } else { self.at(u, inward(v)) }
    }
}

impl Curve {
    /// Whether it comes back to its start.
    pub fn is_closed(&self) -> bool {
        let [from, to] = self.domain();
        let has_ends = from.is_finite() && to.is_finite();
        has_ends
            && (self.period().is_some() || {
                let size = CurveFeet::new(self, [from, to]).bounds().diagonal();
                norm(minus(self.at(from), self.at(to))) <= ROUNDED_PLACE_SHARE * size
            })
    }
}

fn turn(curve: &Curve) -> Option<f64> {
    let [from, to] = curve.domain();
    curve.is_closed().then_some(to - from)
}

fn is_one(places: &[Point], near: f64) -> bool {
    places.iter().all(|p| norm(minus(*p, places[0])) <= near)
}

/// The line of a spline surface along which a parameter is held.
pub(super) fn iso_curve(nurbs: &Nurbs, held: Direction, t: f64) -> Curve {
    match nurbs {
        Nurbs::Plain(s) => Curve::Spline(s.iso_curve(held, t)),
        Nurbs::Rational(s) => Curve::Rational(Rational::from(s.masses().iso_curve(held, t))),
    }
}

/// The control points of such a line.
fn border(nurbs: &Nurbs, held: Direction, t: f64) -> Vec<Point> {
    match iso_curve(nurbs, held, t) {
        Curve::Spline(curve) => curve.points().to_vec(),
        Curve::Rational(curve) => curve.masses().points().iter().filter_map(|m| m.place()).collect(),
        _ => vec![],
    }
}

fn spline_poles(nurbs: &Nurbs) -> Vec<Pole> {
    let size = Aabb::of(&nurbs.control_points().into_iter().map(|p| p.0).collect::<Vec<_>>()).diagonal();
    let mut found = vec![];
    for held in [Direction::U, Direction::V] {
        let (from, to) = nurbs.knots()[held as usize].domain();
        for at in [from, to] {
            let places = border(nurbs, held, at);
            if is_one(&places, ROUNDED_PLACE_SHARE * size) {
                found.extend(places.first().map(|place| Pole { held: held as usize, at, place: *place }));
            }
        }
    }
    found
}

/// Where a profile meets the axis that it is turned about.
fn profile_poles(curve: &Curve, origin: Point, axis: Point) -> Vec<Pole> {
    let domain = curve.domain();
    let shadow = CurveFeet::along(curve, domain, axis);
    let center = minus(origin, times(dot(origin, axis), axis));
    // An infinite profile has no size of its own: how far off it starts stands for it.
    let reach = shadow.bounds().diagonal();
    let size = if reach.is_finite() { reach } else { norm(minus(curve.at(0.0), origin)) };
    let mut found: Vec<Pole> = vec![];
    shadow.candidates(center, f64::INFINITY, |foot| {
        let is_known =
            |pole: &Pole| (pole.at - foot.parameter).abs() <= ROUNDED_PLACE_SHARE * (1.0 + pole.at.abs());
        if foot.distance <= ROUNDED_PLACE_SHARE * size && !found.iter().any(is_known) {
            let arm = minus(curve.at(foot.parameter), origin);
            let place = plus(origin, times(dot(arm, axis), axis));
            found.push(Pole { held: 1, at: foot.parameter, place });
        }
        f64::INFINITY
    });
    found.sort_by(|a, b| a.at.total_cmp(&b.at));
    found
}
