//! Poses of a body of revolution but for a detail, such as a shaft with a keyway. The detail alone tells the angle and the end.
//! A few hundred samples hardly see it, and no small step leads from one angle to another.

use super::AlignError;
use super::freedom::{Freedom, named};
use super::icp::Problem;
use super::start::Search;
use super::system::Spectrum;
use super::work::COMPARED_ITERATIONS;
use crate::parallel::prelude::*;
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::space::{Point, Vector, cross, least_axis, times, unit};
use std::f64::consts::{PI, TAU};

/// Turns about the axis that are tried.
const AXIS_TURNS: i32 = 144;
/// Share of the score at the pose that half of these turns must have: then it is a body of revolution.
const ALIKE_TURN_SCORE: f64 = 0.7;
/// Iterations that bring each turned pose to rest.
const TURN_ITERATIONS: usize = 6;
/// Best turns of either end that are looked around.
const MAX_TURNS_REFINED: usize = 4;
/// Turns to either side of such a pose, in units of the tried turns.
const FINE_TURN_STEPS: f64 = 2.0;
/// Steps in which these turns are gone through on either side.
const FINE_TURNS_PER_SIDE: i32 = 24;
/// Turns by which a detail is brought away from its place.
const AXIS_PROBE_TURNS: [f64; 3] = [0.11, 0.29, 0.43];

/// The best poses that differ from `pose` by a turn about the axis of the reference, and the same with its ends interchanged.
/// They come best first; there are none where the reference is no such body. They come to lie on the samples of `coarse` and
/// are compared on those of `finer`; no distance counts there for more than `cap`.
pub(super) fn poses(
    search: &Search,
    pose: &Rigid,
    [coarse, finer]: [&Problem; 2],
    cap: f64,
    progress: &dyn Progress,
) -> Result<Vec<Rigid>, AlignError> {
    let Some((point, direction)) = axis(search, pose, finer, progress)? else { return Ok(vec![]) };
    let by = |turn: f64| Rigid::rotation_about(point, times(turn * TAU / f64::from(AXIS_TURNS), direction));
    let enough = ALIKE_TURN_SCORE * search.score(pose);
    let alike = (0..AXIS_TURNS).filter(|k| search.score(&by(f64::from(*k)).after(pose)) >= enough).count();
    if 2 * alike < AXIS_TURNS as usize {
        return Ok(vec![]);
    }
    let Some((across, _)) = unit(cross(direction, least_axis(direction))) else { return Ok(vec![]) };
    let other = Rigid::rotation_about(search.reference_mean(), times(PI, across)).after(pose);
    let ends = [*pose, settled(search, &other, finer, progress)?];
    // Far turned the axis is not known well enough; a short way about it is.
    let cost = |pose: Rigid| Ok::<_, AlignError>((finer.cost(&pose, cap, progress)?, pose));
    let brought = |pose: Rigid| cost(coarse.run(pose, 2.0 * search.spacing, TURN_ITERATIONS, progress)?.pose);
    let mut found = vec![];
    for end in ends {
        let turned: Vec<Rigid> = (0..AXIS_TURNS).map(|k| by(f64::from(k)).after(&end)).collect();
        let mut turned: Vec<(f64, Rigid)> = turned.into_par_iter().map(brought).collect::<Result<_, _>>()?;
        turned.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut best: Vec<Rigid> = vec![];
        for (_, pose) in turned {
            if best.len() < MAX_TURNS_REFINED && best.iter().all(|b| search.apart(b, &pose) > search.spacing)
            {
                best.push(pose);
            }
        }
        for pose in best {
            let about = (-FINE_TURNS_PER_SIDE..=FINE_TURNS_PER_SIDE)
                .map(|k| by(f64::from(k) / f64::from(FINE_TURNS_PER_SIDE) * FINE_TURN_STEPS).after(&pose));
            let about: Vec<Rigid> = about.collect();
            let costs: Vec<(f64, Rigid)> = about.into_par_iter().map(cost).collect::<Result<_, _>>()?;
            found.extend(costs.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)));
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(found.into_iter().map(|f| f.1).collect())
}

/// Where the samples come to lie from `pose`.
fn settled(
    search: &Search,
    pose: &Rigid,
    finer: &Problem,
    progress: &dyn Progress,
) -> Result<Rigid, AlignError> {
    let pose = search.wide(finer).run(*pose, 2.0 * search.spacing, COMPARED_ITERATIONS, progress)?.pose;
    Ok(finer.run(pose, 2.0 * search.spacing, COMPARED_ITERATIONS, progress)?.pose)
}

/// The axis of the reference, a point and a direction: that of the motion which the samples hold least. Turned away from where it belongs the
/// detail is an outlier; of several turns the one counts at which the turn is held least.
fn axis(
    search: &Search,
    pose: &Rigid,
    finer: &Problem,
    progress: &dyn Progress,
) -> Result<Option<(Point, Vector)>, AlignError> {
    let of = |pose: &Rigid| -> Result<(f64, Option<(Point, Vector)>), AlignError> {
        let mut matches = finer.matches(pose, f64::INFINITY, progress)?;
        let sigma = finer.deviation(&matches);
        finer.weigh(&mut matches, sigma);
        let system = finer.system_of_facets(&matches, pose);
        let spectrum = Spectrum::of(&system);
        let axis = match named(system.center, system.radius, &spectrum.vectors[..1])[..] {
            [Freedom::Turns { point, direction }] => Some((point, direction)),
            _ => None,
        };
        Ok((spectrum.values[0] / system.weight, axis))
    };
    let (mut least, mut axis) = of(pose)?;
    let Some((point, direction)) = axis else { return Ok(None) };
    for away in AXIS_PROBE_TURNS {
        let turned = Rigid::rotation_about(point, times(away * TAU, direction)).after(pose);
        // Where it clearly does not lie on the reference, that is no such body.
        if search.score(&turned) == 0.0 {
            continue;
        }
        let (held, other) = of(&settled(search, &turned, finer, progress)?)?;
        if held < least && other.is_some() {
            (least, axis) = (held, other);
        }
    }
    Ok(axis)
}
