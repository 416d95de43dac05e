//! Surfaces against closed forms, and against themselves under changes that keep them.

mod exact;
mod reach;
mod search;

use super::super::basis::Knots;
use super::*;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::space::{Point, cross, dot, minus, norm, plus, times, unit};
use std::f64::consts::PI;

/// A surface of random control points over uneven knots, one of them double.
fn wild(seed: u64) -> Surface<Point> {
    let random = &mut Random::new(seed);
    let knots = [
        Knots::clamped(3, -1.0, &[0.0, 0.2, 0.2, 1.5], 2.0).unwrap(),
        Knots::clamped(2, 5.0, &[5.5, 7.0], 8.0).unwrap(),
    ];
    let (m, n) = (knots[0].count(), knots[1].count());
    let points = (0..m * n)
        .map(|k| [(k / n) as f64 + random.unit(), (k % n) as f64 + random.unit(), 2.0 * random.unit()])
        .collect();
    Surface::new(knots, points).unwrap()
}

fn near(a: Point, b: Point, tolerance: f64) -> bool {
    norm(minus(a, b)) <= tolerance
}

/// Parameters all over a domain, its ends among them.
fn places(domain: [(f64, f64); 2]) -> Vec<[f64; 2]> {
    let at = |(a, b): (f64, f64), k: u32| a + (b - a) * f64::from(k) / 12.0;
    (0..13).flat_map(|i| (0..13).map(move |j| [at(domain[0], i), at(domain[1], j)])).collect()
}

/// Circle of radius 1 in two parts of half a turn each? A quarter is enough: control points and weights.
fn quarter() -> [([f64; 2], f64); 3] {
    [([1.0, 0.0], 1.0), ([1.0, 1.0], 0.5f64.sqrt()), ([0.0, 1.0], 1.0)]
}

/// A quarter of a turn about z of a quarter of a circle of radius `minor` about `(major, 0)` in the plane of x and z.
fn turned(major: f64, minor: f64) -> RationalSurface {
    let mut points = vec![];
    for ([x, y], w) in quarter() {
        for ([c, s], q) in quarter() {
            let r = major + minor * c;
            points.push(([r * x, r * y, minor * s], w * q));
        }
    }
    let knots = || Knots::uniform(2, 1, 0.0, 1.0);
    RationalSurface::new([knots(), knots()], &points).unwrap()
}

#[test]
fn pyramid_basis_and_polynomials_agree() {
    let surface = wild(1);
    let patches = Patches::new(&surface);
    for [u, v] in places(surface.domain()) {
        let place = surface.at(u, v);
        assert!(near(surface.iso_curve(Direction::U, u).at(v), place, 1e-13));
        assert!(near(surface.iso_curve(Direction::V, v).at(u), place, 1e-13));
        assert!(near(patches.at(u, v), place, 1e-13));
        let (jet, d) = (patches.jet(u, v), surface.derivatives(u, v, 2));
        for (a, b) in jet.first.iter().zip([d[1][0], d[0][1]]) {
            assert!(near(*a, b, 1e-11), "{u} {v}");
        }
        for (a, b) in jet.second.iter().zip([d[2][0], d[1][1], d[0][2]]) {
            assert!(near(*a, b, 1e-10), "{u} {v}: {a:?} {b:?}");
        }
    }
    // A parameter outside of the domain is taken to its edge.
    assert_eq!(surface.at(-9.0, 99.0), surface.at(-1.0, 8.0));
}

#[test]
fn derivatives_are_slopes() {
    let surface = wild(2);
    let h = 1e-5;
    for [u, v] in [[-0.4, 5.2], [0.7, 6.1], [1.8, 7.7]] {
        let d = surface.derivatives(u, v, 4);
        for (i, j) in [(1, 0), (2, 0), (3, 0), (1, 1), (2, 1), (1, 2)] {
            let before = |a: f64, b: f64| surface.derivatives(u + a, v + b, 4);
            let (low, high) =
                if i > 0 { (before(-h, 0.0), before(h, 0.0)) } else { (before(0.0, -h), before(0.0, h)) };
            let k = if i > 0 { (i - 1, j) } else { (i, j - 1) };
            let slope = times(0.5 / h, minus(high[k.0][k.1], low[k.0][k.1]));
            assert!(near(slope, d[i][j], 1e-6 * (1.0 + norm(d[i][j]))), "{i} {j}");
        }
        assert_eq!((d[4][0], d[1][3]), ([0.0; 3], [0.0; 3]));
    }
}

