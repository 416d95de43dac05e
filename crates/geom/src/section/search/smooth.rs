//! Smooth rows, of which the first partition makes many lines and arcs.

use super::rounds::Search;
use super::start::Part;
use crate::progress::{Cancelled, Progress};
use crate::section::model::chain::SegmentKind;
use crate::section::model::criterion::{Model, Plan};
use crate::section::model::free;
use crate::section::model::least::State;

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
/// Lines and arcs are searched that cost no more than so much above the cheapest found: a search takes off some pieces, hardly more.
const FAR: f64 = 20.0;
/// Fewer points to a line or arc do not tell it from a curve.
const ENOUGH: usize = 10;
const FINE: f64 = 4.0;
/// and nearly so up to this many times.
const NEARLY: f64 = 1.3;
/// A dozen steps leave free pieces no dearer than this for each point above the cheapest, where they can follow the row: their points are
/// then 1.65 times as far off.
const POINT_COST_TO_DROP: f64 = 1.0;

impl Search<'_> {
    /// The cheapest model reachable from that of the parts, or from one free piece where many lines and arcs stand for a smooth curve.
    /// Merging them one by one takes as many rounds as there are pieces, each of as many models.
    pub fn best(
        &mut self,
        parts: &[Part],
        closed: bool,
        progress: &dyn Progress,
    ) -> Result<Model, Cancelled> {
        let plain = self.plain(parts, closed);
        let first = self.cheapest(plain.clone(), parts, closed);
        let Some(smooth) = self.smooth(&plain, first.cost) else {
            return self.run(first, progress);
        };
        let found = self.run(smooth, progress)?;
        // Joins of several free pieces are where the start put them. One that follows the row stays, where its distances are not
        // told from 0: then costs tell rounding, and no kinds.
        let off = (found.state.sum / self.criterion.count).sqrt();
        if (found.state.chain.pieces.len() > 1 || off > FINE * self.criterion.resolution)
            && !self.is_spent()
            && let Some(held) = self.held(&plain, found.cost)
        {
            let other = self.run(held, progress)?;
            if other.cost < found.cost {
                return Ok(other);
            }
        }
        // Free pieces that nearly follow the points may stand for lines and arcs that are not far from the first model.
        let hopeful = self.is_within(&found.state, NEARLY)
            && !self.is_near(&first.state)
            && self.row.points.len() >= ENOUGH * parts.len()
            && first.cost < found.cost + FAR;
        if !hopeful && self.is_near(&found.state) {
            return Ok(found);
        }
        let other = self.run(first, progress)?;
        Ok(if found.cost < other.cost { found } else { other })
    }

    /// One of the lines and arcs between two free pieces, where that is cheapest: the longest and those that turn most are tried. An
    /// arc that free pieces run into takes all their coefficients where they stand for it, too.
    fn held(&mut self, first: &Model, bar: f64) -> Option<Model> {
        let base = self.base(first.clone());
        let (from, to) = (base.plans.first()?.from, base.plans.last()?.to);
        let pieces = &first.state.chain.pieces;
        let turn = |k: &usize| (pieces[*k].length * pieces[*k].curvature(0.0)).abs();
        let length = |k: &usize| pieces[*k].length;
        let inner = || 1..pieces.len() - 1;
        let by_turn = inner().max_by(|a, b| turn(a).total_cmp(&turn(b)))?;
        let by_length = inner().max_by(|a, b| length(a).total_cmp(&length(b)))?;
        let mut most = vec![by_turn, by_length];
        most.dedup();
        let mut best: Option<Model> = None;
        for k in most {
            let own = base.plans[k];
            for count in COUNTS {
                let free = |from: f64, to: f64| Plan { kind: SegmentKind::Spline, count, from, to };
                let plans = [free(from, own.from), own, free(own.to, to)];
                let built = self.build(&base, &plans, f64::INFINITY);
                let mut model = self.converge(&built);
                let least = best.as_ref().map_or(bar, |b| b.cost);
                let dearer = model.cost > least;
                if model.cost < least && self.follows(&mut model.state) {
                    best = Some(model);
                } else if dearer && best.is_some() {
                    break;
                }
            }
        }
        best
    }

    /// Whether the points are no farther off than local fits tell.
    pub fn is_near(&self, state: &State) -> bool {
        self.is_within(state, KNOWN)
    }

    /// Whether the points are no farther off than so many times what local fits tell.
    fn is_within(&self, state: &State, times: f64) -> bool {
        let off = (state.sum / self.criterion.count).sqrt();
        off <= (times * self.criterion.noise).max(FINE * self.criterion.resolution)
    }

    /// As few free pieces of equal length as are cheapest in place of many lines and arcs, where that costs less than `bar`.
    fn smooth(&mut self, first: &Model, bar: f64) -> Option<Model> {
        let mut base = self.base(first.clone());
        if base.plans.len() < MANY || !self.kinds[1] {
            return None;
        }
        if !self.is_near(&first.state)
            && let Some(along) = self.along(&first.state, &base.plans)
        {
            base = along;
        }
        let (from, to) = (base.plans.first()?.from, base.plans.last()?.to);
        let mut best: Option<Model> = None;
        for pieces in PIECES {
            if self.is_spent() {
                break;
            }
            let mut better = false;
            // Several pieces are for curves that one of most coefficients cannot follow.
            let held = self.row.points.len() / EACH / pieces;
            for count in COUNTS.into_iter().filter(|c| pieces == 1 || (LONG..=held).contains(c)) {
                let at = |k: usize| from + (to - from) * k as f64 / pieces as f64;
                let plan = |k: usize| Plan { kind: SegmentKind::Spline, count, from: at(k), to: at(k + 1) };
                let plans: Vec<Plan> = (0..pieces).map(plan).collect();
                let built = self.build(&base, &plans, f64::INFINITY);
                let least = best.as_ref().map_or(bar, |b| b.cost);
                if built.cost > least + POINT_COST_TO_DROP * self.criterion.count {
                    continue;
                }
                let mut model = self.converge(&built);
                if model.cost < least && self.follows(&mut model.state) {
                    (best, better) = (Some(model), true);
                }
            }
            if best.as_ref().is_some_and(|b| !better || self.is_near(&b.state)) {
                break;
            }
        }
        best
    }
}
