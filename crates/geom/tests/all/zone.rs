//! Zones against brute force, datum systems against their definition.

use std::f64::consts::FRAC_PI_2;
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::rigid::Rigid;
use trueness_geom::shape::Kind;
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, plus, times, unit};
use trueness_geom::zone::datum::{Datum, DatumError, Freedom, Rule, Source, System};
use trueness_geom::zone::motion::{Search, placed};
use trueness_geom::zone::{ZoneError, slab, slab_at_angle, tube, tube_at_angle};

fn cloud(seed: u64, count: usize, size: Vector) -> Vec<Point> {
    let mut random = Random::new(seed);
    (0..count).map(|_| size.map(|s| s * (random.unit() - 0.5))).collect()
}

fn width(points: &[Point], normal: Vector) -> f64 {
    let heights = points.iter().map(|p| dot(*p, normal));
    heights.clone().fold(f64::NEG_INFINITY, f64::max) - heights.fold(f64::INFINITY, f64::min)
}

/// Seen along the axis, the narrowest strip lies along a line through two of the points.
#[test]
fn the_narrowest_wall_is_that_of_all_pairs() {
    for seed in 0..20 {
        let size = [[30.0, 0.1, 20.0], [9.0, 8.0, 7.0], [0.1, 40.0, 1.0]][seed as usize % 3];
        let points = cloud(seed, 24, size);
        let axis = unit([0.3, 0.2 * seed as f64, 1.0]).unwrap().0;
        let flat = |v: Vector| minus(v, times(dot(v, axis), axis));
        let mut least = f64::INFINITY;
        for (i, p) in points.iter().enumerate() {
            for q in &points[..i] {
                if let Some((normal, _)) = unit(cross(axis, flat(minus(*p, *q)))) {
                    least = least.min(width(&points, normal));
                }
            }
        }
        let zone = slab_at_angle(&points, axis, FRAC_PI_2).unwrap();
        assert!((zone.width - least).abs() < 1e-11, "{seed}: {} instead of {least}", zone.width);
        assert!(dot(zone.normal, axis).abs() < 1e-14);
        let reached = dot(minus(points[zone.high], points[zone.low]), zone.normal);
        assert!((reached - zone.width).abs() < 1e-12);
    }
}

/// No direction of a dense search at the same angle is narrower, for many points too.
#[test]
fn no_other_turn_is_narrower() {
    for (seed, count) in [(1, 40), (2, 400), (3, 9000)] {
        let points = cloud(seed, count, [50.0, 0.05, 30.0]);
        let axis = [0.0, 0.6, 0.8];
        for degrees in [20.0f64, 53.0, 90.0] {
            let angle = degrees.to_radians();
            let zone = slab_at_angle(&points, axis, angle).unwrap();
            assert!((dot(zone.normal, axis) - angle.cos()).abs() < 1e-14);
            let frame = Rigid::into_frame([0.0; 3], axis, [1.0, 0.0, 0.0]).unwrap();
            let [u, v, w] = frame.rotation();
            for k in 0..4000 {
                let turn = std::f64::consts::TAU * f64::from(k) / 4000.0;
                let across = plus(times(turn.cos(), u), times(turn.sin(), v));
                let normal = plus(times(angle.cos(), w), times(angle.sin(), across));
                assert!(width(&points, normal) >= zone.width - 1e-10);
            }
        }
    }
}

/// The smallest circle around points is that of two or three of them that holds all.
#[test]
fn the_thinnest_tube_is_that_of_all_pairs_and_triples() {
    for seed in 0..20 {
        let points = cloud(seed, 18, [4.0, 3.0, 50.0]);
        let direction = unit([0.1, -0.2, 1.0]).unwrap().0;
        let frame = Rigid::into_frame([0.0; 3], direction, [1.0, 0.0, 0.0]).unwrap();
        let flat: Vec<Point> = points.iter().map(|p| frame.point(*p)).map(|[x, y, _]| [x, y, 0.0]).collect();
        let holds = |c: Point, r: f64| flat.iter().all(|p| norm(minus(*p, c)) <= r + 1e-12);
        let mut least = f64::INFINITY;
        for (i, a) in flat.iter().enumerate() {
            for (j, b) in flat[..i].iter().enumerate() {
                let (c, r) = (times(0.5, plus(*a, *b)), 0.5 * norm(minus(*a, *b)));
                if holds(c, r) {
                    least = least.min(r);
                }
                for d in &flat[..j] {
                    let (p, q) = (minus(*b, *a), minus(*d, *a));
                    let n = cross(p, q);
                    let up = minus(times(dot(p, p), cross(q, n)), times(dot(q, q), cross(p, n)));
                    let offset = times(0.5 / dot(n, n), up);
                    let (c, r) = (plus(*a, offset), norm(offset));
                    if holds(c, r) {
                        least = least.min(r);
                    }
                }
            }
        }
        let zone = tube(&points, direction).unwrap();
        assert!((zone.diameter - 2.0 * least).abs() < 1e-11, "{seed}: {} {least}", zone.diameter);
        for p in &points {
            assert!(norm(cross(minus(*p, zone.point), zone.direction)) <= 0.5 * zone.diameter + 1e-12);
        }
    }
}

