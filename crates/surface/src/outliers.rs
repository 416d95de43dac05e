//! Points that contradict their neighbors.
//!
//! A point that a surface of few knots passes by is the part's own shape as often as an outlier. So the neighbors of a
//! point judge it. The heights of the 24 nearest places tell a plane by least median of squares (Rousseeuw 1984), and
//! the noise around it. A point far off that plane contradicts them, unless a quarter of them lie as it does. A step or
//! an edge has points on both sides.

use super::{Base, BaseKind};
use trueness_geom::fit::Scatter;
use trueness_geom::num::median::median;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Point, dot, minus};
use trueness_geom::spatial::neighbors::PointTree;

/// Neighbors that are asked.
const NEIGHBORS_ASKED: usize = 24;
/// Fewer neighbors are not believed.
const MIN_NEIGHBORS: usize = 12;
/// Planes through three of them that are tried. All planes through 24 neighbors with a third of outliers fail in one of
/// 300 cases.
const TRIAL_PLANES: usize = 16;
/// From the median of the sizes to a standard deviation, with the factor for so few of them (Rousseeuw and Leroy 1987).
const SIGMA_PER_MEDIAN: f64 = 1.4826 * (1.0 + 5.0 / (NEIGHBORS_ASKED - 3) as f64);
/// Standard deviations from the first plane within which a neighbor tells the second.
const NEAR_PLANE_SIGMAS: f64 = 2.5;
/// Standard deviations from which on a point contradicts. At the rim of a curved neighborhood the plane itself is two
/// to three off.
const CONTRADICTING_SIGMAS: f64 = 6.0;
/// Neighbors that lie off the plane as the point does, within a quarter of its distance, from which on it is no outlier.
const MIN_NEIGHBORS_ALIKE: usize = 6;
/// The point lies apart from its neighbors where the square of the nearest one's distance is more than this share of the farthest
/// one's.
const APART_SQUARE_RATIO: f64 = 0.8;
/// Neighbors narrower than this share of their length are those of one row of a scanner. Only the heights along it
/// count: where the row leans, noise moves points across it.
const ROW_WIDTH_RATIO: f64 = 0.2;
/// Slope of the steepest plane: a row of a scanner lies in a plane on edge, with all its outliers.
const MAX_SLOPE: f64 = 2.0;
/// Share of the size of the numbers below which a difference is rounding.
const ROUNDING_SHARE: f64 = 1e-12;
/// Points between two questions whether to stop.
const POINTS_PER_JUDGING: usize = 1024;

/// The judgment of a point by its neighbors.
struct Judgment {
    /// Its distance from their plane.
    off: f64,
    /// Their standard deviation.
    spread: f64,
    /// Neighbors that lie as it does.
    alike: usize,
}

