//! Starts for cones of any half angle, from nearly cylinders to nearly planes, and of any pattern of points.
//!
//! Proposers give axes, each axis its best cone in closed form, one comparison by the true distances chooses:
//! 1. **All around.** Directions over the half sphere, evenly spread, and as evenly in the coordinates in which the points
//!    spread alike or inversely. The valley of a flat cone's axis is as narrow as the cone is flat, that of a long thin one as
//!    it is thin. Where the axis lies follows from the moments of the points ([`Powers`]).
//! 2. **From within.** A patch looks like a cylinder. Its curvature across the generators tells how the cone's half angle goes
//!    with the distance of its apex, on either side. So all distances are tried, from half the patch to the cylinder.
//! 3. **From a tip.** All directions from the apex to points lie on a circle of the unit sphere, so its plane has the axis. Points at
//!    the ends of the principal directions are tried as apexes: exact where one of them is.
//!
//! About an axis a cone is a straight line through distance over height, by orthogonal least squares.

use super::family::{Element, Family};
use super::gauss::{Effort, minimize};
use super::normal::Alike;
use super::revolution::{Powers, Profile, directions};
use super::round::least_squares;
use super::sample::Sample;
use super::scatter::Scatter;
use crate::frame::Pose;
use crate::space::{Point, Vector, dot, minus, plus, times, unit};
use std::borrow::Cow;

/// Points that cones are compared by.
const CONE_JUDGES: usize = 128;
/// Cones that are improved by a few steps.
const MAX_IMPROVED_CONES: usize = 24;
/// Improved cones that are starts.
const MAX_CONE_STARTS: usize = 6;
const FEW_STEPS: Effort = Effort { steps: 8, enough: 1e-3 };
/// Distances of the apex from the middle of a patch, in halves of its length: near, far, and nowhere.
const APEX_DISTANCES: [f64; 8] = [0.5, 1.0, 1.5, 2.5, 5.0, 12.0, 40.0, f64::INFINITY];

/// Cones near which the best one is to be sought.
pub(super) fn cones<F: Family<6>>(points: &[Point]) -> Vec<Element> {
    let scatter = Scatter::of(points);
    let judging = judges(points, &scatter);
    let cones = |poses: Vec<Pose>| -> Vec<(f64, Element)> {
        poses.iter().map(|pose| cone_about::<F>(pose, &judging)).collect()
    };
    let mut first = best(cones(all_around(points, &scatter)), MAX_IMPROVED_CONES);
    first.extend(best(cones(from_within(points, &scatter)), MAX_IMPROVED_CONES));
    first.extend(best(cones(from_tips(points, &scatter)), MAX_IMPROVED_CONES));
    let sample = Sample { points: Cow::Borrowed(&judging), center: [0.0; 3], scale: 1.0, station: [0.0; 3] };
    let improved = first.iter().filter_map(|start| {
        let end = minimize::<6, F, _>(start, &sample, &Alike, FEW_STEPS)?;
        Some((end.sums.square, end.element))
    });
    let starts = best(improved.collect(), MAX_CONE_STARTS);
    starts.into_iter().map(|cone| F::settled(refooted(cone, [0.0; 3]))).collect()
}

/// Some of the points, and those at the ends of each principal direction: the tip of a cone may be a single point.
fn judges(points: &[Point], scatter: &Scatter) -> Vec<Point> {
    let mut judging: Vec<Point> =
        points.iter().copied().step_by(points.len().div_ceil(CONE_JUDGES).max(1)).collect();
    if judging.len() < points.len() {
        judging.extend(ends(points, scatter));
    }
    judging
}

/// The points at the ends of each principal direction.
fn ends(points: &[Point], scatter: &Scatter) -> Vec<Point> {
    let each = scatter.axes.into_iter().flat_map(|axis| {
        let along = move |p: &&Point, q: &&Point| dot(**p, axis).total_cmp(&dot(**q, axis));
        [points.iter().min_by(along), points.iter().max_by(along)]
    });
    each.flatten().copied().collect()
}

/// Axes of the cones with their apex at an end.
fn from_tips(points: &[Point], scatter: &Scatter) -> Vec<Pose> {
    ends(points, scatter).into_iter().map(|tip| from_tip(tip, points)).collect()
}

/// The axis of the cone with its apex there.
fn from_tip(tip: Point, points: &[Point]) -> Pose {
    let ways: Vec<Vector> = points.iter().filter_map(|&p| Some(unit(minus(p, tip))?.0)).collect();
    Pose::along(tip, Scatter::of(&ways).axes[0])
}

/// The cone with its apex near `tip`.
pub(super) fn with_apex<F: Family<6>>(tip: Point, points: &[Point]) -> Element {
    F::settled(refooted(cone_about::<F>(&from_tip(tip, points), points).1, [0.0; 3]))
}

/// The `count` best.
fn best(mut all: Vec<(f64, Element)>, count: usize) -> Vec<Element> {
    all.retain(|cone| cone.0.is_finite());
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all.into_iter().take(count).map(|cone| cone.1).collect()
}

