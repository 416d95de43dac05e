//! Number and kinds of the pieces of a smooth row: a search over merging, splitting and changing pieces by a penalized
//! likelihood, each model refined as a whole.

use super::base::Base;
use super::chain::{Chain, Piece, Pose, SegmentKind, arc_end};
use super::criterion::{Criterion, Model, Plan};
use super::free;
use super::least::{Row, SOFT, STIFF, State, Stop, Work};
use super::start::Part;
use crate::progress::{Cancelled, Progress};
use std::cell::Cell;

/// A model that is dearer than the best by this much after four steps is not refined.
const HOPELESS: f64 = 30.0;

/// The search over the models of one row.
pub(super) struct Search<'a> {
    pub row: Row<'a>,
    pub criterion: Criterion,
    pub work: Work,
    /// Mean distance between points.
    pub spacing: f64,
    /// Kinds that are allowed besides lines.
    pub kinds: [bool; 2],
    /// At joins of free pieces the curvature must not jump.
    pub even: bool,
    /// Set where the search is given up because it takes long from this end of the row; `None`: it is not given up.
    pub hasty: Option<&'a Cell<bool>>,
    /// Least length of a piece, in distances between points.
    pub shortest: f64,
}

impl Search<'_> {
    fn stop(&self, steps: usize, gain: f64) -> Stop {
        Stop { steps, gain, shortest: self.shortest * self.spacing, stiff: SOFT, target: f64::INFINITY }
    }

    /// The model of the parts that dynamic programming found.
    pub fn first(&mut self, parts: &[Part], closed: bool) -> Model {
        let lengths = self.lengths(parts, closed);
        let part = &parts[0];
        let heading = libm::atan2(part.along[1], part.along[0]) - 0.5 * part.curvature * lengths[0];
        let own: Vec<f64> = parts.iter().map(|p| p.curvature).collect();
        self.first_of(parts, &lengths, &own, heading, closed)
    }

    /// The model of parts that turn from one to the next as they do by themselves, the cheapest without and with lines that follow a
    /// line; for where the headings of many parts add up to one far off, and parts are lost on the way back.
    pub fn turned(&mut self, parts: &[Part], closed: bool) -> Model {
        let mut of = |parts: &[Part]| {
            let lengths = self.lengths(parts, closed);
            let (heading, turning) = self.turning(parts, &lengths);
            self.first_of(parts, &lengths, &turning, heading, closed)
        };
        let (bent, model) = (without_bends(parts), of(parts));
        if bent.len() == parts.len() {
            return model;
        }
        let other = of(&bent);
        if other.cost < model.cost { other } else { model }
    }

    /// Lengths of parts: chords of a smoothed row, as noise makes the row itself longer.
    fn lengths(&self, parts: &[Part], closed: bool) -> Vec<f64> {
        let points = self.row.points;
        let n = points.len();
        let chord = |i: usize, j: usize| {
            libm::hypot(points[j % n][0] - points[i % n][0], points[j % n][1] - points[i % n][1])
        };
        let length = |(g, part): (usize, &Part)| {
            let (from, to) = (part.from, part.to + usize::from(g + 1 < parts.len() || closed));
            let stride = ((to - from) / 6).max(1);
            let (mut i, mut length) = (from, 0.0);
            while i < to - 1 {
                let j = (i + stride).min(to - 1);
                let flat = chord(i, j);
                let bend = (0.5 * part.curvature.abs() * flat).min(0.999);
                length += if bend > 1e-6 { 2.0 * libm::asin(bend) / part.curvature.abs() } else { flat };
                i = j;
            }
            length.max(2.0 * self.spacing)
        };
        parts.iter().enumerate().map(length).collect()
    }

    /// The heading at the start, and curvatures with which parts of these lengths turn from one to the next as the parts by themselves
    /// do, whatever their own ones: lines tell where the arcs beside them begin and end.
    fn turning(&self, parts: &[Part], lengths: &[f64]) -> (f64, Vec<f64>) {
        let points = self.row.points;
        let (n, last) = (points.len(), parts.len() - 1);
        let angle = |part: &Part, i: usize| {
            let [x, y] = part.heading(points[i % n]);
            libm::atan2(y, x)
        };
        let heading = angle(&parts[0], parts[0].from);
        let mut before = heading;
        let mut turned = |g: usize| {
            let part = &parts[g];
            let own = part.curvature * lengths[g];
            let end = angle(part, part.to - 1);
            let after = match (part.kind, parts.get(g + 1)) {
                (SegmentKind::Line, _) => angle(part, part.from),
                (_, Some(next)) if next.kind == SegmentKind::Line => angle(next, next.from),
                (_, Some(next)) => end + 0.5 * wrapped(angle(next, next.from) - end),
                (_, None) => end,
            };
            let turn = own + wrapped(after - before - own);
            before = after;
            if part.kind == SegmentKind::Line { 0.0 } else { turn / lengths[g] }
        };
        (heading, (0..=last).map(&mut turned).collect())
    }

    /// The model of parts of these lengths and curvatures.
    fn first_of(
        &mut self,
        parts: &[Part],
        lengths: &[f64],
        curvatures: &[f64],
        heading: f64,
        closed: bool,
    ) -> Model {
        let points = self.row.points;
        let n = points.len();
        let piece = |((part, length), curvature): ((&Part, &f64), &f64)| match part.kind {
            SegmentKind::Line => Piece::line(*length),
            _ => Piece::arc(*length, *curvature),
        };
        let pieces = parts.iter().zip(lengths).zip(curvatures).map(piece).collect();
        let mut breaks: Vec<usize> = parts.iter().map(|p| p.from).collect();
        breaks.push(breaks[0] + n);
        let chain = Chain { start: points[parts[0].from % n], heading, pieces, closed: false, even: false };
        let feet = vec![0.5; n];
        let mut state = State { chain, breaks, feet, sum: 0.0 };
        let stop = self.stop(60, 1e-6);
        self.work.improve(&self.row, &mut state, None, &stop);
        if closed || self.even {
            // Nearly closed by the points alone, it is closed by force.
            (state.chain.closed, state.chain.even) = (closed, self.even);
            state.breaks.iter_mut().for_each(|b| *b += if closed { n } else { 0 });
            self.work.improve(&self.row, &mut state, None, &stop);
        }
        self.model(state)
    }

    fn model(&mut self, state: State) -> Model {
        let cost = self.criterion.cost(&state);
        Model { cost: if cost.is_nan() { f64::INFINITY } else { cost }, state }
    }

    /// What models one step from this one are built on.
    pub fn base(&mut self, mut model: Model) -> Base {
        let all = self.work.stations(&self.row, &mut model.state);
        Base::new(model, &all)
    }

    pub fn follows(&mut self, state: &mut State) -> bool {
        self.work.follows(&self.row, state, self.spacing)
    }

    /// Converged; as it was where that runs into a loop.
    pub fn settle(&mut self, model: &Model) -> Model {
        let mut state = model.state.clone();
        let stop = self.stop(60, 1e-11);
        self.work.improve(&self.row, &mut state, None, &stop);
        if state.chain.closed || state.chain.even {
            self.work.improve(&self.row, &mut state, None, &Stop { stiff: STIFF, ..stop });
        }
        let mut before = model.state.clone();
        match self.follows(&mut state) || !self.follows(&mut before) {
            true => self.model(state),
            false => self.model(before),
        }
    }

    /// The model made of `plans` on `base`; given up early where a few steps leave it far above the cost `bar`.
    pub fn build(&mut self, base: &Base, plans: &[Plan], bar: f64) -> Model {
        let chain = &base.model.state.chain;
        let pieces: Vec<Piece> = plans
            .iter()
            .map(|plan| {
                let length = (plan.to - plan.from).max(2.0 * self.spacing);
                let coefficients = match plan.kind {
                    SegmentKind::Line => vec![],
                    SegmentKind::Arc => vec![chain.mean_curvature(&base.stations, plan.from, plan.to)],
                    SegmentKind::Spline => base.coefficients(plan),
                };
                Piece { kind: plan.kind, length, coefficients }
            })
            .collect();
        let n = self.row.points.len();
        let first = base.model.state.breaks[0];
        let mut breaks: Vec<usize> =
            plans.iter().map(|p| first + base.order.partition_point(|s| *s < p.from)).collect();
        breaks[0] = first;
        breaks.push(first + n);
        let mut feet = vec![0.5; n];
        for (g, plan) in plans.iter().enumerate().filter(|(_, p)| p.kind == SegmentKind::Spline) {
            for i in breaks[g]..breaks[g + 1] {
                feet[i % n] = (base.order[i - first] - plan.from) / (plan.to - plan.from);
            }
        }
        let chain = Chain { start: chain.start, heading: chain.heading, pieces, ..*chain };
        let mut state = State { chain, breaks, feet, sum: 0.0 };
        let target = self.criterion.sum_at(bar, &state.chain);
        let stop = Stop { target, ..self.stop(4, 1e-4) };
        self.work.improve(&self.row, &mut state, None, &stop);
        let model = self.model(state);
        if model.cost > bar + HOPELESS {
            return model;
        }
        let mut state = model.state;
        let stop = Stop { target, ..self.stop(8, 1e-4) };
        self.work.improve(&self.row, &mut state, None, &stop);
        self.model(state)
    }

    /// The cheapest model reachable from the first.
    pub fn run(&mut self, first: Model, progress: &dyn Progress) -> Result<Model, Cancelled> {
        let mut best = first;
        let mut idle = 0;
        for _ in 0..60 {
            if progress.cancelled() {
                return Err(Cancelled);
            }
            let base = self.base(best.clone());
            let found = self.round(&base);
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
            }
        }
        Ok(self.settle(&best))
    }

    /// The cheapest model over two chains, where one costs less than `bar`.
    pub fn over(
        &mut self,
        base: &Base,
        first: usize,
        bar: f64,
        progress: &dyn Progress,
    ) -> Result<Option<Model>, Cancelled> {
        let mut best: Option<Model> = None;
        for plans in base.joined(first) {
            let least = best.as_ref().map_or(bar, |b| b.cost);
            let mut model = self.build(base, &plans, least);
            if model.cost < least && self.follows(&mut model.state) {
                best = Some(model);
            }
        }
        best.map(|model| self.run(model, progress)).transpose()
    }

    /// The cheapest model whose end is tangent to its start, of one whose ends, this `gap` apart, meet in a corner, where that costs
    /// less than `bar`.
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
            if model.cost < best.as_ref().map_or(bar, |b| b.cost) && self.follows(&mut model.state) {
                best = Some(model);
            }
        }
        best.map(|model| self.run(model, progress)).transpose()
    }

    /// The same model with `more` coefficients to each free piece.
    pub fn looser(&mut self, model: &Model, more: usize) -> Model {
        let base = self.base(model.clone());
        if base.plans.iter().all(|p| p.kind != SegmentKind::Spline) {
            return model.clone();
        }
        let mut plans = base.plans.clone();
        plans
            .iter_mut()
            .filter(|p| p.kind == SegmentKind::Spline)
            .for_each(|p| p.count = (p.count + more).min(free::MOST));
        let built = self.build(&base, &plans, f64::INFINITY);
        self.settle(&built)
    }

    /// The best of all models one step away.
    fn round(&mut self, base: &Base) -> Option<Model> {
        let mut best: Option<Model> = None;
        for change in base.changes(self.kinds, self.spacing) {
            let bar = best.as_ref().map_or(base.model.cost, |b| b.cost.min(base.model.cost));
            let mut model = self.build(base, &change, bar);
            if best.as_ref().is_none_or(|b| model.cost < b.cost) && self.follows(&mut model.state) {
                best = Some(model);
            }
        }
        best
    }
}

