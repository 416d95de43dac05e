//! Number and kinds of the pieces of a smooth row. A search goes over merging, splitting and changing pieces by a
//! penalized likelihood, and refines each model as a whole.

use super::model_edits::PlacedModel;
use crate::model::budget::Budget;
use crate::model::chain::{Chain, Piece, Pose, SegmentKind, arc_end};
use crate::model::criterion::{Criterion, Model, PieceSpec, Unknowns};
use crate::model::free;
use crate::model::least::{Row, State, Stop, Work};
use trueness_geom::progress::{Cancelled, Progress};

/// A model that is dearer than the best by this much after four steps is not refined.
const COST_TO_DROP: f64 = 30.0;

/// A model may have the same kinds, fewer unknowns, and be dearer by no more than so much for each point. It is refined
/// all the same. Where a curvature grows from 0, a join moves slowly.
const SLOW_COST_PER_POINT: f64 = 0.2;

/// Products after which a search ends with the cheapest model so far: some seconds. Rows of some dozen segments take a hundredth.
/// Smooth curves of many turns, which are many arcs at first and few free pieces in the end, would take minutes.
const MAX_PRODUCTS_PER_SEARCH: f64 = 5e9;

/// The search over the models of one row.
pub(crate) struct Search<'a> {
    pub row: Row<'a>,
    pub criterion: Criterion,
    pub work: Work,
    /// Mean distance between points.
    pub spacing: f64,
    /// Kinds that are allowed besides lines.
    pub kinds: [bool; 2],
    /// At joins of free pieces the curvature must not jump.
    pub even: bool,
    /// Products that all searches of a contour may take from now on, those of this one when it ends.
    pub budget: &'a Budget,
    /// Least length of a piece, in distances between points.
    pub shortest: f64,
    /// Products after which a search ends.
    pub until: f64,
}

impl Drop for Search<'_> {
    fn drop(&mut self) {
        self.budget.take(self.work.effort);
    }
}

