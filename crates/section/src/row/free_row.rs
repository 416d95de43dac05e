//! Rows of a free form, as one curve.
//!
//! A form that nobody drew of lines and arcs, as a body or a rock, has none. A search takes its bends for arcs by the
//! dozen. Such a row is a cubic B-spline through its points by weighted least squares, whose spans are as fine as the
//! points tell. Wide spans are halved where a finer curve follows the points by more than the noise alone would let it.
//! The one counts that foretells other points best (Hurvich and Tsai, Biometrika 76, 1989). Flat and round places of
//! such a form are parts of a partition in which that curve is one kind more. Its cost from one point to another is a
//! difference of two sums.

use super::assembly::Joined;
use super::candidate::{Candidate, Question};
use super::clean::Clean;
use super::corner_search::RESOLUTION_SPACINGS;
use crate::model::chain::SegmentKind;
use crate::model::result::{Contour, Geometry, SectionError, Segment};
use crate::search::partition::{FreeCost, MAX_PART_STARTS, Penalty, kinds_with_free};
use crate::search::parts::noise;
use trueness_geom::num::banded::Banded;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::curve::Curve;

/// Fewest points of a span.
const MIN_POINTS_PER_SPAN: usize = 4;
/// Fewest spans of a curve.
const MIN_SPANS: usize = 6;
/// Each curve of equal spans has so many times as many as the one before.
const SPAN_GROWTH: f64 = 1.5;
/// Feet are found anew so many times for a curve that is compared, and for the one that is taken.
const FIT_PASSES: [usize; 2] = [2, 6];
/// On the curve that is taken feet are found so many times more, without another fit.
const FINAL_FOOT_STEPS: usize = 5;
/// Spans are halved so many times at most.
const MAX_SPAN_HALVINGS: usize = 8;
/// Points of a span lie off more than the noise makes them where they do by so many times its variance.
const MAX_SPAN_VARIANCE_RATIO: f64 = 2.0;
/// A line or arc of fewer points, and of less than half of a row, may be a bend of the form.
const MIN_POINTS_OF_SEGMENT: usize = 32;
/// A bend of a form is no line and no arc to less than this share of its surface's departure from smooth ones.
const MIN_FORM_SHARE: f64 = 0.1;
/// One part of a free form in so many is a line or an arc.
const SEGMENT_RARITY: f64 = 1e4;
/// Unknowns of a line, an arc and one more free curve, their joins counted.
const UNKNOWNS_PER_KIND: [f64; 3] = [2.0, 3.0, 3.0];
/// Knots on either side of the seam of a closed curve, so that feet may lie beyond it.
const KNOTS_BEYOND_SEAM: usize = 4;

/// A row as the data of a curve fit.
struct Row<'a> {
    points: &'a [[f64; 2]],
    /// 1 of points that count, 0 of outliers.
    weights: Vec<f64>,
    closed: bool,
    /// Shares of the length through the points at which they lie.
    shares: Vec<f64>,
    /// Points that count, and the distance that is not told from 0.
    count: f64,
    least: f64,
}

/// A curve along a row.
#[derive(Clone)]
struct FreeCurve {
    /// First point of each span, and the end.
    limits: Vec<usize>,
    curve: Curve<[f64; 2]>,
    /// Parameters of the feet.
    feet: Vec<f64>,
    /// Signed distances, positive to the left.
    residuals: Vec<f64>,
    /// Weighted sum of their squares.
    sum: f64,
    cost: f64,
}

