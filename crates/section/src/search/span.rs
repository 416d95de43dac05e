//! A part of a row between two corners, or a whole closed row without any: one chain.

use super::blocks::Blocks;
use super::model_edits::PlacedModel;
use super::parts::{Part, shares};
use super::profile::Interval;
use super::rounds::Search;
use super::task::{Span, Task};
use crate::model::chain::{Layout, Piece, Pose, SegmentKind, arc_end};
use crate::model::criterion::Model;
use crate::model::flat::angle;
use crate::model::free;
use crate::model::least::{Spread, State, Work};
use crate::model::prior::NEGLIGIBLE_OFFSET_SPACINGS;
use trueness_geom::progress::{Cancelled, Progress};

/// Coefficients that a free piece has more while intervals are found than the criterion chose. The chosen piece alone takes its own
/// shape for certain, and intervals come out too short.
const EXTRA_COEFFICIENTS: usize = 2;

/// A chain is unreliable whose points lie farther off than this many times their noise.
const MAX_RMS_RATIO: f64 = 10.0;
/// The noise counts as this share of the distance between points at least. The larger one holds where the row is too
/// short to tell its noise.
const MIN_NOISE_SPACINGS: [f64; 2] = [NEGLIGIBLE_OFFSET_SPACINGS, 0.02];
/// Length of a reliable chain over the way from point to point; the second range holds where noise makes that way longer.
const LENGTH_RATIOS: [std::ops::Range<f64>; 2] = [0.6..1.6, 0.3..1.6];
/// Noise of more than this share of the distance between points makes the way longer, and is not known well where a row is short.
const MAX_QUIET_NOISE_SPACINGS: f64 = 0.25;
/// A chain is then looked for from so many equal parts.
const EQUAL_PARTS: usize = 4;
/// Each of these has so many points at least.
const MIN_POINTS_PER_EQUAL_PART: usize = 4;

/// Steps by all points from where blocks of them have led to.
const POLISHING_STEPS: usize = 6;
/// More points than this are thinned while pieces are looked for.
const MAX_SEARCHED_POINTS: usize = 1500;

/// A chain found.
pub(crate) struct Found {
    pub span: Span,
    /// The chain does not run along its points.
    pub unreliable: bool,
    /// One arc that is a whole circle.
    pub circle: bool,
    pub state: State,
    pub layout: Layout,
    pub intervals: Vec<Interval>,
    pub spread: Option<Spread>,
    /// Standard deviation of the noise.
    pub noise: f64,
    pub residuals: Vec<f64>,
    pub stations: Vec<f64>,
}

impl Span {
    /// Sum of squares of the chain of these parts.
    pub fn sum(&self, parts: &[Part], task: &Task) -> f64 {
        let mut search = self.search(task);
        let first = search.first(parts, false);
        search.converge(&first).state.sum
    }

    /// Finds the pieces and the intervals of the joins.
    pub fn find(self, parts: &[Part], task: &Task, progress: &dyn Progress) -> Result<Found, Cancelled> {
        if task.draft {
            let mut search = self.search(task);
            let state = search.first(parts, task.closed).state;
            let (unreliable, work) = (self.is_unreliable(&state, task), search.take_work());
            drop(search);
            return Ok(Found { unreliable, ..self.found((state, vec![], task.scatter, work)) });
        }
        let mut best = self.search_from(parts, task, progress)?;
        if self.is_unreliable(&best.state, task)
            && EQUAL_PARTS * MIN_POINTS_PER_EQUAL_PART <= self.points.len()
            && !task.budget.is_spent(0.0)
        {
            let other =
                self.search_from(&shares(&self.points, &self.weights, EQUAL_PARTS), task, progress)?;
            if other.cost < best.cost || !self.is_unreliable(&other.state, task) {
                best = other;
            }
        }
        let mut search = self.search(task);
        let found = match Blocks::of(&self, &best.state).filter(|_| best.state.chain.joins() > 0) {
            None => with_intervals(&mut search, best, task, progress)?,
            Some(blocks) => {
                let own = blocks.task(task);
                let (_, intervals, ..) =
                    with_intervals(&mut blocks.span.search(&own), blocks.model(), &own, progress)?;
                let noise = search.variance(&best.state).0.sqrt();
                (best.state, intervals, noise, search.take_work())
            }
        };
        drop(search);
        let unreliable = self.is_unreliable(&found.0, task);
        Ok(Found { unreliable, ..self.found(found) })
    }

