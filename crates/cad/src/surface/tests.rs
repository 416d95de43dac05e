use super::*;
use crate::curve::Curve;
use crate::frame::Frame;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use trueness_geom::num::random::Random;
use trueness_geom::space::Point;
use trueness_geom::space::{minus, norm, plus, times};
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::curve::Curve as Spline;
use trueness_geom::spline::surface::Nurbs;
use trueness_geom::spline::surface::descend;

pub(crate) fn spot(random: &mut Random, size: f64) -> Point {
    [0, 1, 2].map(|_| size * (2.0 * random.unit() - 1.0))
}

const KINDS: usize = 14;

/// A random surface of kind number `kind`, and a rectangle to try it in.
fn surface(random: &mut Random, kind: usize) -> (Surface, [[f64; 2]; 2]) {
    let frame = Frame::new(spot(random, 2.0), spot(random, 1.0), Some(spot(random, 1.0))).unwrap();
    let radius = 0.5 + random.unit();
    let turn = [0.0, TAU];
    let knots = || Knots::clamped(3, 0.0, &[0.3, 0.7], 1.0).unwrap();
    let mut net = |wavy: f64, weight: f64| -> Vec<(Point, f64)> {
        let at = |k: usize| f64::from(u32::try_from(k).unwrap()) * 0.8;
        (0..36)
            .map(|k| (plus([at(k / 6), at(k % 6), 0.0], spot(random, wavy)), 1.0 + weight * random.unit()))
            .collect()
    };
    let plane = frame.axes;
    match kind {
        0 => (Surface::Plane(frame), [[-3.0, 3.0]; 2]),
        1 => (Surface::Cylinder { frame, radius }, [turn, [-3.0, 3.0]]),
        2 => (Surface::Cone { frame, radius, half_angle: 0.5 }, [turn, [-4.0, 3.0]]),
        3 => (Surface::Cone { frame, radius: 0.0, half_angle: -1.1 }, [turn, [-3.0, 3.0]]),
        4 => (Surface::Sphere { frame, radius }, [turn, [-FRAC_PI_2, FRAC_PI_2]]),
        5 => (Surface::Torus { frame, major: 2.0, minor: radius }, [turn, turn]),
        6 => {
            let major = if random.unit() < 0.5 { 0.4 } else { -0.4 };
            let torus = Surface::Torus { frame, major, minor: radius };
            let [_, part] = torus.domain();
            (torus, [turn, part])
        }
        7 => (
            Surface::Spline(Box::new(Nurbs::weighted([knots(), knots()], &net(0.4, 0.0)).unwrap())),
            [[0.0, 1.0]; 2],
        ),
        8 => (
            Surface::Spline(Box::new(Nurbs::weighted([knots(), knots()], &net(0.3, 2.0)).unwrap())),
            [[0.0, 1.0]; 2],
        ),
        9 => {
            let curve = Curve::Ellipse { frame, radii: [radius, 2.0] };
            let direction = plus(times(2.0, plane[2]), times(0.5, plane[0]));
            (Surface::Extrusion { curve: Box::new(curve), direction }, [turn, [-2.0, 2.0]])
        }
        10 => {
            let points: Vec<Point> =
                (0..6).map(|k| frame.place([f64::from(k), f64::from(k * k % 5), 0.0])).collect();
            let curve = Curve::Spline(Spline::new(knots(), points).unwrap());
            (Surface::Extrusion { curve: Box::new(curve), direction: plane[2] }, [[0.0, 1.0], [-2.0, 2.0]])
        }
        11 => {
            let points = [
                [1.0, 0.0, 0.0],
                [2.0, 0.0, 1.0],
                [0.5, 0.0, 2.0],
                [2.5, 0.0, 2.5],
                [1.0, 0.0, 4.0],
                [0.0, 0.0, 4.0],
            ];
            let points = points.map(|p| frame.place(p)).to_vec();
            let curve = Curve::Spline(Spline::new(knots(), points).unwrap());
            (
                Surface::Revolution { curve: Box::new(curve), origin: frame.origin, axis: plane[2] },
                [turn, [0.0, 1.0]],
            )
        }
        12 => {
            // A hyperboloid of one sheet.
            let direction = plus(plane[1], plane[2]);
            let curve = Curve::Line { origin: frame.place([radius, 0.0, 0.0]), direction };
            (
                Surface::Revolution { curve: Box::new(curve), origin: frame.origin, axis: plane[2] },
                [turn, [-2.0, 2.0]],
            )
        }
        _ => {
            let basis = Box::new(surface(random, 10).0);
            (Surface::Offset { basis, distance: 0.05 }, [[0.0, 1.0], [-2.0, 2.0]])
        }
    }
}