/// The same cone with its origin at the foot of `place`.
pub(super) fn refooted(element: Element, place: Point) -> Element {
    let height = element.pose.local(place)[2];
    let mut moved = element.footed(place);
    moved.size[0] += height * libm::sin(element.size[1]);
    moved
}

/// The best cone about the third axis of a frame, and the sum of the squared distances.
fn cone_about<F: Family<6>>(pose: &Pose, points: &[Point]) -> (f64, Element) {
    let section: Vec<[f64; 2]> = (points.iter())
        .map(|&p| {
            let [x, y, z] = pose.local(p);
            [(x * x + y * y).sqrt(), z]
        })
        .collect();
    let share = 1.0 / section.len() as f64;
    let mean: [f64; 2] = std::array::from_fn(|k| share * section.iter().map(|s| s[k]).sum::<f64>());
    let (mut rr, mut rz, mut zz) = (0.0, 0.0, 0.0);
    for s in &section {
        let [r, z] = [s[0] - mean[0], s[1] - mean[1]];
        (rr, rz, zz) = (rr + r * r, rz + r * z, zz + z * z);
    }
    // The line along (sin, cos) of the angle makes Σ (r cos − z sin)² least.
    let angle = 0.5 * libm::atan2(2.0 * rz, zz - rr);
    let (sin, cos) = libm::sincos(angle);
    let element = Element { pose: *pose, size: [mean[0] * cos - mean[1] * sin, angle] };
    let square = points.iter().map(|&p| F::distance(element.size, pose.local(p)).powi(2)).sum();
    (square, element)
}

/// Axes in directions all around, in three measures of direction.
fn all_around(points: &[Point], scatter: &Scatter) -> Vec<Pose> {
    let powers = Powers::of(points);
    let spread = scatter.variance.map(|v| v.max(1e-14 * scatter.variance[2]).sqrt());
    let measures = [[1.0; 3], spread, spread.map(|s| 1.0 / s)];
    let ways = measures.into_iter().flat_map(|measure| {
        let along = move |g: Vector| {
            (0..3).fold([0.0; 3], |sum, k| plus(sum, times(g[k] * measure[k], scatter.axes[k])))
        };
        directions().map(along)
    });
    let ways: Vec<Vector> = scatter.axes.into_iter().chain(ways).collect();
    let profiles = [Profile::Opening, Profile::Constant];
    let axes = profiles.into_iter().flat_map(|profile| {
        let powers = &powers;
        ways.iter().filter_map(move |w| powers.axis(Pose::along(scatter.mean, *w).axes, profile))
    });
    axes.map(|axis| axis.pose).filter(|pose| pose.origin.iter().all(|x| x.is_finite())).collect()
}

/// Axes of the cones that touch the patch of points with its curvature, their apex at several distances on either side.
fn from_within(points: &[Point], scatter: &Scatter) -> Vec<Pose> {
    let [w, u, v] = scatter.axes;
    let local: Vec<Point> = (points.iter())
        .map(|&p| {
            let q = minus(p, scatter.mean);
            [dot(u, q), dot(v, q), dot(w, q)]
        })
        .collect();
    let rows = local.iter().map(|[x, y, z]| (vec![1.0, *x, *y, 0.5 * x * x, x * y, 0.5 * y * y], *z));
    let Some(c) = least_squares(rows) else { return vec![] };
    // Least and greatest curvature; the generators go along the one of lesser magnitude.
    let (middle, half) = (0.5 * (c[3] + c[5]), libm::hypot(0.5 * (c[3] - c[5]), c[4]));
    let (sin, cos) = libm::sincos(0.5 * libm::atan2(2.0 * c[4], c[3] - c[5]));
    let (curvature, [a, b]) =
        if middle < 0.0 { (middle - half, [cos, sin]) } else { (middle + half, [-sin, cos]) };
    let along = plus(times(a, u), times(b, v));
    let length =
        (local.iter().map(|[x, y, _]| (a * x + b * y).powi(2)).sum::<f64>() / local.len() as f64).sqrt();
    let slope = plus(times(c[1], u), times(c[2], v));
    let toward = unit(times(curvature.signum(), minus(w, slope)));
    let foot = plus(scatter.mean, times(c[0], w));
    let radius = 1.0 / curvature.abs();
    let Some((toward, _)) = toward.filter(|_| radius.is_finite()) else { return vec![] };
    let generator = minus(along, times(dot(along, toward), toward));
    let mut poses = vec![];
    for far in APEX_DISTANCES {
        for side in [1.0, -1.0] {
            // tan of the half angle: the radius of curvature over the distance of the apex.
            let angle = libm::atan2(radius, 2.0 * far * length);
            let (sin, cos) = libm::sincos(angle);
            // From the patch the axis lies toward the center, leaning away from the apex.
            let axis = plus(times(side * cos, generator), times(sin, toward));
            let place = plus(foot, times(radius, toward));
            poses.push(Pose::along(place, axis));
        }
    }
    poses
}
