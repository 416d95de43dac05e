//! The chains of a row between its corners, as a first partition tells them.

use super::clean::{Clean, spacing};
use super::noise_levels::Partition;
use super::polygon;
use crate::model::budget::Budget;
use crate::model::chain::SegmentKind;
use crate::model::criterion::Criterion;
use crate::model::flat::angle;
use crate::model::prior::KnownNoise;
use crate::model::result::{Continuity, Options, SectionError};
use crate::search::parts::{Part, shares};
use crate::search::span::{Found, single};
use crate::search::task::{Span, Task};
use std::collections::VecDeque;
use std::ops::Range;
use trueness_geom::progress::Progress;

/// A turn between two parts is a corner from here on, radians, and from so many standard deviations of the headings.
const CORNER_TURN_AND_SIGMAS: (f64, f64) = (polygon::MIN_CORNER_TURN, 8.0);
/// A turn of more than this is a corner without further test, radians.
pub(super) const CLEAR_CORNER_TURN: f64 = 0.6;
/// Distances below this share of the spacing count as 0: free pieces would grow without end on exact data.
pub(super) const RESOLUTION_SPACINGS: f64 = 1e-4;

/// Data that all spans of a row have in common.
pub(super) struct CornerSearch<'a> {
    pub clean: &'a Clean,
    pub weights: &'a [f64],
    pub options: &'a Options,
    pub spacing: f64,
    /// Points are followed at this step: nearer ones scatter more than they are apart.
    pub step: usize,
    pub sigma: f64,
    pub known_noise: Option<KnownNoise>,
    pub own: f64,
    /// The continuity that all joins have, where it is not left to the data.
    pub forced: Option<Continuity>,
    /// The parts are known exactly: arcs are tangent to the lines beside them.
    pub known: bool,
    /// Arcs are taken for tangent to their neighbors.
    pub tangent: bool,
    /// The chains of the parts as they are, without any search.
    pub draft: bool,
    /// As of the search.
    pub budget: &'a Budget,
}

/// Chains in the order of the row.
pub(super) struct Chains {
    pub founds: Vec<Found>,
    /// They join in corners, the last and the first too if the row is closed: one closed chain has none.
    pub cornered: bool,
}

impl Partition {
    /// How chains of its parts are looked for.
    pub(super) fn corner_search<'a>(&'a self, options: &'a Options, budget: &'a Budget) -> CornerSearch<'a> {
        CornerSearch {
            clean: &self.clean,
            weights: &self.weights,
            options,
            spacing: spacing(&self.clean, self.step),
            step: self.step,
            sigma: self.sigma,
            known_noise: self.known_noise,
            own: self.own,
            forced: self.forced,
            known: self.known,
            tangent: self.tangent,
            draft: false,
            budget,
        }
    }
}

