//! A few pieces of a long chain as a chain of their own.
//!
//! A fit of all pieces costs more than the square of their number, and a search asks for some dozens of fits a piece. A
//! change at a piece hardly moves one that is several pieces away: each piece between holds place and heading by its
//! own points. So long chains are searched, and their joins profiled, by pieces near each other; then all pieces are
//! fitted together.

use super::model_edits::PlacedModel;
use super::rounds::Search;
use crate::model::chain::{Chain, Ends, Layout, Pose, SegmentKind};
use crate::model::criterion::{Model, Rest, Unknowns};
use crate::model::least::{Row, State, Work};
use std::f64::consts::TAU;
use std::ops::Range;

/// Pieces on either side that are fitted anew while models are compared.
const PIECES_BESIDE: usize = 3;
/// Pieces on either side that are fitted anew while a join is profiled. Ends of intervals in chains of arcs are then those of a fit
/// of all pieces to a hundredth.
const PIECES_BESIDE_JOIN: usize = 5;
/// Pieces that are looked at together.
const CORE_PIECES: usize = 4;

/// Pieces that follow each other, with their points.
#[derive(Clone, Debug)]
pub(super) struct PieceNeighborhood {
    /// Their numbers in the whole chain; of a closed one they may go on beyond its last piece.
    pub pieces: Range<usize>,
    /// Pieces looked at, counted from the first of these.
    pub core: Range<usize>,
    points: Vec<[f64; 2]>,
    weights: Vec<f64>,
    pub state: State,
}

impl PieceNeighborhood {
    /// The pieces about some of a chain, held where they meet the others. `around` is for a join: of a closed chain
    /// then also over its seam, with so many pieces on either side.
    fn about(
        row: &Row,
        state: &State,
        layout: &Layout,
        core: Range<usize>,
        around: Option<usize>,
    ) -> PieceNeighborhood {
        let count = state.chain.pieces.len();
        let margin = around.unwrap_or(PIECES_BESIDE);
        let (before, after) = match around.is_some() && state.chain.closed {
            true => (margin, margin),
            false => (margin.min(core.start), margin.min(count - core.end)),
        };
        // Numbers do not fall below 0.
        let turns = if before > core.start { count } else { 0 };
        let pieces = core.start + turns - before..core.end + turns + after;
        let core = before..before + core.len();
        let mut near = PieceNeighborhood { core, ..PieceNeighborhood::of(row, state, layout, pieces) };
        let open = !state.chain.closed && near.pieces.end == count;
        let end = (!open).then(|| near.end());
        near.state.chain.ends = Ends { end, ..near.state.chain.ends };
        near
    }

    /// The pieces about a join: of a closed chain also about that over its seam.
    pub fn at_join(row: &Row, state: &State, layout: &Layout, join: usize) -> PieceNeighborhood {
        let first = if join == 0 { state.chain.pieces.len() } else { join };
        PieceNeighborhood::about(row, state, layout, first - 1..first + 1, Some(PIECES_BESIDE_JOIN))
    }

    fn of(row: &Row, state: &State, layout: &Layout, pieces: Range<usize>) -> PieceNeighborhood {
        let (count, n) = (state.chain.pieces.len(), row.points.len());
        let at = |k: usize| state.breaks[k % count] + k / count * n;
        // The end of an open chain is no start of a piece.
        let end = if pieces.end == count { state.breaks[count] } else { at(pieces.end) };
        let from = at(pieces.start);
        let numbers = || (from..end).map(|i| i % n);
        let pose = &layout.poses[pieces.start % count];
        let chain = Chain {
            start: pose.at,
            heading: pose.heading,
            pieces: pieces.clone().map(|k| state.chain.pieces[k % count].clone()).collect(),
            closed: false,
            even: state.chain.even,
            ends: Ends { start: pieces.start > 0 || state.chain.closed, end: None },
        };
        let mut breaks: Vec<usize> = pieces.clone().map(|k| at(k) - from).collect();
        breaks.push(end - from);
        PieceNeighborhood {
            core: 0..pieces.len(),
            points: numbers().map(|i| row.points[i]).collect(),
            weights: numbers().map(|i| row.weights[i]).collect(),
            state: State { chain, breaks, feet: numbers().map(|i| state.feet[i]).collect(), sum: 0.0 },
            pieces,
        }
    }

