//! Curvatures to 1e-10 of their closed forms, at places all over.

use super::super::{Bend, Nurbs, RationalSurface, Surface};
use super::turned;
use crate::num::random::Random;
use crate::space::{Point, dot};
use crate::spline::basis::Knots;
use crate::spline::value::{Mass, Value};

const NEAR: f64 = 1e-10;

/// All four curvatures are those of `principal`, in either order.
fn check(bend: &Bend, principal: [f64; 2]) {
    let [a, b] = principal;
    let found = [bend.principal[0].curvature, bend.principal[1].curvature, bend.mean, bend.gaussian];
    for (found, expected) in found.into_iter().zip([a.max(b), a.min(b), 0.5 * (a + b), a * b]) {
        assert!((found - expected).abs() < NEAR, "{bend:?} {principal:?}");
    }
    let [first, second] = bend.principal.map(|p| p.direction);
    for (x, y, expected) in [(first, first, 1.0), (second, second, 1.0), (first, second, 0.0)] {
        assert!((dot(x, y) - expected).abs() < 1e-12);
    }
}

fn places(seed: u64) -> impl Iterator<Item = [f64; 2]> {
    let mut random = Random::new(seed);
    (0..2000).map(move |_| [random.unit(), random.unit()])
}

fn knots(degree: usize) -> Knots {
    Knots::uniform(degree, 1, 0.0, 1.0)
}

/// The surface of the paper: over `x, y` from 1 to 3 its height is `4.8 s (1 − s) t (1 − t)`.
#[test]
fn the_nine_points_of_the_paper() {
    let points: Vec<Point> =
        (0..9).map(|k| [(1 + k / 3) as f64, (1 + k % 3) as f64, if k == 4 { 1.2 } else { 0.0 }]).collect();
    let surface = Surface::new([knots(2), knots(2)], points).unwrap();
    for [s, t] in places(1) {
        let (a, b) = (s * (1.0 - s), t * (1.0 - t));
        // By x and y, of which s and t are halves.
        let slope = [2.4 * (1.0 - 2.0 * s) * b, 2.4 * (1.0 - 2.0 * t) * a];
        let (xx, xy, yy) = (-2.4 * b, 1.2 * (1.0 - 2.0 * s) * (1.0 - 2.0 * t), -2.4 * a);
        let w = 1.0 + slope[0] * slope[0] + slope[1] * slope[1];
        let gaussian = (xx * yy - xy * xy) / (w * w);
        let mean = ((1.0 + slope[1] * slope[1]) * xx - 2.0 * slope[0] * slope[1] * xy
            + (1.0 + slope[0] * slope[0]) * yy)
            / (2.0 * w.powf(1.5));
        let bend = surface.bend(s, t).unwrap();
        assert!((bend.mean - mean).abs() < NEAR && (bend.gaussian - gaussian).abs() < NEAR);
        let [k, l] = bend.principal.map(|p| p.curvature);
        assert!(k >= l && (0.5 * (k + l) - mean).abs() < NEAR && (k * l - gaussian).abs() < NEAR);
        assert!(bend.normal[2] > 0.0);
    }
    let middle = surface.bend(0.5, 0.5).unwrap();
    check(&middle, [-0.6, -0.6]);
}

