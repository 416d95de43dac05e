//! The search: seeds are tried a batch at a time, the best of a batch take their regions first.
//!
//! R. Schnabel, R. Wahl, R. Klein, "Efficient RANSAC for point-cloud shape detection", Computer Graphics Forum 26 (2007). Ours
//! differs: a trial is a patch around a random piece, not a handful of points. That stands noise and makes nearly every trial
//! on a face a success. A region is connected from the first.

use super::criterion::{fewest_points, is_of_corners, is_shown};
use super::flood::{Marks, patch};
use super::grow::{Context, PROMISING_SHARE};
use super::pieces::NO_PIECE;
use super::region::GrownRegion;
use super::seeds::Seeds;
use crate::num::random::Random;
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress};

/// Seeds tried against the same state: the answer depends on it, not on the number of threads.
const SEEDS_PER_BATCH: u64 = 32;
/// Pieces that a trial may reach; regions that are taken grow on.
const TRIAL_PIECES: usize = 500;
/// Pieces of a neighborhood that was tried in vain.
const MAX_TRIED_PIECES: usize = 16;
/// Trials for each region that could be there: the chance to miss a face of the smallest share asked for is e^-4.
const TRIALS_PER_REGION: f64 = 4.0;

/// The limits of the search.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Least weight of a region.
    pub weight: f64,
    /// Fewest measured points of a region.
    pub points: usize,
    /// Seed of the random choices.
    pub seed: u64,
}

/// The regions found, in the order they were taken, and the region of each piece.
pub(super) fn search(
    context: &Context,
    limits: &Limits,
    progress: &dyn Progress,
) -> Result<(Vec<GrownRegion>, Vec<u32>), Cancelled> {
    let surface = context.surface;
    let mut found: Vec<GrownRegion> = Vec::new();
    let mut labels = vec![NO_PIECE; surface.len()];
    let mut tried = vec![false; surface.len()];
    let mut seeds = Seeds::new(surface, |_| true);
    let total: f64 = surface.weights.iter().sum();
    let most = (TRIALS_PER_REGION * total / limits.weight.max(1e-6 * total)).ceil() as u64;
    let (mut trial, mut idle) = (0, 0);
    let mut marks = Marks::new(surface);
    while trial < most && !seeds.is_empty() {
        if progress.cancelled() {
            return Err(Cancelled);
        }
        let open = |piece: u32| labels[piece as usize] == NO_PIECE && !tried[piece as usize];
        let drawn: Vec<u32> = (trial..trial + SEEDS_PER_BATCH)
            .map(|k| seeds.draw(&mut Random::stream(limits.seed, k)))
            .filter(|&piece| open(piece))
            .collect();
        trial += SEEDS_PER_BATCH;
        idle += SEEDS_PER_BATCH - drawn.len() as u64;
        if idle > 4 * SEEDS_PER_BATCH {
            // Most of the list is taken: draw from what is left.
            seeds = Seeds::new(surface, open);
            idle = 0;
            trial -= 4 * SEEDS_PER_BATCH;
            continue;
        }
        let free = |piece: u32| labels[piece as usize] == NO_PIECE;
        let trials: Vec<Option<GrownRegion>> = (drawn.par_iter())
            .map_init(|| Marks::new(surface), |marks, &seed| context.around(seed, TRIAL_PIECES, marks, &free))
            .collect();
        let mut promising: Vec<(u32, GrownRegion)> = Vec::new();
        for (&seed, trial) in drawn.iter().zip(trials) {
            match trial {
                Some(grown) if is_promising(&grown, limits) => promising.push((seed, grown)),
                _ => mark_tried(context, seed, limits, &mut tried, &mut marks),
            }
        }
        let merit = |grown: &GrownRegion| grown.merit(context.noise);
        promising.sort_by(|a, b| merit(&b.1).total_cmp(&merit(&a.1)).then(a.0.cmp(&b.0)));
        for (place, (seed, trial)) in promising.iter().enumerate() {
            let seed = *seed;
            if labels[seed as usize] != NO_PIECE || tried[seed as usize] {
                continue;
            }
            // The rest of it is tried again when the others have their regions.
            let along = |(own, other): &(u32, GrownRegion)| {
                labels[*own as usize] == NO_PIECE
                    && is_of_corners(trial, other, context.noise)
                    && trial.pieces.contains(own)
            };
            if promising[place + 1..].iter().any(along) {
                continue;
            }
            let free = |piece: u32| labels[piece as usize] == NO_PIECE;
            let Some(grown) = context.whole(trial, limits.weight, &mut marks, &free) else {
                mark_tried(context, seed, limits, &mut tried, &mut marks);
                continue;
            };
            if !enough(context, &grown, limits) {
                mark_tried(context, seed, limits, &mut tried, &mut marks);
                grown.pieces.iter().for_each(|&piece| tried[piece as usize] = true);
                continue;
            }
            for &piece in &grown.pieces {
                labels[piece as usize] = found.len() as u32;
            }
            progress.advance(grown.pieces.len() as u64);
            found.push(grown);
        }
    }
    Ok((found, labels))
}

fn is_promising(grown: &GrownRegion, limits: &Limits) -> bool {
    grown.pieces.len() >= TRIAL_PIECES || grown.weight >= PROMISING_SHARE * limits.weight
}

fn enough(context: &Context, grown: &GrownRegion, limits: &Limits) -> bool {
    let (surface, kind) = (context.surface, grown.shape.kind());
    // Enough to tell, and not a million.
    let first_pieces = &grown.pieces[..grown.pieces.len().min(8 * limits.points.max(fewest_points(kind)))];
    let points = surface.points_of(first_pieces.iter().copied()).len();
    grown.weight >= limits.weight && points >= limits.points && is_shown(surface, kind, first_pieces, points)
}

/// Nothing starts from the seed and its nearest neighbors again. Next to a drawn facet that could be a face by itself there may be another face.
fn mark_tried(context: &Context, seed: u32, limits: &Limits, tried: &mut [bool], marks: &mut Marks) {
    let is_face = context.surface.is_drawn && context.surface.weights[seed as usize] >= limits.weight;
    let most = if is_face { 1 } else { MAX_TRIED_PIECES };
    for piece in patch(context.surface, seed, most, context.crease, marks, |_| true) {
        tried[piece as usize] = true;
    }
    tried[seed as usize] = true;
}

#[cfg(test)]
mod tests {
    use super::super::tests::{context, parts::turned};
    use super::*;
    use crate::progress::Silent;

    /// Regions are as large as asked for, and no piece is in two.
    #[test]
    fn regions_are_large_enough_and_apart() {
        let part = turned(1.0, 72).moved().noisy(0.01, 4);
        context(&part.mesh, |context| {
            let total: f64 = context.surface.weights.iter().sum();
            for share in [0.002, 0.05, 0.15] {
                let limits = Limits { weight: share * total, points: 0, seed: 1 };
                let (found, labels) = search(context, &limits, &Silent).unwrap();
                assert!(!found.is_empty() && found.iter().all(|region| region.weight >= limits.weight));
                for (label, region) in found.iter().enumerate() {
                    assert!(region.pieces.iter().all(|&p| labels[p as usize] == label as u32));
                    assert!((region.weight - context.surface.weight(&region.pieces)).abs() < 1e-9 * total);
                }
            }
        });
    }
}