#[test]
fn parameters_name_the_place() {
    let mut random = Random::new(7);
    for round in 0..KINDS * 12 {
        let (surface, [[a, b], [c, d]]) = surface(&mut random, round % KINDS);
        let feet = SurfaceFeet::new(&surface);
        for _ in 0..10 {
            let (u, v) = (a + (b - a) * random.unit(), c + (d - c) * random.unit());
            let place = surface.at(u, v);
            let [x, y] = feet.parameters(place, None);
            assert!(norm(minus(surface.at(x, y), place)) < 1e-12, "{surface:?} {u} {v} {x} {y}");
            let periods = surface.periods();
            let shift = [0, 1].map(|k| periods[k].map_or(0.0, |p| 2.0 * p));
            let near = [u + shift[0] + 0.01, v + shift[1] - 0.01];
            let own = feet.parameters(place, Some(near));
            let off = (own[0] - u - shift[0]).abs() + (own[1] - v - shift[1]).abs();
            assert!(off < 1e-9, "{surface:?} {u} {v} {own:?}");
        }
    }
}

/// The least distance of many descents.
fn brute(surface: &Surface, [[a, b], [c, d]]: [[f64; 2]; 2], p: Point) -> f64 {
    let domain = surface.domain().map(|[from, to]| {
        if surface.kind() == SurfaceKind::Spline { (from, to) } else { (f64::NEG_INFINITY, f64::INFINITY) }
    });
    let mut starts = vec![];
    for i in 0..=30 {
        for j in 0..=30 {
            let at = [a + (b - a) * f64::from(i) / 30.0, c + (d - c) * f64::from(j) / 30.0];
            starts.push((norm(minus(surface.at(at[0], at[1]), p)), at));
        }
    }
    starts.sort_by(|x, y| x.0.total_cmp(&y.0));
    let found =
        starts.iter().take(25).map(|(_, at)| descend(|[u, v]| surface.jet(u, v), domain, p, *at).0.distance);
    found.fold(starts[0].0, f64::min)
}

#[test]
fn nearest_places_are_those_of_brute_force() {
    let mut random = Random::new(21);
    for round in 0..KINDS * 10 {
        let (surface, part) = surface(&mut random, round % KINDS);
        let feet = SurfaceFeet::new(&surface);
        for _ in 0..4 {
            let p = spot(&mut random, 3.0);
            let foot = feet.nearest(p);
            let [u, v] = foot.parameters;
            assert!(norm(minus(surface.at(u, v), foot.place)) < 1e-11, "{surface:?}");
            assert!((norm(minus(foot.place, p)) - foot.distance).abs() < 1e-12, "{surface:?}");
            if surface.kind() == SurfaceKind::Offset {
                continue;
            }
            let least = brute(&surface, part, p);
            assert!(foot.distance <= least + 1e-11, "{} {least} {p:?} {surface:?}", foot.distance);
        }
    }
}

