//! Corners that are none.
//!
//! The first partition is of lines and arcs, each by itself. A curve whose curvature changes fast is a few short arcs
//! there that do not meet with a common tangent, however tangent the curve is. So each blunt corner is doubted. One
//! chain is looked for over both sides; where it costs less than two chains and the corner, there is no corner.

use super::corner_search::{CLEAR_CORNER_TURN, Chains, CornerSearch};
use crate::model::criterion::Unknowns;
use crate::model::flat::angle;
use crate::model::result::SectionError;
use crate::search::parts::Part;
use crate::search::span::Found;
use crate::search::task::Span;
use trueness_geom::progress::Progress;

/// Corners that are doubted, those that turn least. Each takes a search.
const MAX_DOUBTED_CORNERS: usize = 12;
/// A corner in unknowns, beyond those of the chains on both sides: its place among the points was chosen among many.
pub(super) const CORNER_UNKNOWNS: Unknowns = Unknowns { number: 1.0, weight: 3.0, kinds: 0.0 };

/// Chains of more points are left: they have points enough for the parts of a first partition to tell a corner.
const MAX_POINTS_TO_JOIN: usize = 1500;

impl CornerSearch<'_> {
    /// The chains between corners, without corners that cost more than a chain over them, with those that cost less.
    pub(super) fn chains(&self, parts: &[Part], progress: &dyn Progress) -> Result<Chains, SectionError> {
        let mut all = self.all(parts, progress)?;
        if self.forced.is_some() || self.known || self.draft || self.step > 1 {
            return Ok(all);
        }
        let mut tried: Vec<[usize; 2]> = vec![];
        for _ in 0..MAX_DOUBTED_CORNERS {
            let Some(first) = self.gentlest_corner(&all, &tried).filter(|_| !self.budget.is_spent(0.0))
            else {
                break;
            };
            let next = (first + 1) % all.founds.len();
            let pair = [first, next].map(|k| &all.founds[k]);
            tried.push(pair.map(|f| f.span.numbers[0]));
            let founds = if next == first { &pair[..1] } else { &pair };
            let Some(found) = self.chain_over(founds, progress)? else { continue };
            all.cornered &= next != first;
            all.founds[first] = found;
            if next != first {
                all.founds.remove(next);
            }
        }
        self.with_corners_inserted(all, progress)
    }

    /// The first of the two neighboring chains, not yet tried, that turn least from one to the next. A single chain of
    /// a closed row is its own neighbor.
    fn gentlest_corner(&self, all: &Chains, tried: &[[usize; 2]]) -> Option<usize> {
        let (founds, count) = (&all.founds, all.founds.len());
        let pairs = if self.clean.closed && all.cornered { count } else { count - 1 };
        let turn = |k: usize| {
            let (a, b) = (&founds[k], &founds[(k + 1) % count]);
            let fits = a.span.points.len() + b.span.points.len() <= MAX_POINTS_TO_JOIN;
            let turn = angle(a.beyond(true, 0.0).along, b.beyond(false, 0.0).along).abs();
            let doubted =
                fits && turn < CLEAR_CORNER_TURN && !tried.contains(&[a, b].map(|f| f.span.numbers[0]));
            doubted.then_some((k, turn))
        };
        (0..pairs).filter_map(turn).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k)
    }

    /// One chain over two, or a closed one over one, where that costs less than with the corner.
    fn chain_over(&self, founds: &[&Found], progress: &dyn Progress) -> Result<Option<Found>, SectionError> {
        let numbers: Vec<usize> = founds.iter().flat_map(|f| f.span.numbers.iter().copied()).collect();
        let count = numbers.len();
        let task = self.task(founds.len() == 1, count == self.clean.points.len(), count);
        let span = Span::new(&self.clean.points, self.weights, numbers);
        let criterion = span.criterion(&task);
        let unknowns =
            founds.iter().map(|f| Unknowns::of(&f.state.chain)).fold(CORNER_UNKNOWNS, Unknowns::and);
        let bar = criterion.cost_of(founds.iter().map(|f| f.state.sum).sum(), unknowns);
        Ok(span.chain_over(founds, bar, &task, progress)?)
    }
}