impl Search<'_> {
    /// Whether the searches of the contour have used up their budget.
    pub fn is_spent(&self) -> bool {
        self.budget.is_spent(self.work.effort)
    }

    /// The working memory of the last state that was measured.
    pub fn take_work(&mut self) -> Work {
        let effort = std::mem::take(&mut self.work.effort);
        self.budget.take(effort);
        std::mem::take(&mut self.work)
    }

    pub fn stop(&self, steps: usize, gain: f64) -> Stop {
        Stop { steps, gain, shortest: self.shortest * self.spacing, exact: false, target: f64::INFINITY }
    }

    pub fn model(&mut self, state: State) -> Model {
        let cost = self.criterion.cost(&state);
        Model { cost: if cost.is_nan() { f64::INFINITY } else { cost }, state }
    }

    /// The model that models one step from this one are built on.
    pub fn placed(&mut self, mut model: Model) -> PlacedModel {
        let all = self.work.stations(&self.row, &mut model.state);
        PlacedModel::new(model, &all)
    }

    pub fn is_followed(&mut self, state: &mut State) -> bool {
        self.work.is_followed(&self.row, state, self.spacing)
    }

    /// Converged; as it was where that runs into a loop.
    pub fn converge(&mut self, model: &Model) -> Model {
        self.converge_within(model, 60)
    }

    /// The same within so many steps.
    pub fn converge_within(&mut self, model: &Model, steps: usize) -> Model {
        let mut state = model.state.clone();
        let stop = self.stop(steps, 1e-11);
        self.work.improve(&self.row, &mut state, None, &stop);
        if state.chain.closed || state.chain.even || state.chain.ends.end.is_some() {
            self.work.improve(&self.row, &mut state, None, &Stop { exact: true, ..stop });
        }
        let mut before = model.state.clone();
        match self.is_followed(&mut state) || !self.is_followed(&mut before) {
            true => self.model(state),
            false => self.model(before),
        }
    }

    /// The model made of `specs` on `placed`; given up early where a few steps leave it far above the cost `bar`.
    pub fn build(&mut self, placed: &PlacedModel, specs: &[PieceSpec], bar: f64) -> Model {
        let chain = &placed.model.state.chain;
        let pieces: Vec<Piece> = specs
            .iter()
            .map(|spec| {
                let length = (spec.to - spec.from).max(2.0 * self.spacing);
                let coefficients = match spec.kind {
                    SegmentKind::Line => vec![],
                    SegmentKind::Arc => vec![chain.mean_curvature(&placed.stations, spec.from, spec.to)],
                    SegmentKind::Spline => placed.coefficients(spec),
                };
                Piece { kind: spec.kind, length, coefficients }
            })
            .collect();
        let n = self.row.points.len();
        let first = placed.model.state.breaks[0];
        let mut breaks: Vec<usize> =
            specs.iter().map(|p| first + placed.order.partition_point(|s| *s < p.from)).collect();
        breaks[0] = first;
        breaks.push(first + n);
        let mut feet = vec![0.5; n];
        for (g, spec) in specs.iter().enumerate().filter(|(_, p)| p.kind == SegmentKind::Spline) {
            for i in breaks[g]..breaks[g + 1] {
                feet[i % n] = (placed.order[i - first] - spec.from) / (spec.to - spec.from);
            }
        }
        let chain = Chain { start: chain.start, heading: chain.heading, pieces, ..*chain };
        let mut state = State { chain, breaks, feet, sum: 0.0 };
        let target = self.criterion.sum_at(bar, &state.chain);
        let stop = Stop { target, ..self.stop(4, 1e-4) };
        self.work.improve(&self.row, &mut state, None, &stop);
        let model = self.model(state);
        if model.cost > bar + COST_TO_DROP {
            return model;
        }
        let mut state = model.state;
        let stop = Stop { target, ..self.stop(8, 1e-4) };
        self.work.improve(&self.row, &mut state, None, &stop);
        self.model(state)
    }

    /// The cheapest model reachable from the first, as far as the search may go. Steps of a long one are looked for by
    /// pieces near each other; where that does not lead to the points, by all pieces.
    pub fn run(&mut self, first: Model, progress: &dyn Progress) -> Result<Model, Cancelled> {
        let long = first.state.chain.is_long();
        let start = long.then(|| first.clone());
        let mut found = self.rounds(first, long, progress)?;
        if let Some(start) = start.filter(|_| !self.is_near(&found.state)) {
            let other = self.rounds(start, false, progress)?;
            if other.cost < found.cost {
                found = other;
            }
        }
        Ok(self.converge(&found))
    }

    /// Rounds of the search.
    fn rounds(
        &mut self,
        first: Model,
        by_neighborhood: bool,
        progress: &dyn Progress,
    ) -> Result<Model, Cancelled> {
        let mut best = first;
        let mut idle = 0;
        let mut unchanged = vec![];
        self.until = self.work.effort + MAX_PRODUCTS_PER_SEARCH.min(self.budget.left());
        for _ in 0..60 {
            if progress.cancelled() {
                return Err(Cancelled);
            }
            if self.work.effort > self.until {
                self.budget.cut_short();
                break;
            }
            let placed = self.placed(best.clone());
            let found = if by_neighborhood && best.state.chain.is_long() {
                self.round_nearby(&placed, &mut unchanged)
            } else {
                unchanged.clear();
                self.round(&placed)
            };
            match found.filter(|f| f.cost < best.cost - 1e-6) {
                Some(found) => {
                    idle = 0;
                    best = found;
                }
                None => idle += 1,
            }
            let pieces = best.state.chain.pieces.len();
            if !best.state.chain.closed || pieces < 2 || idle > 1 {
                if idle > 0 {
                    break;
                }
            } else {
                // The seam goes to another join, so that the pair over it is seen too.
                best.state = rotated(&best.state, pieces / 2, self.row.points.len());
                if unchanged.len() == pieces {
                    unchanged.rotate_left(pieces / 2);
                }
            }
        }
        Ok(best)
    }

    /// The cheapest model over two chains, built on one of these, where one costs less than `bar`.
    pub fn chain_over(
        &mut self,
        bases: &[Option<PlacedModel>],
        first: usize,
        bar: f64,
        progress: &dyn Progress,
    ) -> Result<Option<Model>, Cancelled> {
        let mut best: Option<Model> = None;
        for placed in bases.iter().flatten() {
            for specs in placed.joined(first) {
                let least = best.as_ref().map_or(bar, |b| b.cost);
                let mut model = self.build(placed, &specs, least);
                if (least..least + COST_TO_DROP).contains(&model.cost) {
                    model = self.converge(&model);
                }
                if model.cost < least && self.is_followed(&mut model.state) {
                    best = Some(model);
                }
            }
        }
        best.map(|model| self.run(model, progress)).transpose()
    }

    /// The cheapest model whose end is tangent to its start, where that costs less than
    /// `bar`. The ends of the given one, this `gap` apart, meet in a corner.
    pub fn closing(
        &mut self,
        state: &State,
        gap: f64,
        bar: f64,
        progress: &dyn Progress,
    ) -> Result<Option<Model>, Cancelled> {
        let mut best: Option<Model> = None;
        // Either end goes on to the other.
        for ahead in [true, false] {
            let mut state = state.clone();
            let n = self.row.points.len();
            let chain = &mut state.chain;
            chain.closed = true;
            let last = chain.pieces.len() - 1;
            if ahead {
                chain.pieces[last].length += gap;
            } else {
                let turn = -gap * chain.pieces[0].curvature(0.0);
                chain.start = Pose::new(chain.start, chain.heading).place(arc_end(-gap, turn));
                chain.heading += turn;
                chain.pieces[0].length += gap;
            }
            state.breaks.iter_mut().for_each(|b| *b += n);
            let stop = self.stop(60, 1e-6);
            self.work.improve(&self.row, &mut state, None, &stop);
            let mut model = self.model(state);
            if model.cost < best.as_ref().map_or(bar, |b| b.cost) && self.is_followed(&mut model.state) {
                best = Some(model);
            }
        }
        best.map(|model| self.run(model, progress)).transpose()
    }

    /// The same model with `more` coefficients to each free piece, or half as many again where that is more.
    pub fn looser(&mut self, model: &Model, more: usize) -> Model {
        let placed = self.placed(model.clone());
        if placed.specs.iter().all(|p| p.kind != SegmentKind::Spline) {
            return model.clone();
        }
        let mut specs = placed.specs.clone();
        specs
            .iter_mut()
            .filter(|p| p.kind == SegmentKind::Spline)
            .for_each(|p| p.count = (p.count + more.max(p.count / 2)).min(free::MAX_COEFFICIENTS));
        let built = self.build(&placed, &specs, f64::INFINITY);
        self.converge(&built)
    }

    /// The best of all models one step away.
    fn round(&mut self, placed: &PlacedModel) -> Option<Model> {
        self.round_of(placed, |_| true)
    }

    /// The best of those models one step away that are asked for.
    pub fn round_of(
        &mut self,
        placed: &PlacedModel,
        is_asked: impl Fn(&[PieceSpec]) -> bool,
    ) -> Option<Model> {
        let mut best: Option<Model> = None;
        let own = Unknowns::of(&placed.model.state.chain).number;
        for change in placed.changes(self.kinds, self.spacing) {
            if self.work.effort > self.until {
                self.budget.cut_short();
                break;
            }
            if !is_asked(&change) {
                continue;
            }
            let bar = best.as_ref().map_or(placed.model.cost, |b| b.cost.min(placed.model.cost));
            let mut model = self.build(placed, &change, bar);
            let kinds = |specs: &[PieceSpec]| specs.iter().map(|p| p.kind).collect::<Vec<_>>();
            let fewer =
                Unknowns::of(&model.state.chain).number < own && kinds(&change) == kinds(&placed.specs);
            if fewer && (bar..bar + SLOW_COST_PER_POINT * self.criterion.count).contains(&model.cost) {
                model = self.converge(&model);
            }
            if best.as_ref().is_none_or(|b| model.cost < b.cost) && self.is_followed(&mut model.state) {
                best = Some(model);
            }
        }
        best
    }
}

/// A closed state that starts `by` pieces later.
pub(super) fn rotated(state: &State, by: usize, count: usize) -> State {
    let chain = &state.chain;
    let mut layout = crate::model::chain::Layout::default();
    layout.fill(chain);
    let Pose { at, heading, .. } = layout.poses[by];
    let mut pieces = chain.pieces.clone();
    pieces.rotate_left(by);
    let mut breaks: Vec<usize> = state.breaks[by..state.breaks.len() - 1].to_vec();
    breaks.extend(state.breaks[..by].iter().map(|b| b + count));
    breaks.push(breaks[0] + count);
    if breaks[0] >= 2 * count {
        breaks.iter_mut().for_each(|b| *b -= count);
    }
    let chain = Chain { start: at, heading, pieces, ..*chain };
    State { chain, breaks, feet: state.feet.clone(), sum: state.sum }
}