impl Row<'_> {
    fn new<'a>(clean: &'a Clean, outliers: &[usize]) -> Row<'a> {
        let (points, closed) = (&clean.points, clean.closed);
        let far = |a: [f64; 2], b: [f64; 2]| libm::hypot(b[0] - a[0], b[1] - a[1]);
        let mut shares = vec![0.0];
        for w in points.windows(2) {
            shares.push(shares[shares.len() - 1] + far(w[0], w[1]));
        }
        let (first, last) = (points[0], points[points.len() - 1]);
        let whole = shares[shares.len() - 1] + if closed { far(last, first) } else { 0.0 };
        shares.iter_mut().for_each(|s| *s /= whole);
        let counts = |i| f64::from(outliers.binary_search(&i).is_err());
        let weights: Vec<f64> = (0..points.len()).map(counts).collect();
        let (count, least) =
            (weights.iter().sum(), (RESOLUTION_SPACINGS * clean.spacing).max(clean.rounding));
        Row { points, weights, closed, shares, count, least }
    }

    /// Knots at the points that spans begin with; those of a closed curve go on over its seam.
    fn knots(&self, limits: &[usize]) -> Option<Knots> {
        let at: Vec<f64> = limits[..limits.len() - 1].iter().map(|i| self.shares[*i]).collect();
        if !self.closed {
            return Knots::clamped(3, 0.0, &at[1..], 1.0).ok();
        }
        let before = at[at.len() - KNOTS_BEYOND_SEAM..].iter().map(|t| t - 1.0);
        let after = at[..=KNOTS_BEYOND_SEAM].iter().map(|t| t + 1.0);
        Knots::new(3, before.chain(at.iter().copied()).chain(after).collect()).ok()
    }

    /// The number of an unknown of `count`, so that those that share points are near each other on a closed curve too.
    fn place(&self, k: usize, count: usize) -> usize {
        if !self.closed {
            return k;
        }
        let k = (k + count - KNOTS_BEYOND_SEAM % count) % count;
        if 2 * k < count { 2 * k } else { 2 * (count - 1 - k) + 1 }
    }

    /// The curve over the spans, its feet found anew so many times. `None` where the points do not determine it.
    fn fit(&self, limits: &[usize], passes: usize, progress: &dyn Progress) -> Option<FreeCurve> {
        let knots = self.knots(limits)?;
        let spans = limits.len() - 1;
        let count = if self.closed { spans } else { knots.count() };
        let mut feet = self.shares.clone();
        let mut found: Option<FreeCurve> = None;
        for _ in 0..=passes {
            let mut matrix = Banded::new(count, 7);
            let mut sides = vec![[0.0; 2]; count];
            for ((p, w), t) in self.points.iter().zip(&self.weights).zip(&feet) {
                let (first, values) = knots.basis(*t);
                let places: [usize; 4] = std::array::from_fn(|k| self.place(first + k, count));
                for (i, a) in places.iter().zip(&values) {
                    for (j, b) in places.iter().zip(&values).filter(|(j, _)| *j <= i) {
                        *matrix.entry(*i, *j) += w * a * b;
                    }
                    (0..2).for_each(|k| sides[*i][k] += w * a * p[k]);
                }
            }
            matrix.factor(progress).ok()?.solve(&mut sides);
            let control = (0..knots.count()).map(|k| sides[self.place(k, count)]).collect();
            let curve = Curve::new(knots.clone(), control).ok()?;
            let next = self.seen_from(curve, feet, limits);
            feet = next.feet.clone();
            found = Some(next);
        }
        found.map(|f| FreeCurve { cost: self.cost(f.sum, count as f64), ..f })
    }

    /// Twice the negative logarithm of the likelihood and the penalty for so many unknowns.
    fn cost(&self, sum: f64, unknowns: f64) -> f64 {
        let spare = self.count - unknowns - 1.0;
        if spare <= 0.0 {
            return f64::INFINITY;
        }
        self.count * libm::log(sum / self.count + self.least * self.least)
            + 2.0 * unknowns * self.count / spare
    }

    /// The distances from a curve, and the feet one step nearer.
    fn seen_from(&self, curve: Curve<[f64; 2]>, feet: Vec<f64>, limits: &[usize]) -> FreeCurve {
        let (from, to) = curve.domain();
        let mut feet = feet;
        let mut residuals = Vec::with_capacity(feet.len());
        let mut last = from;
        for (p, t) in self.points.iter().zip(&mut feet) {
            let mut at = [[0.0; 2]; 2];
            curve.derivatives_into(*t, &mut at);
            let [place, along] = at;
            let d = [p[0] - place[0], p[1] - place[1]];
            let size = libm::hypot(along[0], along[1]).max(f64::MIN_POSITIVE);
            residuals.push((along[0] * d[1] - along[1] * d[0]) / size);
            // The order of the row stands.
            *t = (*t + (along[0] * d[0] + along[1] * d[1]) / (size * size)).clamp(last, to);
            last = *t;
        }
        let sum = residuals.iter().zip(&self.weights).map(|(r, w)| w * r * r).sum();
        FreeCurve { limits: limits.to_vec(), curve, feet, residuals, sum, cost: f64::INFINITY }
    }

    /// Spans of as many points each.
    fn even(&self, spans: usize) -> Vec<usize> {
        let n = self.points.len();
        (0..=spans).map(|k| k * n / spans).collect()
    }

    /// Sums of squares of the distances in each span.
    fn squares(&self, found: &FreeCurve) -> Vec<f64> {
        let own = |w: &[usize]| (w[0]..w[1]).map(|i| self.weights[i] * found.residuals[i].powi(2)).sum();
        found.limits.windows(2).map(own).collect()
    }

    /// The variance of points about a curve in the middle one of its spans, each with an unknown.
    fn typical(&self, found: &FreeCurve) -> f64 {
        let each = found.limits.windows(2).zip(self.squares(found));
        let mut all: Vec<f64> = each.map(|(w, square)| square / (w[1] - w[0] - 1).max(1) as f64).collect();
        all.sort_by(f64::total_cmp);
        all[all.len() / 2] + self.least * self.least
    }

    /// The cheapest curve of those whose spans are equal, and of those whose spans are halved where the points ask for it.
    fn cheapest(&self, progress: &dyn Progress) -> Option<FreeCurve> {
        let n = self.points.len();
        let mut levels = vec![];
        let mut spans = MIN_SPANS as f64;
        while MIN_POINTS_PER_SPAN * spans as usize <= n {
            levels.push(self.fit(&self.even(spans as usize), FIT_PASSES[0], progress)?);
            spans *= SPAN_GROWTH;
        }
        let cheapest = (0..levels.len()).min_by(|a, b| levels[*a].cost.total_cmp(&levels[*b].cost))?;
        let variance = self.typical(&levels[levels.len() - 1]);
        let mut own = self.fit(&self.even(MIN_SPANS), FIT_PASSES[0], progress)?;
        let mut best: Option<FreeCurve> = None;
        for _ in 0..MAX_SPAN_HALVINGS {
            let mut next = vec![0];
            for (w, square) in own.limits.windows(2).zip(self.squares(&own)) {
                let count = w[1] - w[0];
                if count >= 2 * MIN_POINTS_PER_SPAN
                    && square > MAX_SPAN_VARIANCE_RATIO * variance * count as f64
                {
                    next.push((w[0] + w[1]) / 2);
                }
                next.push(w[1]);
            }
            if next.len() == own.limits.len() {
                break;
            }
            own = self.fit(&next, FIT_PASSES[0], progress)?;
            if best.as_ref().is_none_or(|b| own.cost < b.cost) {
                best = Some(own.clone());
            }
        }
        let even = levels.swap_remove(cheapest);
        let best = best.filter(|b| b.cost < even.cost).unwrap_or(even);
        let mut found = self.fit(&best.limits, FIT_PASSES[1], progress)?;
        for _ in 0..FINAL_FOOT_STEPS {
            found = self.seen_from(found.curve, found.feet, &found.limits);
        }
        Some(found)
    }
}