/// The points that contradict their neighbors by their heights over the base, in ascending order; `places` are theirs over it.
///
/// A dense group of outliers, from a quarter of the neighbors on, is not told from a shape of the part. Fewer than 13
/// places have no outlier. Cost: a search for neighbors and sixteen planes for each point.
pub(super) fn outliers(
    points: &[Point],
    base: &Base,
    places: &[[f64; 2]],
    progress: &dyn Progress,
) -> Result<Vec<u32>, Cancelled> {
    let own = distinct(places);
    let tree = PointTree::new(&own.iter().map(|i| flat(places[*i as usize])).collect::<Vec<_>>());
    let judge = |i: usize| {
        let mut near = tree.k_nearest(&flat(places[i]), NEIGHBORS_ASKED + 1, None);
        near.retain(|(square, _)| *square > 0.0);
        near.truncate(NEIGHBORS_ASKED);
        // Neighbors that lie apart do not know how the surface goes on to here.
        if near.first()?.0 > APART_SQUARE_RATIO * near.last()?.0 {
            return None;
        }
        let around: Vec<usize> = near.iter().map(|(_, n)| own[*n as usize] as usize).collect();
        let up = match base.kind {
            BaseKind::Mesh => Scatter::of(&around.iter().map(|n| points[*n]).collect::<Vec<_>>()).axes[0],
            _ => base.up(points[i]),
        };
        let from = |n: &usize| {
            let [u, v] = [0, 1].map(|k| places[*n][k] - places[i][k]);
            [u, v, dot(minus(points[*n], points[i]), up)]
        };
        judged(&around.iter().map(from).collect::<Vec<_>>())
    };
    let indices: Vec<usize> = (0..places.len()).collect();
    let chunk = |part: &[usize]| {
        if progress.cancelled() {
            Err(Cancelled)
        } else {
            Ok(part.iter().map(|i| judge(*i)).collect::<Vec<_>>())
        }
    };
    let found: Result<Vec<Vec<Option<Judgment>>>, Cancelled> =
        indices.par_chunks(POINTS_PER_JUDGING).map(chunk).collect();
    let found: Vec<Option<Judgment>> = found?.into_iter().flatten().collect();
    let mut spreads: Vec<f64> = found.iter().flatten().map(|judged| judged.spread).collect();
    let Some(usual) = median(&mut spreads) else { return Ok(vec![]) };
    let largest = points.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
    let contradicts = |judged: &Judgment| {
        let least = (CONTRADICTING_SIGMAS * judged.spread.max(usual)).max(ROUNDING_SHARE * largest);
        judged.alike < MIN_NEIGHBORS_ALIKE && judged.off.abs() > least
    };
    let far = (0u32..).zip(&found).filter(|(_, judged)| judged.as_ref().is_some_and(contradicts));
    Ok(far.map(|(i, _)| i).collect())
}

/// All but those with these numbers, which ascend.
pub(super) fn others<T: Copy>(all: &[T], out: &[u32]) -> Vec<T> {
    let mut out = out.iter().peekable();
    (0u32..).zip(all).filter(|(i, _)| out.next_if_eq(&i).is_none()).map(|(_, one)| *one).collect()
}

fn flat([u, v]: [f64; 2]) -> Point {
    [u, v, 0.0]
}

/// The first point at each place: many at one place would all be asked for each other.
fn distinct(parameters: &[[f64; 2]]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..parameters.len() as u32).collect();
    let place = |i: &u32| parameters[*i as usize];
    order.sort_by(|a, b| {
        let (p, q) = (place(a), place(b));
        p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])).then(a.cmp(b))
    });
    order.dedup_by(|a, b| place(a) == place(b));
    order
}

/// The judgment of the point at the origin by its neighbors, which are seen from it; `None` where they are too few.
fn judged(around: &[[f64; 3]]) -> Option<Judgment> {
    let count = around.len();
    if count < MIN_NEIGHBORS {
        return None;
    }
    let around = along_row(around);
    let sizes = |plane: &[f64; 3]| around.iter().map(|n| off(plane, n).abs()).collect::<Vec<f64>>();
    let median = |plane: &[f64; 3]| -> f64 {
        let mut sizes = sizes(plane);
        *sizes.select_nth_unstable_by(count / 2, f64::total_cmp).1
    };
    // Three that stand apart in the order of their distances, always others.
    let trial = |t: usize| {
        let [a, b, c] = [t, t + 8 + t / 3, t + 16 + t / 5].map(|k| around[k % count]);
        through([a, b, c])
    };
    let is_flat = |[a, b, _]: &[f64; 3]| libm::hypot(*a, *b) <= MAX_SLOPE;
    let first = (0..TRIAL_PLANES)
        .map(trial)
        .filter(is_flat)
        .map(|plane| (median(&plane), plane))
        .fold((f64::INFINITY, [0.0; 3]), |best, next| if next.0 < best.0 { next } else { best });
    if first.0 == f64::INFINITY {
        return None;
    }
    let near = NEAR_PLANE_SIGMAS * SIGMA_PER_MEDIAN * first.0;
    let held: Vec<[f64; 3]> = around.iter().copied().filter(|n| off(&first.1, n).abs() <= near).collect();
    let plane = least_squares(&held).filter(is_flat).unwrap_or(first.1);
    let square: f64 = held.iter().map(|n| off(&plane, n)).map(|d| d * d).sum();
    let spread = (square / (held.len() as f64 - 3.0).max(1.0)).sqrt();
    let own = -plane[2];
    let alike = around.iter().filter(|n| (off(&plane, n) - own).abs() <= own.abs() / 4.0).count();
    Some(Judgment { off: own, spread, alike })
}

