//! Whole contours: corners first, then the chains between them, then corners as the places where chains cross.

use super::assembly::Joined;
use super::chain::SegmentKind;
use super::convert::segments;
use super::corner::crossing;
use super::crossings::crossings_with_loops;
use super::direction::from_the_end;
use super::exact::missed;
use super::levels::{MARGIN, SAME, Start, hidden};
use super::polygon::{self, turn};
use super::resolved::{Among, misses, resolved};
use super::result::{Continuity, Contour, Join, Options, SectionError};
use super::row::{Clean, check_row, spacing};
use super::search::Criterion;
use super::span::{Found, Span, Task, single};
use super::start::{Part, noise, shares};
use crate::num::special::student_quantile;
use crate::progress::Progress;
use std::cell::Cell;
use std::collections::VecDeque;
use std::ops::Range;

/// A turn between two parts is a corner from here on, radians, and from so many standard deviations of the headings.
const CORNER: (f64, f64) = (polygon::CORNER, 8.0);
/// A turn of more than this is a corner without further test, radians.
const SHARP: f64 = 0.6;
/// Distances below this share of the spacing are not told from 0: free pieces would grow without end on exact data.
const RESOLUTION: f64 = 1e-4;
/// Parts are searched whose chains cost no more than so much above the cheapest found: a search takes off some pieces, hardly more.
const FAR: f64 = 20.0;
/// A loop of a contour is told that is longer than so many distances between points: it goes by points of the row.
const LOOP: f64 = 3.0;
/// A crossing is followed this far from the chains' ends, in distances between points.
const FARTHEST: f64 = 20.0;

/// The lines, arcs and curves of a row of points in order along a contour, and the joins between them, with their
/// uncertainties.
///
/// Corners are where neighboring parts of a first partition differ in heading; between corners, all joins are tangent. The
/// number and kinds of segments come from a penalized likelihood, the intervals from the likelihood with a join held. The
/// points are taken to scatter normally across the contour, all alike. A row given the other way round has the same contour, the
/// other way round. Points that repeat the one before, and single points
/// far off what their neighbors tell, are left out and listed.
///
/// # Errors
/// [`SectionError`]: too few points, numbers that are none, points out of order, options without meaning.
///
/// ```
/// use trueness_geom::section::{contour, SegmentKind, Options};
/// let line = (0..30).map(|i| [f64::from(i) - 30.0, 0.0]);
/// let arc = (0..30).map(|i| f64::from(i) * 0.05).map(|a| [20.0 * a.sin(), 20.0 - 20.0 * a.cos()]);
/// let points: Vec<[f64; 2]> = line.chain(arc).collect();
/// let found = contour(&points, &Options::default(), &trueness_geom::progress::Silent).unwrap();
/// let kinds: Vec<SegmentKind> = found.segments.iter().map(|s| s.geometry.kind()).collect();
/// assert_eq!(kinds, [SegmentKind::Line, SegmentKind::Arc]);
/// assert!(found.joins[0].point[0].abs() < 1e-3 && found.joins[0].point[1].abs() < 1e-6);
/// ```
pub fn contour(
    points: &[[f64; 2]],
    options: &Options,
    progress: &dyn Progress,
) -> Result<Contour, SectionError> {
    check_row(points, options)?;
    let turned: Vec<[f64; 2]> = points.iter().rev().copied().collect();
    let backward = from_the_end(points);
    let ways = if backward { [&turned[..], points] } else { [points, &turned] };
    let (hasty, again) = (Cell::new(false), Cell::new(false));
    let mut found = in_order(ways[0], options, Some(&hasty), progress);
    let mut is_backward = backward;
    // What takes long from one end may be short from the other.
    if hasty.get() && !matches!(found, Err(SectionError::Cancelled(_))) {
        found = in_order(ways[1], options, Some(&again), progress);
        match again.get() {
            true => found = in_order(ways[0], options, None, progress),
            false => is_backward = !backward,
        }
    }
    // A search that ended badly may end well from the other end.
    let doubtful = |found: &Contour| !hasty.get() && is_doubtful(found, points, options);
    if found.as_ref().map_or_else(|e| *e == SectionError::Astray, doubtful) {
        let other = match in_order(ways[1], options, None, progress) {
            Err(SectionError::Cancelled(e)) => return Err(e.into()),
            other => other,
        };
        let cheaper = match (&found, &other) {
            (Ok(found), Ok(other)) => rank(other, points.len()) < rank(found, points.len()),
            (_, other) => other.is_ok(),
        };
        if cheaper {
            (found, is_backward) = (other, !backward);
        }
    }
    let found = found?;
    let mut found = if is_backward { found.turned_round(points) } else { found };
    found.crossings = crossings_with_loops(&found.segments, found.closed, LOOP * found.spacing, progress)?;
    Ok(found)
}

