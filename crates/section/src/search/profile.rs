//! Where a join may lie: the likelihood as a function of its place, everything else fitted anew.

use super::near::{PieceNeighborhood, spliced};
use super::rounds::Search;
use crate::model::chain::{Layout, Pose};
use crate::model::criterion::Model;
use crate::model::least::{Held, State, Stop};
use trueness_geom::num::special::student_quantile;

/// The places that the data allow for a join.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The join with everything fitted anew, at either end.
    pub ends: [[f64; 2]; 2],
    /// Standard uncertainty of the place along the curve: the interval's length over that of the unit normal, or Student's,
    /// distribution.
    pub uncertainty: f64,
    /// The end is that of a neighboring segment, or the interval was not followed farther: the data allow more.
    pub open: [bool; 2],
}

impl Interval {
    /// Whether a place is between the ends, or no farther beside or beyond them than half their distance.
    fn holds(&self, at: [f64; 2]) -> bool {
        let [a, b] = self.ends;
        let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        libm::hypot(at[0] - middle[0], at[1] - middle[1]) <= libm::hypot(b[0] - a[0], b[1] - a[1])
    }
}

/// Farthest that an interval is followed to either side, in distances between points.
const MAX_INTERVAL_SPACINGS: f64 = 25.0;

/// Ends of intervals are found to about this share of their distance. The root of the growth of the sum of squares is
/// straight but for a third of it at most. A secant over this share of it misses 2 %.
const INTERVAL_END_ACCURACY: f64 = 0.06;

/// Share of the growth of the sum of squares to the end of an interval that a fit with the join held may miss.
const GROWTH_SLACK_SHARE: f64 = 0.01;

/// The likelihood of longer rows is normal, and its second derivative tells the intervals: nothing is fitted anew. So too where the
/// search has taken all it may.
pub(super) const MAX_PROFILED_POINTS: usize = 6000;

