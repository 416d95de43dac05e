//! Dimensions in closed form, against brute force, and their uncertainties over fresh noise.

use super::*;
use crate::{Continuity, Options, contour};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;

fn normal(random: &mut Random) -> f64 {
    (0..12).map(|_| random.unit()).sum::<f64>() - 6.0
}

fn noisy(points: impl IntoIterator<Item = [f64; 2]>, noise: f64, seed: u64) -> Vec<[f64; 2]> {
    let random = &mut Random::new(seed);
    points.into_iter().map(|p| p.map(|x| x + noise * normal(random))).collect()
}

fn found(points: &[[f64; 2]], closed: bool) -> Contour {
    let options = Options { closed: Some(closed), ..Options::default() };
    contour(points, &options, &Silent).unwrap()
}

fn of(all: &[Dimension], kind: DimensionKind) -> Vec<Dimension> {
    all.iter().filter(|d| d.kind == kind).copied().collect()
}

/// Closed: lines of length 20 at the heights 0 and 8, half circles of radius 4.
fn slot() -> Vec<[f64; 2]> {
    let line = |y: f64, sense: f64| (0..100).map(move |i| [sense * (0.2 * (f64::from(i) + 0.5) - 10.0), y]);
    let bow = |x: f64, from: f64| {
        (0..63).map(move |i| {
            let (sin, cos) = libm::sincos(from + PI * (f64::from(i) + 0.5) / 63.0);
            [x + 4.0 * cos, 4.0 + 4.0 * sin]
        })
    };
    line(0.0, 1.0).chain(bow(10.0, -FRAC_PI_2)).chain(line(8.0, -1.0)).chain(bow(-10.0, FRAC_PI_2)).collect()
}

#[test]
fn a_slot_has_a_width_and_two_centers() {
    let all = dimensions(&[found(&noisy(slot(), 0.001, 3), true)]);
    assert!(of(&all, DimensionKind::Angle).is_empty(), "{all:?}");
    let [width] = of(&all, DimensionKind::Width)[..] else { panic!("{all:?}") };
    let [centers] = of(&all, DimensionKind::Centers)[..] else { panic!("{all:?}") };
    assert!((width.value - 8.0).abs() < 4.0 * width.uncertainty.unwrap(), "{width:?}");
    assert!((centers.value - 20.0).abs() < 4.0 * centers.uncertainty.unwrap(), "{centers:?}");
    // Measured across, in the middle.
    let [p, q] = width.between;
    assert!((p[0] - q[0]).abs() < 0.01 && p[0].abs() < 0.1 && (distance(p, q) - width.value).abs() < 1e-12);
}

/// A segment that does not run along its points is measured by none: neither widths nor centers, angles or gaps.
#[test]
fn segments_astray_have_no_dimensions() {
    let sound = found(&noisy(slot(), 0.001, 3), true);
    for k in 0..sound.segments.len() {
        let contour = Contour { unreliable: vec![k], ..sound.clone() };
        let kinds: Vec<&str> = dimensions(&[contour]).iter().map(|d| d.kind.name()).collect();
        let line = sound.segments[k].geometry.kind() == SegmentKind::Line;
        assert_eq!(kinds, if line { ["centers"] } else { ["width"] }, "{k}");
    }
    let square = |x: f64| {
        let side = move |k: usize, t: f64| [[t, 0.0], [5.0, t], [5.0 - t, 5.0], [0.0, 5.0 - t]][k];
        let at = move |i: usize| side(i / 20, (i % 20) as f64 * 0.25);
        (0..80).map(at).map(move |p| [p[0] + x, p[1]])
    };
    let of_two = [found(&noisy(square(0.0), 0.001, 4), true), found(&noisy(square(9.0), 0.001, 5), true)];
    let count = |all: &[Dimension], kind| of(all, kind).len();
    let all = dimensions(&of_two);
    assert_eq!((count(&all, DimensionKind::Angle), count(&all, DimensionKind::Gap)), (8, 1));
    let mut of_two = of_two;
    of_two[0].unreliable = (0..4).collect();
    let all = dimensions(&of_two);
    assert_eq!((count(&all, DimensionKind::Angle), count(&all, DimensionKind::Gap)), (4, 0));
    assert!(all.iter().all(|d| d.of.iter().all(|[c, _]| *c == 1)), "{all:?}");
}

