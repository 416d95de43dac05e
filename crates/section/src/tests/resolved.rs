//! Rows of curves without noise.

use super::*;
use crate::model::flat::angle;

/// Upper and lower side of a profile of NACA's four digits, chord 100, with a sharp trailing edge: `a` from 0 to 2 π around it.
fn naca(camber: f64, thickness: f64, a: f64) -> [f64; 2] {
    let x = 0.5 * (1.0 + libm::cos(a));
    let half =
        5.0 * thickness * (0.2969 * x.sqrt() - x * (0.1260 + x * (0.3516 - x * (0.2843 - 0.1036 * x))));
    let side = if a <= std::f64::consts::PI { 1.0 } else { -1.0 };
    let p = 0.4;
    let (mean, slope) = if x < p {
        (camber / (p * p) * (2.0 * p * x - x * x), 2.0 * camber / (p * p) * (p - x))
    } else {
        let q = (1.0 - p) * (1.0 - p);
        (camber / q * (1.0 - 2.0 * p + 2.0 * p * x - x * x), 2.0 * camber / q * (p - x))
    };
    let (sin, cos) = libm::sincos(libm::atan(slope));
    [100.0 * (x - side * half * sin), 100.0 * (mean + side * half * cos)]
}

/// The greatest distance of places of a curve from a contour.
fn off(contour: &Contour, places: impl Iterator<Item = [f64; 2]>) -> f64 {
    let nearest = |p: [f64; 2]| {
        contour.segments.iter().map(|s| s.nearest(p).distance.abs()).fold(f64::INFINITY, f64::min)
    };
    places.map(nearest).fold(0.0, f64::max)
}

fn control_points(contour: &Contour) -> usize {
    let of = |s: &Segment| match &s.geometry {
        Geometry::Spline { curve, .. } => curve.points().len(),
        _ => 0,
    };
    contour.segments.iter().map(of).sum()
}

/// A profile has one corner, its trailing edge, and none where its curvature is high. One curve of few control points
/// runs along all of it, between the points too, and reversed rows have the same.
#[test]
fn a_profile_has_no_corner_at_its_leading_edge() {
    let tau = std::f64::consts::TAU;
    for (camber, thickness) in [(0.0, 0.12), (0.02, 0.12), (0.04, 0.09)] {
        // Half the points: between few the leading edge is hardly known; points are kept within a millionth of the size.
        for (half, most) in [(30, 0.05), (50, 0.006), (100, 8e-4), (400, 1.5e-4), (800, 1.5e-4)] {
            let at = |k: usize| naca(camber, thickness, tau * k as f64 / (2 * half) as f64);
            let points: Vec<[f64; 2]> = (0..2 * half).map(at).collect();
            let contour = found(&points);
            assert_eq!(kinds(&contour), [SegmentKind::Spline], "{camber} {half}");
            assert!(
                contour.closed && contour.joins.len() == 1 && contour.unreliable.is_empty(),
                "{camber} {half}"
            );
            let join = &contour.joins[0];
            assert!(
                far(join.point, [100.0, 0.0]) < 1e-9 && join.turn.abs() > 2.5,
                "{camber} {half}: {join:?}"
            );
            let fewer = control_points(&contour);
            assert!(fewer < half.min(100) + 60, "{camber} {half}: {fewer} control points");
            let between = (0..4001).map(|k| naca(camber, thickness, tau * k as f64 / 4000.0));
            let off = off(&contour, between);
            assert!(off < most, "{camber} {thickness} {half}: {off}");
            let turned: Vec<[f64; 2]> = points.iter().rev().copied().collect();
            let other = found(&turned);
            assert!(other.joins[0].point == join.point && control_points(&other) == fewer);
        }
    }
}

