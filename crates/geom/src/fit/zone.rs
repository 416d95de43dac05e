//! Minimum zone, minimum circumscribed and maximum inscribed elements of any number of points.
//!
//! Few points touch the best element, so the problem is solved by exchange:
//! 1. the element is optimized for a small working set of points;
//! 2. one pass over all points finds those farther off than the zone of the working set allows;
//! 3. if there are any, the worst of each part of the list join the working set, and it goes on with 1.
//!
//! At the end no point is outside, so the element is optimal for all points. The multipliers of the touching points certify it.

use super::family::{Element, Family};
use super::linear::MAX_JOINING_POINTS;
use super::minimax::{Aim, Low, minimax};
use super::sample::Sample;
use super::solution::{Fit, Touching};
use super::unknown::Local;
use super::{FitError, Kind, Method, Options, gaussian, survey};
use crate::num::random::Random;
use crate::progress::Progress;
use crate::space::Point;

/// Points all over the surface that are in the working set from the first.
const COVERING_POINTS: usize = 64;
/// Most rounds of exchange. Two to five are the rule.
const MAX_EXCHANGE_ROUNDS: usize = 60;
/// Height in the unit frame up to which sticking out is rounding.
const TOUCHING_ROUNDING: f64 = 1e-15;
/// Range of the distances over that of the least-squares element from which on an optimum is another one. A flat ring also fits
/// through a cylinder that lies on its side.
const OTHER_OPTIMUM_RANGE: f64 = 6.0;
/// Further starts about the first optimum.
const FURTHER_STARTS: u64 = 12;

/// The fit by greatest distances.
pub(super) fn zone<const P: usize, F: Family<P>>(
    sample: &Sample,
    kind: Kind,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Fit, FitError> {
    let aim = aim::<P, F>(kind, options.method)?;
    let first = gaussian::near::<P, F>(sample, kind, options)?;
    let mut search = Search::<P, F>::new(sample, aim, &first);
    // The greatest distance from a center is a convex function of it.
    search.only_one = aim.outer && aim.pinned && kind != Kind::Cylinder;
    let best = search.best(&first, options.seed, progress)?.ok_or(FitError::Undetermined { kind })?;
    progress.advance(sample.len() as u64);
    let mut element = best.element;
    if aim.pinned {
        element.size[0] += if aim.outer { best.value } else { -best.value };
        if element.size[0] <= 0.0 {
            return Err(FitError::Undetermined { kind });
        }
    }
    let element = F::settled(element);
    let mut touching: Vec<Touching> = best
        .held
        .iter()
        .map(|&(k, side, multiplier)| Touching { point: search.working[k], side: side as i8, multiplier })
        .collect();
    touching.sort_by_key(|t| t.point);
    Ok(Fit {
        shape: F::shape(&element, sample),
        method: options.method,
        residuals: gaussian::residuals::<P, F>(&element, sample),
        covariance: None,
        touching,
        outliers: 0,
        iterations: best.steps,
        converged: best.slack < 1e-6,
    })
}

/// Which distances count.
fn aim<const P: usize, F: Family<P>>(kind: Kind, method: Method) -> Result<Aim, FitError> {
    // Whether its surfaces at equal distance are of its kind, and one of them has no inside.
    let round = match kind {
        Kind::Circle2 | Kind::Sphere | Kind::Cylinder => true,
        Kind::Line2 | Kind::Line | Kind::Plane | Kind::Circle | Kind::Ellipse2 | Kind::Cone | Kind::Torus => {
            false
        }
    };
    match method {
        Method::MinimumCircumscribed if round => Ok(Aim { outer: true, inner: false, pinned: true }),
        Method::MaximumInscribed if round => Ok(Aim { outer: false, inner: true, pinned: true }),
        // Curves parallel to an ellipse are no ellipses.
        Method::MinimumZone if kind != Kind::Ellipse2 => {
            Ok(Aim { outer: true, inner: F::SIGNED, pinned: false })
        }
        Method::MinimumZone
        | Method::MinimumCircumscribed
        | Method::MaximumInscribed
        | Method::Gaussian
        | Method::Robust => Err(FitError::NoSuchMethod { kind, method }),
    }
}

/// Greatest less least distance.
fn range(blocks: &[survey::Survey]) -> f64 {
    let greatest = blocks.iter().fold(f64::NEG_INFINITY, |m, b| m.max(b.greatest));
    greatest - blocks.iter().fold(f64::INFINITY, |m, b| m.min(b.least))
}

/// The exchange, with the points it has gathered.
struct Search<'a, const P: usize, F> {
    sample: &'a Sample<'a>,
    aim: Aim,
    /// Whether there is but one optimum, wherever it lies.
    only_one: bool,
    /// Range of the distances from the first element.
    range: f64,
    /// First box of the minimax search.
    reach: f64,
    /// Indices of the points of the working set, and their places in the unit frame.
    working: Vec<usize>,
    places: Vec<Point>,
    family: std::marker::PhantomData<F>,
}

