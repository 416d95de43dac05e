//! Knots in and out, and degrees up, without changing the curve.
//!
//! Every control point is the blossom of the curve at the knots it belongs to. So the points of new knots are blossoms at the
//! new knots. (Ramshaw 1987; Goldman and Lyche, Knot Insertion and Deletion Algorithms, 1993.)

use super::super::basis::{KnotError, Knots};
use super::super::pyramid::blossom;
use super::super::value::Value;
use super::b_spline::Curve;

impl<V: Value> Curve<V> {
    /// The same curve with the knot `t` once more.
    ///
    /// # Errors
    /// [`KnotError`] where `t` is outside of the domain or then stands too often.
    pub fn insert(&self, t: f64) -> Result<Curve<V>, KnotError> {
        Ok(self.over(&self.knots.with(t)?))
    }

    /// Control points of the Bézier curves that the curve consists of, one after the other, ends shared: of degree `p` and
    /// `n` spans `p n + 1`.
    ///
    /// ```
    /// use trueness_geom::spline::{basis::Knots, curve::Curve};
    /// let points = vec![[0.0, 0.0], [1.0, 2.0], [2.0, -1.0], [3.0, 1.0], [4.0, 0.0]];
    /// let curve = Curve::new(Knots::uniform(3, 2, 0.0, 1.0), points).unwrap();
    /// let (control, middle) = (curve.bezier(), curve.at(0.5));
    /// assert_eq!(control.len(), 7);
    /// assert!((0..2).all(|k| (control[3][k] - middle[k]).abs() < 1e-15));
    /// ```
    pub fn bezier(&self) -> Vec<V> {
        let degree = self.knots.degree();
        let mut curve = self.clone();
        let distinct = curve.knots.distinct();
        for knot in &distinct[1..distinct.len() - 1] {
            while curve.knots.multiplicity(*knot) < degree {
                match curve.insert(*knot) {
                    Ok(finer) => curve = finer,
                    Err(_) => break,
                }
            }
        }
        curve.points
    }

    /// The curve between two parameters, `from` below `to`.
    ///
    /// # Errors
    /// [`KnotError`] where they are not within the domain, or in that order.
    ///
    /// ```
    /// use trueness_geom::spline::{basis::Knots, curve::Curve};
    /// let points = vec![[0.0, 0.0], [1.0, 2.0], [2.0, -1.0], [3.0, 1.0], [4.0, 0.0]];
    /// let curve = Curve::new(Knots::uniform(3, 2, 0.0, 1.0), points).unwrap();
    /// let part = curve.part(0.2, 0.9).unwrap();
    /// assert_eq!(part.domain(), (0.2, 0.9));
    /// assert!([0.2, 0.4, 0.5, 0.9].iter().all(|t| (part.at(*t)[1] - curve.at(*t)[1]).abs() < 1e-14));
    /// ```
    pub fn part(&self, from: f64, to: f64) -> Result<Curve<V>, KnotError> {
        let degree = self.knots.degree();
        let mut curve = self.clone();
        for end in [from, to] {
            while curve.knots.multiplicity(end) < degree {
                curve = curve.insert(end)?;
            }
        }
        // Where `degree` knots are equal, the point before them is the place of the curve there. A clamped start has one more.
        let values = curve.knots.values();
        let first = values.partition_point(|k| *k < from).saturating_sub(1);
        let past = values.partition_point(|k| *k < to);
        let within = values.iter().filter(|k| **k > from && **k < to);
        let ends = |end: f64| std::iter::repeat_n(end, degree + 1);
        let knots = Knots::new(degree, ends(from).chain(within.copied()).chain(ends(to)).collect())?;
        Curve::new(knots, curve.points.get(first..past).unwrap_or_default().to_vec())
    }

    /// The same curve over another domain, which starts before its second knot and ends after its last but one. Beyond its own
    /// ends it goes on as the polynomials there do.
    ///
    /// # Errors
    /// [`KnotError`] where the domain is another one.
    pub fn going_on(&self, (from, to): (f64, f64)) -> Result<Curve<V>, KnotError> {
        let (degree, (first, last)) = (self.knots.degree(), self.domain());
        let inner: Vec<f64> =
            self.knots.values().iter().copied().filter(|k| *k > first && *k < last).collect();
        let knots = Knots::clamped(degree, from, &inner, to)?;
        let own = self.knots.values();
        // The outermost pieces: a point at an end is the blossom of the one there.
        let spans = [degree, self.points.len() - 1];
        let count = self.points.len();
        let point = |i: usize| {
            let arguments = &knots.values()[i + 1..=i + degree];
            let at_start = arguments.first().is_some_and(|t| *t <= from);
            let at_end = arguments.last().is_some_and(|t| *t >= to);
            match (at_start, at_end) {
                (true, _) => blossom(own, &self.points, spans[0], arguments),
                (_, true) => blossom(own, &self.points, spans[1], arguments),
                _ => self.points[i],
            }
        };
        Curve::new(knots.clone(), (0..count).map(point).collect())
    }

