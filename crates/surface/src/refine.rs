//! Knots where a tolerance asks for them.

use super::pass::{corrected, rms};
use super::{Base, BaseKind, Options, Reached, SurfaceError, SurfaceFit, base, border, nearest, solve};
use trueness_geom::progress::Progress;
use trueness_geom::space::{Point, norm};
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::spans::Spans;
use trueness_geom::spline::surface::Patches;

/// Times that knots are set.
const MAX_KNOT_ROUNDS: usize = 24;
/// A round that takes away less than this share of the standard deviation follows the noise.
const MIN_ROUND_GAIN: f64 = 0.03;
/// So many such rounds, one after the other, end it.
const IDLE_ROUNDS_TO_END: usize = 2;

/// Corrections of the parameters for each set of knots.
const CORRECTIONS_PER_ROUND: usize = 2;

/// Spans of the first surface: four along the shorter side, about square ones.
pub(super) fn first_spans(domain: [(f64, f64); 2]) -> [usize; 2] {
    let sides = domain.map(|d| d.1 - d.0);
    let shorter = sides[0].min(sides[1]);
    sides.map(|s| (4.0 * s / shorter).round().clamp(4.0, 32.0) as usize)
}

/// Points that are to be met.
#[derive(Clone, Copy)]
pub(super) struct Task<'a> {
    pub points: &'a [Point],
    pub tolerance: f64,
    pub options: &'a Options,
    pub progress: &'a dyn Progress,
}

impl Task<'_> {
    /// The fit over these knots, with true distances of all that may be beyond the tolerance; and the feet of its descents.
    pub(super) fn over(
        &self,
        base: Base,
        parameters: Vec<[f64; 2]>,
        knots: [Knots; 2],
        corrections: usize,
    ) -> Result<(SurfaceFit, Vec<[f64; 2]>), SurfaceError> {
        let own = Options { corrections: self.options.corrections.min(corrections), ..self.options.clone() };
        let mut local = corrected(self.points, parameters, base, knots, &own, self.progress)?;
        if self.options.ends_move() {
            local = border::reaching_over(self.points, local);
        }
        let feet = local.feet.clone();
        Ok((nearest::with_true_distances(self.points, local, self.tolerance, self.progress)?, feet))
    }

    /// Whether all points that count are within the tolerance.
    pub(super) fn within(&self, found: &SurfaceFit) -> bool {
        found.counted().all(|i| found.deviations[i].abs() <= self.tolerance)
    }

    /// Standard deviation of the points that count.
    fn spread(&self, found: &SurfaceFit) -> f64 {
        let counted: Vec<f64> = found.counted().map(|i| found.deviations[i]).collect();
        let count = counted.len() as f64;
        let used = found.degrees_of_freedom.unwrap_or(found.support.control_points as f64);
        let free = count - used;
        if free > 0.0 { rms(&counted) * (count / free).sqrt() } else { f64::INFINITY }
    }
}

/// Fits, sets knots where points are beyond the tolerance, and fits again.
///
/// It ends where all points are within, or where no points are left to set knots by. It ends as well where more knots
/// no longer lower the standard deviation of the points. The answer is then the surface before they were set.
pub(super) struct Rounds<'a> {
    task: Task<'a>,
    halved: Halved,
    base: Base,
    parameters: Vec<[f64; 2]>,
    knots: [Knots; 2],
    /// The surface of least standard deviation, and that.
    best: Option<(f64, SurfaceFit)>,
    idle: usize,
    done: usize,
}

/// The outcome of a round.
pub(super) enum Round {
    /// Knots were set after this surface.
    Going(SurfaceFit),
    /// The end.
    Over(SurfaceFit),
}

