//! Whether points stand on edge on their base. Also the direction in which a surface has heights where it has none over
//! the least-squares plane of its points.
//!
//! A strip whose ripples are larger than its width has the plane of the ripples as its own, and stands on edge on it.
//! So does a ring like a low fence. Over a place of the plane there is then no height, but all those of the strip's
//! width. Steep ground that rises to one corner leans over its own plane. It folds as seen along the normal of that
//! plane, and does not as seen along another direction. It has heights along a direction that no normal of the surface
//! is at right angles to.

use std::f64::consts::{FRAC_PI_2, TAU};
use trueness_geom::fit::Scatter;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Point, Vector, cross, dot, least_axis, minus, plus, times, unit};
use trueness_geom::spatial::neighbors::PointTree;
use trueness_geom::spline::surface::{FootSearch, Surface};

/// Points among which neighbors are looked for, at most.
const MAX_POINTS_FOR_DIRECTION: usize = 1 << 16;
/// Points whose normal is asked for among them, at most.
const MAX_NORMALS_FOR_DIRECTION: usize = 1 << 12;
/// Points that a normal is found from.
const NEIGHBORS_PER_NORMAL: usize = 16;
/// No normal of fewer points can be relied upon.
const MIN_POINTS_WITH_NORMALS: usize = 64;
/// Variance of the places around a point across the line through them, as a share of that along it. Less makes it a
/// line of places.
const MIN_VARIANCE_RATIO: f64 = 0.04;
/// Points that are asked whether they stand on edge, at most.
const MAX_NORMALS_FOR_EDGES: usize = 1 << 10;
/// Points among which their neighbors are looked for, at most.
const MAX_POINTS_FOR_EDGES: usize = 1 << 14;
/// Cosine of the angle between normal and base, 80°, below which a point stands on edge.
const MAX_COSINE_ON_EDGE: f64 = 0.17;
/// Share of the normals that may stand at a worse angle: at edges and outliers they are those of no surface.
const WORSE_NORMALS_SHARE: f64 = 0.02;
/// First angle between directions that are tried, radians.
const FIRST_DIRECTION_ANGLE: f64 = 0.1;
/// Directions that are listed, at most.
const MAX_DIRECTIONS_LISTED: usize = 6;
/// Cosine of the angle between two of them, 20°.
const MAX_COSINE_OF_DIRECTIONS: f64 = 0.94;
/// Times that the angle is halved.
const ANGLE_HALVINGS: u32 = 8;

/// Share of the points whose surface stands on edge on the base, at 80° and more, by the normals of some of them. `up`
/// is the normal of the base at a place. 0 of fewer than 64 points.
///
/// Cost: a search among at most 16,384 points.
pub(super) fn standing(
    points: &[Point],
    up: impl Fn(Point) -> Vector,
    progress: &dyn Progress,
) -> Result<f64, Cancelled> {
    if points.len() < MIN_POINTS_WITH_NORMALS {
        return Ok(0.0);
    }
    let (found, asked_count) = normals(points, [MAX_POINTS_FOR_EDGES, MAX_NORMALS_FOR_EDGES], progress)?;
    let on_edge =
        found.iter().filter(|(place, normal)| dot(up(*place), *normal).abs() < MAX_COSINE_ON_EDGE).count();
    // Among noise wider than the distance of neighbors hardly any have a normal.
    Ok(on_edge as f64 / asked_count as f64)
}

/// Share of the points that stand on edge and that the surface passes by. It has another direction there than they
/// have, by 45° and more. Where it follows a steep wall they stand on edge, and it with them.
///
/// Cost: as of [`standing`], and at most 1,024 nearest places.
pub(super) fn passed_by(
    points: &[Point],
    up: impl Fn(Point) -> Vector,
    surface: &Surface<Point>,
    progress: &dyn Progress,
) -> Result<f64, Cancelled> {
    /// Cosine of the angle between the two from which on it follows them.
    const MIN_FOLLOWING_COSINE: f64 = 0.7;
    let (mut found, asked_count) = normals(points, [MAX_POINTS_FOR_EDGES, MAX_NORMALS_FOR_EDGES], progress)?;
    found.retain(|(place, normal)| dot(up(*place), *normal).abs() < MAX_COSINE_ON_EDGE);
    let search = match FootSearch::new(&[surface.clone().into()], progress) {
        Err(_) if progress.cancelled() => return Err(Cancelled),
        Err(_) => return Ok(found.len() as f64 / asked_count as f64),
        Ok(search) => search,
    };
    let is_missed = |(place, normal): &&(Point, Vector)| {
        search.nearest(place).foot.normal.is_none_or(|n| dot(n, *normal).abs() < MIN_FOLLOWING_COSINE)
    };
    Ok(found.par_iter().filter(is_missed).count() as f64 / asked_count as f64)
}

