//! Noisy rows of few points to a segment: local fits of nine points hold a corner each.

use super::sparse::{is_right, rounded_rectangle};
use super::*;

fn with_noise(points: &[[f64; 2]], noise: f64, seed: u64) -> Vec<[f64; 2]> {
    let random = &mut Random::new(seed);
    points.iter().map(|p| [p[0] + noise * normal(random), p[1] + noise * normal(random)]).collect()
}

/// So many points to a side of a regular polygon of radius 10, corners included.
fn polygon(sides: usize, each: usize) -> Vec<[f64; 2]> {
    let corner = |k: usize| {
        let (s, c) = libm::sincos(0.3 + std::f64::consts::TAU * k as f64 / sides as f64);
        [10.0 * c, 10.0 * s]
    };
    let at = |i: usize| {
        let (a, b, t) = (corner(i / each), corner(i / each + 1), (i % each) as f64 / each as f64);
        [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]
    };
    (0..sides * each).map(at).collect()
}

/// A contour that calls form noise, without a word.
fn hides_form(contour: &Contour, noise: f64) -> bool {
    contour.unreliable.is_empty() && contour.noise > 1.6 * noise
}

/// 64 points of a rounded rectangle, three or so to a corner, are its lines and arcs, not one free curve of great noise.
#[test]
fn noisy_rounded_rectangles_are_lines_and_arcs() {
    let (sizes, noise) = ([30.0, 20.0, 3.0], 0.03);
    let (mut right, mut resolved) = (0, 0);
    for seed in 0..12 {
        let exact = rounded_rectangle(64, 0.08 * seed as f64, sizes, 0.2, 15);
        let contour = found(&with_noise(&exact, noise, 40 + seed));
        assert!(!hides_form(&contour, noise), "{seed}: {:?} {}", kinds(&contour), contour.noise);
        let by_turns = kinds(&contour).chunks(2).all(|k| {
            k == [SegmentKind::Line, SegmentKind::Arc] || k == [SegmentKind::Arc, SegmentKind::Line]
        });
        resolved += usize::from(by_turns && contour.segments.len() == 8);
        right += usize::from(contour.unreliable.is_empty() && is_right(&contour, sizes, 1.0));
    }
    // Where a join is taken for a corner, radii of three points each are known badly.
    assert!(resolved >= 11 && right >= 6, "{resolved} and {right} of 12");
}

/// Polygons of few noisy points to a side are polygons, and none is a circle whose noise is its corners.
#[test]
fn noisy_polygons_are_no_circles() {
    for (sides, each, fewest) in [(5, 5, 6), (6, 6, 8), (7, 6, 8), (8, 5, 6), (10, 5, 4)] {
        let mut right = 0;
        for seed in 0..12 {
            let contour = found(&with_noise(&polygon(sides, each), 0.02, 70 + seed));
            assert!(!hides_form(&contour, 0.02), "{sides} {each} {seed}: {:?}", kinds(&contour));
            let lines = kinds(&contour).iter().all(|k| *k == SegmentKind::Line);
            right += usize::from(lines && contour.segments.len() == sides);
        }
        assert!(right >= fewest, "{sides} sides of {each}: {right} of 12");
    }
}

/// Too few points to tell noise from corners: named unreliable, not a sure circle.
#[test]
fn corners_that_points_cannot_tell_are_named() {
    for sides in [5, 6, 8, 10, 12] {
        for noise in [0.0, 0.005, 0.01] {
            let contour = found(&with_noise(&polygon(sides, 2), noise, sides as u64));
            let polygon =
                contour.segments.len() == sides && kinds(&contour).iter().all(|k| *k == SegmentKind::Line);
            assert!(polygon || !contour.unreliable.is_empty(), "{sides} {noise}: {:?}", kinds(&contour));
        }
    }
    // Four arcs that meet in corners, of five points each.
    let arc = |k: usize, i: usize| {
        let turn = 0.5 * std::f64::consts::PI * k as f64;
        let (s, c) = libm::sincos(turn + 0.24 * (i as f64 - 2.0));
        let (st, ct) = libm::sincos(turn);
        [12.5 * c - 4.0 * ct, 12.5 * s - 4.0 * st]
    };
    let arcs: Vec<[f64; 2]> = (0..20).map(|i| arc(i / 5, i % 5)).collect();
    let row = |seed: u64| found(&with_noise(&arcs, 0.02, 90 + seed));
    let silent = (0..8).filter(|seed| hides_form(&row(*seed), 0.03)).count();
    assert!(silent <= 2, "{silent} of 8");
}

/// Rows of noise about one line, circle or bend are not called unreliable, and not cut into more.
#[test]
fn noise_alone_is_not_astray() {
    let (mut unreliable, mut all) = (0, 0);
    for seed in 0..40 {
        for count in [16, 24, 40, 64, 100] {
            let circle: Vec<[f64; 2]> = (0..count)
                .map(|i| libm::sincos(std::f64::consts::TAU * f64::from(i) / f64::from(count)))
                .map(|(s, c)| [10.0 * c, 10.0 * s])
                .collect();
            let line: Vec<[f64; 2]> = (0..count).map(|i| [f64::from(i), 0.3 * f64::from(i)]).collect();
            for (row, kind) in [(circle, SegmentKind::Arc), (line, SegmentKind::Line)] {
                let contour = found(&with_noise(&row, 0.03, seed));
                all += 1;
                unreliable += usize::from(!contour.unreliable.is_empty() || kinds(&contour) != [kind]);
            }
        }
    }
    assert!(50 * unreliable <= all, "{unreliable} of {all}");
}
