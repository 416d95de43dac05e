//! Corners: where two chains cross.

use crate::model::chain::{Pose, SegmentKind};
use crate::model::result::{Continuity, Join};
use crate::search::span::Found;

/// A corner lies no farther from where its points end than this share of the farthest, beyond its uncertainty.
const MAX_GAP_SHARE: f64 = 0.25;

/// Or so many times the mean distance between the points of the line that runs there: a cut of large facets has few.
const MAX_GAP_LOCAL_SPACINGS: f64 = 5.0;

/// A corner takes less than this share of the way along a segment's points: the other end may take as much.
const MAX_SHORTENING_SHARE: f64 = 0.45;

/// A way from the end of a side's points is none that is so small a share of the gap between both sides.
const ZERO_WAY_SHARE: f64 = 0.05;

/// The way to a corner and back is passed over that is so many times as long as that from point to point.
const MIN_DETOUR_RATIO: f64 = 2.0;
/// Such a way is also so many times as long as the steps between the points before it: points would lie on it.
const MIN_DETOUR_STEPS: f64 = 1.5;

/// The corner between two chains: where they cross, each going on as its end does. Where they cross in a wide gap of the points its interval
/// is the gap. Where they cross nowhere near, it is the middle between where the points end.
pub(super) fn crossing(a: &Found, b: &Found, quantile: f64, farthest: f64) -> Join {
    let feet = [a.beyond(true, a.last_foot()), b.beyond(false, b.first_foot())].map(|pose| pose.at);
    let width = libm::hypot(feet[1][0] - feet[0][0], feet[1][1] - feet[0][1]);
    let is_wide = width > MAX_GAP_SHARE * farthest;
    let farthest = farthest.max(width);
    let (mut u, mut v) = (0.0, 0.0);
    let (mut p, mut q) = (a.beyond(true, 0.0), b.beyond(false, 0.0));
    for _ in 0..30 {
        let d = [q.at[0] - p.at[0], q.at[1] - p.at[1]];
        let det = p.along[0] * -q.along[1] + p.along[1] * q.along[0];
        if det.abs() < 1e-9 {
            break;
        }
        let du = (d[0] * -q.along[1] + d[1] * q.along[0]) / det;
        let dv = (p.along[0] * d[1] - p.along[1] * d[0]) / det;
        u = (u + du).clamp(-farthest, farthest);
        v = (v + dv).clamp(-farthest, farthest);
        (p, q) = (a.beyond(true, u), b.beyond(false, v));
        if du.abs() + dv.abs() < 1e-13 * farthest {
            break;
        }
    }
    let point = [0.5 * (p.at[0] + q.at[0]), 0.5 * (p.at[1] + q.at[1])];
    let turn = libm::atan2(
        p.along[0] * q.along[1] - p.along[1] * q.along[0],
        p.along[0] * q.along[0] + p.along[1] * q.along[1],
    );
    let across = |f: &Found, end: usize| f.spread.as_ref().map_or(f.noise, |s| s.ends[end] * f.noise);
    let (direction, uncertainty) = ellipse(&p, &q, across(a, 1), across(b, 0));
    // Two parts that head nearly the same way do not tell where they cross, by more than the shorter of the two segments is long.
    let most =
        [a.pieces().last(), b.pieces().first()].iter().flatten().fold(farthest, |m, p| m.min(p.length));
    let reach = quantile * uncertainty;
    // Where the points end, the corner is. No segment may lose so much that no length is left at its other end. Where
    // few points lie on a line it goes on as far; an arc or a free curve does not tell as much.
    let near = |f: &Found, at_end: bool| {
        let local = if f.end_kind(at_end) == SegmentKind::Line {
            MAX_GAP_LOCAL_SPACINGS * f.local_spacing(at_end)
        } else {
            0.0
        };
        (MAX_GAP_SHARE * farthest).max(local) + 3.0 * uncertainty.min(farthest)
    };
    let (near_a, near_b) = (near(a, true), near(b, false));
    let (beyond, within) = (u - a.last_foot(), v - b.first_foot());
    // A corner where the points of the one side end is told by these, however wide the gap to the points of the other is.
    let ends_there = |way: f64, f: &Found| {
        is_wide && way.abs() <= (3.0 * libm::hypot(uncertainty, f.noise)).min(ZERO_WAY_SHARE * width)
    };
    let far = |way: f64, near: f64, other: bool| way.abs() > near && !other;
    let is_far = far(beyond, near_a, ends_there(within, b)) || far(within, near_b, ends_there(beyond, a));
    let eaten =
        -beyond > MAX_SHORTENING_SHARE * a.extent(true) || within > MAX_SHORTENING_SHARE * b.extent(false);
    // Both go on to meet within a gap of the points: that is where they were drawn to, but nothing tells.
    let free = [a.end_kind(true), b.end_kind(false)].contains(&SegmentKind::Spline);
    let slack = MAX_GAP_SHARE * farthest;
    let gap = !free && beyond.min(-within) >= -slack && beyond.max(-within) <= width + slack;
    // Points as close as these are would lie on the way to a corner far beyond both ends.
    let way = if beyond.min(-within) > 0.0 { beyond - within } else { 0.0 };
    let passed = way > MIN_DETOUR_RATIO * width
        && way > MIN_DETOUR_STEPS * a.last_step(true).max(b.last_step(false)).max(3.0 * uncertainty);
    if reach > most || eaten || passed || is_far {
        let hidden = between(feet, turn, uncertainty.min(most));
        return if gap && !passed && reach <= most { Join { point, ..hidden } } else { hidden };
    }
    let end = |sign: f64| [point[0] + sign * reach * direction[0], point[1] + sign * reach * direction[1]];
    Join {
        point,
        continuity: Continuity::G0,
        interval: [end(-1.0), end(1.0)],
        uncertainty,
        open: [false; 2],
        turn,
    }
}

/// The corner of two chains that do not cross where their points end. It lies anywhere between the last point of the
/// one and the first of the other.
fn between(feet: [[f64; 2]; 2], turn: f64, uncertainty: f64) -> Join {
    let width = libm::hypot(feet[1][0] - feet[0][0], feet[1][1] - feet[0][1]);
    Join {
        point: [0, 1].map(|k| 0.5 * (feet[0][k] + feet[1][k])),
        continuity: Continuity::G0,
        interval: feet,
        uncertainty: uncertainty.max(width * (1.0 / 12.0_f64).sqrt()),
        open: [true; 2],
        turn,
    }
}

/// Direction and standard deviation of the greatest uncertainty of the crossing of two lines that are each uncertain across. Parallels may
/// cross anywhere along them.
fn ellipse(p: &Pose, q: &Pose, a: f64, b: f64) -> ([f64; 2], f64) {
    let (n, m) = (p.normal(), q.normal());
    let det = n[0] * m[1] - n[1] * m[0];
    if det == 0.0 {
        return (p.along, f64::INFINITY);
    }
    // Moving the one line by 1 moves the crossing along the other.
    let (x, y) = ([m[1] / det, -m[0] / det], [-n[1] / det, n[0] / det]);
    let entry = |i: usize, j: usize| a * a * x[i] * x[j] + b * b * y[i] * y[j];
    let (xx, xy, yy) = (entry(0, 0), entry(0, 1), entry(1, 1));
    let half = 0.5 * (xx - yy);
    let greatest = 0.5 * (xx + yy) + (half * half + xy * xy).sqrt();
    let angle = 0.5 * libm::atan2(2.0 * xy, xx - yy);
    let (sin, cos) = libm::sincos(angle);
    ([cos, sin], greatest.max(0.0).sqrt())
}