/// Some of the points and their normals, those of planes through 16 neighbors, and how many were asked. The first
/// number of points is searched at most, and the second one asked.
fn normals(
    points: &[Point],
    [among, most_asked]: [usize; 2],
    progress: &dyn Progress,
) -> Result<(Vec<(Point, Vector)>, usize), Cancelled> {
    let sample: Vec<Point> = points.iter().step_by(points.len().div_ceil(among)).copied().collect();
    let tree = PointTree::new(&sample);
    let of = |p: &Point| {
        let around: Vec<Vector> = tree
            .k_nearest(p, NEIGHBORS_PER_NORMAL, None)
            .iter()
            .map(|n| minus(sample[n.1 as usize], *p))
            .collect();
        let Scatter { variance, axes, .. } = Scatter::of(&around);
        // Every direction across is a normal of points on a line.
        let plane = variance[1] > 4.0 * variance[0] && variance[1] > MIN_VARIANCE_RATIO * variance[2];
        plane.then_some((*p, axes[0]))
    };
    if progress.cancelled() {
        return Err(Cancelled);
    }
    let asked: Vec<Point> = sample.iter().step_by(sample.len().div_ceil(most_asked)).copied().collect();
    Ok((asked.par_iter().filter_map(of).collect(), asked.len()))
}

/// Directions, to the side of `normal`, along which the surface may have heights, the best first. The least cosine of
/// the angle to a normal of the surface is great for them; 2 % of the normals do not count. The first has the greatest,
/// each other one the greatest of those 20° and more from all before. Normals are those of planes through 16 neighbors,
/// and to which side they look is not known. So a direction over which the surface folds with steep sides alone may
/// come before one over which it does not. None where no points have a plane.
///
/// Cost: a search among at most 65,536 points, which are every `k`-th.
pub(super) fn directions(
    points: &[Point],
    normal: Vector,
    progress: &dyn Progress,
) -> Result<Vec<Vector>, Cancelled> {
    let normals: Vec<Vector> =
        normals(points, [MAX_POINTS_FOR_DIRECTION, MAX_NORMALS_FOR_DIRECTION], progress)?
            .0
            .into_iter()
            .map(|(_, normal)| normal)
            .collect();
    let Some((u, _)) = unit(cross(normal, least_axis(normal))).filter(|_| !normals.is_empty()) else {
        return Ok(vec![]);
    };
    let v = cross(normal, u);
    let at = |tilt: f64, turn: f64| {
        let across = plus(times(libm::cos(turn), u), times(libm::sin(turn), v));
        plus(times(libm::cos(tilt), normal), times(libm::sin(tilt), across))
    };
    let rings = (FRAC_PI_2 / FIRST_DIRECTION_ANGLE) as usize;
    let ring = |n: usize| {
        let tilt = n as f64 * FIRST_DIRECTION_ANGLE;
        let count = ((TAU * libm::sin(tilt) / FIRST_DIRECTION_ANGLE).ceil() as usize).max(1);
        (0..count).map(move |k| (tilt, TAU * k as f64 / count as f64))
    };
    let tried: Vec<Vector> = (0..=rings).flat_map(ring).map(|(tilt, turn)| at(tilt, turn)).collect();
    let scores: Vec<f64> = tried.par_iter().map(|d| score(&normals, *d)).collect();
    // The first of equal ones is nearest to the normal.
    let mut by_score: Vec<usize> = (0..scores.len()).collect();
    by_score.sort_by(|a, b| scores[*b].total_cmp(&scores[*a]));
    let mut coarse: Vec<usize> = vec![];
    for k in by_score {
        if coarse.len() < MAX_DIRECTIONS_LISTED
            && coarse.iter().all(|c| dot(tried[*c], tried[k]).abs() < MAX_COSINE_OF_DIRECTIONS)
        {
            coarse.push(k);
        }
    }
    if progress.cancelled() {
        return Err(Cancelled);
    }
    Ok(coarse.par_iter().map(|k| climbed(&normals, tried[*k], scores[*k])).collect())
}

/// The direction near this one of the greatest score.
fn climbed(normals: &[Vector], mut best: Vector, mut most: f64) -> Vector {
    for k in 1..=ANGLE_HALVINGS {
        let angle = FIRST_DIRECTION_ANGLE / f64::from(1u32 << k);
        let Some((x, _)) = unit(cross(best, least_axis(best))) else { break };
        let y = cross(best, x);
        let around = (0..8).filter_map(|n| {
            let turn = TAU * f64::from(n) / 8.0;
            let across = plus(times(libm::cos(turn), x), times(libm::sin(turn), y));
            unit(plus(best, times(angle, across))).map(|(d, _)| d)
        });
        for tried in around.collect::<Vec<_>>() {
            let score = score(normals, tried);
            if score > most {
                (best, most) = (tried, score);
            }
        }
    }
    best
}

/// The cosine of the angle to a normal that all but few have at least.
fn score(normals: &[Vector], direction: Vector) -> f64 {
    let mut cosines: Vec<f64> = normals.iter().map(|n| dot(*n, direction).abs()).collect();
    let at = (WORSE_NORMALS_SHARE * cosines.len() as f64) as usize;
    *cosines.select_nth_unstable_by(at, f64::total_cmp).1
}
