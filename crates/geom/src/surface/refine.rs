//! Knots where a tolerance asks for them.

use super::pass::{corrected, rms};
use super::{Base, Options, Reached, SurfaceError, SurfaceFit, nearest, solve};
use crate::progress::Progress;
use crate::space::Point;
use crate::spline::basis::Knots;
use crate::spline::spans::Spans;

/// Times that knots are set.
const ROUNDS: usize = 24;
/// A round that takes away less than this share of the standard deviation follows the noise.
const GAIN: f64 = 0.03;
/// So many such rounds, one after the other, end it.
const PATIENCE: usize = 2;

/// Spans of the first surface: four along the shorter side, about square ones.
pub(super) fn first_spans(domain: [(f64, f64); 2]) -> [usize; 2] {
    let sides = domain.map(|d| d.1 - d.0);
    let shorter = sides[0].min(sides[1]);
    sides.map(|s| (4.0 * s / shorter).round().clamp(4.0, 32.0) as usize)
}

/// Fits, sets knots where points are beyond the tolerance, and fits again.
///
/// It ends where all points are within, where more knots lower the standard deviation of the points no more (the answer
/// is then the surface before they were set), or where there are no points left to set knots by.
pub(super) fn to_tolerance(
    points: &[Point],
    mut parameters: Vec<[f64; 2]>,
    base: Base,
    mut knots: [Knots; 2],
    tolerance: f64,
    options: &Options,
    progress: &dyn Progress,
) -> Result<SurfaceFit, SurfaceError> {
    let own = Options { corrections: options.corrections.min(2), ..options.clone() };
    let mut best: Option<(f64, SurfaceFit)> = None;
    let mut idle = 0;
    for _ in 0..ROUNDS {
        let local = corrected(points, parameters.clone(), base, knots.clone(), &own, progress)?;
        let feet = local.feet.clone();
        let found = nearest::told(points, local, tolerance, progress)?;
        if found.deviations.iter().all(|d| d.abs() <= tolerance) {
            return Ok(SurfaceFit { reached: Some(Reached::Tolerance), ..found });
        }
        if options.base != super::BaseKind::Xy {
            parameters = feet;
        }
        let used = found.degrees_of_freedom.unwrap_or(found.support.control_points as f64);
        let free = points.len() as f64 - used;
        let spread = if free > 0.0 {
            rms(&found.deviations) * (points.len() as f64 / free).sqrt()
        } else {
            f64::INFINITY
        };
        let next = finer(&knots, &found, tolerance, points.len());
        match &best {
            Some((least, _)) if spread > (1.0 - GAIN) * least => idle += 1,
            _ => {
                idle = 0;
                best = Some((spread, found));
            }
        }
        let stop = |reached| best.as_ref().map(|(_, f)| SurfaceFit { reached: Some(reached), ..f.clone() });
        let end = if idle >= PATIENCE {
            stop(Reached::Noise)
        } else if next == knots {
            stop(Reached::Points)
        } else if solve::allowed(
            [next[0].count(), next[1].count()],
            [next[0].degree(), next[1].degree()],
            options.memory,
        )
        .is_err()
        {
            stop(Reached::Memory)
        } else {
            None
        };
        if let Some(found) = end {
            return Ok(found);
        }
        knots = next;
    }
    match best {
        Some((_, found)) => Ok(SurfaceFit { reached: Some(Reached::Noise), ..found }),
        None => corrected(points, parameters, base, knots, &own, progress),
    }
}

/// Cells whose farthest point is nearer than this share of the farthest one of all wait for the next round: beside what bends most
/// a surface of too few knots swings, and that passes by itself.
const URGENT: f64 = 0.1;
/// Of a cell the sides longer than this share of the other are halved.
const LONGER: f64 = 0.7;

/// Halves the longer sides of the cells that hold points beyond the tolerance, if their spans hold more points than the halves
/// have functions: of the most urgent of them only, where all would make more control points than there are points.
///
/// A knot goes all through the surface, so it is set only where it is urgent: a dimple in a plane takes a quarter of the control points
/// that it would if all spans with a point beyond the tolerance were halved.
fn finer(knots: &[Knots; 2], found: &SurfaceFit, tolerance: f64, points: usize) -> [Knots; 2] {
    let spans = [Spans::new(&knots[0]), Spans::new(&knots[1])];
    let mut farthest = vec![0.0f64; spans[0].count() * spans[1].count()];
    let mut held = [vec![0usize; spans[0].count()], vec![0usize; spans[1].count()]];
    for (foot, deviation) in found.feet.iter().zip(&found.deviations) {
        let at = [0, 1].map(|k| spans[k].locate(foot[k]).0);
        (0..2).for_each(|k| held[k][at[k]] += 1);
        let cell = &mut farthest[at[0] * spans[1].count() + at[1]];
        *cell = cell.max(deviation.abs());
    }
    let most = farthest.iter().fold(0.0, |m: f64, d| m.max(*d));
    let mut limit = tolerance.max(URGENT * most);
    loop {
        let next = with_halves(knots, &spans, &held, farthest.iter().map(|d| *d > limit));
        if limit >= most || next[0].count().saturating_mul(next[1].count()) <= points {
            return next;
        }
        limit *= 1.25;
    }
}

/// Halves the longer sides of the cells that are urgent.
fn with_halves(
    knots: &[Knots; 2],
    spans: &[Spans; 2],
    held: &[Vec<usize>; 2],
    urgent: impl Iterator<Item = bool>,
) -> [Knots; 2] {
    let mut halved = held.each_ref().map(|h| vec![false; h.len()]);
    for (cell, _) in urgent.enumerate().filter(|(_, urgent)| *urgent) {
        let at = [cell / spans[1].count(), cell % spans[1].count()];
        let allowed = [0, 1].map(|k| held[k][at[k]] >= 2 * knots[1 - k].count());
        let half = [0, 1].map(|k| spans[k].half(at[k]));
        for k in 0..2 {
            halved[k][at[k]] |= allowed[k] && (half[k] > LONGER * half[1 - k] || !allowed[1 - k]);
        }
    }
    [0, 1].map(|k| {
        let p = knots[k].degree();
        let mut inner: Vec<f64> = knots[k].values()[p + 1..knots[k].count()].to_vec();
        let middle = |span: usize| 0.5 * (spans[k].limits(span).0 + spans[k].limits(span).1);
        inner.extend((0..spans[k].count()).filter(|span| halved[k][*span]).map(middle));
        inner.sort_unstable_by(f64::total_cmp);
        let (from, to) = knots[k].domain();
        Knots::clamped(p, from, &inner, to).unwrap_or_else(|_| knots[k].clone())
    })
}