    /// Whether no point belongs to the pieces.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// The pose in which the pieces end.
    fn end(&self) -> Pose {
        let mut layout = Layout::default();
        layout.fill(&self.state.chain);
        layout.poses[self.state.chain.pieces.len()]
    }

    pub fn row(&self) -> Row<'_> {
        Row { points: &self.points, weights: &self.weights }
    }

    /// The search over these pieces: the cost of their models counts the rest of the chain too.
    pub fn search<'b>(&'b self, whole: &Search<'b>, all: &State, own: f64) -> Search<'b> {
        let (all_unknowns, unknowns) = (Unknowns::of(&all.chain), Unknowns::of(&self.state.chain));
        let rest = Rest { sum: (all.sum - own).max(0.0), unknowns: all_unknowns.less(unknowns) };
        let criterion = crate::model::criterion::Criterion { rest: Some(rest), ..whole.criterion };
        Search {
            row: self.row(),
            criterion,
            work: Work::default(),
            budget: whole.budget,
            until: f64::INFINITY,
            ..*whole
        }
    }
}

/// A state with other pieces in place of some. Each entry is a range of its pieces and the state of their points alone.
/// The ranges are in rising order, apart from each other, and none is around the seam.
pub(super) fn spliced(state: &State, changed: &[(Range<usize>, State)], count: usize) -> State {
    let mut chain = Chain { pieces: vec![], ..state.chain.clone() };
    let (mut breaks, mut feet) = (vec![], state.feet.clone());
    let mut next = 0;
    for (pieces, own) in changed {
        chain.pieces.extend_from_slice(&state.chain.pieces[next..pieces.start]);
        breaks.extend_from_slice(&state.breaks[next..pieces.start]);
        if pieces.start == 0 {
            (chain.start, chain.heading) = (own.chain.start, own.chain.heading);
        }
        let from = state.breaks[pieces.start];
        chain.pieces.extend(own.chain.pieces.iter().cloned());
        breaks.extend(own.breaks[..own.breaks.len() - 1].iter().map(|b| b + from));
        own.feet.iter().enumerate().for_each(|(i, t)| feet[(from + i) % count] = *t);
        next = pieces.end;
    }
    chain.pieces.extend_from_slice(&state.chain.pieces[next..]);
    breaks.extend_from_slice(&state.breaks[next..]);
    State { chain, breaks, feet, sum: state.sum }
}

