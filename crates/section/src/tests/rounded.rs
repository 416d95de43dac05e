//! Rows whose coordinates are rounded, as files hold them.

use super::*;

/// A rectangle of 30 by 20 mm with corners of radius 4, turned by `turn`, in points about `spacing` apart.
fn rectangle(spacing: f64, turn: f64) -> Vec<[f64; 2]> {
    let (w, h, r) = (15.0_f64, 10.0_f64, 4.0);
    let half = std::f64::consts::FRAC_PI_2;
    let mut all = vec![];
    for (k, [x, y]) in [[w, -h], [w, h], [-w, h], [-w, -h]].into_iter().enumerate() {
        // The corner, then the side that follows it.
        let center = [x - r * x.signum(), y - r * y.signum()];
        let start = half * (k as f64 - 1.0);
        let count = (half * r / spacing) as usize;
        for i in 0..count {
            let (sin, cos) = libm::sincos(start + half * (i as f64 + 0.5) / count as f64);
            all.push([center[0] + r * cos, center[1] + r * sin]);
        }
        let (sin, cos) = libm::sincos(start + half);
        let (from, along) = ([center[0] + r * cos, center[1] + r * sin], [-sin, cos]);
        let length = 2.0 * if k % 2 == 0 { h - r } else { w - r };
        let count = (length / spacing) as usize;
        for i in 0..count {
            let s = length * (i as f64 + 0.5) / count as f64;
            all.push([from[0] + s * along[0], from[1] + s * along[1]]);
        }
    }
    let (sin, cos) = libm::sincos(turn);
    all.iter().map(|[x, y]| [cos * x - sin * y + 3.3, sin * x + cos * y - 7.1]).collect()
}

/// Exact lines and arcs whose coordinates are rounded are lines and arcs with tangent joins, whatever the digits. That
/// holds along the axes (where lines are rounded by nothing) and across them.
#[test]
fn rounded_lines_and_arcs_are_these() {
    for spacing in [0.5, 0.1] {
        for turn in [0.0, 0.3] {
            for step in [1e-2, 1e-3, 1e-4, 1e-5] {
                let rounded = |x: f64| (x / step).round() * step;
                let points: Vec<[f64; 2]> = rectangle(spacing, turn).iter().map(|p| p.map(rounded)).collect();
                let found = found(&points);
                let what = format!("{spacing} {turn} {step}: {:?}", kinds(&found));
                assert_eq!(found.segments.len(), 8, "{what}");
                assert!(found.joins.iter().all(|j| j.continuity == Continuity::G1), "{what}");
                let arcs = kinds(&found).iter().filter(|k| **k == SegmentKind::Arc).count();
                assert_eq!(arcs, 4, "{what}");
            }
        }
    }
}

/// Lines are lines whatever the step that their coordinates are rounded to. Some points of theirs lie on a line
/// exactly, and all about them with a period.
#[test]
fn rounded_lines_run_along_their_points() {
    for step in [0.01, 0.025] {
        for k in 0..15 {
            let angle = 0.4 * f64::from(k);
            let at = |s: f64, turn: f64| {
                let (sin, cos) = libm::sincos(angle + turn);
                [s * cos, s * sin]
            };
            let points: Vec<[f64; 2]> = (-40..40)
                .map(|i| 0.5 * (f64::from(i) + 0.5))
                .map(|s| if s < 0.0 { at(s, 0.0) } else { at(s, 0.6) })
                .map(|p| p.map(|x| step * (x / step).round()))
                .collect();
            let found = found(&points);
            assert_eq!(kinds(&found), [SegmentKind::Line; 2], "{step} {k}");
            assert!(found.unreliable.is_empty(), "{step} {k}: {}", found.noise);
        }
    }
}