/// The contour of a row of a free form, as the surface that it was cut from tells.
pub(super) fn propose(
    question: &Question,
    best: Option<&Contour>,
    progress: &dyn Progress,
) -> Result<Option<Candidate>, SectionError> {
    let is_stated = question.options.noise.is_some() || question.options.continuity.is_some();
    let Some(form) = question.prior.free_form.filter(|_| !is_stated && best.is_none()) else {
        return Ok(None);
    };
    Ok(free_form(question, form, progress)?.and_then(Candidate::beyond_chance))
}

/// The contour of a row of a free form, whose surface departs from smooth ones by `form`. `None` where lines and arcs are a part of it, or
/// where its points are too few or scatter by more than they are apart.
///
/// # Errors
/// Cancelled.
fn free_form(
    question: &Question,
    form: f64,
    progress: &dyn Progress,
) -> Result<Option<Contour>, SectionError> {
    let mut clean = question.clean.clone();
    let (noise, step) = noise(&clean.points, clean.closed);
    if step > 1 || clean.points.len() < MIN_POINTS_PER_SPAN * MIN_SPANS {
        return Ok(None);
    }
    let outliers = clean.outliers(noise.max(clean.rounding), step);
    clean.bring_in(&outliers);
    let row = Row::new(&clean, &outliers);
    let found = row.cheapest(progress).filter(|f| f.is_all(&row, form));
    if progress.cancelled() {
        return Err(Cancelled.into());
    }
    let Some(found) = found else { return Ok(None) };
    let mut found = found.joined(&row, &clean);
    found.finish(&clean, 0, question.points.len(), outliers);
    Ok(Some(found.contour))
}