impl Search<'_> {
    /// A cheaper model than a long one. It is the best of all steps near each few pieces, as many as do not touch each
    /// other, combined. If those together are no cheaper, it is the best alone. `idle` tells the pieces near which no
    /// step has paid since they changed.
    pub fn round_nearby(&mut self, placed: &PlacedModel, idle: &mut Vec<bool>) -> Option<Model> {
        let model = &placed.model;
        let count = model.state.chain.pieces.len();
        idle.resize(count, false);
        let mut layout = Layout::default();
        layout.fill(&model.state.chain);
        let mut found: Vec<(f64, Range<usize>, State)> = vec![];
        for first in (0..count).step_by(CORE_PIECES) {
            let core = first..(first + CORE_PIECES).min(count);
            if idle[core.clone()].iter().all(|i| *i) {
                continue;
            }
            let near = PieceNeighborhood::about(&self.row, &model.state, &layout, core.clone(), None);
            match self.step_near(&near, model) {
                Some((cost, state)) if cost < model.cost - 1e-6 => {
                    found.push((cost, near.pieces.clone(), state));
                }
                _ => idle[core].fill(true),
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut apart: Vec<(Range<usize>, State)> = vec![];
        for (_, pieces, state) in &found {
            if apart.iter().all(|(p, _)| p.end <= pieces.start || pieces.end <= p.start) {
                apart.push((pieces.clone(), state.clone()));
            }
        }
        // Together, then the better half of them, …, then the best alone.
        let mut tried_together = apart.len();
        while tried_together > 0 {
            let mut changed = apart[..tried_together].to_vec();
            changed.sort_by_key(|(pieces, _)| pieces.start);
            let tried = self.together(model, &changed);
            if let Some(tried) = tried.filter(|t| t.cost < model.cost - 1e-6) {
                spread_idle(idle, &changed);
                return Some(tried);
            }
            tried_together /= 2;
        }
        None
    }

    /// The best step that begins in the core, with its cost.
    fn step_near(&mut self, near: &PieceNeighborhood, model: &Model) -> Option<(f64, State)> {
        if near.is_empty() {
            return None;
        }
        let mut state = near.state.clone();
        self.work.residuals(&near.row(), &mut state);
        let own = state.sum;
        let mut search = near.search(self, &model.state, own);
        let start = search.model(state);
        let placed = search.placed(start);
        let inside = |specs: &[crate::model::criterion::PieceSpec]| {
            let same = specs.iter().zip(&placed.specs).take_while(|(a, b)| a == b).count();
            near.core.contains(&same)
        };
        let best = search.round_of(&placed, inside);
        best.map(|best| (best.cost, best.state))
    }

    /// The model with these pieces changed, all fitted together.
    fn together(&mut self, model: &Model, changed: &[(Range<usize>, State)]) -> Option<Model> {
        let mut state = spliced(&model.state, changed, self.row.points.len());
        let stop = self.stop(30, 1e-6);
        let row = self.row;
        self.work.improve(&row, &mut state, None, &stop);
        let mut tried = self.model(state);
        self.is_followed(&mut tried.state).then_some(tried)
    }

    /// A long chain of the pieces of `state`, whose joins are tangent but whose pieces may lie far off their points. It
    /// is fitted from its start on, each piece with those before it.
    pub fn grown(&mut self, state: &State) -> State {
        let (row, count) = (self.row, state.chain.pieces.len());
        let mut grown = state.clone();
        let mut layout = Layout::default();
        let stop = self.stop(30, 1e-4);
        for next in 0..count {
            // By itself first, with its join: that brings it to its points.
            for before in [1, PIECES_BESIDE_JOIN] {
                layout.fill(&grown.chain);
                let near =
                    PieceNeighborhood::of(&row, &grown, &layout, next.saturating_sub(before)..next + 1);
                if near.is_empty() {
                    continue;
                }
                let mut state = near.state.clone();
                self.work.improve(&near.row(), &mut state, None, &stop);
                state.chain.ends = Ends::default();
                grown = spliced(&grown, &[(near.pieces, state)], row.points.len());
            }
        }
        grown
    }
}

/// A state without the pieces that have no points, whose length a neighbor has, and without whole turns of arcs.
pub(super) fn mended(state: &State) -> State {
    let mut state = state.clone();
    for piece in state.chain.pieces.iter_mut().filter(|p| p.kind == SegmentKind::Arc) {
        // The end of an arc is that of one shorter by a turn.
        let curvature = piece.coefficients[0].abs();
        let turns = (piece.length * curvature / TAU).floor();
        if turns > 0.0 {
            piece.length -= turns * TAU / curvature;
        }
    }
    let mut g = 0;
    while state.chain.pieces.len() > 1 && g < state.chain.pieces.len() {
        if state.breaks[g] < state.breaks[g + 1] {
            g += 1;
            continue;
        }
        let gone = state.chain.pieces.remove(g);
        // Where a piece begins that has none, the next one does.
        state.breaks.remove(if g == 0 { 1 } else { g });
        state.chain.pieces[g.saturating_sub(1)].length += gone.length;
    }
    state
}

/// After these changes: near them all is to be looked at again.
fn spread_idle(idle: &mut Vec<bool>, changed: &[(Range<usize>, State)]) {
    for (pieces, own) in changed.iter().rev() {
        let new = std::iter::repeat_n(false, own.chain.pieces.len());
        idle.splice(pieces.clone(), new);
    }
}
