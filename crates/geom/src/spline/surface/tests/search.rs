//! Nearest places on surfaces against closed forms, brute force, and motion.

use super::super::{FootError, FootSearch, Nurbs, Surface};
use crate::closest::QueryError;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::space::{Point, dot, minus, norm};
use crate::spline::basis::Knots;

const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;

fn one() -> Knots {
    Knots::uniform(2, 1, 0.0, 1.0)
}

/// A profile in the plane of x and z turned by a quarter about z, exactly.
fn turned(profile: Knots, points: &[([f64; 2], f64)]) -> Nurbs {
    let rows = points
        .iter()
        .flat_map(|([x, z], w)| [([*x, 0.0, *z], *w), ([*x, *x, *z], *w * HALF), ([0.0, *x, *z], *w)]);
    Nurbs::weighted([profile, one()], &rows.collect::<Vec<_>>()).unwrap()
}

/// An eighth of a sphere of radius 2 around the origin, with a pole; the normal looks inward.
fn eighth() -> Nurbs {
    turned(one(), &[([2.0, 0.0], 1.0), ([2.0, 2.0], HALF), ([0.0, 2.0], 1.0)])
}

fn random_point(random: &mut Random, size: f64) -> Point {
    std::array::from_fn(|_| size * (random.unit() - 0.5))
}

#[test]
fn sphere_cylinder_and_torus_by_their_closed_forms() {
    let sphere = FootSearch::new(&[eighth()], &Silent).unwrap();
    let line = Knots::uniform(1, 1, 0.0, 1.0);
    let cylinder = turned(line, &[([2.0, 0.0], 1.0), ([2.0, 5.0], 1.0)]);
    let cylinder = FootSearch::new(&[cylinder], &Silent).unwrap();
    // A quarter of the tube's circle of radius 1, 4 from the axis.
    let torus = turned(one(), &[([5.0, 0.0], 1.0), ([5.0, 1.0], HALF), ([4.0, 1.0], 1.0)]);
    let torus = FootSearch::new(&[torus], &Silent).unwrap();
    let mut random = Random::stream(1, 0);
    for _ in 0..2000 {
        let p = random_point(&mut random, 1.0).map(|x| x.abs() * 10.0);
        let found = sphere.nearest(&p);
        assert!(found.certain && (found.foot.distance - (norm(p) - 2.0).abs()).abs() < 1e-13);
        let signed = found.foot.signed(p);
        assert!((signed - (2.0 - norm(p))).abs() < 1e-13 || (signed + 2.0 - norm(p)).abs() < 1e-13);
        let found = cylinder.nearest(&p);
        let radial = libm::hypot(p[0], p[1]) - 2.0;
        assert!((found.foot.distance - radial.abs()).abs() < 1e-13, "{found:?}");
        assert_eq!(
            found.foot.signed(p) > 0.0,
            cylinder.nearest(&[0.1, 0.1, 1.0]).foot.signed([0.1, 0.1, 1.0]) > 0.0 && radial < 0.0
                || cylinder.nearest(&[3.0, 3.0, 1.0]).foot.signed([3.0, 3.0, 1.0]) > 0.0 && radial > 0.0
        );
        // Points over that quarter of the tube.
        let (x, z) = (libm::hypot(p[0], p[1]) - 4.0, p[2]);
        if x >= 0.0 {
            let found = torus.nearest(&p);
            assert!((found.foot.distance - (libm::hypot(x, z) - 1.0).abs()).abs() < 1e-13, "{p:?} {found:?}");
            assert!(found.certain && !found.border || x < 0.01 || z < 0.01);
        }
    }
}

/// Waves with several minima of the distance almost everywhere.
fn waves(seed: u64, degree: usize, spans: usize) -> Surface<Point> {
    let mut random = Random::stream(seed, 7);
    let knots = || Knots::uniform(degree, spans, 0.0, 3.0);
    let n = knots().count();
    let point = |k: usize| [(k / n) as f64, (k % n) as f64, 4.0 * random.unit()];
    Surface::new([knots(), knots()], (0..n * n).map(point).collect()).unwrap()
}

