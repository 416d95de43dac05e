//! Rows that are polygons, exactly.

use super::clean::Clean;
use crate::model::chain::SegmentKind;
use crate::model::flat::angle;
use crate::search::partition::{Penalty, partition};
use crate::search::parts::{Part, scatter};

/// Points on a line, at least: two are on one by themselves.
pub(super) const MIN_POINTS_PER_LINE: usize = 3;
/// Parts that turn by less from one to the next are parts of a curve, radians.
pub(super) const MIN_CORNER_TURN: f64 = 0.12;

/// The sides of a polygon whose points lie on them exactly, to the noise of the penalty, three on each at least. Also
/// where the row is turned to, so that it begins with a side. Where sides are short, each local fit of the noise holds
/// a corner and takes it for noise.
pub(super) fn polygon(clean: &Clean, penalty: &Penalty) -> Option<(usize, Vec<Part>)> {
    let (n, mut points) = (clean.points.len(), clean.points.clone());
    let weights = vec![1.0; n];
    let sharp = |i: usize| {
        let [a, b, c] = [i + n - 1, i, i + 1].map(|k| clean.points[k % n]);
        angle([b[0] - a[0], b[1] - a[1]], [c[0] - b[0], c[1] - b[1]]).abs()
    };
    let by = if clean.closed { (0..n).max_by(|i, j| sharp(*i).total_cmp(&sharp(*j)))? } else { 0 };
    points.rotate_left(by);
    let parts = partition(&points, &weights, &Penalty { fewest: MIN_POINTS_PER_LINE, ..*penalty });
    let sides = parts.iter().all(|p| p.kind == SegmentKind::Line && p.to - p.from >= MIN_POINTS_PER_LINE);
    let last = if clean.closed { parts.len() } else { parts.len() - 1 };
    let corners =
        (0..last).all(|k| angle(parts[k].along, parts[(k + 1) % parts.len()].along).abs() > MIN_CORNER_TURN);
    let exact = scatter(&points, &weights, &parts) <= penalty.noise;
    (parts.len() > 1 && sides && corners && exact).then_some((by, parts))
}