impl<'a> Rounds<'a> {
    pub(super) fn new(task: Task<'a>, halved: Halved, base: Base, parameters: Vec<[f64; 2]>) -> Rounds<'a> {
        let domain = base::ranges(parameters.iter().copied());
        let (spans, degree) = (first_spans(domain), task.options.degree);
        let knots = [0, 1].map(|k| Knots::uniform(degree[k], spans[k], domain[k].0, domain[k].1));
        Rounds { task, halved, base, parameters, knots, best: None, idle: 0, done: 0 }
    }

    /// Control points of the next round.
    pub(super) fn control_points(&self) -> usize {
        self.knots[0].count() * self.knots[1].count()
    }

    pub(super) fn next(&mut self) -> Result<Round, SurfaceError> {
        let Task { points, tolerance, options, .. } = self.task;
        let (found, feet) =
            self.task.over(self.base, self.parameters.clone(), self.knots.clone(), CORRECTIONS_PER_ROUND)?;
        self.knots = found.surface.knots().clone();
        if self.task.within(&found) {
            return Ok(Round::Over(SurfaceFit { reached: Some(Reached::Tolerance), ..found }));
        }
        if options.base != BaseKind::Xy {
            self.parameters = feet;
        }
        let spread = self.task.spread(&found);
        let next = finer(&self.knots, &found, self.halved, tolerance, points.len());
        let least = self.best.as_ref().map_or(f64::INFINITY, |(least, _)| *least);
        if self.best.is_some() && spread > (1.0 - MIN_ROUND_GAIN) * least {
            self.idle += 1;
        } else {
            self.idle = 0;
            self.best = Some((spread, found.clone()));
        }
        self.done += 1;
        if let Some(reached) = self.end(&next) {
            let (_, best) = self.best.take().unwrap_or((spread, found));
            return Ok(Round::Over(SurfaceFit { reached: Some(reached), ..best }));
        }
        self.knots = next;
        Ok(Round::Going(found))
    }

    /// Why it ends short of the tolerance, if it does.
    fn end(&self, next: &[Knots; 2]) -> Option<Reached> {
        let (counts, degrees) = (next.each_ref().map(Knots::count), next.each_ref().map(Knots::degree));
        if self.idle >= IDLE_ROUNDS_TO_END {
            Some(Reached::Noise)
        } else if *next == self.knots {
            Some(Reached::Points)
        } else if solve::allowed(counts, degrees, self.task.options.memory).is_err() {
            Some(Reached::Memory)
        } else {
            (self.done == MAX_KNOT_ROUNDS).then_some(Reached::Noise)
        }
    }
}

/// Cells whose farthest point is nearer than this share of the farthest one of all wait for the next round. A surface of too few
/// knots swings beside its strongest bends, and that passes by itself.
const URGENT_SHARE: f64 = 0.1;
/// Which sides of a cell are halved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Halved {
    /// The longer ones: cells stay about square.
    Longer,
    /// The sides along which the surface bends: few lines, where it bends one way. A shape that is thin as seen along
    /// the lines can be missed for a while.
    Bent,
}

impl Halved {
    /// Sides of a cell are halved that have more than such a share of the other side's measure. The measure is the
    /// length, or how far the surface bends over the side.
    fn share(self) -> f64 {
        match self {
            Halved::Longer => 0.7,
            Halved::Bent => 0.5,
        }
    }
}

/// Halves the sides of the cells that hold points beyond the tolerance, if their spans hold more points than the halves
/// have functions. Only the most urgent sides are halved where all would make more control points than there are
/// points.
///
/// A knot goes all through the surface, so it is set only where it is urgent. Else all spans with a point beyond the
/// tolerance would be halved. A dimple in a plane takes a quarter of the control points that it would then.
fn finer(
    knots: &[Knots; 2],
    found: &SurfaceFit,
    halved: Halved,
    tolerance: f64,
    points: usize,
) -> [Knots; 2] {
    let spans = [Spans::new(&knots[0]), Spans::new(&knots[1])];
    let mut farthest = vec![0.0f64; spans[0].count() * spans[1].count()];
    let mut sizes = vec![[0.0f64; 2]; farthest.len()];
    let patches = Patches::new(&found.surface);
    let mut held = [vec![0usize; spans[0].count()], vec![0usize; spans[1].count()]];
    for (foot, deviation) in found.counted().map(|i| (&found.feet[i], found.deviations[i])) {
        let at = [0, 1].map(|k| spans[k].locate(foot[k]).0);
        (0..2).for_each(|k| held[k][at[k]] += 1);
        let cell = at[0] * spans[1].count() + at[1];
        farthest[cell] = farthest[cell].max(deviation.abs());
        if deviation.abs() > tolerance {
            let half = [0, 1].map(|k| spans[k].half(at[k]));
            let own = match halved {
                Halved::Longer => half,
                Halved::Bent => {
                    let second = patches.jet(foot[0], foot[1]).second;
                    [norm(second[0]) * half[0] * half[0], norm(second[2]) * half[1] * half[1]]
                }
            };
            (0..2).for_each(|k| sizes[cell][k] = sizes[cell][k].max(own[k]));
        }
    }
    let most = farthest.iter().fold(0.0, |m: f64, d| m.max(*d));
    let mut limit = tolerance.max(URGENT_SHARE * most);
    loop {
        let next =
            with_halves(knots, &spans, &held, (&sizes, halved.share()), farthest.iter().map(|d| *d > limit));
        if limit >= most || next[0].count().saturating_mul(next[1].count()) <= points {
            return next;
        }
        limit *= 1.25;
    }
}

/// Halves the sides of the cells that are urgent whose sizes are more than a share of the other's.
fn with_halves(
    knots: &[Knots; 2],
    spans: &[Spans; 2],
    held: &[Vec<usize>; 2],
    (sizes, share): (&[[f64; 2]], f64),
    urgent: impl Iterator<Item = bool>,
) -> [Knots; 2] {
    let mut halved = held.each_ref().map(|h| vec![false; h.len()]);
    for (cell, _) in urgent.enumerate().filter(|(_, urgent)| *urgent) {
        let at = [cell / spans[1].count(), cell % spans[1].count()];
        let allowed = [0, 1].map(|k| held[k][at[k]] >= 2 * knots[1 - k].count());
        for k in 0..2 {
            let own = sizes[cell][k] > share * sizes[cell][1 - k];
            halved[k][at[k]] |= allowed[k] && (own || !allowed[1 - k]);
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