/// Points scatter about a contour this many times as much as about local fits where it hides form.
const DOUBTFUL: f64 = 1.3;

/// Whether segments of a contour are astray, or its points scatter more than about local fits.
fn is_doubtful(found: &Contour, points: &[[f64; 2]], options: &Options) -> bool {
    let own = options.noise.unwrap_or_else(|| noise(points, found.closed).0);
    !found.astray.is_empty() || own > 0.0 && rms(found) > DOUBTFUL * own
}

/// Root mean square distance of the points from a contour, outliers left out.
fn rms(found: &Contour) -> f64 {
    let kept = found.residuals.iter().enumerate().filter(|(i, _)| found.outliers.binary_search(i).is_err());
    let (sum, count) = kept.fold((0.0, 0.0), |(sum, count), (_, r)| (sum + r * r, count + 1.0));
    (sum / f64::max(count, 1.0)).sqrt()
}

/// By which of two contours of a row the one to take is told: segments astray first, then twice the negative logarithm of the
/// likelihood and the penalty for the unknowns.
fn rank(found: &Contour, count: usize) -> (usize, f64) {
    let (count, floor) = (count as f64, RESOLUTION * found.spacing);
    let off = rms(found);
    let cost = count * libm::log(off * off + floor * floor)
        + (found.unknowns + found.joins.len() as f64) * libm::log(count);
    (found.astray.len(), cost)
}

/// The contour of a row, found from its first point; `hasty` as of the search.
fn in_order(
    points: &[[f64; 2]],
    options: &Options,
    hasty: Option<&Cell<bool>>,
    progress: &dyn Progress,
) -> Result<Contour, SectionError> {
    let clean = Clean::new(points, options)?;
    if progress.cancelled() {
        return Err(SectionError::Cancelled(crate::progress::Cancelled));
    }
    let mut start = Start::new(clean, options);
    let free = options.noise.is_none() && options.continuity.is_none();
    if free && let Some(found) = resolved(&start, options, Among::Rows) {
        return Ok(found.whole(points.len()));
    }
    let mut chains = Plan { hasty, ..start.plan(options) }.all(&start.parts, progress)?;
    if hasty.is_some_and(Cell::get) {
        // It is of no use.
        return Err(SectionError::Astray);
    }
    let fine = start.fine(options);
    let mut finer = start.finer(options, fine, &chains.0);
    while let Some(other) = finer.pop_front() {
        let bar = start.cost(&chains.0);
        if !promises(&other, options, bar, progress)? {
            continue;
        }
        let found = match other.plan(options).all(&other.parts, progress) {
            Err(SectionError::Cancelled(e)) => return Err(e.into()),
            Err(_) => continue,
            Ok(found) => found,
        };
        if found.0.len() > 1
            && let Some(tangent) = other.tangent()
        {
            finer.push_front(tangent);
        }
        let gain = bar - other.cost(&found.0);
        if gain.abs() < SAME {
            // The search leads back to where it was.
            break;
        }
        let margin = if other.is_tangent() { 0.0 } else { MARGIN };
        if gain > margin {
            (start, chains) = (other, found);
        }
    }
    let mut found = start.plan(options).join(chains.0, chains.1)?;
    if options.noise.is_none() && options.resolution.is_none() {
        found.astray(missed(&start.clean.points, &found.contour));
        found.astray(fine.map_or(vec![], |fine| hidden(&found.contour, fine)));
    }
    let is_doubtful = free && (is_cornered(&found.contour) || misses(&found.contour, 0.0));
    let other = if is_doubtful { resolved(&start, options, Among::Contours) } else { None };
    if let Some(other) = other.filter(|r| r.is_better_than(&found.contour)) {
        return Ok(other.whole(points.len()));
    }
    found.finish(&start.clean, start.turned, points.len(), start.outliers);
    Ok(found.contour)
}

