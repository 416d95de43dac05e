//! Rows of many segments, and of many points.

use super::*;
use std::f64::consts::{FRAC_PI_3, TAU};

/// A thread of so many pitches of 3 mm: flanks of 1.5 mm at 60° to the axis, crests and roots of radius 0.5 mm. Its joins in order, and
/// the place at each length; lengths of a pitch.
fn thread(s: f64) -> [f64; 2] {
    let (flank, radius) = (1.5, 0.5);
    let arc = 2.0 * FRAC_PI_3 * radius;
    let (half, up) = (flank + arc, FRAC_PI_3);
    let (sin, cos) = libm::sincos(up);
    // Half a pitch: up a flank and over a crest.
    let wide = flank * cos + 2.0 * radius * sin;
    let (turns, rest) = ((s / half).floor(), s % half);
    let local = if rest < flank {
        [rest * cos, rest * sin]
    } else {
        let heading = up - (rest - flank) / radius;
        let (s, c) = libm::sincos(heading);
        [flank * cos + radius * (sin - s), flank * sin + radius * (c - cos)]
    };
    // Every other half is the first one upside down, from the height at which it ended.
    let odd = turns % 2.0 == 1.0;
    [turns * wide + local[0], if odd { flank * sin - local[1] } else { local[1] }]
}

fn thread_row(pitches: f64, count: usize, noise: f64, seed: u64) -> Vec<[f64; 2]> {
    let random = &mut Random::new(seed);
    let length = pitches * 2.0 * (1.5 + FRAC_PI_3);
    (0..count)
        .map(|i| thread(length * i as f64 / count as f64))
        .map(|p| [p[0] + noise * normal(random), p[1] + noise * normal(random)])
        .collect()
}

/// Eighty flanks, crests and roots are eighty lines and arcs; their joins lie in their intervals as often as these say.
#[test]
fn a_thread_is_its_flanks_crests_and_roots() {
    let expected: Vec<SegmentKind> =
        (0..80).map(|k| if k % 2 == 0 { SegmentKind::Line } else { SegmentKind::Arc }).collect();
    let mut missed = 0;
    for seed in 1..=3 {
        let contour = found(&thread_row(20.0, 3000, 0.002, seed));
        assert!((contour.noise / 0.002 - 1.0).abs() < 0.06, "{}", contour.noise);
        assert_eq!(kinds(&contour), expected);
        assert!(contour.unreliable.is_empty(), "{:?}", contour.unreliable);
        let mut s = 0.0;
        for (k, join) in contour.joins.iter().enumerate() {
            s += if k % 2 == 0 { 1.5 } else { FRAC_PI_3 };
            let ([a, b], truth) = (join.interval, thread(s));
            missed += usize::from(far(a, truth).max(far(b, truth)) > 1.02 * far(a, b));
        }
        let radii = contour.segments.iter().filter_map(|s| match s.geometry {
            Geometry::Arc { radius, .. } => Some(radius),
            _ => None,
        });
        assert!(radii.into_iter().all(|r| (r - 0.5).abs() < 0.02));
    }
    // 12 of 237 joins are expected outside of 95 % intervals, less than 4 or more than 23 in one draw of a hundred.
    assert!((3..=24).contains(&missed), "{missed}");
}

/// An outlier that is the first or the last point of a segment turns none round, and has its own distance.
#[test]
fn an_outlier_where_two_segments_join_turns_neither_round() {
    let (pitches, count) = (6.0, 900);
    let step = pitches * 2.0 * (1.5 + FRAC_PI_3) / f64::from(count);
    for join in [5, 7] {
        let length = (0..join).map(|k| if k % 2 == 0 { 1.5 } else { FRAC_PI_3 }).sum::<f64>();
        for extra in [-1, 0] {
            let mut row = thread_row(pitches, count as usize, 0.002, 7);
            let wild = ((length / step).ceil() as i32 + extra) as usize;
            row[wild] = row[wild + 50];
            row[wild][0] += 0.1;
            let contour = found(&row);
            assert!(contour.unreliable.is_empty(), "{join} {extra}: {:?}", contour.unreliable);
            assert_eq!(contour.segments.len(), 24, "{join} {extra}");
            assert!(contour.outliers.contains(&wild), "{join} {extra}: {:?}", contour.outliers);
            assert!(contour.joins.iter().all(|j| j.uncertainty < 0.01), "{join} {extra}");
            assert!(contour.residuals[wild].abs() > 0.1, "{join} {extra}: {}", contour.residuals[wild]);
        }
    }
}

/// A spiral of many turns is smooth: its turns do not become lines and arcs by the hundred, and none is unreliable.
#[test]
fn a_spiral_is_followed_through_all_its_turns() {
    let random = &mut Random::new(2);
    let place = |t: f64| {
        let a = 20.0 * TAU * t.sqrt();
        let (sin, cos) = libm::sincos(a);
        [(5.0 + 0.5 * a) * cos, (5.0 + 0.5 * a) * sin]
    };
    let points: Vec<[f64; 2]> = (0..4000)
        .map(|i| place(i as f64 / 4000.0))
        .map(|p| [p[0] + 0.01 * normal(random), p[1] + 0.01 * normal(random)])
        .collect();
    let contour = found(&points);
    assert!((contour.noise / 0.01 - 1.0).abs() < 0.1, "{}", contour.noise);
    assert!(contour.segments.len() < 40, "{}", contour.segments.len());
}

/// A rounded rectangle of many points has the radii and widths of all of them, not of those thinned.
#[test]
fn long_rows_are_fitted_by_all_points() {
    let random = &mut Random::new(3);
    let quarter = 2.5 * TAU;
    let length = 4.0 * (30.0 + quarter);
    let place = |s: f64| {
        let (side, rest) = ((s / (30.0 + quarter)).floor(), s % (30.0 + quarter));
        let p = if rest < 30.0 {
            [rest - 15.0, -25.0]
        } else {
            let (sin, cos) = libm::sincos((rest - 30.0) / 10.0);
            [15.0 + 10.0 * sin, -15.0 - 10.0 * cos]
        };
        let (sin, cos) = libm::sincos(side * 0.25 * TAU);
        [cos * p[0] - sin * p[1], sin * p[0] + cos * p[1]]
    };
    let count = 40_000;
    let points: Vec<[f64; 2]> = (0..count)
        .map(|i| place(length * i as f64 / f64::from(count)))
        .map(|p| [p[0] + 0.02 * normal(random), p[1] + 0.02 * normal(random)])
        .collect();
    let closed = Options { closed: Some(true), ..Options::default() };
    let contour = contour(&points, &closed, &Silent).unwrap();
    assert_eq!(contour.segments.len(), 8);
    for segment in &contour.segments {
        if let Geometry::Arc { radius, .. } = segment.geometry {
            // 4,400 points over a quarter of a circle: 0.02 / √4400 times 6, and four of these.
            assert!((radius - 10.0).abs() < 0.008, "{radius}");
        }
    }
    assert!((contour.noise / 0.02 - 1.0).abs() < 0.02, "{}", contour.noise);
    let own: f64 = contour.residuals.iter().map(|r| r * r).sum();
    // The distance from the true one, whose sides lie 25 mm from the middle.
    let off = |p: &[f64; 2]| {
        let [x, y] = p.map(|x| x.abs() - 15.0);
        libm::hypot(x.max(0.0), y.max(0.0)) + x.max(y).min(0.0) - 10.0
    };
    let truth: f64 = points.iter().map(|p| off(p) * off(p)).sum();
    assert!(own < truth && truth < own * (1.0 + 60.0 / f64::from(count)), "{own} {truth}");
}