    /// The same curve over knots that hold all of its own.
    fn over(&self, knots: &Knots) -> Curve<V> {
        let p = knots.degree();
        let point = |i: usize| {
            let span = self.inner_span(knots.values(), i, p + 1);
            blossom(self.knots.values(), &self.points, span, &knots.values()[i + 1..=i + p])
        };
        Curve { knots: knots.clone(), points: (0..knots.count()).map(point).collect() }
    }

    /// The widest span inside the support of function `i` over finer knots, as a span of this curve. All of them give the same
    /// point; beside a narrow one more digits are lost.
    fn inner_span(&self, knots: &[f64], i: usize, width: usize) -> usize {
        let (from, to) = self.domain();
        let support = knots[i..=i + width].windows(2).filter(|w| w[0] < w[1] && w[0] >= from && w[1] <= to);
        let widest = support.max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
        let middle = widest.map_or(knots[i], |w| 0.5 * (w[0] + w[1]));
        self.knots.span(middle)
    }

    /// The same curve with degree one higher.
    ///
    /// The blossom of the higher degree is the mean of those of the lower with one argument left out.
    pub fn elevated(&self) -> Curve<V> {
        let knots = self.knots.elevated();
        let (p, u) = (knots.degree(), knots.values());
        let point = |i: usize| {
            let span = self.inner_span(u, i, p + 1);
            let all = &u[i + 1..=i + p];
            (0..p).fold(V::ZERO, |sum, excluded| {
                let rest: Vec<f64> =
                    all.iter().enumerate().filter(|(k, _)| *k != excluded).map(|(_, x)| *x).collect();
                sum.plus(1.0 / p as f64, blossom(self.knots.values(), &self.points, span, &rest))
            })
        };
        let points = (0..knots.count()).map(point).collect();
        Curve { knots, points }
    }

    /// The curve without the inner knot number `index`, if it then moves by no more than `tolerance`, and by how much that is.
    /// The measure is the greatest change of a coordinate of a control point, which bounds that of the curve.
    ///
    /// The new control points are computed from either side and meet in the middle: Piegl and Tiller, algorithm A5.8.
    pub fn remove(&self, index: usize, tolerance: f64) -> Option<(Curve<V>, f64)> {
        let knots = self.knots.without(index)?;
        let (p, u) = (self.knots.degree(), self.knots.values());
        let t = *u.get(index)?;
        // Functions whose support holds the knot.
        let last = u.partition_point(|k| *k <= t) - 1;
        let first = last.checked_sub(p)?;
        let (mut low, mut high) = (first, last - self.knots.multiplicity(t));
        let replaced = low..=high;
        let at = |i: usize| (t - u[i]) / (u[i + p + 1] - u[i]);
        let (mut left, mut right) = (self.points[low.checked_sub(1)?], *self.points.get(high + 1)?);
        let (mut new_low, mut new_high) = (vec![], vec![]);
        while high > low {
            let a = at(low);
            left = self.points[low].minus(left.times(1.0 - a)).times(1.0 / a);
            let b = at(high);
            right = self.points[high].minus(right.times(b)).times(1.0 / (1.0 - b));
            new_low.push(left);
            new_high.push(right);
            low += 1;
            high -= 1;
        }
        let moved = if high < low {
            // The two last ones stand for the same point.
            let middle = left.between(0.5, right);
            let (l, r) = (new_low.pop(), new_high.pop());
            new_low.push(middle);
            l.zip(r).map_or(0.0, |(l, r)| l.minus(r).size())
        } else {
            let a = at(low);
            self.points[low].minus(left.between(a, right)).size()
        };
        if moved.is_nan() || moved > tolerance {
            return None;
        }
        let mut points = self.points.clone();
        new_high.reverse();
        points.splice(replaced, new_low.into_iter().chain(new_high));
        Some((Curve::new(knots, points).ok()?, moved))
    }
}
