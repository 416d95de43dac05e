//! Points at the rims of faces: what they hold is not known from the face that is closest, as with another noise it were another one.

use super::AlignError;
use super::freedom::HELD;
use super::icp::{Match, Problem, normal_at};
use super::system::{Spectrum, System};
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::space::{Point, Vector, cross, dot, plus, times, unit};

/// Standard deviations from a rim within which noise decides which face is closest.
const NEAR: f64 = 6.0;
/// Cosine between normals below which faces meet at a rim, and from which on they are taken for faces of one direction.
const BENT: f64 = 0.8;
const ALONG: f64 = 0.95;
/// Directions of faces that are tried: those with the most points at rims.
const MOST: usize = 8;
/// Ways from a point in which a rim is looked for, and how far they dip into the part.
const WAYS: usize = 8;
const DIP: f64 = 0.5;

/// The equations of the facets in which points at rims lie on the other face there, for that direction of faces that leaves the most motions
/// hardly held: a contour at the ends of walls is held by the walls, not by the ends, though with noise half of it lies on these.
pub(super) fn weakest(
    problem: &Problem,
    matches: &[Match],
    (pose, sigma, step): (&Rigid, f64, f64),
    progress: &dyn Progress,
) -> Result<(System, Spectrum), AlignError> {
    let solved = |matches: &[Match]| {
        let system = problem.system_of_facets(matches, pose);
        let spectrum = Spectrum::without(&system, &problem.stays(&system, pose));
        (system, spectrum)
    };
    let own = solved(matches);
    let reach = (NEAR * sigma).max(64.0 * problem.rounding).min(step);
    let beside = beside(problem, matches, reach, progress)?;
    let mut best = (hardly_held(&own), own);
    for face in directions(matches, &beside) {
        let mut others = matches.to_vec();
        for (m, beside) in others.iter_mut().zip(&beside).filter(|(m, _)| dot(m.facet, face).abs() > ALONG) {
            let other = beside.iter().flatten().find(|n| dot(**n, face).abs() <= ALONG);
            m.facet = other.copied().unwrap_or(m.facet);
        }
        let found = solved(&others);
        let count = hardly_held(&found);
        if count > best.0 {
            best = (count, found);
        }
    }
    Ok(best.1)
}

/// How many motions the facets hardly hold.
fn hardly_held((facets, spectrum): &(System, Spectrum)) -> usize {
    spectrum.values[spectrum.stay..].iter().filter(|v| **v < HELD * facets.weight).count()
}

/// Normals of the faces beside that of each match, in some ways from it.
fn beside(
    problem: &Problem,
    matches: &[Match],
    reach: f64,
    progress: &dyn Progress,
) -> Result<Vec<[Option<Vector>; WAYS]>, AlignError> {
    let mut all = vec![[None; WAYS]; matches.len()];
    let counting: Vec<usize> = (0..matches.len()).filter(|&i| matches[i].equation.weight > 0.0).collect();
    for way in 0..WAYS {
        let there: Vec<Point> = counting.iter().map(|&i| aside(&matches[i], way, reach)).collect();
        let normals = normal_at(problem.target, &there, progress)?;
        for (&i, normal) in counting.iter().zip(normals) {
            all[i][way] = normal.filter(|n| dot(*n, matches[i].facet).abs() < BENT);
        }
    }
    Ok(all)
}

/// A place aside from that of a match along its facet, and a bit below it.
fn aside(m: &Match, way: usize, reach: f64) -> Point {
    let n = m.facet;
    let least = (0..3).min_by(|&i, &j| n[i].abs().total_cmp(&n[j].abs())).unwrap_or(0);
    let axis: Vector = std::array::from_fn(|k| f64::from(u8::from(k == least)));
    let u = unit(cross(n, axis)).map_or([0.0; 3], |u| u.0);
    let v = cross(n, u);
    let angle = std::f64::consts::TAU * way as f64 / WAYS as f64;
    let along = plus(times(libm::cos(angle), u), times(libm::sin(angle), v));
    plus(m.equation.point, times(reach, plus(along, times(-DIP, n))))
}

/// Directions of the faces at whose rims enough points lie to hold a motion, the most first.
fn directions(matches: &[Match], beside: &[[Option<Vector>; WAYS]]) -> Vec<Vector> {
    let mut found: Vec<(Vector, f64)> = vec![];
    let mut total = 0.0;
    for (m, beside) in matches.iter().zip(beside) {
        total += m.equation.weight;
        if beside.iter().all(Option::is_none) || m.equation.weight <= 0.0 {
            continue;
        }
        match found.iter_mut().find(|(face, _)| dot(*face, m.facet).abs() > ALONG) {
            Some((_, weight)) => *weight += m.equation.weight,
            None => found.push((m.facet, m.equation.weight)),
        }
    }
    found.retain(|(_, weight)| *weight >= HELD * total);
    found.sort_by(|a, b| b.1.total_cmp(&a.1));
    found.truncate(MOST);
    found.into_iter().map(|f| f.0).collect()
}