#[test]
fn knots_degrees_and_parts_keep_the_surface() {
    let surface = wild(3);
    let mut finer = surface.clone();
    for (direction, t) in [(Direction::U, 0.7), (Direction::U, 0.2), (Direction::V, 5.5), (Direction::V, 6.0)]
    {
        finer = finer.insert(direction, t).unwrap();
    }
    let higher = surface.elevated(Direction::U).elevated(Direction::V);
    assert_eq!((finer.counts(), higher.knots()[0].degree(), higher.knots()[1].degree()), ([10, 7], 4, 3));
    let [a, b] = surface.split(Direction::U, 0.2).unwrap();
    let [c, d] = surface.split(Direction::V, 6.3).unwrap();
    for [u, v] in places(surface.domain()) {
        let place = surface.at(u, v);
        let of_u = if u < 0.2 { &a } else { &b };
        let of_v = if v < 6.3 { &c } else { &d };
        for other in [&finer, &higher, of_u, of_v] {
            assert!(near(other.at(u, v), place, 1e-12), "{u} {v}");
        }
    }
    assert!(surface.insert(Direction::U, 9.0).is_err());
    assert!(surface.split(Direction::V, 5.0).is_err());
}

#[test]
fn rational_patches_have_the_curvature_of_sphere_cylinder_and_torus() {
    let sphere = turned(0.0, 2.5);
    let torus = turned(7.0, 2.0);
    for i in 0..=20 {
        for j in 0..=20 {
            let (u, v) = (f64::from(i) / 20.0, f64::from(j) / 20.0);
            let place = sphere.at(u, v).unwrap();
            assert!((norm(place) - 2.5).abs() < 1e-14);
            // The pole, where all derivatives by u vanish, has no normal.
            if j < 20 {
                let bend = sphere.bend(u, v).unwrap();
                let side = dot(bend.normal, place).signum();
                assert!((bend.mean + side / 2.5).abs() < 1e-10 && (bend.gaussian - 1.0 / 6.25).abs() < 1e-10);
                assert!(bend.principal.iter().all(|p| (p.curvature + side / 2.5).abs() < 1e-10));
            } else {
                assert!(sphere.bend(u, v).is_none());
            }
            let [x, y, z] = torus.at(u, v).unwrap();
            let (r, bend) = (x.hypot(y), torus.bend(u, v).unwrap());
            assert!(((r - 7.0).hypot(z) - 2.0).abs() < 1e-14);
            let cos = (r - 7.0) / 2.0;
            // Outward normal: both bend away from it, the tube by 1/2, the turn by cos/r.
            let outward = dot(bend.normal, [x * (r - 7.0) / r, y * (r - 7.0) / r, z]).signum();
            let expected = [-outward / 2.0, -outward * cos / r];
            let (low, high) = (expected[0].min(expected[1]), expected[0].max(expected[1]));
            assert!((bend.principal[0].curvature - high).abs() < 1e-10, "{bend:?} {high}");
            assert!((bend.principal[1].curvature - low).abs() < 1e-10);
            assert!(
                (bend.mean - 0.5 * (low + high)).abs() < 1e-10 && (bend.gaussian - low * high).abs() < 1e-10
            );
            // Along the circles of latitude lies the curvature of the turn.
            let around = [-y / r, x / r, 0.0];
            let of_turn = if (expected[1] - high).abs() < 1e-12 { 0 } else { 1 };
            assert!((dot(bend.principal[of_turn].direction, around).abs() - 1.0).abs() < 1e-12);
        }
    }
    let points: Vec<(Point, f64)> =
        quarter().iter().flat_map(|([x, y], w)| [0.0, 4.0].map(|z| ([3.0 * x, 3.0 * y, z], *w))).collect();
    let knots = [Knots::uniform(2, 1, 0.0, 1.0), Knots::uniform(1, 1, 0.0, 1.0)];
    let cylinder = RationalSurface::new(knots, &points).unwrap();
    for i in 0..=20 {
        let bend = cylinder.bend(f64::from(i) / 20.0, 0.4).unwrap();
        assert!((bend.mean.abs() - 1.0 / 6.0).abs() < 1e-10 && bend.gaussian.abs() < 1e-10);
        let flat = bend.principal.iter().find(|p| p.curvature.abs() < 1e-10).unwrap();
        assert!((flat.direction[2].abs() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn rational_derivatives_are_those_of_the_mass_points_inserted() {
    // Inserting knots into the mass points changes no derivative of the rational surface.
    let torus = turned(7.0, 2.0);
    let finer = torus.masses().insert(Direction::U, 0.3).unwrap().insert(Direction::V, 0.6).unwrap();
    let finer = RationalSurface::from(finer.elevated(Direction::U));
    let (a, b) = (torus.derivatives(0.4, 0.7, 4).unwrap(), finer.derivatives(0.4, 0.7, 4).unwrap());
    for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
        assert!(near(*a, *b, 1e-11 * (1.0 + norm(*a))), "{a:?} {b:?}");
    }
}

#[test]
fn principal_directions_of_a_saddle() {
    // z = x² − y², turned and sheared in its parameters: at the top curvatures 2 along x, −2 along y.
    let knots = || Knots::uniform(2, 1, -1.0, 1.0);
    // Blossom of u² over −1 … 1 is 1, −1, 1; of u it is −1, 0, 1.
    let (square, own) = ([1.0, -1.0, 1.0], [-1.0, 0.0, 1.0]);
    let points: Vec<Point> = (0..9)
        .map(|k| (k / 3, k % 3))
        .map(|(i, j)| {
            [own[i] + 0.5 * own[j], own[j], square[i] + own[i] * own[j] + 0.25 * square[j] - square[j]]
        })
        .collect();
    let bend = Surface::new([knots(), knots()], points).unwrap().bend(0.0, 0.0).unwrap();
    assert!((bend.gaussian + 4.0).abs() < 1e-12 && bend.mean.abs() < 1e-12);
    let [a, b] = bend.principal;
    assert!((a.curvature - 2.0).abs() < 1e-12 && (a.direction[0].abs() - 1.0).abs() < 1e-12);
    assert!((b.curvature + 2.0).abs() < 1e-12 && (b.direction[1].abs() - 1.0).abs() < 1e-12);
    assert!(Bend::new([[1.0, 0.0, 0.0], [2.0, 0.0, 0.0]], [[0.0; 3]; 3]).is_none());
    assert!(Bend::new([[f64::NAN, 0.0, 0.0], [0.0, 1.0, 0.0]], [[0.0; 3]; 3]).is_none());
}

#[test]
fn the_closest_place_is_no_farther_than_any_of_a_dense_search() {
    let random = &mut Random::new(8);
    for seed in 0..4 {
        let surface = wild(10 + seed);
        let patches = Patches::new(&surface);
        let [(a, b), (c, d)] = surface.domain();
        for _ in 0..25 {
            let point = [8.0 * random.unit() - 1.0, 6.0 * random.unit() - 1.0, 6.0 * random.unit() - 2.0];
            let foot = surface.closest(point);
            let mut least = f64::INFINITY;
            for i in 0..=150 {
                for j in 0..=150 {
                    let place =
                        patches.at(a + (b - a) * f64::from(i) / 150.0, c + (d - c) * f64::from(j) / 150.0);
                    least = least.min(norm(minus(place, point)));
                }
            }
            assert!(foot.distance <= least + 1e-12, "{} {least}", foot.distance);
            assert!(near(surface.at(foot.parameters[0], foot.parameters[1]), foot.place, 1e-12));
            // Inside, the difference stands at right angles.
            let [u, v] = foot.parameters;
            if u > a && u < b && v > c && v < d {
                let jet = patches.jet(u, v);
                let away = minus(point, foot.place);
                for s in jet.first {
                    assert!(dot(away, s).abs() <= 1e-7 * norm(away) * norm(s) + 1e-12, "{}", dot(away, s));
                }
            }
        }
    }
}

#[test]
fn feet_of_points_lifted_off_are_found_again() {
    let surface = wild(4);
    let patches = Patches::new(&surface);
    let random = &mut Random::new(9);
    for _ in 0..200 {
        let [(a, b), (c, d)] = surface.domain();
        let (u, v) = (a + (b - a) * random.unit(), c + (d - c) * random.unit());
        let jet = patches.jet(u, v);
        let (normal, _) = unit(cross(jet.first[0], jet.first[1])).unwrap();
        let height = 0.02 * (random.unit() - 0.5);
        let point = plus(jet.place, times(height, normal));
        let foot = patches.foot_from(point, [u + 0.01, v - 0.01]);
        assert!(foot.settled);
        assert!((foot.signed(point) - height).abs() < 1e-12, "{} {height}", foot.signed(point));
    }
}

#[test]
fn facets_keep_the_tolerance() {
    let surface = wild(6);
    for tolerance in [0.1, 0.01] {
        let facets = surface.tessellate(tolerance, 1_000_000, &Silent).unwrap().unwrap();
        let patches = Patches::new(&surface);
        let mut worst = 0.0f64;
        for face in &facets.mesh.faces {
            let [a, b, c] = face.map(|i| facets.parameters[i as usize]);
            let [x, y, z] = face.map(|i| facets.mesh.positions[i as usize]);
            for [r, s] in [[0.5, 0.5], [0.5, 0.0], [0.0, 0.5], [1.0 / 3.0, 1.0 / 3.0]] {
                let w = [1.0 - r - s, r, s];
                let u = [0, 1].map(|k| w[0] * a[k] + w[1] * b[k] + w[2] * c[k]);
                let flat = plus(plus(times(w[0], x), times(w[1], y)), times(w[2], z));
                worst = worst.max(norm(minus(patches.at(u[0], u[1]), flat)));
            }
        }
        assert!(worst <= tolerance, "{worst} of {tolerance}");
        // And it is not wasteful: the bound is within reach of what happens.
        assert!(worst > 0.05 * tolerance, "{worst} of {tolerance}");
    }
    assert!(surface.tessellate(1e-9, 1000, &Silent).unwrap().is_none());
    // A plane takes two facets a span, a twisted one more.
    let knots = || Knots::uniform(1, 1, 0.0, 1.0);
    let corners = |z: f64| vec![[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, z]];
    let count = |z: f64| {
        let surface = Surface::new([knots(), knots()], corners(z)).unwrap();
        surface.tessellate(1e-3, 100_000, &Silent).unwrap().unwrap().mesh.faces.len()
    };
    assert_eq!(count(0.0), 2);
    // Greatest distance z h k / 4 of a facet: 1/16 · … each side in 16 parts.
    assert!((400..2_000).contains(&count(1.0)), "{}", count(1.0));
}

#[test]
fn the_half_circle_of_three_mass_points_is_exact() {
    use crate::spline::pyramid::neville;
    use crate::spline::value::Mass;
    let points = [([-1.0, 0.0], 2.0), ([0.0, 1.0], 1.0), ([1.0, 0.0], 2.0)].map(|(p, m)| Mass::new(p, m));
    for i in 0..=200 {
        let t = -1.0 + f64::from(i) / 100.0;
        let [x, y] = neville(&[-1.0, 0.0, 1.0], &points, t).unwrap().place().unwrap();
        assert!((x * x + y * y - 1.0).abs() < 4.0 * f64::EPSILON && y >= 0.0);
        // Its angle is twice that of the tangent of half: t = tan(angle / 2).
        assert!((2.0 * t.atan() - x.atan2(y)).abs() < 1e-14 * PI);
    }
}