impl<'a, const P: usize, F: Family<P>> Search<'a, P, F> {
    fn new(sample: &'a Sample<'a>, aim: Aim, first: &Element) -> Self {
        let mut search = Search {
            sample,
            aim,
            only_one: false,
            range: 0.0,
            reach: 0.0,
            working: Vec::new(),
            places: Vec::new(),
            family: std::marker::PhantomData,
        };
        let blocks = survey::blocks::<P, F>(first, sample);
        let most = blocks.iter().fold(0.0f64, |m, b| m.max(b.greatest.abs()).max(b.least.abs()));
        search.range = range(&blocks);
        search.reach = 4.0 * most.max(1e-12);
        search.join(first, f64::NEG_INFINITY, &blocks);
        // Points all over the surface keep the element from leaving through a gap between the few extreme ones.
        for index in sample.spread(COVERING_POINTS) {
            search.add_working(index);
        }
        search
    }

    /// Takes in the points that stick out farther than `value`: the worst of the worst blocks. Returns how far
    /// the worst of all points sticks out, as distance.
    fn join(&mut self, element: &Element, value: f64, blocks: &[survey::Survey]) -> f64 {
        let mut worst = f64::NEG_INFINITY;
        let mut found = Vec::new();
        for (counts, side) in [(self.aim.outer, 1.0), (self.aim.inner, -1.0)] {
            if !counts {
                continue;
            }
            let out = |b: &survey::Survey| if side > 0.0 { b.greatest } else { -b.least };
            let mut order: Vec<usize> = (0..blocks.len()).filter(|&k| out(&blocks[k]) > value).collect();
            worst = blocks.iter().map(out).fold(worst, f64::max);
            order.sort_by(|&i, &j| out(&blocks[j]).total_cmp(&out(&blocks[i])).then(i.cmp(&j)));
            order.truncate(MAX_JOINING_POINTS);
            for &block in &order {
                found.extend(survey::find::<P, F>(element, self.sample, block, side * out(&blocks[block])));
            }
        }
        found.sort_unstable();
        found.dedup();
        for index in found {
            self.add_working(index);
        }
        worst
    }

    fn add_working(&mut self, index: usize) {
        if !self.working.contains(&index) {
            self.working.push(index);
            self.places.push(self.sample.unit(self.sample.points[index]));
        }
    }

    /// The optimum of all points near `start`; `None` if no optimum is reached or it is not below `limit`.
    fn all_points(&mut self, start: &Element, limit: f64) -> Option<Low> {
        let mut element = *start;
        for _ in 0..MAX_EXCHANGE_ROUNDS {
            let low = minimax::<P, F>(&element, &self.places, self.aim, self.reach)?;
            // Further points can only raise it.
            if low.value >= limit {
                return None;
            }
            let blocks = survey::blocks::<P, F>(&low.element, self.sample);
            let before = self.working.len();
            let worst = self.join(&low.element, low.value + TOUCHING_ROUNDING, &blocks);
            if worst <= low.value + TOUCHING_ROUNDING || self.working.len() == before {
                return self.belongs_to_feature(&low, &blocks).then_some(low);
            }
            element = low.element;
        }
        None
    }

    /// Whether the optimum belongs to the feature. It has not left through a gap between the points, and its distances range
    /// not much farther than those of the first element.
    fn belongs_to_feature(&self, low: &Low, blocks: &[survey::Survey]) -> bool {
        let most = OTHER_OPTIMUM_RANGE * self.range.max(TOUCHING_ROUNDING);
        self.only_one || (range(blocks) <= most && !(self.aim.pinned && low.value.abs() > most))
    }

    /// The best of the optima reached from `first` and from starts scattered about it.
    fn best(&mut self, first: &Element, seed: u64, progress: &dyn Progress) -> Result<Option<Low>, FitError> {
        let mut best = self.all_points(first, f64::INFINITY);
        let mut random = Random::new(seed);
        let further = match self.sample.len() {
            _ if self.only_one => 0,
            0..=1000 => 4 * FURTHER_STARTS,
            _ => FURTHER_STARTS,
        };
        for k in 0..further {
            if progress.cancelled() {
                return Err(FitError::Cancelled);
            }
            let about = best.as_ref().map_or(*first, |b| b.element);
            let spread = self.reach * [0.5, 2.0, 8.0][k as usize % 3];
            let step = std::array::from_fn(|i| match F::LOCAL[i] {
                Local::Size(0) if self.aim.pinned => 0.0,
                _ => spread * (2.0 * random.unit() - 1.0),
            });
            let Some(start) = about.moved(&F::LOCAL, &step).filter(|e| F::sound(e.size)) else { continue };
            let limit = best.as_ref().map_or(f64::INFINITY, |b| b.value - 1e-13);
            if let Some(low) = self.all_points(&start, limit) {
                best = Some(low);
            }
        }
        Ok(best)
    }
}
