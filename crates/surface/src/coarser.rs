//! Knots that a tolerance can do without.
//!
//! Halves of spans come in powers of two. A line that was urgent in an early round may not be needed among the later
//! ones. So a surface within its tolerance gives knots back, several at a time: those whose removal changes it least.
//! The jump of the highest derivative across a knot tells that change. (Lyche and Mørken, Knot removal for parametric
//! B-spline curves and surfaces, Computer Aided Geometric Design 4, 1987). The rest is fitted again, and kept if all
//! points are still within.

use super::refine::Task;
use super::{Reached, SurfaceError, SurfaceFit};
use trueness_geom::space::{Point, minus, norm, times};
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::spans::Spans;
use trueness_geom::spline::surface::Patches;

/// Fits at most.
const MAX_TRIES: usize = 40;
/// Knots are tried, the cheap ones first, whose removal changes the surface by no more than this times what the tolerance leaves there.
/// The rest is fitted anew, and takes up most of the change.
const MAX_REMOVAL_COSTS: [f64; 7] = [3.0, 5.0, 8.0, 12.0, 18.0, 27.0, 40.0];

/// The surface, if within its tolerance, without the knots that it can do without.
///
/// Knots that a try has shown to be needed, as points lie beyond the tolerance where they stood, are not tried again.
pub(super) fn coarser(task: Task, mut found: SurfaceFit) -> Result<SurfaceFit, SurfaceError> {
    let mut tries = 0;
    for max_cost in MAX_REMOVAL_COSTS {
        let mut needed: [Vec<f64>; 2] = [vec![], vec![]];
        while found.reached == Some(Reached::Tolerance) && tries < MAX_TRIES {
            let spare = spare(&found, task.tolerance, max_cost, &needed);
            let Some((knots, removed)) = without(found.surface.knots(), &spare) else { break };
            // The parameters are those of nearest places on much the same surface.
            let (next, _) = task.over(found.base, found.feet.clone(), knots, 0)?;
            tries += 1;
            if task.within(&next)
                && next.beyond_border.len() <= found.beyond_border.len()
                && next.far_control_points <= found.far_control_points
            {
                let corrections = found.corrections;
                found = SurfaceFit { reached: Some(Reached::Tolerance), corrections, ..next };
            } else {
                missed(&next, task.tolerance, removed, &mut needed);
            }
        }
    }
    Ok(found)
}

/// Adds the knots that are missed where points are beyond the tolerance; the dearest one, where none is.
fn missed(found: &SurfaceFit, tolerance: f64, removed: [Vec<f64>; 2], needed: &mut [Vec<f64>; 2]) {
    let knots = found.surface.knots().each_ref().map(Knots::distinct);
    let mut any = false;
    let mut marks = removed.each_ref().map(|g| vec![false; g.len()]);
    for foot in found.counted().filter(|i| found.deviations[*i].abs() > tolerance).map(|i| found.feet[i]) {
        for k in 0..2 {
            let at = knots[k].partition_point(|x| *x <= foot[k]).clamp(1, knots[k].len() - 1);
            for (knot, mark) in removed[k].iter().zip(&mut marks[k]) {
                if knots[k][at - 1] < *knot && *knot < knots[k][at] {
                    *mark = true;
                    any = true;
                }
            }
        }
    }
    for k in 0..2 {
        let own = removed[k].iter().zip(&marks[k]).filter(|(_, mark)| **mark || !any);
        needed[k].extend(own.map(|(knot, _)| *knot));
    }
}

/// An inner knot, by its direction and the number of the span before it. Its cost is the deviation that its removal may
/// add, as a share of the part that the tolerance has left there.
#[derive(Clone, Copy, Debug)]
struct SpareKnot {
    direction: usize,
    span: usize,
    cost: f64,
}

/// The inner knots that stand once and may not be needed, cheapest first.
fn spare(found: &SurfaceFit, tolerance: f64, max_cost: f64, needed: &[Vec<f64>; 2]) -> Vec<SpareKnot> {
    let knots = found.surface.knots();
    let spans = knots.each_ref().map(Spans::new);
    let columns = spans[1].count();
    let mut left = vec![tolerance; spans[0].count() * columns];
    for (foot, deviation) in found.counted().map(|i| (found.feet[i], found.deviations[i])) {
        let cell = spans[0].locate(foot[0]).0 * columns + spans[1].locate(foot[1]).0;
        left[cell] = left[cell].min(tolerance - deviation.abs());
    }
    let patches = Patches::new(&found.surface);
    let mut all = vec![];
    for direction in 0..2 {
        let own = &spans[direction];
        for span in 0..own.count() - 1 {
            let stands = own.first(span + 1) - own.first(span);
            if stands != 1 || needed[direction].contains(&own.limits(span).1) {
                continue;
            }
            let across = |other: usize| {
                let cells = [span, span + 1].map(|s| match direction {
                    0 => s * columns + other,
                    _ => other * columns + s,
                });
                jump(&patches, own, direction, span, cells)
                    / left[cells[0]].min(left[cells[1]]).max(1e-3 * tolerance)
            };
            let halves = [own.half(span), own.half(span + 1)];
            let reach = 2.0 * halves[0] * halves[1] / (halves[0] + halves[1]);
            let size = (0..own.degree()).fold(1.0, |product, _| product * 2.0 * reach);
            let cost = size * (0..spans[1 - direction].count()).map(across).fold(0.0, f64::max);
            if cost < max_cost {
                all.push(SpareKnot { direction, span, cost });
            }
        }
    }
    all.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    all
}

/// Greatest jump of the highest derivative, over its factorial, across the knot after `span` between two cells.
fn jump(patches: &Patches, spans: &Spans, direction: usize, span: usize, cells: [usize; 2]) -> f64 {
    let highest = |side: usize| -> Vec<Point> {
        let (coefficients, q) = patches.patch(cells[side]);
        let p = spans.degree();
        let size = (0..p).fold(1.0, |product, _| product * spans.half(span + side));
        let own = coefficients.iter().enumerate().filter(|(n, _)| [n / q, n % q][direction] == p);
        own.map(|(_, c)| times(1.0 / size, *c)).collect()
    };
    highest(0).iter().zip(highest(1)).map(|(a, b)| norm(minus(*a, b))).sum()
}

/// The knots without those `spare`, no two of them neighbors, and which they are; `None` of none.
fn without(knots: &[Knots; 2], spare: &[SpareKnot]) -> Option<([Knots; 2], [Vec<f64>; 2])> {
    let distinct = knots.each_ref().map(Knots::distinct);
    let mut marks = distinct.each_ref().map(|d| vec![false; d.len()]);
    for SpareKnot { direction, span, .. } in spare {
        let own = &mut marks[*direction];
        own[*span + 1] = !own[*span] && !own[*span + 2];
    }
    let removed = [0, 1].map(|k| {
        let own = distinct[k].iter().zip(&marks[k]);
        own.filter(|(_, mark)| **mark).map(|(knot, _)| *knot).collect::<Vec<f64>>()
    });
    let keep = |k: usize| {
        let ((from, to), p) = (knots[k].domain(), knots[k].degree());
        let inner = knots[k].values()[p + 1..knots[k].count()].iter().copied();
        let inner: Vec<f64> = inner.filter(|x| !removed[k].contains(x)).collect();
        Knots::clamped(p, from, &inner, to).ok()
    };
    let any = removed.iter().any(|g| !g.is_empty());
    Some([keep(0)?, keep(1)?]).filter(|_| any).map(|knots| (knots, removed))
}