/// The least distance of a dense sample, then of descents from the best of it.
fn brute(surface: &Surface<Point>, p: &Point) -> f64 {
    const N: usize = 160;
    let patches = super::super::Patches::new(surface);
    let mut all: Vec<(f64, [f64; 2])> = (0..=N * (N + 1) + N)
        .map(|k| [(k / (N + 1)) as f64 / N as f64 * 3.0, (k % (N + 1)) as f64 / N as f64 * 3.0])
        .map(|at| (norm(minus(surface.at(at[0], at[1]), *p)), at))
        .collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all.iter()
        .take(60)
        .map(|(d, at)| patches.foot_from(*p, *at).distance.min(*d))
        .fold(f64::INFINITY, f64::min)
}

#[test]
fn no_place_of_a_dense_sample_is_nearer() {
    for (seed, degree, spans) in [(1, 3, 5), (2, 2, 6), (3, 5, 2), (4, 4, 3)] {
        let surface = waves(seed, degree, spans);
        let search = FootSearch::new(&[surface.clone().into()], &Silent).unwrap();
        let mut random = Random::stream(seed, 1);
        let (mut worst, mut certain) = (0.0f64, 0);
        for _ in 0..60 {
            let p = plus(random_point(&mut random, 12.0), [3.5, 3.5, 2.0]);
            let (found, wanted) = (search.nearest(&p), brute(&surface, &p));
            worst = worst.max((found.foot.distance - wanted).abs());
            assert!(found.foot.distance <= wanted + 1e-12, "{p:?} {found:?} {wanted}");
            let [u, v] = found.foot.parameters;
            assert!(norm(minus(surface.at(u, v), found.foot.place)) < 1e-12);
            certain += usize::from(found.certain);
        }
        assert!(worst < 1e-6 && certain == 60, "{degree}: {worst} {certain}");
    }
}

/// Over a trough two places are nearly as near, one to each side. They are farther apart than the search may leave out, nearer
/// than its cells know their places.
#[test]
fn the_nearer_side_of_a_trough_is_found() {
    // z = x² over uneven cells: those of the right are coarser.
    let along = Knots::clamped(2, -2.5, &[-1.8, -1.3, -0.6], 2.5).unwrap();
    let t = along.values().to_vec();
    let rows = (0..along.count()).map(|i| (0.5 * (t[i + 1] + t[i + 2]), t[i + 1] * t[i + 2]));
    let points = rows.flat_map(|(x, z)| [-3.0, 3.0].map(|y| [x, y, z])).collect();
    let trough = Surface::new([along, Knots::uniform(1, 1, -3.0, 3.0)], points).unwrap();
    let patches = super::super::Patches::new(&trough);
    let search = FootSearch::new(&[trough.into()], &Silent).unwrap();
    let mut random = Random::stream(11, 3);
    for k in 0..4000 {
        let off = [1e-6, 1e-5, 1e-4, 1e-2][k % 4] * (random.unit() - 0.5);
        let p = [off, 4.0 * (random.unit() - 0.5), 1.0 + 3.0 * random.unit()];
        let side = |start: f64| patches.foot_from(p, [start, p[1]]).distance;
        let wanted = side(-1.5).min(side(1.5));
        let found = search.nearest(&p);
        assert!(found.certain && (found.foot.distance - wanted).abs() < 1e-8, "{p:?} {found:?} {wanted}");
    }
}

fn plus(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|k| a[k] + b[k])
}

