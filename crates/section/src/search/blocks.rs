//! Long rows by one point for each block of neighbors.
//!
//! A fit of all points of a long row differs from that of the means of its blocks by less than any uncertainty. The
//! mean must be that of the distances from a chain which follows the row: the mean of the points themselves lies off a
//! bend. So a long row is fitted by blocks until nothing changes any more, and by all its points in a few steps from
//! there.

use super::profile::MAX_PROFILED_POINTS;
use super::task::{Span, Task};
use crate::model::criterion::{Criterion, Model};
use crate::model::least::{State, Work};

/// Rows of twice as many points are fitted by blocks, of which there are at least so many. Rows of so many points have
/// their intervals from the second derivative of the likelihood.
const MIN_BLOCKS: usize = MAX_PROFILED_POINTS + 1;

/// A row by blocks.
pub(super) struct Blocks {
    size: usize,
    /// Points of the row.
    count: usize,
    pub span: Span,
    /// The chain that the distances are from.
    state: State,
}

impl Blocks {
    /// The blocks of a row along a chain; `None` of rows that are not long.
    pub fn of(span: &Span, state: &State) -> Option<Blocks> {
        let count = span.points.len();
        let size = count / MIN_BLOCKS;
        if size < 2 {
            return None;
        }
        let mut state = state.clone();
        let mut work = Work::default();
        let off = work.residuals(&span.row(), &mut state).to_vec();
        let kept = |b: usize| {
            let range = b * size..count.min((b + 1) * size);
            range.filter(|i| span.weights[*i] > 0.0)
        };
        let blocks = count.div_ceil(size);
        let mean = |b: usize, of: &dyn Fn(usize) -> f64| {
            let (sum, n) = kept(b).fold((0.0, 0.0), |(sum, n), i| (sum + of(i), n + 1.0));
            if n > 0.0 { sum / n } else { of(b * size) }
        };
        let middles: Vec<[f64; 2]> =
            (0..blocks).map(|b| [0, 1].map(|k| mean(b, &|i| span.points[i][k]))).collect();
        let mut reduced = Span { numbers: vec![], points: vec![], weights: vec![] };
        let mut feet = vec![];
        for b in 0..blocks {
            let all: Vec<usize> = kept(b).collect();
            let middle = all.get(all.len() / 2).copied().unwrap_or(b * size);
            let (from, to) = (middles[b.saturating_sub(1)], middles[(b + 1).min(blocks - 1)]);
            let along = [to[0] - from[0], to[1] - from[1]];
            let length = libm::hypot(along[0], along[1]).max(f64::MIN_POSITIVE);
            let moved = (mean(b, &|i| off[i]) - off[middle]) / length;
            let p = span.points[middle];
            reduced.numbers.push(span.numbers[middle]);
            reduced.points.push([p[0] - moved * along[1], p[1] + moved * along[0]]);
            reduced.weights.push(all.iter().map(|i| span.weights[*i]).sum::<f64>() / size as f64);
            feet.push(state.feet[middle]);
        }
        let place = |i: &usize| i / count * blocks + i % count / size;
        let mut breaks: Vec<usize> = state.breaks.iter().map(place).collect();
        let last = breaks.len() - 1;
        breaks[last] = breaks[0] + blocks;
        let mut state = State { chain: state.chain, breaks, feet, sum: 0.0 };
        work.residuals(&reduced.row(), &mut state);
        Some(Blocks { size, count, span: reduced, state })
    }

    /// How the chain of the blocks is looked for.
    pub fn task<'a>(&self, task: &Task<'a>) -> Task<'a> {
        let size = self.size as f64;
        let Criterion { noise, degrees, .. } = task.criterion;
        let criterion = Criterion { noise: noise / size.sqrt(), degrees: degrees / size, ..task.criterion };
        let scatter = task.scatter / size.sqrt();
        Task { criterion, scatter, spacing: task.spacing * size, step: 1, ..*task }
    }

    /// The chain along which the blocks were made.
    pub fn model(&self) -> Model {
        Model { state: self.state.clone(), cost: 0.0 }
    }

    /// A chain fitted to the blocks, with the points of the row.
    pub fn whole(&self, found: State) -> Model {
        let blocks = self.span.points.len();
        let place = |i: &usize| i / blocks * self.count + (i % blocks * self.size).min(self.count);
        let mut breaks: Vec<usize> = found.breaks.iter().map(place).collect();
        let last = breaks.len() - 1;
        breaks[last] = breaks[0] + self.count;
        let feet = (0..self.count).map(|i| found.feet[i / self.size]).collect();
        Model { state: State { chain: found.chain, breaks, feet, sum: 0.0 }, cost: 0.0 }
    }
}
