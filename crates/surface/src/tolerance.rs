//! The surface of few control points that keeps to a tolerance: which way knot lines run, how many there are.

use super::base::{self, Base};
use super::coarser::coarser;
use super::grain::grain;
use super::refine::{Halved, Round, Rounds, Task};
use super::{BaseKind, Reached, SurfaceError, SurfaceFit};

/// Control points from which on the surface is known well enough to tell its grain.
const MIN_CONTROL_POINTS_OF_GRAIN: usize = 300;
/// Directions nearer to the sides of the rectangle than this, in radians, are theirs.
const ALIGNED_ANGLE: f64 = 0.003;
/// Times that the rectangle is turned at most: its angle is seen better where lines run along it.
const MAX_RECTANGLE_TURNS: usize = 4;

/// The one of two surfaces with fewer control points, less the knots that it can do without.
///
/// The cells of the one are halved along the main bends, over a plane after its rectangle was turned to where it bends
/// most. Cells of the other stay about square. It is the surer way to small deviations, and so the answer where none of
/// them keeps to the tolerance.
pub(super) fn to_tolerance(
    task: Task,
    base: Base,
    parameters: Vec<[f64; 2]>,
) -> Result<SurfaceFit, SurfaceError> {
    let bent = along_what_bends(task, base, parameters.clone())?.filter(reached);
    let mut square = Rounds::new(task, Halved::Longer, base, parameters);
    let found = loop {
        // More control points than the other has are no use.
        if let Some(bent) =
            bent.as_ref().filter(|bent| square.control_points() >= bent.support.control_points)
        {
            break bent.clone();
        }
        if let Round::Over(found) = square.next()? {
            break bent.filter(|_| !reached(&found)).unwrap_or(found);
        }
    };
    coarser(task, found)
}

fn reached(found: &SurfaceFit) -> bool {
    found.reached == Some(Reached::Tolerance)
}

/// The surface whose cells are halved along its main bends, over a rectangle turned along them; `None` where all ends
/// at the noise.
fn along_what_bends(
    task: Task,
    mut base: Base,
    parameters: Vec<[f64; 2]>,
) -> Result<Option<SurfaceFit>, SurfaceError> {
    let mut rounds = Rounds::new(task, Halved::Bent, base, parameters);
    let mut turns = if base.kind == BaseKind::Plane { MAX_RECTANGLE_TURNS } else { 0 };
    let mut best: Option<SurfaceFit> = None;
    loop {
        let round = rounds.next()?;
        let (Round::Going(found) | Round::Over(found)) = &round;
        let over = matches!(round, Round::Over(_));
        // Turning has a price, empty corners: it must be worth a tenth.
        let fewer = |b: &SurfaceFit| 10 * found.support.control_points < 9 * b.support.control_points;
        if over && reached(found) && best.as_ref().is_none_or(fewer) {
            best = Some(found.clone());
        }
        let noisy = found.reached == Some(Reached::Noise);
        if turns > 0 && !noisy && (over || found.support.control_points >= MIN_CONTROL_POINTS_OF_GRAIN) {
            turns -= 1;
            let aslant = |[a, b]: &[f64; 2]| a.abs().min(b.abs()) > libm::sin(ALIGNED_ANGLE);
            if let Some(direction) = grain(found).filter(aslant) {
                let (turned, parameters) = base::turned(task.points, &base, direction);
                base = turned;
                rounds = Rounds::new(task, Halved::Bent, base, parameters);
                continue;
            }
        }
        if over {
            return Ok(best);
        }
    }
}
