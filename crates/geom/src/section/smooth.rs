//! Smooth rows, of which the first partition makes many lines and arcs.

use super::chain::Kind;
use super::free;
use super::search::{Base, Model, Plan, Search};
use crate::progress::{Cancelled, Progress};

/// From so many lines and arcs on, one free piece of one of these numbers of coefficients is tried in their place.
const MANY: usize = 8;
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
        let off = (found.state.sum / self.criterion.count).sqrt();
        if off <= (KNOWN * self.criterion.noise).max(FINE * self.criterion.resolution) {
            return Ok(found);
        }
        let other = self.run(first, progress)?;
        Ok(if found.cost < other.cost { found } else { other })
    }

    /// One free piece in place of many lines and arcs, where that is cheaper.
    fn smooth(&mut self, first: &Model) -> Option<Model> {
        let base = Base::new(self, first.clone());
        let (from, to) = (base.plans.first()?.from, base.plans.last()?.to);
        if base.plans.len() < MANY || !self.kinds[1] {
            return None;
        }
        let mut best: Option<Model> = None;
        for count in COUNTS {
            let built = self.build(&base, &[Plan { kind: Kind::Spline, count, from, to }], f64::INFINITY);
            let mut model = self.settle(&built);
            let least = best.as_ref().map_or(first.cost, |b| b.cost);
            if model.cost < least && self.follows(&mut model.state) {
                best = Some(model);
            }
        }
        best
    }
}