/// A straight axis at 60° fits a tube at 60° of no thickness, whatever its azimuth.
#[test]
fn a_leaning_axis_lies_in_its_tube() {
    for k in 0..7 {
        let turn = f64::from(k);
        let way = [60f64.to_radians().sin() * turn.cos(), 60f64.to_radians().sin() * turn.sin(), 0.5];
        let points: Vec<Point> = (0..9).map(|i| plus([5.0, 6.0, 7.0], times(f64::from(i), way))).collect();
        let zone = tube_at_angle(&points, [0.0, 0.0, 1.0], 60f64.to_radians()).unwrap();
        assert!(zone.diameter < 1e-9, "{}", zone.diameter);
    }
}

#[test]
fn what_makes_no_zone_is_refused() {
    assert_eq!(slab(&[], [0.0, 0.0, 1.0]), Err(ZoneError::NoPoints));
    assert_eq!(
        slab(&[[0.0; 3], [0.0, f64::NAN, 0.0]], [0.0, 0.0, 1.0]),
        Err(ZoneError::NotFinite { index: 1 })
    );
    assert_eq!(slab(&[[0.0; 3]], [0.0; 3]), Err(ZoneError::NoDirection));
    assert_eq!(tube(&[[0.0; 3]], [0.0; 3]).unwrap_err(), ZoneError::NoDirection);
    assert_eq!(tube(&[[1.0; 3]; 5], [0.0, 0.0, 1.0]).unwrap().diameter, 0.0);
}

/// A plane of this normal (its points a little off), at this height along it.
fn plane(normal: Vector, height: f64, seed: u64) -> Vec<Point> {
    let (n, _) = unit(normal).unwrap();
    let least = (0..3).min_by(|&i, &j| n[i].abs().total_cmp(&n[j].abs())).unwrap();
    let toward: Vector = std::array::from_fn(|k| f64::from(u8::from(k == least)));
    let frame = Rigid::into_frame(times(height, n), n, toward).unwrap().inverse();
    cloud(seed, 60, [60.0, 40.0, 0.01]).into_iter().map(|p| frame.point(p)).collect()
}

/// In a system the second plane is perpendicular to the first, the third to both; by minimum zone all material is inside.
#[test]
fn three_planes_make_a_frame() {
    let outward = [[0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]];
    let planes =
        [plane(outward[0], 0.0, 1), plane([-1.0, 2e-4, 1e-4], 0.0, 2), plane([1e-4, -1.0, 2e-4], 0.0, 3)];
    let source = |k: usize| Source { points: &planes[k], kind: Kind::Plane, outward: outward[k] };
    let sources = [source(0), source(1), source(2)].map(|s| vec![s]);
    for rule in [Rule::Gaussian, Rule::MinimumZone] {
        let system = System::associated(&sources, rule, &Silent).unwrap();
        assert!(system.free.is_none());
        let normal = |d: &Datum| if let Datum::Plane { normal, .. } = d { *normal } else { unreachable!() };
        let normals: Vec<Vector> = system.datums.iter().map(normal).collect();
        for (i, n) in normals.iter().enumerate() {
            assert!(dot(*n, outward[i]) > 0.99);
            assert!(normals[..i].iter().all(|m| dot(*m, *n).abs() < 1e-14));
        }
        // z into the material of the first, x of the second; both start at the datum.
        for (points, k) in [(&planes[0], 2), (&planes[1], 0)] {
            let heights: Vec<f64> = points.iter().map(|p| system.frame.point(*p)[k]).collect();
            let least = heights.iter().copied().fold(f64::INFINITY, f64::min);
            let mean = heights.iter().sum::<f64>() / heights.len() as f64;
            let at = if rule == Rule::Gaussian { mean } else { least };
            assert!(at.abs() < 1e-12, "{rule:?} {k} {at}");
        }
    }
    // By least squares the second plane is the best of those perpendicular to the first.
    let system = System::associated(&sources[..2], Rule::Gaussian, &Silent).unwrap();
    assert_eq!(system.free, Freedom { shift: [false, true, false], turn: [false; 3] });
    let Datum::Plane { point, normal } = system.datums[1] else { unreachable!() };
    let sum = |n: Vector| planes[1].iter().map(|p| dot(minus(*p, point), n).powi(2)).sum::<f64>();
    let z = system.frame.rotation()[2];
    for turn in [-1e-5f64, 1e-5] {
        let other = plus(times(turn.cos(), normal), times(turn.sin(), cross(z, normal)));
        assert!(sum(other) > sum(normal));
    }
}

