use super::*;
use crate::frame::Frame;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use trueness_geom::num::random::Random;
use trueness_geom::space::Point;
use trueness_geom::space::{Aabb, dot, minus, norm, plus, times};
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::curve::Curve as Spline;
use trueness_geom::spline::rational::Rational;

fn spot(random: &mut Random, size: f64) -> Point {
    [0, 1, 2].map(|_| size * (2.0 * random.unit() - 1.0))
}

fn frame(random: &mut Random) -> Frame {
    Frame::new(spot(random, 3.0), spot(random, 1.0), Some(spot(random, 1.0))).unwrap()
}

/// A random span of kind number `kind` of nine.
fn span(random: &mut Random, kind: usize) -> Span {
    let own = frame(random);
    let radii = [0.2 + 3.0 * random.unit(), 0.2 + 3.0 * random.unit()];
    let start = 10.0 * random.unit() - 5.0;
    let turn = [start, start + TAU * (0.05 + 0.95 * random.unit())];
    let open = [-2.0 * random.unit(), 2.0 * random.unit()];
    let points: Vec<Point> = (0..9).map(|_| spot(random, 4.0)).collect();
    let weights: Vec<_> = points.iter().map(|p| (*p, 0.3 + 2.0 * random.unit())).collect();
    let knots = Knots::new(3, vec![0.0, 0.1, 0.3, 1.0, 1.5, 1.5, 2.0, 2.5, 2.5, 3.0, 3.0, 3.0, 3.0]).unwrap();
    let within = [1.0 + 0.4 * random.unit(), 2.2 + 0.8 * random.unit()];
    let (curve, range) = match kind {
        0 => (Curve::Line { origin: own.origin, direction: spot(random, 2.0) }, open),
        1 => (Curve::Circle { frame: own, radius: radii[0] }, turn),
        2 => (Curve::Ellipse { frame: own, radii }, turn),
        3 => (Curve::Hyperbola { frame: own, radii }, open),
        4 => (Curve::Parabola { frame: own, focal: radii[0] }, open),
        5 => (Curve::Spline(Spline::new(knots, points).unwrap()), within),
        6 => (Curve::Rational(Rational::new(knots, &weights).unwrap()), within),
        7 => (Curve::Polyline(points), [0.4, 7.3]),
        _ => {
            let kind = 1 + random.below(6) as usize;
            let mut part = span(random, kind);
            let [from, to] = part.range;
            let cuts = [0.0, 0.3, 0.45, 1.0].map(|share| from + share * (to - from));
            let of = |range: &[f64]| {
                part.range = [range[0], range[1]];
                part.clone()
            };
            (Curve::Joined(cuts.windows(2).map(of).collect()), [0.3, 2.8])
        }
    };
    let back = random.unit() < 0.5;
    Span { curve, range: if back { [range[1], range[0]] } else { range } }
}

/// The least distance of many places, refined by descents.
fn brute(span: &Span, p: Point) -> f64 {
    let of = |t: f64| norm(minus(span.curve.at(t), p));
    let [from, to] = span.range;
    let at = |i: usize| from + (to - from) * i as f64 / 4000.0;
    let coarse: Vec<f64> = (0..=4000).map(|i| of(at(i))).collect();
    let least = coarse.iter().copied().fold(f64::INFINITY, f64::min);
    let mut best = least;
    for (i, distance) in coarse.iter().enumerate() {
        if *distance <= least + 0.02 {
            best = best.min(span.nearest_from(p, at(i)).distance);
        }
    }
    best
}

#[test]
fn nearest_places_are_those_of_brute_force() {
    let mut random = Random::new(11);
    for round in 0..270 {
        let span = span(&mut random, round % 9);
        let feet = span.feet();
        for _ in 0..6 {
            let p = spot(&mut random, 6.0);
            let foot = feet.nearest(p);
            let least = brute(&span, p);
            assert!((foot.distance - least).abs() < 1e-12, "{} {least} {span:?} {p:?}", foot.distance);
            let [from, to] = [span.range[0].min(span.range[1]), span.range[0].max(span.range[1])];
            assert!(foot.parameter >= from && foot.parameter <= to);
            assert!(norm(minus(span.curve.at(foot.parameter), foot.place)) < 1e-12, "{span:?}");
        }
        // On the curve itself.
        let t = span.range[0] + 0.37 * (span.range[1] - span.range[0]);
        let foot = feet.nearest(span.curve.at(t));
        assert!(foot.distance < 1e-13, "{} {span:?}", foot.distance);
    }
}

#[test]
fn shadows_have_the_nearest_places_of_moved_points() {
    let mut random = Random::new(5);
    for round in 0..90 {
        let span = span(&mut random, round % 9);
        let way = unit_of(spot(&mut random, 1.0));
        let shadow = CurveFeet::along(&span.curve, span.range, way);
        let p = spot(&mut random, 5.0);
        let flat = minus(p, times(dot(p, way), way));
        let foot = shadow.nearest(flat);
        let across = |t: f64| {
            let off = minus(span.curve.at(t), p);
            norm(minus(off, times(dot(off, way), way)))
        };
        let [from, to] = span.range;
        let least =
            (0..=20000).map(|i| across(from + (to - from) * f64::from(i) / 20000.0)).fold(9e9, f64::min);
        assert!((foot.distance - across(foot.parameter)).abs() < 1e-12, "{span:?}");
        let step = span.length() / 2000.0;
        let off = step * step / foot.distance;
        assert!(foot.distance <= least + 1e-12 && foot.distance > least - off, "{} {least}", foot.distance);
    }
}

fn unit_of(v: Point) -> Point {
    times(1.0 / norm(v), v)
}

