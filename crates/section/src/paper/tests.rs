//! The paper's example rebuilt; rows run through from their end; rows without a line.

use super::*;
use crate::{SegmentKind, contour};
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;

/// The paper's example: a line at 45° to the join (5, 1), then a curve whose curvature starts with a jump; points 0.5 apart.
fn example(noise: f64, seed: u64) -> Vec<[f64; 2]> {
    let random = &mut Random::new(seed);
    let mut normal = || (0..12).map(|_| random.unit()).sum::<f64>() - 6.0;
    let eighth = std::f64::consts::FRAC_PI_4;
    let (sin, cos) = libm::sincos(eighth);
    let mut at = [5.0, 1.0];
    let mut points = vec![];
    for i in (0..30).rev() {
        points.push([5.0 - (0.5 * f64::from(i) + 0.2) * cos, 1.0 - (0.5 * f64::from(i) + 0.2) * sin]);
    }
    // Curvature −0.25 and rising by 0.02 a millimeter: by small steps of the middle's direction.
    let (step, mut s) = (1e-3, 0.0);
    while points.len() < 62 {
        let heading = |s: f64| eighth - 0.25 * s + 0.01 * s * s;
        let (sin, cos) = libm::sincos(heading(s + 0.5 * step));
        at = [at[0] + step * cos, at[1] + step * sin];
        s += step;
        if ((s - 0.3) / 0.5 + 1e-9).floor() > ((s - step - 0.3) / 0.5 + 1e-9).floor() {
            points.push(at);
        }
    }
    points.iter().map(|p| [p[0] + noise * normal(), p[1] + noise * normal()]).collect()
}

fn far(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(b[0] - a[0], b[1] - a[1])
}

fn methods(points: &[[f64; 2]]) -> (Vec<Method>, bool, Contour) {
    let found = contour(points, &Options::default(), &Silent).unwrap();
    let kinds: Vec<SegmentKind> = found.segments.iter().map(|s| s.geometry.kind()).collect();
    let answer = line_and_curve(points, &found, None, &Silent);
    let (all, reversed) = answer.unwrap_or_else(|e| panic!("{e}: {kinds:?}, closed: {}", found.closed));
    (all, reversed, found)
}

/// The paper's table: all joins lie on their lines, the curves start there along them, and follow the points. How near
/// the joins come depends on the curve's freedom: within four spacings.
#[test]
fn the_three_methods_on_the_example() {
    for seed in 0..10 {
        let points = example(0.002, seed);
        let (all, reversed, _) = methods(&points);
        assert!(!reversed && all.len() == 3);
        assert!(all.iter().all(|m| far(m.join, [5.0, 1.0]) < 2.0), "{seed}");
        for method in &all {
            let (middle, u) = method.line;
            let d = [method.join[0] - middle[0], method.join[1] - middle[1]];
            assert!((d[0] * u[1] - d[1] * u[0]).abs() < 1e-12, "the join is on the line");
            let start = method.curve.derivative(method.curve.domain().0, 1);
            assert!((start[0] * u[1] - start[1] * u[0]).abs() < 1e-9 * libm::hypot(start[0], start[1]));
            assert!(far(method.curve.at(method.curve.domain().0), method.join) < 1e-12);
            assert!(method.line_residuals[0] < 0.004 && method.curve_residuals[0] < 0.02, "{method:?}");
        }
        let inside = |m: &Method| far(m.interval[0], m.join) + far(m.join, m.interval[1]);
        assert!(all[1..].iter().all(|m| inside(m) < far(m.interval[0], m.interval[1]) + 0.02));
    }
}

#[test]
fn a_row_run_through_from_its_end_has_the_same_joins() {
    let points = example(0.002, 3);
    let (forward, _, found) = methods(&points);
    let turned: Vec<[f64; 2]> = points.iter().rev().copied().collect();
    let (backward, reversed, other) = methods(&turned);
    assert!(reversed);
    for (a, b) in forward.iter().zip(&backward) {
        assert!(far(a.join, b.join) < 1e-6, "{a:?} {b:?}");
    }
    let options = Options::default();
    let one = method_contour(&points, &found, &forward[2], false, &options);
    let two = method_contour(&turned, &other, &backward[2], true, &options);
    assert_eq!(one.segments[0].geometry.kind(), SegmentKind::Line);
    assert_eq!(two.segments[1].geometry.kind(), SegmentKind::Line);
    assert!(far(one.segments[0].end, one.segments[1].start) < 1e-12);
    assert!(far(two.segments[0].end, two.segments[1].start) < 1e-9);
    for (a, b) in one.residuals.iter().zip(two.residuals.iter().rev()) {
        assert!((a + b).abs() < 1e-6, "{a} {b}");
    }
}

#[test]
fn without_a_line_there_is_no_join() {
    let ring: Vec<[f64; 2]> =
        (0..80).map(|i| libm::sincos(f64::from(i) * 0.05)).map(|(s, c)| [9.0 * c, 9.0 * s]).collect();
    let found = contour(&ring, &Options::default(), &Silent).unwrap();
    assert_eq!(line_and_curve(&ring, &found, None, &Silent).unwrap_err(), SectionError::NoLine);
}

/// A curve of few points whose curvature changes fast is a few arcs to a first partition. These do not meet with a
/// common tangent, but it has no corners all the same.
#[test]
fn the_example_is_a_line_and_a_curve() {
    for (noise, fewest) in [(0.0005, 18), (0.002, 18), (0.01, 18)] {
        let right = |seed: &u64| {
            let found = contour(&example(noise, *seed), &Options::default(), &Silent).unwrap();
            let kinds: Vec<SegmentKind> = found.segments.iter().map(|s| s.geometry.kind()).collect();
            let near = || far(found.joins[0].point, [5.0, 1.0]) < 0.25 && found.joins[0].turn == 0.0;
            kinds == [SegmentKind::Line, SegmentKind::Spline] && near()
        };
        let count = (0..20).filter(right).count();
        assert!(count >= fewest, "{noise}: {count} of 20");
    }
}