/// Whether segments do not run along their points, or join in corners.
fn is_cornered(contour: &Contour) -> bool {
    !contour.astray.is_empty() || contour.joins.iter().any(|j| j.continuity == Continuity::G0)
}

/// What all spans of a row have in common.
struct Plan<'a> {
    clean: &'a Clean,
    weights: &'a [f64],
    options: &'a Options,
    spacing: f64,
    /// Points are followed at this step: nearer ones scatter more than they are apart.
    step: usize,
    sigma: f64,
    given: Option<f64>,
    own: f64,
    /// The continuity that all joins have, where it is not left to the data.
    forced: Option<Continuity>,
    /// The parts are known exactly: arcs are tangent to the lines beside them.
    known: bool,
    /// The chains of the parts as they are, without any search.
    draft: bool,
    /// As of the search.
    hasty: Option<&'a Cell<bool>>,
}

/// Whether a search from these parts may lead to chains that cost less than `bar`: those of the parts as they are cost little more.
/// That takes a hundredth of the search.
fn promises(
    start: &Start,
    options: &Options,
    bar: f64,
    progress: &dyn Progress,
) -> Result<bool, SectionError> {
    if bar.is_infinite() {
        return Ok(true);
    }
    let plan = Plan { draft: true, ..start.plan(options) };
    match plan.all(&start.parts, progress) {
        Err(SectionError::Cancelled(e)) => Err(e.into()),
        Err(_) => Ok(false),
        Ok(found) => Ok(start.cost(&found.0) < bar + FAR),
    }
}

/// Where a corner is: the first point after it.
type Corner = usize;

impl Start {
    /// How chains of its parts are looked for.
    fn plan<'a>(&'a self, options: &'a Options) -> Plan<'a> {
        Plan {
            clean: &self.clean,
            weights: &self.weights,
            options,
            spacing: spacing(&self.clean, self.step),
            step: self.step,
            sigma: self.sigma,
            given: options.noise,
            own: self.own,
            forced: self.forced,
            known: self.known,
            draft: false,
            hasty: None,
        }
    }
}