/// Errors over their uncertainties have the mean square 1 over fresh noise, where kinds and joins are found as they
/// are. With 120 draws that is uncertain by 0.13. Uncertainties do not say how likely another model is.
#[test]
fn uncertainties_are_those_of_fresh_noise() {
    let (mut sums, mut count) = ([0.0; 3], 0.0);
    // Two lines at 60° with a rounded corner of radius 3, open; and the slot.
    let (sin, cos) = libm::sincos(PI / 3.0);
    let around = |s: f64| {
        let turn = 3.0 * (PI - PI / 3.0);
        let (far, near) = libm::sincos(PI - PI / 3.0);
        if s < 10.0 {
            [s, 0.0]
        } else if s < 10.0 + turn {
            let (u, v) = libm::sincos((s - 10.0) / 3.0);
            [10.0 + 3.0 * u, 3.0 - 3.0 * v]
        } else {
            let t = s - 10.0 - turn;
            [10.0 + 3.0 * far - cos * t, 3.0 - 3.0 * near + sin * t]
        }
    };
    let whole = 20.0 + 3.0 * (PI - PI / 3.0);
    for seed in 0..120 {
        let bend =
            found(&noisy((0..120).map(|i| around(whole * f64::from(i) / 119.0)), 0.01, 50 + seed), false);
        let closed = found(&noisy(slot(), 0.01, 900 + seed), true);
        let tangent = |c: &Contour| c.joins.iter().all(|j| j.continuity == Continuity::G1);
        if !tangent(&bend) || !tangent(&closed) {
            continue;
        }
        let (a, b) = (dimensions(&[bend]), dimensions(&[closed]));
        let three = [
            (of(&a, DimensionKind::Angle), PI / 3.0),
            (of(&b, DimensionKind::Width), 8.0),
            (of(&b, DimensionKind::Centers), 20.0),
        ];
        if three.iter().any(|(list, _)| list.len() != 1) {
            continue;
        }
        count += 1.0;
        for (sum, (list, truth)) in sums.iter_mut().zip(&three) {
            *sum += ((list[0].value - truth) / list[0].uncertainty.unwrap()).powi(2);
        }
    }
    assert!(count > 114.0, "{count}");
    for mean in sums.map(|s| s / count) {
        assert!((mean - 1.0).abs() < 0.4, "{:?}", sums.map(|s| s / count));
    }
}

/// Around a square with corners: four right angles, two widths; where nothing is known, no uncertainty is told.
#[test]
fn a_square_has_four_angles_and_two_widths() {
    let side = |i: u32| 0.1 * (f64::from(i) + 0.5);
    let square = (0..60)
        .map(|i| [side(i), 0.0])
        .chain((0..60).map(|i| [6.0, side(i)]))
        .chain((0..60).map(|i| [6.0 - side(i), 6.0]))
        .chain((0..60).map(|i| [0.0, 6.0 - side(i)]));
    let all = dimensions(&[found(&noisy(square, 0.002, 7), true)]);
    let (angles, widths) = (of(&all, DimensionKind::Angle), of(&all, DimensionKind::Width));
    assert_eq!((angles.len(), widths.len(), all.len()), (4, 2, 6), "{all:?}");
    for angle in angles {
        assert!((angle.value - FRAC_PI_2).abs() < 5.0 * angle.uncertainty.unwrap(), "{angle:?}");
    }
    for width in widths {
        assert!((width.value - 6.0).abs() < 5.0 * width.uncertainty.unwrap(), "{width:?}");
    }
}