    /// One chain over two that follow each other, or a closed one over one whose ends meet, where that costs less than
    /// `bar`. This span has the points of all.
    pub fn chain_over(
        self,
        founds: &[&Found],
        bar: f64,
        task: &Task,
        progress: &dyn Progress,
    ) -> Result<Option<Found>, Cancelled> {
        let mut search = self.search(task);
        let model = match founds {
            [a, b] => {
                let turn = angle(a.beyond(true, 0.0).along, b.beyond(false, 0.0).along);
                let both = [a, b].map(|f| (&f.state, f.stations.clone()));
                let placed = PlacedModel::of_both(both, turn, task.spacing);
                let along = search.arcs_along_smooth_curve(&placed.model.state, &placed.specs);
                search.chain_over(&[Some(placed), along], a.pieces().len() - 1, bar, progress)?
            }
            [one] => {
                // From the chain's end to its start, whose pieces end where these do.
                let gap = task.spacing + one.last_foot() - one.first_foot();
                search.closing(&one.state, gap, bar, progress)?
            }
            _ => None,
        };
        let Some(model) = model else { return Ok(None) };
        let found = with_intervals(&mut search, model, task, progress)?;
        drop(search);
        let own = found.0.breaks.windows(2).map(|w| w[1].saturating_sub(w[0]));
        let is_loose = own.zip(&found.0.chain.pieces).any(|(count, piece)| piece.is_loose(count));
        let unreliable = is_loose || self.is_unreliable(&found.0, task);
        Ok((!unreliable).then(|| self.found(found)))
    }

    /// The chain of a state, with the intervals of its joins.
    pub fn refined(self, state: State, task: &Task, progress: &dyn Progress) -> Result<Found, Cancelled> {
        let mut search = self.search(task);
        let found = with_intervals(&mut search, Model { state, cost: 0.0 }, task, progress)?;
        drop(search);
        let unreliable = self.is_unreliable(&found.0, task);
        Ok(Found { unreliable, ..self.found(found) })
    }

    /// Whether a chain does not run along its points.
    fn is_unreliable(&self, state: &State, task: &Task) -> bool {
        let n = self.points.len();
        let count = self.weights.iter().sum::<f64>().max(1.0);
        let noise = task.scatter;
        let least = MIN_NOISE_SPACINGS[usize::from(noise <= 0.0)] * task.spacing;
        let off = (state.sum / count).sqrt();
        // Only a whole circle's ends may overlap, by their noise.
        let turns = |p: &Piece| p.length * p.curvature(0.0) / std::f64::consts::TAU;
        let most = if state.chain.pieces.len() == 1 { 1.2 } else { 1.0 };
        let meets_itself = |p: &Piece| p.kind == SegmentKind::Arc && turns(p).abs() > most;
        if state.chain.pieces.iter().any(meets_itself) {
            return true;
        }
        if !state.sum.is_finite()
            || off > MAX_RMS_RATIO * noise.max(least)
            || state.breaks.windows(2).any(|w| w[0] >= w[1])
        {
            return true;
        }
        if n < 3 {
            return false;
        }
        let kept: Vec<[f64; 2]> =
            (0..n).filter(|i| self.weights[*i] > 0.0).step_by(task.step).map(|i| self.points[i]).collect();
        let far = |a: [f64; 2], b: [f64; 2]| libm::hypot(b[0] - a[0], b[1] - a[1]);
        let mut way: f64 = kept.windows(2).map(|w| far(w[0], w[1])).sum();
        let length = if state.chain.closed {
            way += far(kept[kept.len() - 1], kept[0]);
            state.chain.pieces.iter().map(|p| p.length).sum()
        } else {
            let stations = Work::default().stations(&self.row(), &mut state.clone());
            // Below 0 where the chain runs against the order of the points.
            stations[n - 1] - stations[0]
        };
        way > 0.0
            && !LENGTH_RATIOS[usize::from(noise > MAX_QUIET_NOISE_SPACINGS * task.spacing * task.step as f64)]
                .contains(&(length / way))
    }

