//! Number and kinds of the pieces of a smooth row: a search over merging, splitting and changing pieces by a penalized
//! likelihood, each model refined as a whole.

use super::chain::{Chain, Piece, Pose, SegmentKind};
use super::free;
use super::least::{Row, SOFT, STIFF, State, Stop, Work};
use super::start::Part;
use crate::progress::{Cancelled, Progress};
use std::cell::Cell;

/// What a model costs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Criterion {
    /// Standard deviation of the noise known beforehand, and of how many degrees of freedom that knowledge is.
    pub noise: f64,
    pub degrees: f64,
    /// Distances below this are not told from 0.
    pub resolution: f64,
    /// Points that count.
    pub count: f64,
}

/// Cost beyond that of its unknowns of an arc and of a free piece: simple kinds are the likelier ones.
const ARC: f64 = 1.0;
const FREE: f64 = 1.5;
/// A model that is dearer than the best by this much after four steps is not refined.
const HOPELESS: f64 = 30.0;

impl Criterion {
    /// Twice the negative logarithm of the likelihood, the variance of the noise eliminated, plus the penalty of Schwarz
    /// for each unknown; a join counts twice, as its place was chosen among many.
    pub fn cost(&self, state: &State) -> f64 {
        // A piece without points is made up.
        if state.breaks.windows(2).any(|w| w[0] >= w[1]) {
            return f64::INFINITY;
        }
        // An arc that meets itself is none of a contour, but a whole circle's ends may overlap by their noise.
        let pieces = &state.chain.pieces;
        let meets_itself = |p: &Piece| {
            p.kind == SegmentKind::Arc && (p.length * p.curvature(0.0)).abs() >= std::f64::consts::TAU
        };
        if pieces.len() > 1 && pieces.iter().any(meets_itself) {
            return f64::INFINITY;
        }
        self.cost_of(state.sum, self.penalty(&state.chain))
    }
    /// What a sum of squares and so many unknowns cost.
    pub fn cost_of(&self, sum: f64, unknowns: f64) -> f64 {
        let total = self.count + self.degrees;
        let floor = self.resolution * self.resolution;
        let sum = sum + self.degrees * self.noise * self.noise;
        total * libm::log(sum / total + floor) + unknowns * libm::log(self.count)
    }
    /// The sum of squares at which a chain would cost so much.
    fn sum_at(&self, cost: f64, chain: &Chain) -> f64 {
        let total = self.count + self.degrees;
        let mean = libm::exp((cost - self.penalty(chain) * libm::log(self.count)) / total);
        (mean - self.resolution * self.resolution) * total - self.degrees * self.noise * self.noise
    }
    /// Unknowns of a chain as the criterion counts them.
    pub fn penalty(&self, chain: &Chain) -> f64 {
        let each = |p: &Piece| match p.kind {
            SegmentKind::Line => 0.0,
            SegmentKind::Arc => 1.0 + ARC,
            SegmentKind::Spline => p.coefficients.len() as f64 + FREE,
        };
        2.0 + 2.0 * chain.joins() as f64 + chain.pieces.iter().map(each).sum::<f64>()
    }
}

/// A model with what it costs.
#[derive(Clone, Debug)]
pub(super) struct Model {
    pub state: State,
    pub cost: f64,
}