/// A roof of two flat faces: both sides of the crease have one sign, whichever face is taken.
#[test]
fn sides_of_a_crease() {
    let knots = |degree, spans, to| Knots::uniform(degree, spans, 0.0, to);
    let roof = |height: f64| {
        let rows = [[-2.0, 0.0], [0.0, height], [2.0, 0.0]];
        let points = rows.iter().flat_map(|[x, z]| [[*x, -5.0, *z], [*x, 5.0, *z]]).collect();
        Nurbs::from(Surface::new([knots(1, 2, 2.0), knots(1, 1, 1.0)], points).unwrap())
    };
    let mut random = Random::stream(5, 0);
    for height in [1.0, 5.0, -1.0, -5.0] {
        let search = FootSearch::new(&[roof(height)], &Silent).unwrap();
        for _ in 0..500 {
            let p = [2.0 * (random.unit() - 0.5), 8.0 * (random.unit() - 0.5), 20.0 * (random.unit() - 0.5)];
            let above = p[2] - height * (1.0 - p[0].abs() / 2.0);
            let flat = above.abs() / libm::hypot(1.0, height / 2.0);
            let found = search.nearest(&p);
            assert_eq!(found.foot.signed(p) > 0.0, above > 0.0, "{height} {p:?} {found:?}");
            // Never nearer than the faces' planes, and over a face that near.
            assert!(found.foot.distance >= flat - 1e-12);
        }
        let ridge = search.nearest(&[0.0, 0.0, height + 3.0 * height.signum()]);
        assert!((ridge.foot.distance - 3.0).abs() < 1e-12 && !ridge.border);
    }
}

#[test]
fn facets_and_weights_belong_to_the_place() {
    let (surface, mut random) = (waves(9, 3, 4), Random::stream(9, 2));
    let search = FootSearch::new(&[eighth(), surface.into()], &Silent).unwrap();
    let mesh = search.mesh();
    for _ in 0..500 {
        let p = random_point(&mut random, 14.0);
        let found = search.nearest(&p);
        let corners = mesh.corners(found.face);
        let place: Point = std::array::from_fn(|k| (0..3).map(|c| found.weights[c] * corners[c][k]).sum());
        assert!(found.weights.iter().all(|w| *w >= 0.0));
        assert!(norm(minus(place, found.foot.place)) <= search.mesh_distance() + 1e-12);
    }
}

#[test]
fn borders_are_told_from_seams_poles_and_joints() {
    let sphere = FootSearch::new(&[eighth()], &Silent).unwrap();
    assert!(!sphere.nearest(&[0.0, 0.0, 3.0]).border, "a pole");
    assert!(sphere.nearest(&[1.0, 1.0, -3.0]).border);
    // Two eighths side by side: what they share is no border.
    let turned = |s: &Nurbs| {
        let points: Vec<_> = s.control_points().iter().map(|([x, y, z], w)| ([-y, *x, *z], *w)).collect();
        Nurbs::weighted(s.knots().clone(), &points).unwrap()
    };
    let both = FootSearch::new(&[eighth(), turned(&eighth())], &Silent).unwrap();
    assert!(!both.nearest(&[0.0, 3.0, 1.0]).border);
    assert!(both.nearest(&[3.0, -1.0, 1.0]).border);
    assert_eq!(both.nearest(&[-1.0, 1.0, 1.0]).surface, 1);
    // A whole turn in one surface.
    let ring = [
        [2.0, 0.0],
        [2.0, 2.0],
        [0.0, 2.0],
        [-2.0, 2.0],
        [-2.0, 0.0],
        [-2.0, -2.0],
        [0.0, -2.0],
        [2.0, -2.0],
        [2.0, 0.0],
    ];
    let points: Vec<_> = ring
        .iter()
        .enumerate()
        .flat_map(|(k, [x, y])| [0.0, 5.0].map(|z| ([*x, *y, z], if k % 2 == 0 { 1.0 } else { HALF })))
        .collect();
    let around = Knots::new(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0]).unwrap();
    let tube = Nurbs::weighted([around, Knots::uniform(1, 1, 0.0, 1.0)], &points).unwrap();
    let tube = FootSearch::new(&[tube], &Silent).unwrap();
    for (p, border) in [([3.0, 0.0, 1.0], false), ([0.0, 3.0, 1.0], false), ([3.0, 0.0, 6.0], true)] {
        let found = tube.nearest(&p);
        assert!((found.foot.distance - libm::hypot(1.0, (p[2] - 5.0).max(0.0))).abs() < 1e-13);
        assert_eq!(found.border, border, "{p:?}");
        assert!(dot(found.foot.normal.unwrap(), p) > 0.0);
    }
}

