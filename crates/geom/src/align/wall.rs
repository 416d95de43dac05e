//! The other side of a wall: points without normals that lie on one face of a plate lie on the opposite face as well.

use super::AlignError;
use super::icp::Problem;
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::space::{Vector, minus, norm, plus, times};

/// Samples whose way through the material is looked at.
const WALL_SAMPLES: usize = 64;
/// Share of them that must have the same way through the material.
const SAME_WALL_SHARE: f64 = 0.6;
/// Ways through the material that differ by less than this share are the same.
const SAME_WALL_TOLERANCE: f64 = 0.1;
/// Depths below the surface from which the other side is looked for: so many, each twice the one before.
const WALL_DEPTHS: i32 = 24;

/// The way through the material of the reference that most samples have in common at `pose`, from the side where they lie to the other.
pub(super) fn through(
    problem: &Problem,
    pose: &Rigid,
    progress: &dyn Progress,
) -> Result<Option<Vector>, AlignError> {
    let matches = problem.matches(pose, f64::INFINITY, progress)?;
    let most = problem.target.bounds.diagonal();
    let mut ways: Vec<Vector> = vec![];
    let (mut looked, tree) = (0, problem.target.tree);
    for m in matches.iter().filter(|m| m.distance.is_finite()).take(WALL_SAMPLES) {
        looked += 1;
        let inward = times(-1.0, m.facet);
        let on = minus(m.equation.point, m.equation.away);
        for k in (0..WALL_DEPTHS).rev() {
            let depth = most * 0.5_f64.powi(k);
            let from = plus(on, times(depth, inward));
            let Some(met) = tree.crossing(&from, inward, 2.0 * depth)? else { continue };
            // Nearer to the side where the sample lies than to the other: deeper.
            if met.along > -0.5 * depth {
                ways.push(times(depth + met.along, inward));
                break;
            }
        }
    }
    let same = |a: &Vector| {
        ways.iter()
            .copied()
            .filter(|b| norm(minus(*a, *b)) <= SAME_WALL_TOLERANCE * norm(*a))
            .collect::<Vec<Vector>>()
    };
    let most = ways.iter().map(same).max_by_key(Vec::len).unwrap_or_default();
    let enough = !most.is_empty() && most.len() as f64 >= SAME_WALL_SHARE * f64::from(looked);
    let sum = most.iter().fold([0.0; 3], |s, w| plus(s, *w));
    Ok(enough.then(|| times(1.0 / most.len() as f64, sum)))
}
