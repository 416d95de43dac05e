//! A B-spline curve: control points over knots, its places and derivatives.

use super::super::basis::{KnotError, Knots};
use super::super::pyramid::blossom;
use super::super::value::Value;

/// A B-spline curve of points, of vectors, or of mass points.
///
/// ```
/// use trueness_geom::spline::{basis::Knots, curve::Curve};
/// let points = vec![[0.0, 0.0], [1.0, 2.0], [3.0, 2.0], [4.0, 0.0]];
/// let curve = Curve::new(Knots::uniform(3, 1, 0.0, 1.0), points).unwrap();
/// assert_eq!(curve.at(0.5), [2.0, 1.5]);
/// assert_eq!(curve.derivative(0.0, 1), [3.0, 6.0]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Curve<V> {
    pub(super) knots: Knots,
    pub(super) points: Vec<V>,
}

/// Greatest degree at which places and derivatives are found without allocating.
const MAX_INLINE_DEGREE: usize = 5;

impl<V: Value> Curve<V> {
    /// The curve of these control points.
    ///
    /// # Errors
    /// [`KnotError::Points`] where their number does not fit the knots.
    pub fn new(knots: Knots, points: Vec<V>) -> Result<Curve<V>, KnotError> {
        match points.len() == knots.count() {
            true => Ok(Curve { knots, points }),
            false => Err(KnotError::Points { found: points.len(), needed: knots.count() }),
        }
    }
    /// The curve of as many control points as the knots have functions; the callers of this crate see to it.
    pub(in crate::spline) fn over_knots(knots: Knots, points: Vec<V>) -> Curve<V> {
        Curve { knots, points }
    }
    /// Its knots and degree.
    pub fn knots(&self) -> &Knots {
        &self.knots
    }
    /// Its control points.
    pub fn points(&self) -> &[V] {
        &self.points
    }
    /// First and last parameter.
    pub fn domain(&self) -> (f64, f64) {
        self.knots.domain()
    }

    /// The curve at `t`, by de Boor's pyramid; outside of its domain that of the nearer end.
    pub fn at(&self, t: f64) -> V {
        if self.knots.degree() <= MAX_INLINE_DEGREE {
            let mut place = [V::ZERO];
            self.derivatives_into(t, &mut place);
            return place[0];
        }
        let (from, to) = self.domain();
        let arguments = vec![t.clamp(from, to); self.knots.degree()];
        blossom(self.knots.values(), &self.points, self.knots.span(t), &arguments)
    }

    /// The derivative of this order at `t`; from the right, at the last knot from the left.
    pub fn derivative(&self, t: f64, order: usize) -> V {
        if order > MAX_INLINE_DEGREE {
            return self.derivatives(t, order)[order];
        }
        let mut all = [V::ZERO; MAX_INLINE_DEGREE + 1];
        self.derivatives_into(t, &mut all[..=order]);
        all[order]
    }

    /// The curve and its derivatives up to `order` at `t`.
    pub fn derivatives(&self, t: f64, order: usize) -> Vec<V> {
        let mut all = vec![V::ZERO; order + 1];
        self.derivatives_into(t, &mut all);
        all
    }

    /// The curve and as many derivatives at `t` as there is room for, into `out`; those above the degree are 0. Up to degree 5
    /// nothing is allocated.
    ///
    /// ```
    /// use trueness_geom::spline::{basis::Knots, curve::Curve};
    /// let curve = Curve::new(Knots::uniform(2, 1, 0.0, 1.0), vec![[0.0], [0.5], [2.0]]).unwrap();
    /// let mut out = [[0.0]; 3];
    /// curve.derivatives_into(0.5, &mut out);
    /// assert_eq!(out, [[0.75], [2.0], [2.0]]);
    /// ```
    pub fn derivatives_into(&self, t: f64, out: &mut [V]) {
        let p = self.knots.degree();
        if p > MAX_INLINE_DEGREE {
            let (first, rows) = self.knots.derivatives(t, out.len().saturating_sub(1));
            for (o, row) in out.iter_mut().zip(&rows) {
                *o = row.iter().zip(&self.points[first..]).fold(V::ZERO, |sum, (n, p)| sum.plus(*n, *p));
            }
            return;
        }
        let (from, to) = self.domain();
        let (t, k) = (t.clamp(from, to), self.knots.span(t));
        let u = self.knots.values();
        // The control points of the derivative, where they act on the span.
        let mut own = [V::ZERO; MAX_INLINE_DEGREE + 1];
        own[..=p].copy_from_slice(&self.points[k - p..=k]);
        let (mut spare, last) = ([V::ZERO; MAX_INLINE_DEGREE + 1], out.len().saturating_sub(1));
        for (d, o) in out.iter_mut().enumerate() {
            if d > p {
                *o = V::ZERO;
                continue;
            }
            let q = p - d;
            if d > 0 {
                for i in 0..=q {
                    let width = u[k + 1 + i] - u[k + i - q];
                    own[i] = own[i + 1].minus(own[i]).times((q + 1) as f64 / width);
                }
            }
            // De Boor's pyramid of degree q, over a copy where more is to come.
            if d < last {
                spare[..=q].copy_from_slice(&own[..=q]);
            }
            let level = if d == last { &mut own } else { &mut spare };
            for r in 1..=q {
                for i in 0..=q - r {
                    let (low, high) = (u[k + i + r - q], u[k + 1 + i]);
                    let share = (t - low) / (high - low);
                    level[i] = level[i].times(1.0 - share).plus(share, level[i + 1]);
                }
            }
            *o = level[0];
        }
    }

    /// The curve of the first derivative: one degree lower. `None` for degree 0.
    pub fn hodograph(&self) -> Option<Curve<V>> {
        let (p, u) = (self.knots.degree().checked_sub(1)?, self.knots.values());
        let step = |i: usize| {
            let width = u[i + p + 2] - u[i + 1];
            let factor = if width > 0.0 { (p + 1) as f64 / width } else { 0.0 };
            self.points[i + 1].minus(self.points[i]).times(factor)
        };
        let points = (0..self.points.len() - 1).map(step).collect();
        let knots = Knots::new(p, u[1..u.len() - 1].to_vec()).ok()?;
        Curve::new(knots, points).ok()
    }

    /// The same curve run through from its end.
    pub fn reversed(&self) -> Curve<V> {
        let (from, to) = self.domain();
        let values = self.knots.values().iter().rev().map(|k| from + (to - k)).collect();
        let knots = Knots::new(self.knots.degree(), values).unwrap_or_else(|_| self.knots.clone());
        Curve { knots, points: self.points.iter().rev().copied().collect() }
    }
}
