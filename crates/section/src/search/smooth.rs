//! Smooth rows, of which the first partition makes many lines and arcs.

use super::model_edits::PlacedModel;
use super::parts::Part;
use super::rounds::Search;
use crate::model::chain::SegmentKind;
use crate::model::criterion::{Model, PieceSpec};
use crate::model::free;
use crate::model::least::State;
use trueness_geom::progress::{Cancelled, Progress};

/// From so many lines and arcs on, free pieces are tried in their place.
const MIN_PIECES_TO_SMOOTH: usize = 8;
/// So many pieces of equal length are tried.
const PIECE_COUNTS: [usize; 6] = [1, 2, 3, 4, 6, 8];
/// Several pieces have so many coefficients each at least.
const MIN_COEFFICIENTS_OF_SEVERAL: usize = 16;
/// And so many points to each coefficient.
const POINTS_PER_COEFFICIENT: usize = 5;
/// Numbers of their coefficients.
const COEFFICIENT_COUNTS: [usize; 8] = [4, 6, 8, 12, 16, 24, 34, free::MAX_COEFFICIENTS];
/// Where free pieces can follow the row, a dozen steps leave them no dearer than this for each point above the
/// cheapest. Their points are then 1.65 times as far off.
const POINT_COST_TO_DROP: f64 = 1.0;
/// A chain is good enough where its points are no farther off than this many times the noise that local fits tell.
const NEAR_NOISE_RATIO: f64 = 1.1;
/// Lines and arcs are searched that cost no more than so much above the cheapest found: a search takes off some pieces, hardly more.
pub(crate) const COST_TO_SEARCH: f64 = 20.0;
/// Fewer points to a line or arc do not tell it from a curve.
const MIN_POINTS_PER_LINE_OR_ARC: usize = 10;
/// Or where they are no farther off than this many times the resolution.
const NEAR_RESOLUTION_RATIO: f64 = 4.0;
/// A chain is nearly good enough up to this many times the noise.
const HOPEFUL_NOISE_RATIO: f64 = 1.3;

impl Search<'_> {
    /// The cheapest model reachable from that of the parts, or from free pieces where many lines and arcs stand for smooth curves.
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
        // Free pieces that nearly follow the points may stand for lines and arcs that are not far from the first model.
        let hopeful = self.is_within(&found.state, HOPEFUL_NOISE_RATIO)
            && !self.is_near(&first.state)
            && self.row.points.len() >= MIN_POINTS_PER_LINE_OR_ARC * parts.len()
            && first.cost < found.cost + COST_TO_SEARCH;
        if !hopeful && self.is_near(&found.state) {
            return Ok(found);
        }
        let other = self.run(first, progress)?;
        Ok(if found.cost < other.cost { found } else { other })
    }

    /// Whether the points are no farther off than local fits tell.
    pub fn is_near(&self, state: &State) -> bool {
        self.is_within(state, NEAR_NOISE_RATIO)
    }

    /// Whether the points are no farther off than so many times the noise of local fits.
    fn is_within(&self, state: &State, times: f64) -> bool {
        let off = (state.sum / self.criterion.count).sqrt();
        off <= (times * self.criterion.noise).max(NEAR_RESOLUTION_RATIO * self.criterion.resolution)
    }

    /// Free pieces in place of runs of many lines and arcs, where that costs less than `bar`.
    fn smooth(&mut self, first: &Model, bar: f64) -> Option<Model> {
        let mut placed = self.placed(first.clone());
        if placed.specs.len() < MIN_PIECES_TO_SMOOTH || !self.kinds[1] {
            return None;
        }
        let mut specs = self.gathered(&placed);
        let own = specs.as_ref().unwrap_or(&placed.specs);
        if !self.is_near(&first.state)
            && let Some(along) = self.arcs_along_smooth_curve(&first.state, own)
        {
            (specs, placed) = (specs.map(|_| along.specs.clone()), along);
        }
        let mut best: Option<Model> = None;
        // A B-spline by itself takes other coefficients than pieces that go on into each other.
        for count in COEFFICIENT_COUNTS.into_iter().take_while(|_| specs.is_some()) {
            let of =
                |p: &PieceSpec| if p.kind == SegmentKind::Spline { PieceSpec { count, ..*p } } else { *p };
            let own: Vec<PieceSpec> = specs.iter().flatten().map(of).collect();
            best = self.cheaper(&placed, &own, bar, best);
        }
        if best.is_some() {
            return best;
        }
        let (from, to) = (placed.specs.first()?.from, placed.specs.last()?.to);
        for pieces in PIECE_COUNTS {
            if self.is_spent() {
                break;
            }
            let before = best.as_ref().map(|b| b.cost);
            // Several pieces are for curves that one of most coefficients cannot follow.
            let held = self.row.points.len() / POINTS_PER_COEFFICIENT / pieces;
            for count in COEFFICIENT_COUNTS
                .into_iter()
                .filter(|c| pieces == 1 || (MIN_COEFFICIENTS_OF_SEVERAL..=held).contains(c))
            {
                let at = |k: usize| from + (to - from) * k as f64 / pieces as f64;
                let spec =
                    |k: usize| PieceSpec { kind: SegmentKind::Spline, count, from: at(k), to: at(k + 1) };
                best = self.cheaper(&placed, &(0..pieces).map(spec).collect::<Vec<_>>(), bar, best);
            }
            let better = best.as_ref().map(|b| b.cost) != before;
            if best.as_ref().is_some_and(|b| !better || self.is_near(&b.state)) {
                break;
            }
        }
        best
    }

    /// The model of these plans where it costs less than `bar` and the best one so far; else that.
    fn cheaper(
        &mut self,
        placed: &PlacedModel,
        specs: &[PieceSpec],
        bar: f64,
        best: Option<Model>,
    ) -> Option<Model> {
        let least = best.as_ref().map_or(bar, |b| b.cost);
        let built = self.build(placed, specs, f64::INFINITY);
        if built.cost > least + POINT_COST_TO_DROP * self.criterion.count {
            return best;
        }
        let mut model = self.converge(&built);
        if model.cost < least && self.is_followed(&mut model.state) { Some(model) } else { best }
    }
}