/// Vertices of facets lie where parts of a surface meet, and next to it: a foot there is of one of the parts.
#[test]
fn a_place_beside_the_ends_of_parts_is_found() {
    let random = &mut Random::new(77);
    for round in 0..20 * KINDS {
        let (surface, sides) = surface(random, round % KINDS);
        let feet = SurfaceFeet::new(&surface);
        let ends = [0.0, 0.3, 0.7, 1.0];
        for _ in 0..60 {
            let at = sides.map(|[a, b]| {
                let span = random.below(3) as usize;
                let share = random.below(64) as f64 / 64.0;
                a + (b - a) * (ends[span] + (ends[span + 1] - ends[span]) * share)
            });
            let off = [1e-3, 1e-5, 1e-7, 1e-9, 0.0][random.below(5) as usize];
            let place = surface.at(at[0], at[1]);
            let p = plus(place, spot(random, off));
            let (found, wanted) = (feet.nearest(p).distance, norm(minus(p, place)));
            assert!(found <= wanted * (1.0 + 1e-9) + 1e-12, "{surface:?} {at:?} {off}: {found} for {wanted}");
        }
    }
}

#[test]
fn all_feet_of_quadrics_and_tori_stand_at_right_angles() {
    let mut random = Random::new(2);
    for round in 0..7 * 30 {
        let (surface, _) = surface(&mut random, round % 7);
        let p = spot(&mut random, 3.0);
        let feet = surface.feet(p);
        let poles = surface.poles();
        let expected = match surface.kind() {
            SurfaceKind::Plane => 1,
            SurfaceKind::Torus if poles.is_empty() => 4,
            SurfaceKind::Torus => feet.len(),
            SurfaceKind::Cone => 3,
            _ => 2,
        };
        assert_eq!(feet.len(), expected);
        for foot in feet {
            let [u, v] = foot.parameters;
            assert!(norm(minus(surface.at(u, v), foot.place)) < 1e-12, "{surface:?} {foot:?}");
            if poles.iter().all(|pole| norm(minus(pole.place, foot.place)) > 1e-9) {
                let jet = surface.jet(u, v);
                let away = minus(p, foot.place);
                for d in jet.first {
                    assert!(
                        trueness_geom::space::dot(d, away).abs() < 1e-11 * (1.0 + norm(d)),
                        "{surface:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn poles_are_where_a_side_is_a_place() {
    let mut random = Random::new(4);
    let mut counts = vec![];
    for kind in 0..KINDS {
        let (surface, _) = surface(&mut random, kind);
        let poles = surface.poles();
        counts.push(poles.len());
        for pole in poles {
            for other in [0.1, 0.5, 0.9] {
                let [u, v] = if pole.held == 0 { [pole.at, other] } else { [other, pole.at] };
                assert!(norm(minus(surface.at(u, v), pole.place)) < 1e-12, "{surface:?}");
            }
        }
    }
    assert_eq!(counts, [0, 0, 1, 1, 2, 0, 2, 0, 0, 0, 0, 1, 0, 0]);
    // The sphere keeps the angle of the place before.
    let sphere = surface(&mut random, 4).0;
    assert_eq!(sphere.parameters(sphere.at(0.3, FRAC_PI_2), Some([1.7, 1.5]))[0], 1.7);
    // A spline whose first side is a place, and one that closes.
    let flat = || Knots::uniform(1, 1, 0.0, 1.0);
    let corners = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0]];
    let triangle =
        Surface::Spline(Box::new(Nurbs::weighted([flat(), flat()], &corners.map(|p| (p, 1.0))).unwrap()));
    let poles = triangle.poles();
    assert_eq!((poles.len(), poles[0].held, poles[0].at), (1, 0, 0.0));
    assert_eq!(triangle.periods(), [None, None]);
    let ring = [[1.0, 0.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0], [1.0, 0.0]];
    let points: Vec<_> = ring.iter().flat_map(|[x, y]| [0.0, 2.0].map(|z| ([*x, *y, z], 1.0))).collect();
    let tube = Nurbs::weighted([Knots::uniform(2, 4, 0.0, 1.0), flat()], &points).unwrap();
    let tube = Surface::Spline(Box::new(tube));
    assert_eq!(tube.periods(), [Some(1.0), None]);
    let [u, v] = tube.parameters(tube.at(0.02, 0.25), Some([0.99, 0.25]));
    assert!((u - 1.02).abs() < 1e-12 && (v - 0.25).abs() < 1e-12);
    let [u, _] = tube.parameters(tube.at(0.98, 0.25), Some([-0.01, 0.25]));
    assert!((u + 0.02).abs() < 1e-12);
}

#[test]
fn turned_and_extruded_circles_are_tori_and_cylinders() {
    let mut random = Random::new(6);
    let own = Frame::new([1.0, 2.0, 3.0], [1.0, 1.0, 0.2], None).unwrap();
    let across = Frame {
        origin: own.place([2.0, 0.0, 0.0]),
        axes: [own.axes[0], own.axes[2], own.axes[1].map(|x| -x)],
    };
    let circle = Curve::Circle { frame: across, radius: 0.7 };
    let turned = Surface::Revolution { curve: Box::new(circle), origin: own.origin, axis: own.axes[2] };
    let torus = Surface::Torus { frame: own, major: 2.0, minor: 0.7 };
    assert_eq!(turned.periods(), [Some(TAU), Some(TAU)]);
    let base = Curve::Circle { frame: own, radius: 1.5 };
    let tube = Surface::Extrusion { curve: Box::new(base), direction: own.axes[2] };
    let cylinder = Surface::Cylinder { frame: own, radius: 1.5 };
    for (swept, closed) in [(turned, torus), (tube, cylinder)] {
        let (a, b) = (SurfaceFeet::new(&swept), SurfaceFeet::new(&closed));
        for _ in 0..200 {
            let p = plus(own.origin, spot(&mut random, 4.0));
            let (x, y) = (a.nearest(p), b.nearest(p));
            assert!((x.distance - y.distance).abs() < 1e-13);
            let [u, v] = a.parameters(p, None);
            let [s, t] = b.parameters(p, None);
            let angle = |a: f64, b: f64| (a - b + PI).rem_euclid(TAU) - PI;
            assert!(angle(u, s).abs() < 1e-12 && angle(v, t).abs().min((v - t).abs()) < 1e-12);
        }
    }
}

#[test]
fn boxes_hold_their_part_and_lines_follow_the_surface() {
    let mut random = Random::new(12);
    for round in 0..KINDS * 12 {
        let (surface, part) = surface(&mut random, round % KINDS);
        let sides = part.map(|[a, b]| {
            let mut ends = [a + (b - a) * random.unit(), a + (b - a) * random.unit()];
            ends.sort_by(f64::total_cmp);
            ends
        });
        let own = surface.bounds(sides);
        let [us, vs] =
            sides.map(|[a, b]| [0, 1, 2, 3, 4, 5, 6, 7, 8].map(|i| a + (b - a) * f64::from(i) / 8.0));
        let mut near = trueness_geom::space::Aabb::EMPTY;
        for u in us {
            let line = surface.iso_curve(0, u);
            for v in vs {
                let place = surface.at(u, v);
                near = near.union(&trueness_geom::space::Aabb::of(&[place]));
                assert!(own.widened(1e-12).holds(&place), "{surface:?} {sides:?} {place:?} {own:?}");
                if let Some(line) = &line {
                    assert!(norm(minus(line.at(v), place)) < 1e-12, "{surface:?}");
                }
                if let Some(line) = surface.iso_curve(1, v) {
                    assert!(norm(minus(line.at(u), place)) < 1e-12, "{surface:?}");
                }
            }
        }
        if round % KINDS < 7 || surface.kind() == SurfaceKind::Extrusion {
            let off = (0..3).map(|k| (near.min[k] - own.min[k]).max(own.max[k] - near.max[k]));
            assert!(off.fold(0.0, f64::max) < 0.1 * own.diagonal(), "{surface:?} {sides:?}");
        }
        // A descent from beside a place comes back to it.
        let at = [us[4], vs[3]];
        let normal = surface.normal(at[0], at[1]);
        if let Some(normal) = normal {
            let p = plus(surface.at(at[0], at[1]), times(0.01, normal));
            let foot = surface.foot_from(p, [at[0] + 0.01, at[1] + 0.003]);
            assert!((foot.distance - 0.01).abs() < 1e-3, "{surface:?}");
        }
    }
}