/// A piece to be made: its kind, the number of its coefficients if it is free, and where it begins and ends on the model it
/// comes from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    pub kind: SegmentKind,
    pub count: usize,
    pub from: f64,
    pub to: f64,
}

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
        let points = self.row.points;
        let n = points.len();
        let mut lengths = vec![0.0; parts.len()];
        for (g, part) in parts.iter().enumerate() {
            let chord = |i: usize, j: usize| {
                libm::hypot(points[j % n][0] - points[i % n][0], points[j % n][1] - points[i % n][1])
            };
            // Chords of a smoothed row: noise makes the row itself longer.
            let (from, to) = (part.from, part.to + usize::from(g + 1 < parts.len() || closed));
            let stride = ((to - from) / 6).max(1);
            let mut i = from;
            while i < to - 1 {
                let j = (i + stride).min(to - 1);
                let flat = chord(i, j);
                let bend = (0.5 * part.curvature.abs() * flat).min(0.999);
                lengths[g] += if bend > 1e-6 { 2.0 * libm::asin(bend) / part.curvature.abs() } else { flat };
                i = j;
            }
            lengths[g] = lengths[g].max(2.0 * self.spacing);
        }
        let pieces = parts
            .iter()
            .zip(&lengths)
            .map(|(part, length)| match part.kind {
                SegmentKind::Line => Piece::line(*length),
                _ => Piece::arc(*length, part.curvature),
            })
            .collect();
        let part = &parts[0];
        let heading = libm::atan2(part.along[1], part.along[0]) - 0.5 * part.curvature * lengths[0];
        let mut breaks: Vec<usize> = parts.iter().map(|p| p.from).collect();
        breaks.push(breaks[0] + n);
        let chain = Chain { start: points[part.from % n], heading, pieces, closed: false, even: false };
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
            let base = Base::new(self, best.clone());
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

    /// The same model with `more` coefficients to each free piece.
    pub fn looser(&mut self, model: &Model, more: usize) -> Model {
        let base = Base::new(self, model.clone());
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
        let plans = base.plans();
        let mut best: Option<Model> = None;
        for change in base.changes(&plans, self) {
            let bar = best.as_ref().map_or(base.model.cost, |b| b.cost.min(base.model.cost));
            let mut model = self.build(base, &change, bar);
            if best.as_ref().is_none_or(|b| model.cost < b.cost) && self.follows(&mut model.state) {
                best = Some(model);
            }
        }
        best
    }
}

/// A model with the places of its joins and points along it.
pub(super) struct Base {
    model: Model,
    stations: Vec<f64>,
    /// Of the points, in the order of the chain.
    order: Vec<f64>,
    pub plans: Vec<Plan>,
}

impl Base {
    pub fn new(search: &mut Search, mut model: Model) -> Base {
        let row = search.row;
        let all = search.work.stations(&row, &mut model.state);
        let n = row.points.len();
        let first = model.state.breaks[0];
        let mut order: Vec<f64> = (0..n).map(|i| all[(first + i) % n]).collect();
        // Noise may swap neighbors; the order of the row stands.
        let mut greatest = f64::NEG_INFINITY;
        for s in &mut order {
            greatest = greatest.max(*s);
            *s = greatest;
        }
        let stations = model.state.chain.stations();
        let plans = (model.state.chain.pieces.iter().zip(stations.windows(2)))
            .map(|(p, w)| Plan { kind: p.kind, count: p.coefficients.len(), from: w[0], to: w[1] })
            .collect();
        Base { model, stations, order, plans }
    }

    fn plans(&self) -> Vec<Plan> {
        self.plans.clone()
    }

    fn coefficients(&self, plan: &Plan) -> Vec<f64> {
        let chain = &self.model.state.chain;
        let width = (plan.to - plan.from) / (2.0 * plan.count as f64);
        free::places(plan.count)
            .iter()
            .map(|t| {
                let s = plan.from + t * (plan.to - plan.from);
                let (a, b) = ((s - width).max(plan.from), (s + width).min(plan.to));
                chain.mean_curvature(&self.stations, a, b)
            })
            .collect()
    }