#[test]
fn many_equal_places_come_to_an_end() {
    let sphere = FootSearch::new(&[eighth()], &Silent).unwrap();
    let found = sphere.nearest(&[0.0; 3]);
    assert!((found.foot.distance - 2.0).abs() < 1e-14);
    // None of them is nearer than the one found.
    assert!(found.certain);
}

#[test]
fn what_cannot_be_searched_is_refused() {
    assert_eq!(FootSearch::new(&[], &Silent).err(), Some(FootError::NoSurface));
    let flat = |x: f64| -> Nurbs {
        let points = vec![[0.0; 3], [0.0, 1.0, 0.0], [x, 0.0, 0.0], [1.0, 1.0, 0.0]];
        Surface::new([Knots::uniform(1, 1, 0.0, 1.0), Knots::uniform(1, 1, 0.0, 1.0)], points).unwrap().into()
    };
    let bad = FootError::BadPoint { surface: 1, point: 2 };
    assert_eq!(FootSearch::new(&[flat(1.0), flat(f64::NAN)], &Silent).err(), Some(bad));
    let torn = Knots::new(1, vec![0.0, 0.0, 1.0, 1.0, 2.0, 2.0]).unwrap();
    let points = (0..8).map(|k| [f64::from(k / 2), f64::from(k % 2), 0.0]).collect();
    let torn = Surface::new([torn, Knots::uniform(1, 1, 0.0, 1.0)], points).unwrap();
    let error = FootSearch::new(&[torn.into()], &Silent).err();
    assert_eq!(error, Some(FootError::Torn { surface: 0, knot: 1.0, times: 2 }));
    let arc = |weight: f64| {
        let rows = [([0.0, 0.0], 1.0), ([1.0, 0.0], weight), ([1.0, 1.0], 1.0)];
        let points = rows.map(|([x, y], w)| [0.0, 1.0].map(|z| ([x, y, z], w)));
        let knots = [Knots::uniform(2, 1, 0.0, 1.0), Knots::uniform(1, 1, 0.0, 1.0)];
        Nurbs::weighted(knots, &points.concat()).unwrap()
    };
    assert!(FootSearch::new(&[arc(1e4)], &Silent).is_ok());
    let error = FootSearch::new(&[arc(1e6)], &Silent).err();
    assert_eq!(error, Some(FootError::Weights { surface: 0, ratio: 1e6 }));
    let search = FootSearch::new(&[flat(1.0)], &Silent).unwrap();
    let points = [[0.0; 3], [f64::NAN, 0.0, 0.0]];
    assert_eq!(search.map(&points, &Silent, |_, f| f).err(), Some(QueryError::BadPoint(1)));
}

#[test]
fn turned_surfaces_look_the_other_way_and_parts_are_parts() {
    let (whole, mut random) = (eighth(), Random::stream(4, 4));
    let turned = whole.flipped();
    let part = whole.within([(0.2, 0.7), (-1.0, 0.5)]);
    assert_eq!(part.knots().each_ref().map(Knots::domain), [(0.2, 0.7), (0.0, 0.5)]);
    for _ in 0..50 {
        let (u, v) = (random.unit(), random.unit());
        assert!(norm(minus(whole.at(u, v).unwrap(), turned.at(v, u).unwrap())) < 1e-15);
        let [a, b] = [whole.bend(u, v), turned.bend(v, u)].map(|b| b.unwrap().normal);
        assert!(dot(a, b) < -1.0 + 1e-9);
        let (u, v) = (0.2 + 0.5 * u, 0.5 * v);
        assert!(norm(minus(whole.at(u, v).unwrap(), part.at(u, v).unwrap())) < 1e-14);
    }
    let nowhere = FootSearch::new(&[whole], &Silent).unwrap().nearest(&[f64::NAN, 0.0, 0.0]);
    assert!(nowhere.foot.distance.is_nan() && !nowhere.certain);
}