    /// The pieces found from a start of these parts.
    fn search_from(&self, parts: &[Part], task: &Task, progress: &dyn Progress) -> Result<Model, Cancelled> {
        let thin = self.points.len().div_ceil(MAX_SEARCHED_POINTS).max(task.step);
        if thin > 1 {
            return self.find_thinned(parts, task, thin, progress);
        }
        let mut search = self.search(task);
        if task.known {
            return Ok(search.known(parts, task.closed));
        }
        search.best(parts, task.closed, progress)
    }

    /// The pieces by every `step`-th point alone, then refined by all.
    fn find_thinned(
        &self,
        parts: &[Part],
        task: &Task,
        step: usize,
        progress: &dyn Progress,
    ) -> Result<Model, Cancelled> {
        let numbers: Vec<usize> = (0..self.points.len()).step_by(step).collect();
        let mut kept: Vec<Part> = vec![];
        for part in parts {
            let [from, to] = [part.from, part.to].map(|i| i.div_ceil(step));
            if to > from {
                kept.push(Part { from, to, ..*part });
            }
        }
        // The points left tell the shared errors instead of the others.
        let weights: Vec<f64> = self.weights.iter().map(|w| (w * step as f64).min(1.0)).collect();
        let own = Span::new(&self.points, &weights, numbers);
        let thinned = Task { spacing: task.spacing * step as f64, step: 1, ..*task };
        let mut search = own.search(&thinned);
        let found = search.best(&kept, task.closed, progress)?.state;
        let n = self.points.len();
        let thinned_count = own.points.len();
        // Round and round a closed row, the place of a point among all.
        let place =
            |i: usize| (i / thinned_count * n + i % thinned_count * step).min(i / thinned_count * n + n);
        let mut breaks: Vec<usize> = found.breaks.iter().map(|i| place(*i)).collect();
        let last = breaks.len() - 1;
        breaks[last] = breaks[0] + n;
        let feet = (0..n).map(|i| found.feet[(i / step).min(thinned_count - 1)]).collect();
        let mut search = self.search(task);
        let state = State { chain: found.chain, breaks, feet, sum: 0.0 };
        let Some(blocks) = Blocks::of(self, &state) else {
            return Ok(search.converge(&Model { state, cost: 0.0 }));
        };
        let by_blocks = blocks.span.search(&blocks.task(task)).converge(&blocks.model());
        let model = blocks.whole(by_blocks.state);
        Ok(search.converge_within(&model, POLISHING_STEPS))
    }

    fn found(self, (state, intervals, noise, mut work): (State, Vec<Interval>, f64, Work)) -> Found {
        let row = self.row();
        let mut state = state;
        let spread = work.spread(&row, &mut state);
        let residuals = work.residuals(&row, &mut state).to_vec();
        let stations = work.stations(&row, &mut state);
        Found {
            unreliable: false,
            circle: false,
            state,
            layout: std::mem::take(&mut work.layout),
            intervals,
            spread,
            noise,
            residuals,
            stations,
            span: self,
        }
    }
}

/// The best model once more, with the intervals of its joins; where the profile of a join finds a better place, from there.
fn with_intervals(
    search: &mut Search,
    mut best: Model,
    task: &Task,
    progress: &dyn Progress,
) -> Result<(State, Vec<Interval>, f64, Work), Cancelled> {
    let mut intervals = vec![];
    for round in 0..3 {
        let last = round == 2;
        if progress.cancelled() {
            return Err(Cancelled);
        }
        if best.state.chain.joins() == 0 || single(&best.state) {
            break;
        }
        let looser = search.looser(&best, EXTRA_COEFFICIENTS);
        let own = looser.state.chain == best.state.chain;
        // Intervals of a model that is not the last are of no use.
        let mut better = if own || last { None } else { search.better(&best, task.level) };
        if better.is_none() {
            let (found, lower) = search.intervals(&looser, task.level);
            intervals = found;
            better = lower.filter(|_| own);
            if !own {
                search.around(&mut intervals, &best, task.level);
            }
        }
        let Some(state) = better.filter(|_| !last) else { break };
        best = search.converge(&Model { state, cost: 0.0 });
    }
    let noise = search.variance(&best.state).0.sqrt();
    Ok((best.state, intervals, noise, search.take_work()))
}

