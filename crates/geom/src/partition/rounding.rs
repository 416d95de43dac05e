//! How far from its edges a scan is rounded.
//!
//! Scanners and the programs behind them round edges: what was measured there lies off both faces, by more the nearer to the
//! edge. The scan itself tells how far that goes. Points are sorted by their distance from the edges of their faces. Where they
//! deviate clearly more than in the middle of faces they are rounded. One number for the scan, as one program wrote it.

use super::best::Best;
use super::cut::NO_FACE;
use super::faces::Face;
use super::placed::Placed;
use super::work::ROUNDED_EDGE_SPACINGS;
use crate::space::Point;

/// Distances from edges that are told apart, in distances of neighbors.
const EDGE_STEP: f64 = 0.25;
/// Number of these distances. Scans are taken to round edges no farther. Beyond them faces are as in their middle.
const EDGE_STEPS: usize = (ROUNDED_EDGE_SPACINGS / EDGE_STEP) as usize;
/// Steps of a distance of neighbors.
const STEPS_PER_ROW: usize = 4;
/// Least steps that are rounded.
const MIN_ROUNDED_STEPS: usize = 3;
/// Deviations beyond which a point counts no more: single defects tell nothing of all edges.
const MAX_COUNTED_DEVIATIONS: f64 = 3.0;
/// Mean deviation over that in the middle of faces from which on points are rounded: they have moved by three quarters of a
/// standard deviation.
const ROUNDED_EDGE_RATIO: f64 = 1.25;
/// Mean magnitude of normal noise, in standard deviations. The middle is taken to have no less.
const MEAN_MAGNITUDE: f64 = 0.8;
/// Least points of a face that tell of a step.
const MIN_POINTS_PER_STEP: usize = 20;
/// Least faces whose median tells of a step.
const MIN_FACES_PER_STEP: usize = 3;

/// Distance of a point from the edge of its face, millimeters. It is measured from the border or from the adjacent face, as
/// borders move with the faces that make them and may not be known.
pub(super) fn to_edge(best: &Best, faces: &[&Face], p: usize) -> f64 {
    let within = best.seat[p].map_or(f64::INFINITY, |seat| seat.within());
    match best.owner[p] {
        NO_FACE => f64::from(best.adjacent_face[p]),
        own if faces[own as usize].is_narrow() => f64::INFINITY,
        _ => within.min(f64::from(best.adjacent_face[p])),
    }
}

/// How far from edges points are rounded, millimeters, where neighbors lie so far apart. 0 where edges are sharp, as those of a
/// computed mesh are.
pub(super) fn width(
    points: &[Point],
    best: &Best,
    (faces, placed): (&[&Face], &[Placed]),
    noise: f64,
    spacing: f64,
) -> f64 {
    let mut sums = vec![[(0.0, 0usize); EDGE_STEPS + 1]; faces.len()];
    for (p, place) in points.iter().enumerate() {
        let (own, Some(seat)) = (best.owner[p] as usize, best.seat[p]) else { continue };
        let far = to_edge(best, faces, p);
        if far > 0.0 && !faces[own].is_narrow() {
            let off = placed[own].off(faces[own], *place, seat).abs();
            let step = (far / (EDGE_STEP * spacing)).min(EDGE_STEPS as f64) as usize;
            sums[own][step].0 += (off / placed[own].deviation.max(noise)).min(MAX_COUNTED_DEVIATIONS);
            sums[own][step].1 += 1;
        }
    }
    // The median face tells: of a single one it may be worn.
    let of_step = |step: usize| {
        let counted =
            sums.iter().map(|of_face| of_face[step]).filter(|(_, count)| *count >= MIN_POINTS_PER_STEP);
        let mut means: Vec<f64> = counted.map(|(sum, count)| sum / count as f64).collect();
        means.sort_by(f64::total_cmp);
        (means.len() >= MIN_FACES_PER_STEP).then(|| means[means.len() / 2])
    };
    let middle = of_step(EDGE_STEPS).map_or(MEAN_MAGNITUDE, |mean| mean.max(MEAN_MAGNITUDE));
    // Where edges are taken away few points are left beside them.
    let is_rounded = |step: usize| of_step(step).map(|mean| mean > ROUNDED_EDGE_RATIO * middle);
    let (mut otherwise, mut steps) = (0, 0);
    for (step, rounded) in (0..EDGE_STEPS).map(|step| (step, is_rounded(step))) {
        match rounded {
            Some(true) => steps = step + 1,
            // Points next to an edge may belong to an adjacent face that was taken for this one.
            Some(false) if otherwise > 0 => break,
            Some(false) => otherwise += 1,
            None => {}
        }
    }
    // Points on an edge belong to both faces: on a computed mesh all that are at it.
    if steps < MIN_ROUNDED_STEPS {
        return 0.0;
    }
    // As far as nothing says otherwise, within a row of points.
    let end = EDGE_STEPS.min(steps + STEPS_PER_ROW);
    let next = (steps..end).find(|step| is_rounded(*step).is_some());
    EDGE_STEP * spacing * next.unwrap_or(steps) as f64
}
