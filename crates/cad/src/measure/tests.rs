//! Closed forms, wherever a part stands and wherever its seams are.

use super::*;
use crate::brep::Face;
use crate::curve::{Curve, Span};
use crate::frame::{Frame, Placement};
use crate::surface::Surface;
use crate::trim::tests::{Made, circle, drum, frame};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use trueness_geom::num::random::Random;
use trueness_geom::space::{Aabb, cross};
use trueness_geom::spline::{basis::Knots, surface::Nurbs};

fn of(made: &Made, face: &Face, origin: Point) -> Integrals {
    Integrals::of(&Trim::new(&made.brep, face, 0.0).unwrap(), origin)
}

fn total(made: &Made, origin: Point) -> Integrals {
    made.brep.faces.iter().map(|f| of(made, f, origin)).reduce(|a, b| a.plus(&b)).unwrap()
}

fn assert_near(a: f64, b: f64, what: &str) {
    assert!((a - b).abs() <= 1e-10 * b.abs(), "{what}: {a} is not {b}");
}

#[test]
fn drums_have_their_area_and_volume_wherever_they_stand() {
    for seed in 0..20 {
        let frame = frame(seed);
        let (r, h) = (1.0 + seed as f64, 3.0);
        let made = drum(&frame, r, h, 0.37 * seed as f64);
        let whole = total(&made, [0.3, -7.0, 2.0]);
        assert_near(whole.area, TAU * r * (r + h), "area");
        assert_near(whole.volume, PI * r * r * h, "volume");
        let center = frame.place([0.0, 0.0, 0.5 * h]);
        assert!(norm(minus(whole.center_of_volume(), center)) < 1e-9);
        assert!(norm(minus(whole.center_of_area(), center)) < 1e-9);
        assert!(whole.errors[0] < 1e-9 * whole.area && whole.errors[1] < 1e-9 * whole.volume);
        let bounds = made.brep.faces.iter().map(|f| bounds(&Trim::new(&made.brep, f, 0.0).unwrap()));
        let bounds = bounds.fold(Aabb::EMPTY, |a, b| a.union(&b));
        for k in 0..3 {
            // Of a disk: r times the sine of the angle between its normal and the axis.
            let along = frame.axes[2][k];
            let wide = r * f64::sqrt(1.0 - along * along);
            let ends = [frame.origin[k], frame.origin[k] + h * along];
            assert!((bounds.min[k] - (ends[0].min(ends[1]) - wide)).abs() < 1e-12 * r * 10.0);
            assert!((bounds.max[k] - (ends[0].max(ends[1]) + wide)).abs() < 1e-12 * r * 10.0);
        }
    }
}

#[test]
fn cones_reach_their_apex() {
    for seed in 0..20 {
        let base = frame(seed);
        let (r, h) = (2.0, 1.0 + 0.5 * seed as f64);
        let mut made = Made::default();
        let rim = made.edge(circle(&base, 0.0, r, 0.4 * seed as f64));
        let half_angle = f64::atan(r / h);
        // The apex above: the radius falls along the axis; or the axis turned over.
        let surface = if seed % 2 == 0 {
            Surface::Cone { frame: base, radius: r, half_angle: -half_angle }
        } else {
            let [x, y, z] = base.axes;
            let over = Frame { origin: base.origin, axes: [x, y.map(|c| -c), z.map(|c| -c)] };
            Surface::Cone { frame: over, radius: r, half_angle }
        };
        // Both have a normal that looks outward: `∂u × ∂v` does where the radius is above 0.
        made.face(surface, false, &[&[(rim, false)]]);
        made.face(Surface::Plane(base), true, &[&[(rim, true)]]);
        let whole = total(&made, [0.0; 3]);
        assert_near(whole.area, PI * r * (r + f64::hypot(r, h)), "area");
        assert_near(whole.volume, PI * r * r * h / 3.0, "volume");
        let center = base.place([0.0, 0.0, 0.25 * h]);
        assert!(norm(minus(whole.center_of_volume(), center)) < 1e-9);
        let trim = Trim::new(&made.brep, &made.brep.faces[0], 0.0).unwrap();
        let apex = base.place([0.0, 0.0, h]);
        assert!(bounds(&trim).widened(1e-9).holds(&apex));
    }
}

