//! Curves that lines lead into without a jump of curvature, and waves: lines and arcs of a first partition do not tell
//! them.

use super::*;

/// Lines of 40 mm along the x axis to the origin, and a curve after it.
fn after_a_line(curve: impl Iterator<Item = [f64; 2]>, noise: f64, seed: u64) -> Vec<[f64; 2]> {
    let random = &mut Random::new(seed);
    let line = (0..400).map(|i| [0.1 * f64::from(i) - 40.0, 0.0]);
    line.chain(curve).map(|p| [p[0] + noise * normal(random), p[1] + noise * normal(random)]).collect()
}

/// The clothoid of parameter 40 mm, whose curvature is the length over 1,600: places a tenth of a millimeter apart.
fn clothoid(count: usize) -> impl Iterator<Item = [f64; 2]> {
    let steps = 8;
    let step = 0.1 / f64::from(steps);
    let (mut at, mut s) = ([0.0; 2], 0.0);
    (0..count).map(move |_| {
        let now = at;
        for _ in 0..steps {
            let (sin, cos) = libm::sincos((s + 0.5 * step) * (s + 0.5 * step) / 3200.0);
            at = [at[0] + step * cos, at[1] + step * sin];
            s += step;
        }
        now
    })
}

/// A line goes on into a clothoid without a jump. The join is where the curvature begins to grow, and no few
/// coefficients more let the curve begin on the line.
#[test]
fn clothoids_begin_where_the_line_ends() {
    let mut held = 0;
    for seed in 0..10 {
        let found = found(&after_a_line(clothoid(700), 0.002, seed));
        assert_eq!(kinds(&found), [SegmentKind::Line, SegmentKind::Spline], "{seed}");
        let join = &found.joins[0];
        assert_ne!(join.continuity, Continuity::G0);
        assert!(join.point[0].abs() < 1.0, "{seed}: {:?}", join.point);
        let ends = join.interval.map(|p| p[0]);
        held += usize::from(ends[0].min(ends[1]) <= 0.0 && ends[0].max(ends[1]) >= 0.0);
    }
    assert!(held >= 8, "{held} of 10 intervals");
}

/// A wave of a dozen turns has no corner anywhere, and the residuals of its points are their noise.
#[test]
fn waves_have_no_corners() {
    for seed in 0..6 {
        let random = &mut Random::new(seed);
        let points: Vec<[f64; 2]> = (0..800)
            .map(|i| 0.1 * f64::from(i))
            .map(|x| [x + 0.003 * normal(random), 0.5 * libm::sin(x) + 0.003 * normal(random)])
            .collect();
        let found = found(&points);
        let corners = found.joins.iter().filter(|j| j.continuity == Continuity::G0).count();
        assert_eq!(corners, 0, "{seed}: {:?}", kinds(&found));
        assert!(kinds(&found).iter().all(|k| *k == SegmentKind::Spline), "{seed}");
        assert!((0.85..1.2).contains(&(found.noise / 0.003)), "{seed}: {}", found.noise);
    }
}

/// Corners beyond few points of two lines are where these cross, though points elsewhere lie near each other.
#[test]
fn sparse_lines_meet_beyond_their_points() {
    // Three lines: points of the outer two are 10 mm apart, and 5 mm from the corners; those of the middle one 0.1 mm.
    let (low, high) = ([0.0, 0.0], [0.0, 30.0]);
    let mut points: Vec<[f64; 2]> =
        (0..6).rev().map(|i| [low[0] - 5.0 - 10.0 * f64::from(i), low[1]]).collect();
    points.extend((1..300).map(|i| [0.0, 0.1 * f64::from(i)]));
    points.extend((0..6).map(|i| [high[0] + 5.0 + 10.0 * f64::from(i), high[1]]));
    let random = &mut Random::new(5);
    let points: Vec<[f64; 2]> = points.iter().map(|p| p.map(|x| x + 0.002 * normal(random))).collect();
    let found = found(&points);
    assert_eq!(kinds(&found), [SegmentKind::Line; 3]);
    for (join, truth) in found.joins.iter().zip([low, high]) {
        assert!(far(join.point, truth) < 0.02 && join.open == [false; 2], "{join:?}");
    }
}

/// Two lines, or a line and an arc, that meet at a small angle have a corner there. No free curve or arc stands between
/// them, and no tangent join beside. Tangent ones have none.
#[test]
fn blunt_corners_are_found() {
    for (seed, degrees) in [0.5_f64, 1.0, 2.0, 4.0, 6.0].into_iter().enumerate() {
        for (curvature, second) in [(0.0, SegmentKind::Line), (0.1, SegmentKind::Arc)] {
            // Beside an arc few points tell less.
            if curvature > 0.0 && degrees < 6.0 {
                continue;
            }
            let random = &mut Random::new(seed as u64);
            let points: Vec<[f64; 2]> = (-70..50)
                .map(|i| 0.3 * (f64::from(i) + 0.4))
                .map(|s| if s < 0.0 { [s, 0.0] } else { bent(s, degrees.to_radians(), curvature) })
                .map(|p| p.map(|x| x + 0.005 * normal(random)))
                .collect();
            let found = found(&points);
            assert_eq!(kinds(&found), [SegmentKind::Line, second], "{degrees}");
            let join = &found.joins[0];
            assert_eq!(join.continuity, Continuity::G0, "{degrees}");
            assert!(far(join.point, [0.0; 2]) < 3.0 * join.uncertainty, "{degrees}: {join:?}");
            assert!((join.turn.to_degrees() - degrees).abs() < 0.3, "{degrees}: {}", join.turn);
        }
    }
    for seed in 0..6 {
        let random = &mut Random::new(seed);
        let points: Vec<[f64; 2]> = (-70..50)
            .map(|i| 0.3 * (f64::from(i) + 0.4))
            .map(|s| if s < 0.0 { [s, 0.0] } else { bent(s, 0.0, 0.1) })
            .map(|p| p.map(|x| x + 0.005 * normal(random)))
            .collect();
        assert_eq!(found(&points).joins[0].continuity, Continuity::G1, "{seed}");
    }
}

/// The place after a length from the origin on an arc that starts in a direction.
fn bent(length: f64, heading: f64, curvature: f64) -> [f64; 2] {
    let [x, y] = crate::model::chain::arc_end(length, length * curvature);
    let (sin, cos) = libm::sincos(heading);
    [x * cos - y * sin, x * sin + y * cos]
}