#[test]
fn every_minimum_of_a_conic_is_found() {
    let mut random = Random::new(8);
    for round in 0..400 {
        let span = span(&mut random, 2 + round % 3);
        // Within the evolute as well as far outside.
        let p = plus(frame_of(&span.curve).origin, spot(&mut random, if round % 2 == 0 { 0.5 } else { 5.0 }));
        let mut found = vec![];
        span.feet().candidates(p, f64::INFINITY, |foot| {
            found.push(foot.parameter);
            f64::INFINITY
        });
        let [from, to] = [span.range[0].min(span.range[1]), span.range[0].max(span.range[1])];
        let of = |i: i32| norm(minus(span.curve.at(from + (to - from) * f64::from(i) / 3000.0), p));
        for i in 1..3000 {
            if of(i) < of(i - 1) && of(i) < of(i + 1) {
                let t = from + (to - from) * f64::from(i) / 3000.0;
                assert!(found.iter().any(|f| (f - t).abs() < 1.1 * (to - from) / 3000.0), "{span:?} {p:?}");
            }
        }
    }
}

fn frame_of(curve: &Curve) -> Frame {
    match curve {
        Curve::Ellipse { frame, .. } | Curve::Hyperbola { frame, .. } | Curve::Parabola { frame, .. } => {
            *frame
        }
        _ => panic!("not a conic"),
    }
}

#[test]
fn centers_axes_and_ties_have_a_place() {
    let own = Frame::new([1.0, 2.0, 3.0], [0.0, 0.0, 1.0], Some([1.0, 0.0, 0.0])).unwrap();
    let circle = Span { curve: Curve::Circle { frame: own, radius: 2.0 }, range: [1.0, 4.0] };
    let foot = circle.nearest([1.0, 2.0, 7.0]);
    assert_eq!(foot.parameter, 1.0);
    assert!((foot.distance - 20f64.sqrt()).abs() < 1e-15);
    // An ellipse from its center, from its axes within and beyond the centers of curvature.
    let ellipse = Span { curve: Curve::Ellipse { frame: own, radii: [3.0, 1.0] }, range: [0.0, TAU] };
    assert!((ellipse.nearest(own.origin).parameter - FRAC_PI_2).abs() < 1e-15);
    let focal = ellipse.nearest(own.place([2.9, 0.0, 0.0]));
    assert!((focal.distance - 0.1).abs() < 1e-15 && focal.parameter == 0.0);
    let x = 1.0;
    let inner = ellipse.nearest(own.place([x, 0.0, 0.0]));
    // cos t = a·x / (a² − b²)
    assert!((libm::cos(inner.parameter) - 3.0 * x / 8.0).abs() < 1e-15);
    // A circle as a rational spline from its center: all places are equally near.
    let half = 0.5f64.sqrt();
    let corners = [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [-1.0, 1.0], [-1.0, 0.0]];
    let points: Vec<_> =
        corners.iter().zip([1.0, half, 1.0, half, 1.0]).map(|([x, y], w)| ([*x, *y, 0.0], w)).collect();
    let knots = Knots::clamped(2, 0.0, &[1.0, 1.0], 2.0).unwrap();
    let arc = Span { curve: Curve::Rational(Rational::new(knots, &points).unwrap()), range: [0.0, 2.0] };
    assert!((arc.nearest([0.0; 3]).distance - 1.0).abs() < 1e-15);
    assert!((arc.nearest([0.0, 0.0, 1.0]).distance - 2f64.sqrt()).abs() < 1e-15);
    assert!((arc.nearest([3.0, 4.0, 0.0]).distance - 4.0).abs() < 1e-14);
    assert!((arc.length() - PI).abs() < 1e-12);
    let bounds = arc.bounds();
    assert!(
        norm(minus(bounds.max, [1.0, 1.0, 0.0])) < 1e-15 && norm(minus(bounds.min, [-1.0, 0.0, 0.0])) < 1e-15
    );
}

#[test]
fn boxes_lengths_and_chords_are_those_of_many_places() {
    let mut random = Random::new(3);
    for round in 0..108 {
        let span = span(&mut random, round % 9);
        let [from, to] = span.range;
        let many: Vec<Point> =
            (0..=20000).map(|i| span.curve.at(from + (to - from) * f64::from(i) / 20000.0)).collect();
        let (own, near) = (span.bounds(), Aabb::of(&many));
        // A corner may lie between two places.
        let step = span.length() / 4000.0;
        for k in 0..3 {
            assert!(own.min[k] <= near.min[k] + 1e-13 && own.min[k] > near.min[k] - step, "{span:?}");
            assert!(own.max[k] >= near.max[k] - 1e-13 && own.max[k] < near.max[k] + step, "{span:?}");
        }
        let chords: f64 = many.windows(2).map(|w| norm(minus(w[1], w[0]))).sum();
        assert!((span.length() - chords).abs() < 4.0 * step && span.length() > chords - 1e-10, "{span:?}");
        let parameters = span.sample(1e-3, 0.2);
        assert_eq!((parameters[0], parameters[parameters.len() - 1]), (from, to));
        assert!(parameters.windows(2).all(|w| (w[1] > w[0]) == (to > from) && w[0] != w[1]), "{span:?}");
        for w in parameters.windows(2) {
            let [a, b] = [w[0], w[1]].map(|t| span.curve.at(t));
            let chord = Span { curve: Curve::Line { origin: a, direction: minus(b, a) }, range: [0.0, 1.0] };
            for share in [0.2, 0.5, 0.7] {
                let p = span.curve.at(w[0] + share * (w[1] - w[0]));
                assert!(chord.nearest(p).distance <= 1e-3, "{span:?}");
            }
        }
    }
}