#[test]
fn caps_of_spheres_have_their_area_whatever_their_axis() {
    for seed in 0..40 {
        let base = frame(seed);
        let mut random = Random::new(seed);
        let r = 2.0;
        let h = r * (1.8 * random.unit() - 0.9);
        let axis = [0, 1, 2].map(|_| random.unit() - 0.5);
        let other = Frame::new(base.origin, base.vector(axis), None).unwrap();
        let mut made = Made::default();
        let rim = made.edge(circle(&base, h, f64::sqrt(r * r - h * h), TAU * random.unit()));
        let top = Frame { origin: base.place([0.0, 0.0, h]), ..base };
        made.face(Surface::Sphere { frame: other, radius: r }, false, &[&[(rim, false)]]);
        made.face(Surface::Plane(top), true, &[&[(rim, true)]]);
        let whole = total(&made, [1.0, 2.0, 3.0]);
        let d = r - h;
        assert_near(whole.area, TAU * r * d + PI * (r * r - h * h), "area");
        assert_near(whole.volume, PI * d * d * (3.0 * r - d) / 3.0, "volume");
    }
}

#[test]
fn tori_are_measured_whole_cut_and_where_they_meet_themselves() {
    for seed in 0..6 {
        let base = frame(seed);
        for (major, minor) in [(3.0f64, 1.0f64), (1.0, 1.0), (1.0, 2.0), (-1.0, 2.0)] {
            let mut made = Made::default();
            made.face(Surface::Torus { frame: base, major, minor }, false, &[]);
            let whole = total(&made, [0.0; 3]);
            // Pappus: the profile from −a to a turned about the axis.
            let a = f64::acos((-major / minor).clamp(-1.0, 1.0));
            assert_near(whole.area, TAU * minor * 2.0 * (major * a + minor * f64::sin(a)), "area");
            let [s, c] = [f64::sin(a), f64::cos(a)];
            // ∫ π ρ² dz with ρ = R + r cos v, z = r sin v.
            let volume = TAU
                * minor
                * (major * major * s + major * minor * (a + s * c) + minor * minor * (s - s * s * s / 3.0));
            assert_near(whole.volume, volume, "volume");
            let bounds = bounds(&Trim::new(&made.brep, &made.brep.faces[0], 0.0).unwrap());
            for k in 0..3 {
                let along = base.axes[2][k];
                let high = if major >= 0.0 {
                    major * f64::sqrt(1.0 - along * along) + minor
                } else {
                    // A lemon: poles on the axis, or where its arc stands still.
                    let tip = f64::sqrt(minor * minor - major * major) * along.abs();
                    let v = f64::atan2(along.abs(), f64::sqrt(1.0 - along * along));
                    if v < a { minor + major * f64::sqrt(1.0 - along * along) } else { tip }
                };
                assert!((bounds.max[k] - base.origin[k] - high).abs() < 1e-10, "{major} {minor} {k}");
                assert!((bounds.min[k] - base.origin[k] + high).abs() < 1e-10, "{major} {minor} {k}");
            }
        }
        // Half of a torus: cut by a plane through its axis.
        let mut made = Made::default();
        let (major, minor) = (3.0, 1.0);
        let tube = |u: f64| {
            let x = base.vector([f64::cos(u), f64::sin(u), 0.0]);
            let origin = plus(base.origin, times(major, x));
            Frame::new(origin, cross(x, base.axes[2]), Some(x)).unwrap()
        };
        let (a, b) = (
            made.edge(circle(&tube(1.0), 0.0, minor, 0.3)),
            made.edge(circle(&tube(1.0 + PI), 0.0, minor, 0.9)),
        );
        made.face(Surface::Torus { frame: base, major, minor }, false, &[&[(a, true)], &[(b, false)]]);
        made.face(Surface::Plane(tube(1.0)), false, &[&[(a, false)]]);
        made.face(Surface::Plane(tube(1.0 + PI)), true, &[&[(b, true)]]);
        let whole = total(&made, [0.0; 3]);
        assert_near(whole.area, 2.0 * PI * PI * major * minor + TAU, "area");
        assert_near(whole.volume, PI * PI * major, "volume");
    }
}