/// A closed chain of one piece joins itself where it happens to start.
pub(crate) fn single(state: &State) -> bool {
    state.chain.closed && state.chain.pieces.len() == 1
}

impl Found {
    pub fn pieces(&self) -> &[Piece] {
        &self.state.chain.pieces
    }
    /// Number of its unknowns.
    pub fn unknowns(&self) -> f64 {
        let each = self.pieces().iter().map(|p| p.coefficients.len() as f64);
        2.0 + self.state.chain.joins() as f64 + each.sum::<f64>()
    }
    /// Standard deviation of its points about it.
    pub fn scatter(&self) -> f64 {
        let spare = self.span.weights.iter().sum::<f64>() - self.unknowns();
        (self.state.sum / spare.max(1.0)).sqrt()
    }
    /// Where the foot of the first point lies from the chain's start, along it.
    pub fn first_foot(&self) -> f64 {
        self.stations[self.state.breaks[0] % self.stations.len()]
    }
    /// Where the foot of the last point lies from the chain's end, along it.
    pub fn last_foot(&self) -> f64 {
        let (n, count) = (self.pieces().len(), self.stations.len());
        let length: f64 = self.pieces().iter().map(|p| p.length).sum();
        self.stations[(self.state.breaks[n] + count - 1) % count] - length
    }
    /// The widest gap between feet on a free piece, in spans of its curvature; 0 of a line or arc.
    pub fn widest(&self, g: usize) -> f64 {
        let piece = &self.pieces()[g];
        if piece.kind != SegmentKind::Spline {
            return 0.0;
        }
        let at = |i: usize| self.stations[i % self.stations.len()];
        let own = self.state.breaks[g]..self.state.breaks[g + 1].saturating_sub(1);
        let gap = own.map(|i| (at(i + 1) - at(i)).abs()).fold(0.0, f64::max);
        gap / piece.length * free::spans(piece.coefficients.len()) as f64
    }
    /// Length along the chain from the first to the last foot of its last or first piece.
    pub fn extent(&self, at_end: bool) -> f64 {
        let breaks = &self.state.breaks;
        let g = if at_end { breaks.len() - 2 } else { 0 };
        let at = |i: usize| self.stations[i % self.stations.len()];
        (at(breaks[g + 1] - 1) - at(breaks[g])).abs()
    }
    /// The kind of its last or first piece.
    pub fn end_kind(&self, at_end: bool) -> SegmentKind {
        let pieces = self.pieces();
        pieces[if at_end { pieces.len() - 1 } else { 0 }].kind
    }
    /// Mean distance between the feet of its last or first piece; 0 of one.
    pub fn local_spacing(&self, at_end: bool) -> f64 {
        let breaks = &self.state.breaks;
        let g = if at_end { breaks.len() - 2 } else { 0 };
        self.extent(at_end) / (breaks[g + 1] - breaks[g]).saturating_sub(1).max(1) as f64
    }
    /// The longest of the three steps between its last or first feet.
    pub fn last_step(&self, at_end: bool) -> f64 {
        let breaks = &self.state.breaks;
        let range = breaks[0]..breaks[breaks.len() - 1];
        let near_end = if at_end {
            range.end.saturating_sub(4).max(range.start)..range.end
        } else {
            range.start..range.end.min(range.start + 4)
        };
        let at = |i: usize| self.stations[i % self.stations.len()];
        near_end.clone().skip(1).map(|i| (at(i) - at(i - 1)).abs()).fold(0.0, f64::max)
    }
    /// The pose at the chain's first or last end, moved along by `length` as the piece there goes on.
    pub fn beyond(&self, at_end: bool, length: f64) -> Pose {
        let n = self.pieces().len();
        let (pose, piece, t) = match at_end {
            true => (self.layout.poses[n], &self.pieces()[n - 1], 1.0),
            false => (self.layout.poses[0], &self.pieces()[0], 0.0),
        };
        let turn = piece.curvature(t) * length;
        Pose::new(pose.place(arc_end(length, turn)), pose.heading + turn)
    }
}
