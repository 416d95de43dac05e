//! Smooth rows, of which the first partition makes many lines and arcs.

use super::chain::Kind;
use super::free;
use super::search::{Base, Model, Plan, Search};
use crate::progress::{Cancelled, Progress};

/// From so many lines and arcs on, one free piece of one of these numbers of coefficients is tried in their place.
const MANY: usize = 8;
/// In so many pieces of equal length; several of so many coefficients each at least.
const PIECES: [usize; 6] = [1, 2, 3, 4, 6, 8];
/// with so many points to a coefficient.
const LONG: usize = 16;
const EACH: usize = 5;
const COUNTS: [usize; 7] = [6, 8, 12, 16, 24, 34, free::MOST];
/// What is found from there is good enough where its points are no farther off than this many times the noise that local fits
/// tell, or this many times what is not told from 0.
const KNOWN: f64 = 1.1;
const FINE: f64 = 4.0;

impl Search<'_> {
    /// The cheapest model reachable from the first, or from one free piece where many lines and arcs stand for a smooth curve.
    /// Merging them one by one takes as many rounds as there are pieces, each of as many models.
    pub fn best(&mut self, first: Model, progress: &dyn Progress) -> Result<Model, Cancelled> {
        let Some(smooth) = self.smooth(&first) else { return self.run(first, progress) };
        let found = self.run(smooth, progress)?;
        if self.is_near(&found) {
            return Ok(found);
        }
        let other = self.run(first, progress)?;
        Ok(if found.cost < other.cost { found } else { other })
    }

    /// Whether the points are no farther off than local fits tell.
    fn is_near(&self, model: &Model) -> bool {
        let off = (model.state.sum / self.criterion.count).sqrt();
        off <= (KNOWN * self.criterion.noise).max(FINE * self.criterion.resolution)
    }

    /// As few free pieces of equal length as are cheapest in place of many lines and arcs, where that is cheaper.
    fn smooth(&mut self, first: &Model) -> Option<Model> {
        let base = Base::new(self, first.clone());
        let (from, to) = (base.plans.first()?.from, base.plans.last()?.to);
        if base.plans.len() < MANY || !self.kinds[1] {
            return None;
        }
        let mut best: Option<Model> = None;
        for pieces in PIECES {
            let mut better = false;
            // Several pieces are for curves that one of most coefficients cannot follow.
            let held = self.row.points.len() / EACH / pieces;
            for count in COUNTS.into_iter().filter(|c| pieces == 1 || (LONG..=held).contains(c)) {
                let at = |k: usize| from + (to - from) * k as f64 / pieces as f64;
                let plan = |k: usize| Plan { kind: Kind::Spline, count, from: at(k), to: at(k + 1) };
                let plans: Vec<Plan> = (0..pieces).map(plan).collect();
                let built = self.build(&base, &plans, f64::INFINITY);
                let mut model = self.settle(&built);
                let least = best.as_ref().map_or(first.cost, |b| b.cost);
                if model.cost < least && self.follows(&mut model.state) {
                    (best, better) = (Some(model), true);
                }
            }
            if best.as_ref().is_some_and(|b| !better || self.is_near(b)) {
                break;
            }
        }
        best
    }
}
