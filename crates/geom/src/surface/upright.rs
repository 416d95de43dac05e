//! The direction in which a surface has heights where it has none over the least-squares plane of its points.
//!
//! Steep ground that rises to one corner leans over its own plane: seen along the normal of that plane it folds, seen along
//! another direction it does not. It has heights along a direction that no normal of the surface is at right angles to.

use crate::fit::Scatter;
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress};
use crate::space::{Point, Vector, cross, dot, least_axis, minus, plus, times, unit};
use crate::spatial::neighbors::PointTree;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Points among which neighbors are looked for, at most.
const POINTS: usize = 1 << 16;
/// Of those, points whose normal is asked for, at most.
const ASKED: usize = 1 << 12;
/// Points that a normal is found from.
const AROUND: usize = 16;
/// Share of the normals that may stand at a worse angle: at edges and outliers they are those of no surface.
const APART: f64 = 0.02;
/// First angle between directions that are tried, radians.
const COARSE: f64 = 0.1;
/// Times that the angle is halved.
const HALVED: u32 = 8;

/// The direction, to the side of `normal`, for which the least cosine of the angle to a normal of the surface is greatest; 2 % of
/// the normals do not count. Normals are those of planes through 16 neighbors. `None` where no points have a plane.
///
/// Cost: a search among at most 65,536 points, which are every `k`-th.
pub(super) fn direction(
    points: &[Point],
    normal: Vector,
    progress: &dyn Progress,
) -> Result<Option<Vector>, Cancelled> {
    let some: Vec<Point> = points.iter().step_by(points.len().div_ceil(POINTS)).copied().collect();
    let tree = PointTree::new(&some);
    let of = |p: &Point| {
        let around: Vec<Vector> =
            tree.k_nearest(p, AROUND, None).iter().map(|n| minus(some[n.1 as usize], *p)).collect();
        let Scatter { variance, axes, .. } = Scatter::of(&around);
        // Of points on a line every direction across is a normal.
        (variance[1] > 4.0 * variance[0]).then_some(axes[0])
    };
    if progress.cancelled() {
        return Err(Cancelled);
    }
    let asked: Vec<Point> = some.iter().step_by(some.len().div_ceil(ASKED)).copied().collect();
    let normals: Vec<Vector> = asked.par_iter().filter_map(of).collect();
    if normals.is_empty() {
        return Ok(None);
    }
    let Some((u, _)) = unit(cross(normal, least_axis(normal))) else { return Ok(None) };
    let v = cross(normal, u);
    let at = |tilt: f64, turn: f64| {
        let across = plus(times(libm::cos(turn), u), times(libm::sin(turn), v));
        plus(times(libm::cos(tilt), normal), times(libm::sin(tilt), across))
    };
    let rings = (FRAC_PI_2 / COARSE) as usize;
    let ring = |n: usize| {
        let tilt = n as f64 * COARSE;
        let count = ((TAU * libm::sin(tilt) / COARSE).ceil() as usize).max(1);
        (0..count).map(move |k| (tilt, TAU * k as f64 / count as f64))
    };
    let tried: Vec<Vector> = (0..=rings).flat_map(ring).map(|(tilt, turn)| at(tilt, turn)).collect();
    let mut scores: Vec<f64> = tried.par_iter().map(|d| score(&normals, *d)).collect();
    // Of equal ones the first, which is nearest to the normal.
    let first = (0..scores.len()).max_by(|a, b| scores[*a].total_cmp(&scores[*b]).then(b.cmp(a)));
    let Some(first) = first else { return Ok(None) };
    let (mut best, mut most) = (tried[first], scores.swap_remove(first));
    for k in 1..=HALVED {
        if progress.cancelled() {
            return Err(Cancelled);
        }
        let angle = COARSE / f64::from(1u32 << k);
        let Some((x, _)) = unit(cross(best, least_axis(best))) else { break };
        let y = cross(best, x);
        let around = (0..8).filter_map(|n| {
            let turn = TAU * f64::from(n) / 8.0;
            let across = plus(times(libm::cos(turn), x), times(libm::sin(turn), y));
            unit(plus(best, times(angle, across))).map(|(d, _)| d)
        });
        for tried in around.collect::<Vec<_>>() {
            let score = score(&normals, tried);
            if score > most {
                (best, most) = (tried, score);
            }
        }
    }
    Ok(Some(best))
}

/// The cosine of the angle to a normal that all but few have at least.
fn score(normals: &[Vector], direction: Vector) -> f64 {
    let mut cosines: Vec<f64> = normals.iter().map(|n| dot(*n, direction).abs()).collect();
    let at = (APART * cosines.len() as f64) as usize;
    *cosines.select_nth_unstable_by(at, f64::total_cmp).1
}