impl FreeCurve {
    /// Number of its unknowns.
    fn unknowns(&self, closed: bool) -> f64 {
        (self.limits.len() - 1) as f64 + if closed { 0.0 } else { 3.0 }
    }

    /// Standard deviation of the points about it.
    fn noise(&self, row: &Row) -> f64 {
        let spare = row.count - self.unknowns(row.closed);
        (self.sum / spare.max(1.0)).sqrt().max(row.least)
    }

    /// Whether no line and no arc is a part of the row.
    fn is_all(&self, row: &Row, form: f64) -> bool {
        let noise = self.noise(row).max(MIN_FORM_SHARE * form);
        let mut before = vec![0.0];
        for w in self.limits.windows(2) {
            for i in w[0]..w[1] {
                let off = self.residuals[i] / noise;
                before.push(before[i] + row.weights[i] * off * off + 2.0 / (w[1] - w[0]) as f64);
            }
        }
        let [line, arc, each] = UNKNOWNS_PER_KIND.map(|unknowns| 2.0 * unknowns);
        let rare = 2.0 * libm::log(SEGMENT_RARITY);
        let fewest = MIN_POINTS_OF_SEGMENT.min(row.points.len() / 2);
        let penalty = Penalty { line: line + rare, arc: arc + rare, noise, fewest, places: MAX_PART_STARTS };
        kinds_with_free(row.points, &row.weights, &penalty, &FreeCost { each, before })
            == [SegmentKind::Spline]
    }

    fn joined(self, row: &Row, clean: &Clean) -> Joined {
        let (noise, unknowns) = (self.noise(row), self.unknowns(row.closed));
        let n = clean.points.len();
        let (first, last) = (self.feet[0], self.feet[n - 1]);
        let ends = if clean.closed { (0.0, 1.0) } else { (first, last) };
        let part = self.curve.part(ends.0, ends.1).unwrap_or(self.curve);
        let (from, to) = part.domain();
        let length = part.length(from, to);
        let kept = |i: &usize| row.weights[*i] > 0.0;
        let off = || (0..n).filter(kept).map(|i| self.residuals[i]);
        let mut stations = vec![];
        let (mut at, mut way) = (from, 0.0);
        for t in &self.feet {
            let t = t.clamp(from, to);
            way += part.length(at, t);
            at = t;
            stations.push(way);
        }
        let bend = [from, to].map(|t| part.curvature(t).unwrap_or(0.0));
        let places = [part.at(from), part.at(to)];
        let mut segment =
            Segment::bare(Geometry::Spline { curve: part, deviation: 0.0 }, places, length, bend);
        segment.count = off().count();
        segment.rms = (off().map(|r| r * r).sum::<f64>() / segment.count.max(1) as f64).sqrt();
        segment.max = off().fold(0.0, |m, r| m.max(r.abs()));
        Joined::of(Contour {
            closed: clean.closed,
            segments: vec![segment],
            noise,
            unknowns,
            independent: row.count,
            spacing: clean.spacing,
            labels: vec![0; n],
            residuals: self.residuals,
            stations,
            ..Contour::default()
        })
    }
}

#[cfg(test)]
mod tests;