#[test]
fn octants_of_a_sphere_have_an_eighth() {
    let base = frame(9);
    let mut made = Made::default();
    let arc = |x: usize, y: usize| {
        let [a, b] = [base.axes[x], base.axes[y]];
        let frame = Frame { origin: base.origin, axes: [a, b, cross(a, b)] };
        Span { curve: Curve::Circle { frame, radius: 2.0 }, range: [0.0, FRAC_PI_2] }
    };
    let sides = [made.edge(arc(0, 1)), made.edge(arc(1, 2)), made.edge(arc(2, 0))];
    // The pole at a corner, on a side, within.
    for axis in [
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 1.0],
        [1.0, 1.0, 1.0],
        [-1.0, -2.0, -3.0],
        [1.0, -1.0, 0.0],
        [0.2, 0.3, -0.1],
    ] {
        let frame = Frame::new(base.origin, base.vector(axis), None).unwrap();
        let face = made.face(Surface::Sphere { frame, radius: 2.0 }, false, &[&sides.map(|e| (e, false))]);
        let own = of(&made, &face, base.origin);
        assert_near(own.area, 2.0 * PI, "area");
        assert_near(own.volume, 4.0 / 3.0 * PI, "volume");
    }
}

#[test]
fn swept_surfaces_are_what_they_sweep() {
    let base = frame(11);
    // A cylinder as an extrusion, a sphere, a cone and a torus as revolutions.
    let circle_of = |radius: f64| Curve::Circle { frame: base, radius };
    let mut made = Made::default();
    let (low, high) = (made.edge(circle(&base, 0.0, 2.0, 0.4)), made.edge(circle(&base, 3.0, 2.0, 0.0)));
    let surface = Surface::Extrusion { curve: Box::new(circle_of(2.0)), direction: times(0.7, base.axes[2]) };
    let face = made.face(surface, false, &[&[(low, false)], &[(high, true)]]);
    assert_near(of(&made, &face, base.origin).area, 6.0 * TAU, "extrusion");
    let upright = Frame {
        origin: plus(base.origin, times(3.0, base.axes[0])),
        axes: [base.axes[0], base.axes[2], base.axes[1]],
    };
    let turned = Surface::Revolution {
        curve: Box::new(Curve::Circle { frame: upright, radius: 1.0 }),
        origin: base.origin,
        axis: base.axes[2],
    };
    let face = made.face(turned, false, &[]);
    let own = of(&made, &face, [0.0; 3]);
    assert_near(own.area, 4.0 * PI * PI * 3.0, "torus");
    assert_near(own.volume, 2.0 * PI * PI * 3.0, "torus");
    // A line at right angles to the axis, and one to the apex.
    let tip = base.place([0.0, 0.0, 4.0]);
    let slope = minus(base.place([3.0, 0.0, 0.0]), tip);
    let cone = Surface::Revolution {
        curve: Box::new(Curve::Line { origin: tip, direction: slope }),
        origin: base.origin,
        axis: base.axes[2],
    };
    let rim = made.edge(circle(&base, 0.0, 3.0, 1.0));
    let face = made.face(cone, true, &[&[(rim, false)]]);
    let own = of(&made, &face, base.origin);
    assert_near(own.area, PI * 3.0 * 5.0, "cone");
    assert_near(own.volume, PI * 9.0 * 4.0 / 3.0, "cone");
}

/// A whole circle of nine control points in the plane of two axes; with their weights.
fn nine_points() -> Vec<([f64; 2], f64)> {
    let w = f64::sqrt(0.5);
    [
        ([1.0, 0.0], 1.0),
        ([1.0, 1.0], w),
        ([0.0, 1.0], 1.0),
        ([-1.0, 1.0], w),
        ([-1.0, 0.0], 1.0),
        ([-1.0, -1.0], w),
        ([0.0, -1.0], 1.0),
        ([1.0, -1.0], w),
        ([1.0, 0.0], 1.0),
    ]
    .to_vec()
}

fn circle_knots() -> Knots {
    Knots::new(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0]).unwrap()
}