    /// Every model one step away: as lists of plans.
    fn changes(&self, plans: &[Plan], search: &Search) -> Vec<Vec<Plan>> {
        let mut all = vec![];
        let n = plans.len();
        let replace = |i: usize, j: usize, new: &[Plan]| [&plans[..i], new, &plans[j + 1..]].concat();
        let [arcs, splines] = search.kinds;
        let allowed = |kind: SegmentKind| match kind {
            SegmentKind::Line => true,
            SegmentKind::Arc => arcs,
            SegmentKind::Spline => splines,
        };
        let mut one = |i: usize, j: usize, kind: SegmentKind, count: usize| {
            let plan = Plan { kind, count, from: plans[i].from, to: plans[j].to };
            if allowed(kind) {
                all.push(replace(i, j, &[plan]));
            }
        };
        for i in 0..n {
            match plans[i].kind {
                SegmentKind::Line => one(i, i, SegmentKind::Arc, 1),
                SegmentKind::Arc => one(i, i, SegmentKind::Line, 0),
                SegmentKind::Spline => {
                    one(i, i, SegmentKind::Line, 0);
                    one(i, i, SegmentKind::Arc, 1);
                }
            }
            if plans[i].kind == SegmentKind::Spline {
                let count = plans[i].count;
                for more in [count.wrapping_sub(1), count + 1, count + 2, count + count / 2 + 1] {
                    if (2..=free::MOST).contains(&more) {
                        one(i, i, SegmentKind::Spline, more);
                    }
                }
            } else {
                [2, 3, 4, 5, 6].into_iter().for_each(|count| one(i, i, SegmentKind::Spline, count));
            }
            if i + 1 < n {
                one(i, i + 1, SegmentKind::Line, 0);
                one(i, i + 1, SegmentKind::Arc, 1);
                [3, 4, 6, 8].into_iter().for_each(|count| one(i, i + 1, SegmentKind::Spline, count));
                let most = plans[i].count.max(plans[i + 1].count);
                let both = plans[i].count + plans[i + 1].count;
                if most > 1 {
                    [most + 2, both]
                        .into_iter()
                        .filter(|c| *c <= free::MOST)
                        .for_each(|c| one(i, i + 1, SegmentKind::Spline, c));
                }
            }
        }
        for (i, j) in runs(plans) {
            if j > i + 1 {
                let longest = (j - i + 3).min(free::MOST);
                [3, 4, 5, 6, 8, 10].into_iter().for_each(|count| one(i, j, SegmentKind::Spline, count));
                if longest > 10 {
                    one(i, j, SegmentKind::Spline, longest);
                }
            }
        }
        for i in 0..n {
            self.splits(i, plans, search, &mut all);
        }
        all
    }

    /// A piece cut in two.
    fn splits(&self, i: usize, plans: &[Plan], search: &Search, all: &mut Vec<Vec<Plan>>) {
        use SegmentKind::{Arc, Line, Spline};
        let plan = plans[i];
        let width = plan.to - plan.from;
        if width < 8.0 * search.spacing {
            return;
        }
        let ways: &[(SegmentKind, SegmentKind, f64)] = match plan.kind {
            Spline => &[
                (Line, Spline, 0.12),
                (Line, Spline, 0.25),
                (Line, Spline, 0.4),
                (Spline, Line, 0.88),
                (Spline, Line, 0.75),
                (Spline, Line, 0.6),
                (Arc, Spline, 0.3),
                (Spline, Arc, 0.7),
                (Line, Arc, 0.3),
                (Line, Arc, 0.5),
                (Arc, Line, 0.5),
                (Arc, Line, 0.7),
            ],
            Arc => &[(Line, Arc, 0.3), (Line, Arc, 0.5), (Arc, Line, 0.5), (Arc, Line, 0.7), (Arc, Arc, 0.5)],
            Line => &[(Line, Arc, 0.5), (Line, Arc, 0.75), (Arc, Line, 0.25), (Arc, Line, 0.5)],
        };
        for (a, b, share) in ways {
            let at = plan.from + share * width;
            if [*a, *b].contains(&Arc) && !search.kinds[0] {
                continue;
            }
            // A free piece that lost a part needs fewer coefficients.
            let fewer = (plan.count > 4 && [*a, *b].contains(&Spline)).then_some(plan.count / 2 + 1);
            for free in std::iter::once(plan.count.max(2)).chain(fewer) {
                let count = |kind: SegmentKind| match kind {
                    Line => 0,
                    Arc => 1,
                    Spline => free,
                };
                let first = Plan { kind: *a, count: count(*a), from: plan.from, to: at };
                let second = Plan { kind: *b, count: count(*b), from: at, to: plan.to };
                all.push([&plans[..i], &[first, second], &plans[i + 1..]].concat());
            }
        }
    }
}

/// First and last of each run of pieces that are no lines.
fn runs(plans: &[Plan]) -> Vec<(usize, usize)> {
    let mut all = vec![];
    let mut start = None;
    for (i, plan) in plans.iter().enumerate() {
        match (plan.kind, start) {
            (SegmentKind::Line, Some(from)) => {
                all.push((from, i - 1));
                start = None;
            }
            (SegmentKind::Line, None) => {}
            (_, None) => start = Some(i),
            _ => {}
        }
    }
    all.extend(start.map(|from| (from, plans.len() - 1)));
    all
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
