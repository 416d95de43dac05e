//! Corners that a chain passes over.
//!
//! The first partition has no corner where lines and arcs turn from one to the next by a few degrees. Curves do so all
//! the way. The chain over such a corner has a short arc or a free piece there, or a join far off. So up to three
//! neighboring pieces of each chain are replaced by two lines or arcs with a corner between them. Where that costs
//! less, the chain ends there.

use super::corner_search::{Chains, CornerSearch};
use super::remove_corners::CORNER_UNKNOWNS;
use crate::model::chain::{Chain, Ends, Piece, Pose, SegmentKind, arc_end, arc_over};
use crate::model::criterion::{Model, Unknowns};
use crate::model::flat::distance;
use crate::model::least::State;
use crate::model::result::SectionError;
use crate::search::parts::{Halves, Part, halves};
use crate::search::span::{Found, single};
use crate::search::task::Span;
use trueness_geom::progress::{Cancelled, Progress};

/// Two pieces take the place of so many neighbors at most.
const MAX_PIECES_AT_CORNER: usize = 3;
/// Fewest points on either side of a corner: fewer lie on a line by chance.
const MIN_POINTS_BESIDE_CORNER: usize = 6;

/// A closed chain counts as many unknowns as the open one of its pieces has without its ends, which have to meet.
/// Beyond that it has two fewer.
const OPENED_CHAIN_UNKNOWNS: Unknowns = Unknowns { number: 0.0, weight: 2.0, kinds: 0.0 };

/// A corner in place of some pieces of a chain.
struct InsertedCorner {
    /// The first of these pieces, and the one behind them.
    from: usize,
    to: usize,
    /// The first point behind the corner, as the chain counts them.
    at: usize,
    /// The line or arc on either side.
    parts: [Part; 2],
}

impl CornerSearch<'_> {
    /// The chains, divided at corners that they pass over.
    pub(super) fn with_corners_inserted(
        &self,
        all: Chains,
        progress: &dyn Progress,
    ) -> Result<Chains, SectionError> {
        let mut cornered = all.cornered;
        let mut founds = vec![];
        let mut rest: Vec<Found> = all.founds.into_iter().rev().collect();
        while let Some(found) = rest.pop() {
            match self.divide(&found, progress)? {
                None => founds.push(found),
                Some(parts) => {
                    cornered = true;
                    rest.extend(parts.into_iter().rev());
                }
            }
        }
        Ok(Chains { founds, cornered })
    }

    /// The chains on both sides of the corner that this one passes over. A closed one becomes the open one from there
    /// on. `None` where none costs less.
    fn divide(&self, found: &Found, progress: &dyn Progress) -> Result<Option<Vec<Found>>, SectionError> {
        if found.unreliable || found.circle || single(&found.state) {
            return Ok(None);
        }
        let (count, total) = (found.span.points.len(), self.clean.points.len());
        let task = self.task(found.state.chain.closed, count == total, count);
        let criterion = found.span.criterion(&task);
        let bar = criterion.cost_of(found.state.sum, Unknowns::of(&found.state.chain));
        let corner = if found.state.chain.closed {
            CORNER_UNKNOWNS.and(OPENED_CHAIN_UNKNOWNS)
        } else {
            CORNER_UNKNOWNS
        };
        let cost = |states: &[(Span, State)], sum: f64| {
            let unknowns = states.iter().map(|(_, s)| Unknowns::of(&s.chain)).fold(corner, Unknowns::and);
            criterion.cost_of(sum, unknowns)
        };
        let mut best: Option<(Vec<(Span, State)>, f64)> = None;
        for (blunt, sum) in corners(found) {
            if self.budget.is_spent(0.0) {
                break;
            }
            let mut states = blunt.states(self, found);
            let least = best.as_ref().map_or(bar, |(_, cost)| *cost);
            if cost(&states, sum) >= least {
                continue;
            }
            if progress.cancelled() {
                return Err(Cancelled.into());
            }
            for (span, state) in &mut states {
                let task = self.task(false, span.points.len() == total, span.points.len());
                let model = Model { state: state.clone(), cost: 0.0 };
                *state = span.search(&task).converge(&model).state;
            }
            let sum = states.iter().map(|(_, s)| s.sum).sum();
            let own = cost(&states, sum);
            if own < least {
                best = Some((states, own));
            }
        }
        let Some((states, _)) = best else { return Ok(None) };
        let refined = |(span, state): (Span, State)| {
            let n = span.points.len();
            span.refined(state, &self.task(false, n == total, n), progress)
        };
        let founds = states.into_iter().map(refined).collect::<Result<Vec<Found>, _>>()?;
        Ok(founds.iter().all(|f| !f.unreliable).then_some(founds))
    }
}