/// A profile of radius and height with weights, turned about the axis of a frame; `u` runs around.
fn turned(frame: &Frame, profile: &[([f64; 2], f64)], knots: Knots) -> Surface {
    let mut points = vec![];
    for ([c, s], w) in nine_points() {
        for ([r, z], weight) in profile {
            points.push((frame.place([r * c, r * s, *z]), w * weight));
        }
    }
    Surface::Spline(Box::new(Nurbs::weighted([circle_knots(), knots], &points).unwrap()))
}

#[test]
fn splines_have_the_areas_and_volumes_of_the_quadrics_that_they_are() {
    for seed in 0..4 {
        let base = frame(seed + 20);
        let start = 0.9 * seed as f64;
        // A cylinder, with and without a seam.
        let straight = Knots::uniform(1, 1, 0.0, 1.0);
        let tube = turned(&base, &[([2.0, -1.0], 1.0), ([2.0, 4.0], 1.0)], straight.clone());
        let mut made = Made::default();
        let (low, high) =
            (made.edge(circle(&base, 0.0, 2.0, start)), made.edge(circle(&base, 3.0, 2.0, -start)));
        let top = Frame { origin: base.place([0.0, 0.0, 3.0]), ..base };
        made.face(tube, false, &[&[(low, false)], &[(high, true)]]);
        made.face(Surface::Plane(top), false, &[&[(high, false)]]);
        made.face(Surface::Plane(base), true, &[&[(low, true)]]);
        let whole = total(&made, [0.0; 3]);
        assert_near(whole.area, TAU * 2.0 * 5.0, "cylinder");
        assert_near(whole.volume, 12.0 * PI, "cylinder");
        // A sphere with two sides that are places, and its cap.
        let w = f64::sqrt(0.5);
        let half =
            [([0.0, -2.0], 1.0), ([2.0, -2.0], w), ([2.0, 0.0], 1.0), ([2.0, 2.0], w), ([0.0, 2.0], 1.0)];
        let arc = Knots::new(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0]).unwrap();
        let ball = turned(&base, &half, arc);
        let mut made = Made::default();
        made.face(ball.clone(), false, &[]);
        let whole = total(&made, [0.0; 3]);
        assert_near(whole.area, 16.0 * PI, "sphere");
        assert_near(whole.volume, 32.0 / 3.0 * PI, "sphere");
        let mut made = Made::default();
        let h = 0.5;
        let rim = made.edge(circle(&base, h, f64::sqrt(4.0 - h * h), start));
        let top = Frame { origin: base.place([0.0, 0.0, h]), ..base };
        made.face(ball, false, &[&[(rim, false)]]);
        made.face(Surface::Plane(top), true, &[&[(rim, true)]]);
        let whole = total(&made, [0.0; 3]);
        let d = 2.0 - h;
        assert_near(whole.area, TAU * 2.0 * d + PI * (4.0 - h * h), "cap");
        assert_near(whole.volume, PI * d * d * (6.0 - d) / 3.0, "cap");
        let trim = Trim::new(&made.brep, &made.brep.faces[0], 0.0).unwrap();
        let reach = bounds(&trim);
        for k in 0..3 {
            // Of a cap above the plane of its rim.
            let (along, wide) = (base.axes[2][k], f64::sqrt(4.0 - h * h));
            let end = |sign: f64| {
                let is_within = 2.0 * sign * along >= h;
                if is_within { 2.0 } else { sign * h * along + wide * f64::sqrt(1.0 - along * along) }
            };
            assert!((reach.max[k] - base.origin[k] - end(1.0)).abs() < 1e-9, "{k}");
            assert!((base.origin[k] - reach.min[k] - end(-1.0)).abs() < 1e-9, "{k}");
        }
        // A torus that repeats both ways.
        let ring: Vec<([f64; 2], f64)> =
            nine_points().iter().map(|([c, s], w)| ([3.0 + c, *s], *w)).collect();
        let mut made = Made::default();
        made.face(turned(&base, &ring, circle_knots()), false, &[]);
        let whole = total(&made, [0.0; 3]);
        assert_near(whole.area, 12.0 * PI * PI, "torus");
        assert_near(whole.volume, 6.0 * PI * PI, "torus");
    }
}