/// Ellipses, however slender, are one closed curve, smooth where it closes.
#[test]
fn ellipses_have_no_corners() {
    for small in [20.0, 5.0] {
        for count in [100, 300, 800, 2000] {
            let at = |t: f64| {
                let (sin, cos) = libm::sincos(std::f64::consts::TAU * t);
                [50.0 * cos, small * sin]
            };
            let points: Vec<[f64; 2]> = (0..count).map(|i| at(f64::from(i) / f64::from(count))).collect();
            let contour = found(&points);
            assert_eq!(kinds(&contour), [SegmentKind::Spline], "{small} {count}");
            assert!(contour.closed && contour.joins.is_empty(), "{small} {count}");
            let Geometry::Spline { curve, .. } = &contour.segments[0].geometry else { unreachable!() };
            let (a, b) = (curve.derivative(0.0, 1), curve.derivative(1.0, 1));
            assert!(angle(a, b).abs() < 1e-9, "{small} {count}");
            let most = if count == 100 { 0.01 } else { 1e-3 };
            let off = off(&contour, (0..3000).map(|i| at(f64::from(i) / 3000.0)));
            assert!(off < most, "{small} {count}: {off}");
        }
    }
}

/// Two curves that meet at an angle have a corner there, at a point or between two.
#[test]
fn corners_between_curves_are_found() {
    for degrees in [12.0_f64, 30.0, 90.0] {
        for between in [false, true] {
            // Two waves from the origin on.
            let (sin, cos) = libm::sincos(degrees.to_radians());
            let wave = |x: f64| [x, 0.4 * x * x / (1.0 + x * x) + 0.002 * x * x * x];
            let at = |s: f64| {
                let [x, y] = wave(s.abs());
                if s < 0.0 { [-x, y] } else { [x * cos - y * sin, x * sin + y * cos] }
            };
            let shift = if between { 0.4 } else { 0.0 };
            let points: Vec<[f64; 2]> = (-60..60).map(|i| at(0.05 * (f64::from(i) + shift))).collect();
            let contour = found(&points);
            assert_eq!(kinds(&contour), [SegmentKind::Spline; 2], "{degrees} {between}");
            let join = &contour.joins[0];
            assert_eq!(join.continuity, Continuity::G0);
            let most = if between { 5e-3 } else { 1e-9 };
            assert!(far(join.point, [0.0; 2]) < most, "{degrees} {between}: {join:?}");
            assert!((join.turn - degrees.to_radians()).abs() < 0.02, "{degrees} {between}: {}", join.turn);
        }
    }
}

/// Lines and arcs among curves are these, exactly.
#[test]
fn lines_and_arcs_stay_what_they_are() {
    // A line, and a curve whose curvature grows from 0.
    let points: Vec<[f64; 2]> = (-60..60)
        .map(|i| 0.1 * f64::from(i))
        .map(|x| if x < 0.0 { [x, 0.0] } else { [x, 0.03 * x * x * x / (1.0 + x)] })
        .collect();
    let contour = found(&points);
    assert_eq!(contour.segments[0].geometry.kind(), SegmentKind::Line);
    assert!(kinds(&contour)[1..].iter().all(|k| *k == SegmentKind::Spline), "{:?}", kinds(&contour));
}

/// A step has two corners, whose turns are opposite, and straight sides are lines.
#[test]
fn a_step_has_two_corners() {
    let points: Vec<[f64; 2]> =
        (0..400).map(|i| [0.1 * f64::from(i), if i < 200 { 0.0 } else { 5.0 }]).collect();
    let contour = found(&points);
    assert_eq!(kinds(&contour), [SegmentKind::Line; 3]);
    assert!(far(contour.joins[0].point, points[199]) < 1e-9);
    assert!(far(contour.joins[1].point, points[200]) < 1e-9);
}

/// A curve with nearly as many control points as there are points runs through these, whatever their noise. The
/// contour's noise is not the residual between them.
#[test]
fn a_curve_through_noise_does_not_hide_it() {
    for seed in 0..4 {
        let random = &mut Random::new(11 + seed);
        let points: Vec<[f64; 2]> = (0..300)
            .map(|i| f64::from(i) / 299.0)
            .map(|t| {
                let (sin, cos) = libm::sincos(60.0 * t);
                [(1.0 + 50.0 * t) * cos, (1.0 + 50.0 * t) * sin].map(|x| x + 0.01 * normal(random))
            })
            .collect();
        let contour = found(&points);
        assert!(contour.noise > 0.005 || !contour.unreliable.is_empty(), "{seed}: {}", contour.noise);
    }
}