fn ring(center: [f64; 2], radius: f64, seed: u64) -> Contour {
    let points = (0..150).map(|i| {
        let (sin, cos) = libm::sincos(TAU * f64::from(i) / 150.0);
        [center[0] + radius * cos, center[1] + radius * sin]
    });
    found(&noisy(points, 0.001, seed), true)
}

/// Gaps of circles beside and within each other, in closed form; and over fresh noise.
#[test]
fn gaps_of_circles_are_those_of_their_radii() {
    let mut sum = 0.0;
    for seed in 0..60 {
        let all = dimensions(&[ring([0.0, 0.0], 3.0, 3 * seed), ring([9.0, 12.0], 5.0, 3 * seed + 1)]);
        let [gap] = of(&all, DimensionKind::Gap)[..] else { panic!("{all:?}") };
        sum += ((gap.value - 7.0) / gap.uncertainty.unwrap()).powi(2);
    }
    assert!((sum / 60.0 - 1.0).abs() < 0.55, "{}", sum / 60.0);
    let all = dimensions(&[ring([0.0, 0.0], 3.0, 1), ring([0.5, 0.0], 5.0, 2), ring([30.0, 0.0], 2.0, 3)]);
    let gaps = of(&all, DimensionKind::Gap);
    let near = |d: &Dimension, value: f64| (d.value - value).abs() < 5.0 * d.uncertainty.unwrap();
    // Each contour and the nearest other, each pair once.
    assert_eq!(gaps.iter().map(|d| d.of.map(|o| o[0])).collect::<Vec<_>>(), [[0, 1], [1, 2]]);
    assert!(near(&gaps[0], 1.5) && near(&gaps[1], 22.5), "{gaps:?}");
}

/// The least distance of lines, arcs and splines is that of many places of both.
#[test]
fn least_distances_are_those_of_brute_force() {
    let segment = |geometry: Geometry, start: [f64; 2], end: [f64; 2], length: f64| Segment {
        geometry,
        length,
        ..Segment::line(start, end)
    };
    let random = &mut Random::new(9);
    for _ in 0..60 {
        let mut one = |k: usize| {
            let mut place = || [10.0 * random.unit(), 10.0 * random.unit()];
            let (p, q, r, s) = (place(), place(), place(), place());
            match k {
                0 => segment(Geometry::Line, p, q, distance(p, q)),
                1 => {
                    let (radius, start, sweep) = (0.3 * q[0], q[1], 0.9 * (r[0] - 5.0));
                    let at = |a: f64| [p[0] + radius * libm::cos(a), p[1] + radius * libm::sin(a)];
                    let geometry = Geometry::Arc { center: p, radius, start, sweep };
                    segment(geometry, at(start), at(start + sweep), radius * sweep.abs())
                }
                _ => {
                    let knots = trueness_geom::spline::basis::Knots::uniform(3, 1, 0.0, 1.0);
                    let curve = trueness_geom::spline::curve::Curve::new(knots, vec![p, q, r, s]).unwrap();
                    let length = curve.length(0.0, 1.0);
                    segment(Geometry::Spline { curve, deviation: 0.0 }, p, s, length)
                }
            }
        };
        for (a, b) in [(0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2)] {
            let (a, b) = (one(a), one(b));
            let (value, [p, q]) = nearest(&a, &b);
            assert!((distance(p, q) - value).abs() < 1e-9, "{value} {p:?} {q:?}");
            let places = |s: &Segment| (0..=400).map(|i| s.place(f64::from(i) / 400.0)).collect::<Vec<_>>();
            let (of_a, of_b) = (places(&a), places(&b));
            let brute =
                of_a.iter().flat_map(|p| of_b.iter().map(|q| distance(*p, *q))).fold(f64::INFINITY, f64::min);
            // Neighboring places are no farther apart than 0.11: the derivative of a spline is below 43.
            assert!(value <= brute + 1e-12 && value > brute - 0.11, "{value} {brute} {a:?} {b:?}");
        }
    }
}