impl Search<'_> {
    /// Standard deviation of the noise, its square, and its degrees of freedom.
    pub fn variance(&self, state: &State) -> (f64, f64) {
        let unknowns = 2.0
            + state.chain.joins() as f64
            + state.chain.pieces.iter().map(|p| p.coefficients.len() as f64).sum::<f64>();
        let degrees = (self.criterion.count - unknowns).max(1.0) + self.criterion.degrees;
        let sum = state.sum + self.criterion.degrees * self.criterion.noise * self.criterion.noise;
        ((sum / degrees).max(self.criterion.resolution * self.criterion.resolution), degrees)
    }

    /// Intervals of all joins at the confidence `level`, and a better model if one was found on the way.
    pub fn intervals(&mut self, model: &Model, level: f64) -> (Vec<Interval>, Option<State>) {
        let (quantile, seeks) = self.seeks(model, level);
        let mut better = None;
        let mut all = vec![];
        for seek in seeks {
            let Pose { at, along, .. } = seek.pose;
            let mut interval = Interval { ends: [at; 2], uncertainty: 0.0, open: [false; 2] };
            if self.row.points.len() > MAX_PROFILED_POINTS || self.is_spent() {
                interval.ends =
                    [-seek.first, seek.first].map(|x| [at[0] + x * along[0], at[1] + x * along[1]]);
                interval.uncertainty = seek.first / quantile;
                all.push(interval);
                continue;
            }
            let lower = match model.state.chain.is_long() {
                true => self.with_pieces_near(model, &seek, |search, best, seek| {
                    search.both(best, seek, &mut interval)
                }),
                false => self.both(&model.state, &seek, &mut interval),
            };
            better = least(better, lower, &model.state);
            let [a, b] = interval.ends;
            interval.uncertainty = libm::hypot(b[0] - a[0], b[1] - a[1]) / (2.0 * quantile);
            all.push(interval);
        }
        (all, better)
    }

    /// Follows a join to both ends of its interval; a lower state found on the way.
    fn both(&mut self, best: &State, seek: &EndSearch, interval: &mut Interval) -> Option<State> {
        let mut better = None;
        for (side, sign) in [-1.0, 1.0].into_iter().enumerate() {
            let (end, open, lower) = self.follow(best, &EndSearch { sign, ..*seek });
            (interval.ends[side], interval.open[side]) = (end, open);
            better = least(better, lower, best);
        }
        better
    }

    /// The answer of `look` for a join of a long chain with the pieces near it alone. A lower state of these is one of
    /// all.
    fn with_pieces_near(
        &mut self,
        model: &Model,
        seek: &EndSearch,
        look: impl FnOnce(&mut Search, &State, &EndSearch) -> Option<State>,
    ) -> Option<State> {
        let mut layout = Layout::default();
        layout.fill(&model.state.chain);
        let near = PieceNeighborhood::at_join(&self.row, &model.state, &layout, seek.join);
        if near.is_empty() {
            return None;
        }
        let mut search = near.search(self, &model.state, 0.0);
        let best = search.converge(&Model { state: near.state.clone(), cost: 0.0 }).state;
        let join = near.core.start + 1;
        let pose = search.pose_of(&best, join);
        let lower = look(&mut search, &best, &EndSearch { join, pose, ..*seek })?;
        // Pieces around the seam of a closed chain stay as they are.
        let whole = near.pieces.end <= model.state.chain.pieces.len();
        whole.then(|| self.with(model, &near, lower)).flatten()
    }

    /// The state of a long chain with these pieces changed, where its sum of squares is lower for it.
    fn with(&mut self, model: &Model, near: &PieceNeighborhood, lower: State) -> Option<State> {
        let row = self.row;
        let mut state = spliced(&model.state, &[(near.pieces.clone(), lower)], row.points.len());
        self.work.improve(&row, &mut state, None, &self.stop(30, 1e-6));
        Some(state).filter(|s| s.sum < lower_than(&model.state))
    }

    /// Takes the model's own interval of each join that is not between the ends of that of a looser one. Joins of free
    /// pieces may be elsewhere there.
    pub fn around(&mut self, intervals: &mut [Interval], model: &Model, level: f64) {
        let first = usize::from(!model.state.chain.closed);
        let mut layout = Layout::default();
        layout.fill(&model.state.chain);
        let unreliable: Vec<usize> = (0..intervals.len())
            .filter(|k| layout.poses.get(first + k).is_some_and(|pose| !intervals[*k].holds(pose.at)))
            .collect();
        if !unreliable.is_empty() {
            let own = self.intervals(model, level).0;
            unreliable.into_iter().filter(|k| *k < own.len()).for_each(|k| intervals[k] = own[k]);
        }
    }

    /// A better model where a join is held at an end of the interval that the second derivative of the likelihood tells.
    pub fn better(&mut self, model: &Model, level: f64) -> Option<State> {
        if self.row.points.len() > MAX_PROFILED_POINTS || self.is_spent() {
            return None;
        }
        let mut better = None;
        for seek in self.seeks(model, level).1 {
            let lower = match model.state.chain.is_long() {
                true => self.with_pieces_near(model, &seek, |search, best, seek| search.lower(best, seek)),
                false => self.lower(&model.state, &seek),
            };
            better = least(better, lower, &model.state);
        }
        better
    }

    /// A lower state where the join is held at either end.
    fn lower(&mut self, best: &State, seek: &EndSearch) -> Option<State> {
        let mut better = None;
        for sign in [-1.0, 1.0] {
            let seek = EndSearch { sign, ..*seek };
            let held = self.hold(best, &seek, seek.first.min(MAX_INTERVAL_SPACINGS * self.spacing));
            better = least(better, held.filter(|h| h.sum < lower_than(best)), best);
        }
        better
    }

    /// Student's quantile, and where the ends of the intervals are first looked for: to the right.
    fn seeks(&mut self, model: &Model, level: f64) -> (f64, Vec<EndSearch>) {
        let (variance, degrees) = self.variance(&model.state);
        let quantile = student_quantile(1.0 - level, degrees);
        let growth = variance * quantile * quantile;
        let mut state = model.state.clone();
        let row = self.row;
        let spreads = self.work.spread(&row, &mut state);
        let first = usize::from(!state.chain.closed);
        let all = (first..state.chain.pieces.len())
            .map(|join| {
                let spread =
                    spreads.as_ref().map_or(self.spacing, |s| s.places[join - first] * variance.sqrt());
                let spread = spread.clamp(1e-7 * self.spacing, 5.0 * self.spacing);
                EndSearch {
                    join,
                    sign: 1.0,
                    first: quantile * spread,
                    growth,
                    pose: self.work.layout.poses[join],
                }
            })
            .collect();
        (quantile, all)
    }

    /// The state with a join held so far from where it is best, all else fitted anew from `start`. `None` where a
    /// neighboring join is in the way.
    fn hold(&mut self, start: &State, seek: &EndSearch, x: f64) -> Option<State> {
        // The sum of squares may miss the least one by so much.
        let gain = GROWTH_SLACK_SHARE * seek.growth / (start.sum + seek.growth).max(f64::MIN_POSITIVE);
        let (shortest, target) = (0.5 * self.spacing, f64::INFINITY);
        let stop = Stop { steps: 14, gain: gain.max(1e-12), shortest, exact: true, target };
        let (at, along) = (seek.pose.at, seek.pose.along);
        let value = at[0] * along[0] + at[1] * along[1] + seek.sign * x;
        let held = Held { join: seek.join, along, value };
        let mut state = start.clone();
        let row = self.row;
        let sound = self.work.improve(&row, &mut state, Some(&held), &stop);
        let place = self.place_of(&state, seek);
        let off = (place[0] * along[0] + place[1] * along[1] - value).abs();
        (sound && off < 1e-3 * x).then_some(state)
    }

    /// Moves a join until the sum of squares reaches the limit. Secants go on the root of its growth, which is straight
    /// where the likelihood is normal. Gives the end, whether it is open, and a lower state found on the way.
    fn follow(&mut self, best: &State, seek: &EndSearch) -> ([f64; 2], bool, Option<State>) {
        let farthest = MAX_INTERVAL_SPACINGS * self.spacing;
        let wanted = seek.growth.max(f64::MIN_POSITIVE).sqrt();
        let mut low = HeldState { x: 0.0, root: 0.0, state: best.clone() };
        let mut high: Option<HeldState> = None;
        // Beyond this a neighboring join is in the way.
        let mut wall = f64::INFINITY;
        let mut lower: Option<State> = None;
        let mut x = seek.first.min(farthest);
        for _ in 0..24 {
            // From the state that is nearest.
            let start = match &high {
                Some(high) if high.x - x < x - low.x => &high.state,
                _ => &low.state,
            };
            let start = start.clone();
            match self.hold(&start, seek, x) {
                None => wall = x,
                Some(state) => {
                    if state.sum < lower_than(best) {
                        lower = Some(state.clone());
                    }
                    let root = (state.sum - best.sum).max(0.0).sqrt();
                    if (root - wanted).abs() < INTERVAL_END_ACCURACY * wanted {
                        // So near the root is as good as straight: the end lies on the line from where the join is best.
                        let place = self.place_of(&state, seek);
                        let from = seek.pose.at;
                        let end = [0, 1].map(|k| from[k] + (place[k] - from[k]) * wanted / root);
                        return (end, false, lower);
                    }
                    let tried = HeldState { x, root, state };
                    if root >= wanted {
                        high = Some(tried);
                    } else {
                        low = tried;
                    }
                }
            }
            let right = high.as_ref().map_or(wall, |h| h.x.min(wall));
            if low.x >= farthest {
                return (self.place_of(&low.state, seek), true, lower);
            }
            if right.is_finite() && right - low.x < INTERVAL_END_ACCURACY * right {
                let (at, open) =
                    high.as_ref().filter(|h| h.x < wall).map_or((&low.state, true), |h| (&h.state, false));
                let at = at.clone();
                return (self.place_of(&at, seek), open, lower);
            }
            x = match &high {
                Some(high) if high.x < wall => {
                    let share = (wanted - low.root) / (high.root - low.root);
                    low.x + (high.x - low.x) * share.clamp(0.05, 0.95)
                }
                _ if wall.is_finite() => 0.5 * (low.x + wall),
                _ => {
                    let secant = if low.root > 0.0 { low.x * wanted / low.root } else { 2.0 * x };
                    secant.clamp(1.15 * x, 3.0 * x).min(farthest)
                }
            };
        }
        (self.place_of(&low.state, seek), high.is_none(), lower)
    }

    /// Where the join is.
    fn place_of(&mut self, state: &State, seek: &EndSearch) -> [f64; 2] {
        self.pose_of(state, seek.join).at
    }

    fn pose_of(&mut self, state: &State, join: usize) -> Pose {
        self.work.layout.fill(&state.chain);
        self.work.layout.poses[join]
    }
}