impl CornerSearch<'_> {
    /// The chains between corners.
    pub(super) fn all(&self, parts: &[Part], progress: &dyn Progress) -> Result<Chains, SectionError> {
        let closed = self.clean.closed;
        let n = self.clean.points.len();
        let forced = self.forced;
        let corner = |k: usize| match forced {
            Some(Continuity::G0) => true,
            Some(_) => false,
            None if self.known || self.tangent => {
                parts[k].kind == SegmentKind::Line && parts[(k + 1) % parts.len()].kind == SegmentKind::Line
            }
            None => self.is_corner(&parts[k], &parts[(k + 1) % parts.len()]),
        };
        let mut ends: Vec<usize> = (0..parts.len() - 1).filter(|k| corner(*k)).map(|k| k + 1).collect();
        let seam = closed && parts.len() > 1 && corner(parts.len() - 1);
        // Parts of a closed row go on over the seam, unless there is a corner.
        if closed && ends.is_empty() && !seam {
            let span = || Span::new(&self.clean.points, self.weights, (0..n).collect());
            let mut found = span().find(parts, &self.task(parts.len() > 1, true, n), progress)?;
            if parts.len() == 1 {
                // A whole circle joins itself anywhere: it is an arc whose ends happen to meet. Any other curve closes.
                found.circle = found.pieces().len() == 1
                    && found.pieces()[0].kind == SegmentKind::Arc
                    && !found.unreliable;
                if !found.circle {
                    let halves = shares(&self.clean.points, self.weights, 2);
                    found = span().find(&halves, &self.task(true, true, n), progress)?;
                }
            }
            if !found.unreliable {
                // Nobody knows where a closed chain of one arc begins; an open one has its center and radius alone.
                if single(&found.state) && found.pieces()[0].kind == SegmentKind::Arc {
                    let whole = shares(&self.clean.points, self.weights, 1);
                    let task = Task { draft: true, ..self.task(false, true, n) };
                    let mut open = span().find(&whole, &task, progress)?;
                    open.circle = !open.unreliable;
                    open.noise = if self.known_noise.is_some() { open.noise } else { open.scatter() };
                    found = if open.circle { open } else { found };
                }
                return Ok(Chains { founds: vec![found], cornered: false });
            }
            if forced.is_some() {
                return Err(SectionError::Unreliable);
            }
            // No closed curve runs along the points: it has corners that the partition does not tell.
            let quarters = shares(&self.clean.points, self.weights, 4.min(n / 2));
            let order = if parts.len() == 1 { quarters } else { parts.to_vec() };
            return self.spans(&order, 0, (1..=order.len()).collect(), progress);
        }
        let mut order: Vec<Part> = parts.to_vec();
        let mut shift = 0;
        if closed && !seam {
            let by = ends[0];
            shift = order[by].from;
            order.rotate_left(by);
            ends = ends.iter().map(|e| e - by).filter(|e| *e > 0).collect();
        }
        ends.push(order.len());
        self.spans(&order, shift, ends, progress)
    }

    /// The chains of groups of parts: each ends before one of `ends`, and the first begins at point `shift`.
    fn spans(
        &self,
        order: &[Part],
        shift: usize,
        ends: Vec<usize>,
        progress: &dyn Progress,
    ) -> Result<Chains, SectionError> {
        let n = self.clean.points.len();
        let starts = std::iter::once(0).chain(ends.iter().copied());
        let mut groups: VecDeque<Range<usize>> = starts.zip(&ends).map(|(from, to)| from..*to).collect();
        let mut all = Chains { founds: vec![], cornered: true };
        while let Some(group) = groups.pop_front() {
            let own = &order[group.clone()];
            let start = (own[0].from + n - shift) % n;
            let count: usize = own.iter().map(|p| p.to - p.from).sum();
            let numbers: Vec<usize> = (start..start + count).map(|i| (i + shift) % n).collect();
            let mut at = 0;
            let local: Vec<Part> = own
                .iter()
                .map(|p| {
                    let part = Part { from: at, to: at + p.to - p.from, ..*p };
                    at = part.to;
                    part
                })
                .collect();
            let task = self.task(false, count == n, count);
            let span = Span::new(&self.clean.points, self.weights, numbers);
            let found = span.find(&local, &task, progress)?;
            if found.unreliable && own.len() > 1 {
                if matches!(self.forced, Some(Continuity::G1 | Continuity::G2)) {
                    return Err(SectionError::Unreliable);
                }
                // No curve without corners runs along these points.
                group.rev().for_each(|k| groups.push_front(k..k + 1));
                continue;
            }
            all.founds.push(found);
        }
        Ok(all)
    }

    pub(super) fn resolution(&self) -> f64 {
        self.options.resolution.unwrap_or((RESOLUTION_SPACINGS * self.spacing).max(self.clean.rounding))
    }

    pub(super) fn task(&self, closed: bool, whole: bool, count: usize) -> Task<'_> {
        let n = self.clean.points.len();
        // Noise that is known beforehand, or that the rest of the row tells.
        let degrees = match self.known_noise {
            Some(known) => known.degrees,
            None if whole || count == n => 0.0,
            None => 0.3 * (n - count) as f64,
        };
        let noise = self.known_noise.map_or(self.own, |n| n.deviation);
        let even = self.options.continuity == Some(Continuity::G2);
        let (resolution, count) = (self.resolution(), count as f64);
        let criterion = Criterion { noise, degrees, resolution, count, points: count, rest: None };
        let closed = closed && whole;
        Task {
            criterion,
            scatter: noise.max(self.own),
            spacing: self.spacing,
            step: self.step,
            closed,
            even,
            level: self.options.level,
            known: self.known,
            draft: self.draft,
            budget: self.budget,
        }
    }

    /// Whether the row turns between two parts by more than their own uncertainty, and enough to matter.
    fn is_corner(&self, before: &Part, after: &Part) -> bool {
        let points = &self.clean.points;
        let (a, b) = (points[before.to - 1], points[after.from % points.len()]);
        let (a, b) = (before.heading(a), after.heading(b));
        let turn = angle(a, b).abs();
        let spread = |part: &Part| {
            let count = (part.to - part.from) as f64;
            let factor = if part.kind == SegmentKind::Line { 3.5 } else { 14.0 };
            self.sigma * factor / (count.sqrt() * count * self.spacing)
        };
        let clear = turn
            > CORNER_TURN_AND_SIGMAS
                .0
                .max(CORNER_TURN_AND_SIGMAS.1 * libm::hypot(spread(before), spread(after)));
        clear && (turn > CLEAR_CORNER_TURN || self.tangent_is_worse(before, after))
    }

    /// Whether two parts by themselves fit so much better than with a common tangent that the corner pays. A join that the
    /// partition put a few points off looks like a corner.
    fn tangent_is_worse(&self, before: &Part, after: &Part) -> bool {
        let n = self.clean.points.len();
        // A few hundred points of either part tell it.
        let stride = ((before.to - before.from).min(after.to - after.from) / 300).max(1);
        let pick =
            |part: &Part| -> Vec<usize> { (part.from..part.to).step_by(stride).map(|i| i % n).collect() };
        let (first, second) = (pick(before), pick(after));
        let alone = |part: &Part, count: usize| Part { from: 0, to: count, ..*part };
        let (cut, end) = (first.len(), first.len() + second.len());
        let local = [alone(before, cut), Part { from: cut, to: end, ..*after }];
        let sum = |numbers: Vec<usize>, parts: &[Part]| {
            let task = self.task(false, true, numbers.len());
            let task = Task { spacing: self.spacing * stride as f64, ..task };
            Span::new(&self.clean.points, self.weights, numbers).sum(parts, &task)
        };
        let both: Vec<usize> = first.iter().chain(&second).copied().collect();
        let count = both.len() as f64;
        let floor = count * self.resolution().powi(2);
        let apart = sum(first, &[alone(before, cut)]) + sum(second, &[alone(after, end - cut)]);
        let tangent = sum(both, &local);
        count * libm::log((tangent + floor) / (apart + floor)) > 3.0 * libm::log(count)
    }
}
