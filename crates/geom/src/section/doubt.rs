//! Corners that are none.
//!
//! The first partition is of lines and arcs, each by itself. A curve whose curvature changes fast is a few short arcs there that do not
//! meet with a common tangent, however tangent the curve is. So each blunt corner is doubted: one chain is looked for over both
//! sides, and where it costs less than two chains and the corner, there is none.

use super::plan::{Chains, Plan, SHARP};
use super::result::SectionError;
use super::search::Criterion;
use super::span::{Found, Span};
use super::start::Part;
use crate::progress::Progress;

/// Corners that are doubted: of more, those that turn least. Each takes a search.
const DOUBTED: usize = 12;
/// Cost of a corner in unknowns, beyond those of the chains on both sides: its place among the points was chosen among many.
const CORNER: f64 = 3.0;

/// Of two neighboring chains what both cost, and how far the row turns between them.
struct Pair {
    first: usize,
    turn: f64,
}

impl Plan<'_> {
    /// The chains between corners, without corners that cost more than a chain over them.
    pub(super) fn chains(&self, parts: &[Part], progress: &dyn Progress) -> Result<Chains, SectionError> {
        let mut all = self.all(parts, progress)?;
        if self.forced.is_some() || self.known || self.draft {
            return Ok(all);
        }
        let mut tried: Vec<[usize; 2]> = vec![];
        for _ in 0..DOUBTED {
            let Some(pair) = self.bluntest(&all, &tried) else { break };
            let next = (pair.first + 1) % all.founds.len();
            let [a, b] = [pair.first, next].map(|k| all.founds[k].span.numbers[0]);
            tried.push([a, b]);
            let Some((found, parts)) = self.over(&all, pair.first, next, progress)? else { continue };
            all.founds[pair.first] = found;
            all.parts[pair.first] = parts;
            all.founds.remove(next);
            all.parts.remove(next);
        }
        Ok(all)
    }

    /// The pair of chains, not yet tried, that turn least from one to the next.
    fn bluntest(&self, all: &Chains, tried: &[[usize; 2]]) -> Option<Pair> {
        let count = all.founds.len();
        let pairs = if self.clean.closed && count > 2 { count } else { count - 1 };
        let pair = |k: usize| {
            let (a, b) = (&all.founds[k], &all.founds[(k + 1) % count]);
            let (u, v) = (a.beyond(true, 0.0).along, b.beyond(false, 0.0).along);
            let turn = libm::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]).abs();
            let seen = tried.contains(&[a.span.numbers[0], b.span.numbers[0]]);
            (turn < SHARP && !seen).then_some(Pair { first: k, turn })
        };
        (0..pairs).filter_map(pair).min_by(|a, b| a.turn.total_cmp(&b.turn))
    }

    /// One chain over two, where that costs less.
    fn over(
        &self,
        all: &Chains,
        first: usize,
        next: usize,
        progress: &dyn Progress,
    ) -> Result<Option<(Found, Vec<Part>)>, SectionError> {
        let (a, b) = (&all.founds[first], &all.founds[next]);
        let numbers = [&a.span.numbers[..], &b.span.numbers].concat();
        let (cut, count) = (a.span.numbers.len(), numbers.len());
        let moved = all.parts[next].iter().map(|p| Part { from: p.from + cut, to: p.to + cut, ..*p });
        let parts: Vec<Part> = all.parts[first].iter().copied().chain(moved).collect();
        let span = Span::new(&self.clean.points, self.weights, numbers);
        let task = self.task(false, count == self.clean.points.len(), count);
        let criterion = task.criterion;
        let found = span.find(&parts, &task, progress)?;
        let cost = |founds: &[&Found]| cost(&criterion, founds);
        let own = found.state.breaks.windows(2).map(|w| w[1].saturating_sub(w[0]));
        let is_loose = own.zip(found.pieces()).any(|(count, piece)| piece.is_loose(count));
        let pays = !found.astray && !is_loose && (a.astray || b.astray || cost(&[&found]) < cost(&[a, b]));
        Ok(pays.then_some((found, parts)))
    }
}

/// What chains cost, and the corners between them.
fn cost(criterion: &Criterion, founds: &[&Found]) -> f64 {
    let corners = (founds.len() - 1) as f64;
    let unknowns: f64 = founds.iter().map(|f| criterion.penalty(&f.state.chain)).sum();
    criterion.cost_of(founds.iter().map(|f| f.state.sum).sum(), unknowns + CORNER * corners)
}