/// A join on its way to an end of its interval.
#[derive(Clone, Copy)]
struct EndSearch {
    join: usize,
    sign: f64,
    first: f64,
    /// Limit of the growth of the sum of squares.
    growth: f64,
    /// Where the join is best.
    pose: Pose,
}

/// A state with the join held so far from where it is best, and the root of the growth of the sum of squares.
struct HeldState {
    x: f64,
    root: f64,
    state: State,
}

/// Sums below this are lower than that of a state, beyond rounding.
fn lower_than(best: &State) -> f64 {
    best.sum * (1.0 - 1e-9)
}

/// The lower of two states, the new one only if that pays.
fn least(better: Option<State>, lower: Option<State>, best: &State) -> Option<State> {
    let sum = better.as_ref().map_or(best.sum, |b| b.sum);
    lower.filter(|l| l.sum < sum * (1.0 - 1e-6)).or(better)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::model::budget::Budget;
    use crate::model::chain::{Chain, Ends, Piece};
    use crate::model::criterion::Criterion;
    use crate::model::least::{Row, Work};
    use trueness_geom::num::random::Random;

    /// Intervals by the pieces near a join are those by all pieces of a chain.
    #[test]
    fn intervals_nearby_are_those_of_the_whole_chain() {
        let random = &mut Random::new(4);
        let pieces: Vec<Piece> = (0..24)
            .map(|k| match k % 4 {
                0 | 2 => Piece::line(3.0),
                1 => Piece::arc(2.0, 0.5),
                _ => Piece::arc(2.5, -0.4),
            })
            .collect();
        let chain = Chain {
            start: [0.0; 2],
            heading: 0.3,
            pieces,
            closed: false,
            even: false,
            ends: Ends::default(),
        };
        let mut layout = Layout::default();
        layout.fill(&chain);
        let (mut points, mut breaks) = (vec![], vec![0]);
        for (g, piece) in chain.pieces.iter().enumerate() {
            for i in 0..20 {
                let length = piece.length * (f64::from(i) + 0.5) / 20.0;
                let turn = length * piece.curvature(0.0);
                let p = layout.poses[g].place(crate::model::chain::arc_end(length, turn));
                points.push(p.map(|x| x + 0.01 * (random.unit() - 0.5)));
            }
            breaks.push(points.len());
        }
        let weights = vec![1.0; points.len()];
        let count = points.len() as f64;
        let mut search = Search {
            row: Row { points: &points, weights: &weights },
            criterion: Criterion {
                noise: 0.003,
                degrees: 0.0,
                resolution: 1e-9,
                count,
                points: count,
                rest: None,
            },
            work: Work::default(),
            spacing: 0.13,
            kinds: [true; 2],
            even: false,
            budget: &Budget::new(f64::INFINITY),
            shortest: 1.0,
            until: f64::INFINITY,
        };
        let state = State { chain, breaks, feet: vec![0.5; points.len()], sum: 0.0 };
        let model = search.converge(&Model { state, cost: 0.0 });
        let none = Interval { ends: [[0.0; 2]; 2], uncertainty: 0.0, open: [false; 2] };
        let seeks = search.seeks(&model, 0.95).1;
        assert_eq!(seeks.len(), 23);
        for seek in seeks {
            let (mut near, mut whole) = (none, none);
            search.both(&model.state, &seek, &mut whole);
            search.with_pieces_near(&model, &seek, |search, best, seek| search.both(best, seek, &mut near));
            let size = libm::hypot(whole.ends[1][0] - whole.ends[0][0], whole.ends[1][1] - whole.ends[0][1]);
            for (a, b) in near.ends.iter().zip(whole.ends) {
                let off = libm::hypot(a[0] - b[0], a[1] - b[1]);
                assert!(off < 0.03 * size, "join {}: {near:?} {whole:?}", seek.join);
            }
        }
    }
}