#[test]
fn datums_that_hold_nothing_are_refused() {
    let z = [0.0, 0.0, 1.0];
    let (a, b, c) = (plane(z, 0.0, 1), plane(z, 9.0, 2), plane([1.0, 0.0, 1.0], 0.0, 3));
    let source = |points| Source { points, kind: Kind::Plane, outward: z };
    let system =
        |second| System::associated(&[vec![source(&a)], vec![source(second)]], Rule::Gaussian, &Silent);
    assert!(matches!(system(&b), Err(DatumError::Idle { datum: 1, .. })));
    let oblique = system(&c);
    assert!(
        matches!(oblique, Err(DatumError::Oblique { datum: 1, degrees }) if (degrees - 45.0).abs() < 0.1)
    );
}

/// Free in everything, the zone about a sphere of given radius is narrower than any near it.
#[test]
fn the_placed_sphere_is_the_best_near_it() {
    let mut random = Random::new(7);
    let points: Vec<Point> = (0..300)
        .map(|_| {
            let way = unit([random.unit() - 0.5, random.unit() - 0.5, random.unit()]).unwrap().0;
            plus([0.03, -0.02, 0.05], times(25.0 + 0.02 * random.unit(), way))
        })
        .collect();
    let distance = |_, p: Point| unit(p).map(|(way, length)| (length - 25.0, way));
    let search =
        Search { start: Rigid::IDENTITY, free: Freedom::ALL, middle: 0.0, floating: false, outer: false };
    let best = placed(&points, &distance, &search, &Silent).unwrap();
    let center = best.motion.inverse().point([0.0; 3]);
    let half = |c: Point| points.iter().map(|p| (norm(minus(*p, c)) - 25.0).abs()).fold(0.0, f64::max);
    assert!((half(center) - best.half).abs() < 1e-12);
    for size in [1e-2, 1e-4, 1e-6] {
        for _ in 0..300 {
            let step = [0; 3].map(|_| size * (random.unit() - 0.5));
            assert!(half(plus(center, step)) >= best.half - 1e-11, "{size}");
        }
    }
}

/// A bore across the first datum places what is left behind two planes; where a turn is free, or nothing is left, it is refused.
#[test]
fn a_cross_bore_is_a_third_datum() {
    let down = Datum::Plane { point: [3.0, 4.0, 0.5], normal: [0.0, 0.0, -1.0] };
    let side = Datum::Plane { point: [-2.0, 7.0, 9.0], normal: [-1.0, 0.0, 0.0] };
    let bore = |direction| Datum::Axis { point: [40.0, 15.0, 10.0], direction };
    let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    for sense in [1.0, -1.0] {
        let system = System::of(&[down, side, bore(times(sense, x))]).unwrap();
        assert!(system.free.is_none());
        let origin = system.frame.inverse().point([0.0; 3]);
        assert!(norm(minus(origin, [-2.0, 15.0, 0.5])) < 1e-12, "{origin:?}");
        assert_eq!(system.frame.rotation(), [x, y, z]);
    }
    // It holds place across itself alone, which both planes have already.
    assert!(matches!(System::of(&[down, side, bore(y)]), Err(DatumError::Idle { datum: 2, .. })));
    assert!(matches!(System::of(&[down, bore(x)]), Err(DatumError::Across { datum: 1 })));
    let oblique = System::of(&[down, side, bore(unit([1.0, 1.0, 0.0]).unwrap().0)]);
    assert!(matches!(oblique, Err(DatumError::Oblique { datum: 2, .. })));
    // Behind an axis and a plane along it, it places the origin along that axis.
    let upright = Datum::Axis { point: [5.0, 6.0, 7.0], direction: z };
    let system = System::of(&[upright, side, bore(y)]).unwrap();
    assert!(system.free.is_none());
    assert!(norm(minus(system.frame.inverse().point([0.0; 3]), [5.0, 6.0, 10.0])) < 1e-12);
}