/// The corners that may be in place of up to so many neighboring pieces. Each has the sum of squares that the chains
/// have at least then.
fn corners(found: &Found) -> Vec<(InsertedCorner, f64)> {
    let (state, n) = (&found.state, found.span.points.len());
    let pieces = &state.chain.pieces;
    let mut all = vec![];
    for from in 0..pieces.len() {
        for to in from + 1..=(from + MAX_PIECES_AT_CORNER).min(pieces.len()) {
            let range = state.breaks[from]..state.breaks[to];
            let points: Vec<[f64; 2]> = range.clone().map(|i| found.span.points[i % n]).collect();
            let weights: Vec<f64> = range.clone().map(|i| found.span.weights[i % n]).collect();
            let own: f64 = range.clone().zip(&weights).map(|(i, w)| w * found.residuals[i % n].powi(2)).sum();
            let outer = [pieces[from].kind, pieces[to - 1].kind];
            for Halves { parts, sum } in halves(&points, &weights, MIN_POINTS_BESIDE_CORNER) {
                if parts.iter().zip(outer).all(|(p, k)| p.kind == SegmentKind::Arc && k != SegmentKind::Arc) {
                    continue;
                }
                let at = range.start + parts[1].from;
                all.push((InsertedCorner { from, to, at, parts }, state.sum - own + sum));
            }
        }
    }
    all
}

impl InsertedCorner {
    /// The chains before and behind the corner, of a closed chain the open one from behind it on, each with its points.
    fn states(&self, search: &CornerSearch, found: &Found) -> Vec<(Span, State)> {
        let (state, n) = (&found.state, found.span.points.len());
        let pieces = &state.chain.pieces;
        let count = pieces.len();
        let before = self.before(found);
        let after = self.after(found);
        let span = |from: usize, to: usize| {
            let numbers = (from..to).map(|i| found.span.numbers[i % n]).collect();
            Span::new(&search.clean.points, search.weights, numbers)
        };
        let feet = |from: usize, to: usize| (from..to).map(|i| state.feet[i % n]).collect::<Vec<f64>>();
        let of = |start: Pose, pieces: Vec<Piece>, breaks: Vec<usize>| {
            let (from, to) = (breaks[0], breaks[breaks.len() - 1]);
            let chain = Chain {
                start: start.at,
                heading: start.heading,
                pieces,
                closed: false,
                even: state.chain.even,
                ends: Ends::default(),
            };
            let breaks = breaks.iter().map(|b| b - from).collect();
            (span(from, to), State { chain, breaks, feet: feet(from, to), sum: 0.0 })
        };
        let (start, first) = after;
        if state.chain.closed {
            let mut all = vec![first];
            all.extend_from_slice(&pieces[self.to..]);
            all.extend_from_slice(&pieces[..self.from]);
            all.push(before.1);
            let mut breaks = vec![self.at];
            breaks.extend_from_slice(&state.breaks[self.to..count]);
            breaks.extend(state.breaks[..=self.from].iter().map(|b| b + n));
            breaks.push(self.at + n);
            return vec![of(start, all, breaks)];
        }
        let mut left = pieces[..self.from].to_vec();
        left.push(before.1);
        let mut breaks = state.breaks[..=self.from].to_vec();
        breaks.push(self.at);
        let mut right = vec![first];
        right.extend_from_slice(&pieces[self.to..]);
        let mut others = vec![self.at];
        others.extend_from_slice(&state.breaks[self.to..]);
        vec![of(before.0, left, breaks), of(start, right, others)]
    }

    /// Where the chain before the corner starts, and its last piece.
    fn before(&self, found: &Found) -> (Pose, Piece) {
        let (part, points) = (&self.parts[0], &found.span.points);
        let last = points[(self.at - 1) % points.len()];
        if self.from > 0 || found.state.chain.closed {
            let pose = found.layout.poses[self.from];
            return (found.layout.poses[0], piece(part, distance(pose.at, last)));
        }
        let first = points[0];
        (pose(part, first), piece(part, distance(first, last)))
    }

    /// Where the chain behind the corner starts, and its first piece.
    fn after(&self, found: &Found) -> (Pose, Piece) {
        let (part, points) = (&self.parts[1], &found.span.points);
        let first = points[self.at % points.len()];
        let count = found.pieces().len();
        if self.to == count && !found.state.chain.closed {
            return (pose(part, first), piece(part, distance(first, points[points.len() - 1])));
        }
        // The rest of the chain stays where it is.
        let end = found.layout.poses[self.to];
        let piece = piece(part, distance(first, end.at));
        let turn = piece.length * piece.curvature(0.0);
        let back = end.place(arc_end(-piece.length, -turn));
        (Pose::new(back, end.heading - turn), piece)
    }
}

/// The pose of a part at a point.
fn pose(part: &Part, at: [f64; 2]) -> Pose {
    let [x, y] = part.heading(at);
    Pose::new(at, libm::atan2(y, x))
}

/// The piece of a part whose ends are so far apart.
fn piece(part: &Part, chord: f64) -> Piece {
    match part.kind {
        SegmentKind::Line => Piece::line(chord),
        _ => Piece::arc(arc_over(chord, part.curvature), part.curvature),
    }
}