#[test]
fn mirrored_parts_have_the_same_area_and_volume() {
    let base = frame(31);
    let made = drum(&base, 2.0, 3.0, 1.0);
    let flat =
        Frame { axes: [base.axes[0], base.axes[1].map(|c| -c), base.axes[2]], origin: [1.0, 2.0, 3.0] };
    let at = Placement { scale: 2.0, ..Placement::between(&base, &flat) };
    assert!(at.is_mirrored());
    let mut brep = crate::brep::Brep::default();
    brep.add(&made.brep, &at, 0);
    let mirrored = Made { brep };
    let whole = total(&mirrored, [0.0; 3]);
    assert_near(whole.area, 4.0 * TAU * 2.0 * 5.0, "area");
    assert_near(whole.volume, 8.0 * 12.0 * PI, "volume");
}

#[test]
fn bores_through_a_cylinder_cut_it_along_quartic_curves() {
    // Two cylinders of the same radius, at right angles: Steinmetz' solid. Each half ellipse bounds two faces.
    let base = frame(32);
    let r = 2.0;
    let other = Frame { origin: base.origin, axes: [base.axes[1], base.axes[2], base.axes[0]] };
    let ellipse = |sign: f64, from: f64| {
        // In the plane z = sign·x (x along the axis of the other one): y = r cos t, x = r sin t.
        let long = plus(base.axes[0], times(sign, base.axes[2]));
        let x = base.axes[1];
        let y = times(f64::sqrt(0.5), long);
        let frame = Frame { origin: base.origin, axes: [x, y, cross(x, y)] };
        Span { curve: Curve::Ellipse { frame, radii: [r, r * f64::sqrt(2.0)] }, range: [from, from + PI] }
    };
    let mut made = Made::default();
    let edges: Vec<u32> = [(1.0, 0.0), (1.0, PI), (-1.0, 0.0), (-1.0, PI)]
        .map(|(sign, from)| made.edge(ellipse(sign, from)))
        .to_vec();
    // x > 0: edges 0 (z = x) and 2 (z = −x) from y = r to y = −r; x < 0: edges 1 and 3 back.
    let (along_z, along_x) =
        (Surface::Cylinder { frame: base, radius: r }, Surface::Cylinder { frame: other, radius: r });
    made.face(along_z.clone(), false, &[&[(edges[0], false), (edges[2], true)]]);
    made.face(along_z, false, &[&[(edges[3], false), (edges[1], true)]]);
    made.face(along_x.clone(), false, &[&[(edges[0], true), (edges[3], true)]]);
    made.face(along_x, false, &[&[(edges[2], false), (edges[1], false)]]);
    let all: Vec<_> = made.brep.faces.iter().map(|f| Trim::new(&made.brep, f, 0.0).map(|t| t.gap)).collect();
    assert!(all.iter().all(|t| t.is_ok()), "{all:?}");
    let whole = total(&made, [0.0; 3]);
    assert_near(whole.area, 16.0 * r * r, "area");
    assert_near(whole.volume, 16.0 / 3.0 * r * r * r, "volume");
}

#[test]
fn lunes_reach_from_pole_to_pole_however_uncertain_their_ends_are() {
    let base = frame(40);
    let r = 50.0;
    let meridian = |t: f64| {
        let x = base.vector([f64::cos(t), f64::sin(t), 0.0]);
        let frame = Frame { origin: base.origin, axes: [x, base.axes[2], cross(x, base.axes[2])] };
        Span { curve: Curve::Circle { frame, radius: r }, range: [-FRAC_PI_2, FRAC_PI_2] }
    };
    for (from, to) in [(0.0, PI), (PI, TAU), (1.0, 1.3), (2.0, 7.9), (0.0, 0.5 * PI)] {
        for uncertainty in [0.0, 1e-3, 0.1] {
            let mut made = Made::default();
            let (up, down) = (made.edge(meridian(to)), made.edge(meridian(from)));
            let face =
                made.face(Surface::Sphere { frame: base, radius: r }, false, &[&[(down, true), (up, false)]]);
            let trim = Trim::new(&made.brep, &face, uncertainty).unwrap();
            let own = Integrals::of(&trim, base.origin);
            assert!(
                (own.area / (2.0 * r * r * (to - from)) - 1.0).abs() < 1e-9,
                "{from} {to} {uncertainty} {}",
                own.area
            );
        }
    }
}