/// The parts without lines that follow a line: of two, the shorter belongs to its other neighbor, or to the longer.
fn without_bends(parts: &[Part]) -> Vec<Part> {
    let mut all: Vec<Part> = parts.to_vec();
    let is_line = |part: Option<&Part>| part.is_some_and(|p| p.kind == SegmentKind::Line);
    while let Some(k) = (1..all.len()).find(|k| is_line(all.get(*k)) && is_line(all.get(k - 1))) {
        let count = |k: usize| all[k].to - all[k].from;
        if count(k - 1) < count(k) {
            let gone = all.remove(k - 1);
            match k.checked_sub(2) {
                Some(before) => all[before].to = gone.to,
                None => all[0].from = gone.from,
            }
        } else {
            let gone = all.remove(k);
            match all.get_mut(k) {
                Some(after) => after.from = gone.from,
                None => all[k - 1].to = gone.to,
            }
        }
    }
    all
}

/// An angle from −π to π.
fn wrapped(angle: f64) -> f64 {
    angle - std::f64::consts::TAU * (angle / std::f64::consts::TAU).round()
}

/// A closed state that starts `by` pieces later.
pub(super) fn rotated(state: &State, by: usize, count: usize) -> State {
    let chain = &state.chain;
    let mut layout = super::chain::Layout::default();
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
