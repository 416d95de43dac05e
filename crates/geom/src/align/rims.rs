//! Points at the rims of faces: noise decides which face is closest there, so that they tell of no motion.

use super::AlignError;
use super::field::normal_of;
use super::icp::{Match, Problem};
use crate::closest::{Hit, Query};
use crate::progress::Progress;
use crate::space::{Point, Vector, cross, dot, least_axis, plus, times, unit};

/// Cosine between normals below which two faces meet at a rim.
const RIM_COSINE: f64 = 0.8;
/// Ways from a point in which a rim is looked for.
const RIM_WAYS: usize = 8;
/// Depth below the face where it is looked for, per length of the way: there the adjacent face is closer.
const RIM_DIP: f64 = 0.5;

/// Whether a rim lies within about `reach` of each match.
pub(super) fn at_rims(
    problem: &Problem,
    matches: &[Match],
    reach: f64,
    progress: &dyn Progress,
) -> Result<Vec<bool>, AlignError> {
    let tree = problem.target.tree;
    let mut all = vec![false; matches.len()];
    let mut normals = vec![];
    for way in 0..RIM_WAYS {
        let there: Vec<Point> = matches.iter().map(|m| aside(m, way, reach)).collect();
        let of_hit =
            |i: usize, hit: Option<Hit>| hit.and_then(|hit| normal_of(&tree.foot(&there[i], &hit).corners));
        tree.map_closest_into(&there, &Query::default(), progress, of_hit, &mut normals)?;
        for ((at_rim, m), normal) in all.iter_mut().zip(matches).zip(&normals) {
            *at_rim |= normal.is_none_or(|n| dot(n, m.facet).abs() < RIM_COSINE);
        }
    }
    Ok(all)
}

/// A place beside that of a match along its facet, and a bit below it.
fn aside(m: &Match, way: usize, reach: f64) -> Point {
    let n = m.facet;
    let u = unit(cross(n, least_axis(n))).map_or([0.0; 3], |u| u.0);
    let v: Vector = cross(n, u);
    let angle = std::f64::consts::TAU * way as f64 / RIM_WAYS as f64;
    let along = plus(times(libm::cos(angle), u), times(libm::sin(angle), v));
    plus(m.equation.point, times(reach, plus(along, times(-RIM_DIP, n))))
}