impl Plan<'_> {
    /// The chains between corners.
    fn all(
        &self,
        parts: &[Part],
        progress: &dyn Progress,
    ) -> Result<(Vec<Found>, Vec<Corner>), SectionError> {
        let closed = self.clean.closed;
        let n = self.clean.points.len();
        let forced = self.forced;
        let corner = |k: usize| match forced {
            Some(Continuity::G0) => true,
            Some(_) => false,
            None if self.known => {
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
                found.circle =
                    found.pieces().len() == 1 && found.pieces()[0].kind == SegmentKind::Arc && !found.astray;
                if !found.circle {
                    let halves = shares(&self.clean.points, self.weights, 2);
                    found = span().find(&halves, &self.task(true, true, n), progress)?;
                }
            }
            if !found.astray {
                // Of a closed chain of one arc nobody knows where it begins; an open one has its center and radius alone.
                if single(&found.state) && found.pieces()[0].kind == SegmentKind::Arc {
                    let whole = shares(&self.clean.points, self.weights, 1);
                    let task = Task { draft: true, ..self.task(false, true, n) };
                    let mut open = span().find(&whole, &task, progress)?;
                    open.circle = !open.astray;
                    open.noise = if self.given.is_some() { open.noise } else { open.scatter() };
                    found = if open.circle { open } else { found };
                }
                return Ok((vec![found], vec![]));
            }
            if forced.is_some() {
                return Err(SectionError::Astray);
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
    ) -> Result<(Vec<Found>, Vec<Corner>), SectionError> {
        let n = self.clean.points.len();
        let starts = std::iter::once(0).chain(ends.iter().copied());
        let mut groups: VecDeque<Range<usize>> = starts.zip(&ends).map(|(from, to)| from..*to).collect();
        let (mut founds, mut corners): (Vec<Found>, Vec<Corner>) = (vec![], vec![]);
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
            let first = numbers[0];
            let task = self.task(false, count == n, count);
            let span = Span::new(&self.clean.points, self.weights, numbers);
            let found = span.find(&local, &task, progress)?;
            if found.astray && own.len() > 1 {
                if matches!(self.forced, Some(Continuity::G1 | Continuity::G2)) {
                    return Err(SectionError::Astray);
                }
                // No curve without corners runs along these points.
                group.rev().for_each(|k| groups.push_front(k..k + 1));
                continue;
            }
            if group.start > 0 || self.clean.closed {
                corners.push(first);
            }
            founds.push(found);
        }
        Ok((founds, corners))
    }

    fn resolution(&self) -> f64 {
        self.options.resolution.unwrap_or(RESOLUTION * self.spacing)
    }

    fn task(&self, closed: bool, whole: bool, count: usize) -> Task<'_> {
        let n = self.clean.points.len();
        // What the rest of the row tells about the noise; next to all if it was given.
        let degrees = match self.given {
            Some(_) => 1e6,
            None if whole || count == n => 0.0,
            None => 0.3 * (n - count) as f64,
        };
        let noise = self.given.unwrap_or(self.own);
        let even = self.options.continuity == Some(Continuity::G2);
        let criterion = Criterion { noise, degrees, resolution: self.resolution(), count: count as f64 };
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
            hasty: self.hasty,
        }
    }

    /// Whether the row turns between two parts by more than their own uncertainty, and enough to matter.
    fn is_corner(&self, before: &Part, after: &Part) -> bool {
        let points = &self.clean.points;
        let (a, b) = (points[before.to - 1], points[after.from % points.len()]);
        let (a, b) = (heading(before, a), heading(after, b));
        let turn = turn(a, b).abs();
        let spread = |part: &Part| {
            let count = (part.to - part.from) as f64;
            let factor = if part.kind == SegmentKind::Line { 3.5 } else { 14.0 };
            self.sigma * factor / (count.sqrt() * count * self.spacing)
        };
        let clear = turn > CORNER.0.max(CORNER.1 * libm::hypot(spread(before), spread(after)));
        clear && (turn > SHARP || self.tangent_is_worse(before, after))
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

    /// Puts the chains together.
    fn join(&self, mut founds: Vec<Found>, corners: Vec<Corner>) -> Result<Joined, SectionError> {
        let closed = self.clean.closed;
        let count = founds.len();
        let mut all = Joined::default();
        let quantile = |f: &Found| {
            let degrees =
                (f.span.points.len() as f64 - 4.0).max(1.0) + if self.given.is_some() { 1e6 } else { 0.0 };
            student_quantile(1.0 - self.options.level, degrees)
        };
        let crossings: Vec<Option<Join>> = (0..count)
            .map(|k| {
                let last = k + 1 == count;
                if corners.is_empty() || last && !closed {
                    return None;
                }
                let (a, b) = (&founds[k], &founds[(k + 1) % count]);
                Some(crossing(a, b, quantile(a), FARTHEST * self.spacing * self.step as f64))
            })
            .collect();
        for k in 0..count {
            let before = match k {
                0 if closed => crossings[count - 1].as_ref(),
                0 => None,
                _ => crossings[k - 1].as_ref(),
            };
            let ends = [before.map(|j| j.point), crossings[k].as_ref().map(|j| j.point)];
            let found = &mut founds[k];
            all.add(found, segments(found, ends, self.spacing), self.clean.points.len());
            if let Some(join) = &crossings[k] {
                all.contour.joins.push(join.clone());
            } else if found.state.chain.closed && !single(&found.state) {
                // The join over the seam is the chain's first.
                all.contour.joins.rotate_left(1);
            }
        }
        let sum: f64 = all.contour.residuals.iter().zip(self.weights).map(|(r, w)| w * r * r).sum();
        let unknowns: f64 = founds.iter().map(Found::unknowns).sum();
        all.contour.unknowns = unknowns;
        let degrees = (self.weights.iter().sum::<f64>() - unknowns).max(1.0);
        all.contour.noise = self.given.unwrap_or_else(|| (sum / degrees).sqrt());
        (all.contour.closed, all.contour.spacing) = (closed, self.spacing);
        all.misdrawn(&self.clean.points, self.weights, self.step);
        all.contour.end_lengths();
        Ok(all)
    }
}

/// Direction of a part's line or arc at a point.
fn heading(part: &Part, at: [f64; 2]) -> [f64; 2] {
    if part.kind == SegmentKind::Line {
        return part.along;
    }
    let radius = 1.0 / part.curvature;
    let center = [part.center[0] - radius * part.along[1], part.center[1] + radius * part.along[0]];
    let out = [at[0] - center[0], at[1] - center[1]];
    let length = libm::hypot(out[0], out[1]).max(f64::MIN_POSITIVE) * part.curvature.signum();
    [-out[1] / length, out[0] / length]
}