/// How far a neighbor is above the plane `a u + b v + c`.
fn off([a, b, c]: &[f64; 3], [u, v, height]: &[f64; 3]) -> f64 {
    height - (a * u + b * v + c)
}

/// The plane through three places; where they stand nearly on a line, the one that is level across it.
fn through([p, q, r]: [[f64; 3]; 3]) -> [f64; 3] {
    /// Sine of the angle of two sides below which they are one line.
    const MIN_SINE_OF_SIDES: f64 = 0.1;
    let (d, e) = (minus(q, p), minus(r, p));
    let det = d[0] * e[1] - d[1] * e[0];
    let [dd, ee] = [d, e].map(|x| x[0] * x[0] + x[1] * x[1]);
    let [a, b] = if det.abs() > MIN_SINE_OF_SIDES * (dd * ee).sqrt() {
        [(d[2] * e[1] - d[1] * e[2]) / det, (d[0] * e[2] - d[2] * e[0]) / det]
    } else {
        let (long, square) = if dd > ee { (d, dd) } else { (e, ee) };
        let slope = if square > 0.0 { long[2] / square } else { 0.0 };
        [slope * long[0], slope * long[1]]
    };
    [a, b, p[2] - a * p[0] - b * p[1]]
}

/// The same places; those of one row with their length along it as the first coordinate, and the second 0.
fn along_row(around: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mean = [0, 1].map(|k| around.iter().map(|p| p[k]).sum::<f64>() / around.len() as f64);
    let moment = |i: usize, k: usize| around.iter().map(|p| (p[i] - mean[i]) * (p[k] - mean[k])).sum::<f64>();
    let angle = 0.5 * libm::atan2(2.0 * moment(0, 1), moment(0, 0) - moment(1, 1));
    let (s, c) = (libm::sin(angle), libm::cos(angle));
    let median = |of: &dyn Fn([f64; 2]) -> f64| {
        let mut sizes: Vec<f64> = around.iter().map(|p| of([p[0] - mean[0], p[1] - mean[1]]).abs()).collect();
        *sizes.select_nth_unstable_by(around.len() / 2, f64::total_cmp).1
    };
    if median(&|[u, v]| c * v - s * u) < ROW_WIDTH_RATIO * median(&|[u, v]| c * u + s * v) {
        around.iter().map(|[u, v, height]| [c * u + s * v, 0.0, *height]).collect()
    } else {
        around.to_vec()
    }
}

/// The plane of least squares, level across places on a line; `None` of places that are all the same.
fn least_squares(places: &[[f64; 3]]) -> Option<[f64; 3]> {
    /// Square of the ratio of the widths below which the places stand on one line.
    const MIN_SQUARE_WIDTH_RATIO: f64 = 1e-3;
    let n = places.len() as f64;
    let mean = [0, 1, 2].map(|k| places.iter().map(|p| p[k]).sum::<f64>() / n);
    let moment = |i: usize, k: usize| places.iter().map(|p| (p[i] - mean[i]) * (p[k] - mean[k])).sum::<f64>();
    let [uu, uv, vv, uh, vh] = [moment(0, 0), moment(0, 1), moment(1, 1), moment(0, 2), moment(1, 2)];
    let det = uu * vv - uv * uv;
    let [a, b] = if det > MIN_SQUARE_WIDTH_RATIO * (uu + vv) * (uu + vv) {
        [(uh * vv - vh * uv) / det, (vh * uu - uh * uv) / det]
    } else if uu + vv > 0.0 {
        // On a line heights are moments along it, shared out.
        [uh / (uu + vv), vh / (uu + vv)]
    } else {
        return None;
    };
    Some([a, b, mean[2] - a * mean[0] - b * mean[1]])
}