/// Three mass points at parameters −1, 0, 1 interpolate half a circle; over `z` it is half a cylinder. Between them the control
/// point has no mass: it is a direction.
#[test]
fn the_half_circle_of_three_mass_points() {
    let line = |z: f64| {
        [([-1.0, 0.0], 2.0), ([0.0, 1.0], 1.0), ([1.0, 0.0], 2.0)].map(|([x, y], m)| Mass::new([x, y, z], m))
    };
    // The control points of a quadratic through a, b, c at the ends and the middle are a, 2 b − (a + c) / 2, c.
    let control = |[a, b, c]: [Mass<3>; 3]| [a, b.times(2.0).plus(-0.5, a).plus(-0.5, c), c];
    let [low, high] = [control(line(0.0)), control(line(5.0))];
    assert_eq!((low[1].mass, low[1].place()), (0.0, None));
    let masses = (0..6).map(|k| if k % 2 == 0 { low[k / 2] } else { high[k / 2] }).collect();
    let half = RationalSurface::from(Surface::new([knots(2), knots(1)], masses).unwrap());
    for [u, v] in places(2) {
        let [x, y, z] = half.at(u, v).unwrap();
        assert!((x.hypot(y) - 1.0).abs() < 1e-14 && y >= 0.0 && (z - 5.0 * v).abs() < 1e-14);
        let bend = half.bend(u, v).unwrap();
        check(&bend, [0.0, -dot(bend.normal, [x, y, 0.0]).signum()]);
    }
}

#[test]
fn sphere_cylinder_and_torus() {
    let (sphere, torus) = (turned(0.0, 2.5), turned(7.0, 2.0));
    let arc = [([3.0, 0.0], 1.0), ([3.0, 3.0], 0.5f64.sqrt()), ([0.0, 3.0], 1.0)];
    let points: Vec<(Point, f64)> =
        arc.iter().flat_map(|([x, y], w)| [0.0, 4.0].map(|z| ([*x, *y, z], *w))).collect();
    let cylinder = Nurbs::weighted([knots(2), knots(1)], &points).unwrap();
    for [u, v] in places(3) {
        let [x, y, z] = torus.at(u, v).unwrap();
        let (r, bend) = (x.hypot(y), torus.bend(u, v).unwrap());
        let cos = (r - 7.0) / 2.0;
        let outward = dot(bend.normal, [cos * x / r, cos * y / r, z / 2.0]).signum();
        check(&bend, [-outward / 2.0, -outward * cos / r]);
        let [x, y, _] = cylinder.at(u, v).unwrap();
        let bend = cylinder.bend(u, v).unwrap();
        check(&bend, [0.0, -dot(bend.normal, [x, y, 0.0]).signum() / 3.0]);
        // Up to a thousandth of a radian from the pole.
        let v = 0.999 * v;
        let bend = sphere.bend(u, v).unwrap();
        let outward = dot(bend.normal, sphere.at(u, v).unwrap()).signum();
        check(&bend, [-outward / 2.5, -outward / 2.5]);
    }
}

/// The curve over a line is the surface there, to rounding: of all degrees, along knots, from corner to corner and across many cells.
#[test]
fn curves_over_lines_are_exact() {
    let random = &mut Random::new(12);
    for degrees in [[1, 2], [3, 3], [9, 5], [2, 9]] {
        let knots = [Knots::uniform(degrees[0], 5, 0.0, 10.0), Knots::uniform(degrees[1], 4, -1.0, 3.0)];
        let count = knots[0].count() * knots[1].count();
        let points: Vec<Point> = (0..count).map(|_| std::array::from_fn(|_| random.unit())).collect();
        let surface = Surface::new(knots, points).unwrap();
        for case in 0..100 {
            let mut end = || [10.0 * random.unit(), 4.0 * random.unit() - 1.0];
            let (mut from, mut to) = (end(), end());
            if case % 5 == 0 {
                // Along a knot.
                (from[0], to[0]) = (4.0, 4.0);
            }
            if case % 7 == 0 {
                (from, to) = ([0.0, -1.0], [10.0, 3.0]);
            }
            let curve = surface.over_line(from, to);
            assert_eq!(curve.knots().degree(), degrees[0] + degrees[1]);
            for step in 0..=40 {
                let t = f64::from(step) / 40.0;
                let [u, v] = [0, 1].map(|k| from[k] + t * (to[k] - from[k]));
                assert!(super::near(curve.at(t), surface.at(u, v), 1e-14), "{degrees:?} {case} {t}");
            }
        }
    }
}
