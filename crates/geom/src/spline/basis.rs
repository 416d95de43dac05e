//! Knots and the basis functions over them, of curves and surfaces.

/// Why numbers are no knots.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum KnotError {
    /// A knot is below the one before, infinite or not a number.
    #[error("knot {index} is {value}: knots must be finite and must not fall")]
    Order {
        /// Its index.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// Fewer than two times the degree and two.
    #[error("{found} knots are too few: degree {degree} needs at least {}", 2 * degree + 2)]
    TooFew {
        /// Knots given.
        found: usize,
        /// The degree.
        degree: usize,
    },
    /// A knot stands too often.
    #[error("knot {value} stands {times} times: at most degree + 1 = {} are allowed", degree + 1)]
    Multiple {
        /// Its value.
        value: f64,
        /// How often it stands.
        times: usize,
        /// The degree.
        degree: usize,
    },
    /// Another number of control points than knots and degree allow.
    #[error("{found} control points do not fit the knots: there must be {needed}")]
    Points {
        /// Points given.
        found: usize,
        /// Points that fit.
        needed: usize,
    },
    /// A weight that is not above 0.
    #[error("the weight of control point {index} is {value}: it must be above 0")]
    Weight {
        /// Its control point, from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
}

/// A sequence of knots that do not fall, with the degree of the functions over it.
///
/// ```
/// use trueness_geom::spline::basis::Knots;
/// let knots = Knots::uniform(3, 4, 0.0, 1.0);
/// let (first, values) = knots.basis(0.3);
/// assert_eq!((knots.count(), first, values.len()), (7, 1, 4));
/// assert!((values.iter().sum::<f64>() - 1.0).abs() < 1e-15);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Knots {
    degree: usize,
    values: Vec<f64>,
}

impl Knots {
    /// Checked knots.
    ///
    /// # Errors
    /// [`KnotError`]: too few, falling, not finite, or one more than `degree + 1` times.
    pub fn new(degree: usize, values: Vec<f64>) -> Result<Knots, KnotError> {
        if values.len() < 2 * degree + 2 {
            return Err(KnotError::TooFew { found: values.len(), degree });
        }
        for (index, value) in values.iter().copied().enumerate() {
            if !value.is_finite() || index > 0 && value < values[index - 1] {
                return Err(KnotError::Order { index, value });
            }
        }
        for group in values.chunk_by(|a, b| a == b) {
            if group.len() > degree + 1 {
                return Err(KnotError::Multiple { value: group[0], times: group.len(), degree });
            }
        }
        let knots = Knots { degree, values };
        let (from, to) = knots.domain();
        if from >= to {
            return Err(KnotError::Multiple { value: from, times: knots.values.len(), degree });
        }
        Ok(knots)
    }

    /// Clamped knots: `degree + 1` times the ends and the increasing numbers `inner` between them.
    ///
    /// # Errors
    /// As [`Knots::new`].
    pub fn clamped(degree: usize, from: f64, inner: &[f64], to: f64) -> Result<Knots, KnotError> {
        let ends = |x: f64| std::iter::repeat_n(x, degree + 1);
        Knots::new(degree, ends(from).chain(inner.iter().copied()).chain(ends(to)).collect())
    }

    /// Clamped knots of `spans` equal spans from `from` to `to`; at least one span, ends are put in order.
    pub fn uniform(degree: usize, spans: usize, from: f64, to: f64) -> Knots {
        let (spans, from, to) = (spans.max(1), from.min(to), from.max(to));
        let at = |i: usize| from + (to - from) * i.min(spans) as f64 / spans as f64;
        let values = (0..=spans + 2 * degree).map(|i| at(i.saturating_sub(degree))).collect();
        Knots { degree, values }
    }

    /// Ascending numbers, none of them too often; the callers of this crate see to it.
    pub(in crate::spline) fn of_sorted(degree: usize, values: Vec<f64>) -> Knots {
        Knots { degree, values }
    }

    /// Degree of the functions.
    pub fn degree(&self) -> usize {
        self.degree
    }
    /// The knots.
    pub fn values(&self) -> &[f64] {
        &self.values
    }
    /// Number of basis functions, and of control points.
    pub fn count(&self) -> usize {
        self.values.len() - self.degree - 1
    }
    /// First and last parameter.
    pub fn domain(&self) -> (f64, f64) {
        (self.values[self.degree], self.values[self.count()])
    }
    /// The knots within the domain, each once, ends included.
    pub fn distinct(&self) -> Vec<f64> {
        let mut all = self.values[self.degree..=self.count()].to_vec();
        all.dedup();
        all
    }
    /// The first knot within that stands more often than the degree, and how often: what is built on it is torn there.
    pub fn torn(&self) -> Option<(f64, usize)> {
        let distinct = self.distinct();
        let mut inner = distinct[1..distinct.len() - 1].iter().map(|knot| (*knot, self.multiplicity(*knot)));
        inner.find(|(_, times)| *times > self.degree())
    }
    /// How often `t` stands among the knots.
    pub fn multiplicity(&self, t: f64) -> usize {
        self.values.iter().filter(|k| **k == t).count()
    }

    /// Index `k` of the span `knots[k] ≤ t < knots[k + 1]` within the domain; the last one at its end. A parameter outside, or
    /// NaN, is taken to the nearer end.
    pub fn span(&self, t: f64) -> usize {
        let (low, high) = (self.degree, self.count());
        let end = self.values[low..=high].partition_point(|k| *k <= t) + low;
        let mut k = end.clamp(low + 1, high) - 1;
        while self.values[k] == self.values[k + 1] && k > low {
            k -= 1;
        }
        while self.values[k] == self.values[k + 1] {
            k += 1;
        }
        k
    }

    /// Index of the first basis function that is not 0 around `t`, and the values of it and the next, `degree + 1` in
    /// all. Their sum is 1.
    pub fn basis(&self, t: f64) -> (usize, Vec<f64>) {
        let (from, to) = self.domain();
        let (k, p) = (self.span(t), self.degree);
        (k - p, self.within(t.clamp(from, to), k, p))
    }

    /// As [`Knots::basis`], with the derivatives: row `i` has the `i`-th, from 0 to `order`. Derivatives above the degree are
    /// 0.
    pub fn derivatives(&self, t: f64, order: usize) -> (usize, Vec<Vec<f64>>) {
        let (first, values) = self.basis(t);
        let (k, p) = (first + self.degree, self.degree);
        let mut rows = vec![values];
        // Column r of `lift` writes the function r of degree p as its derivative's functions of lower degree.
        let mut lift: Vec<Vec<f64>> = (0..=p).map(|r| (0..=p).map(|c| f64::from(r == c)).collect()).collect();
        let (from, to) = self.domain();
        let t = t.clamp(from, to);
        for d in 1..=order {
            if d > p {
                rows.push(vec![0.0; p + 1]);
                continue;
            }
            let q = p - d + 1;
            for row in &mut lift {
                for c in (1..=q).rev() {
                    let i = k - q + c;
                    row[c] = q as f64 * (row[c] - row[c - 1]) / (self.values[i + q] - self.values[i]);
                }
                // Functions of the lower degree are counted from the next control point on.
                row.copy_within(1..=q, 0);
            }
            let lower = self.within(t, k, q - 1);
            rows.push(lift.iter().map(|row| row[..q].iter().zip(&lower).map(|(a, b)| a * b).sum()).collect());
        }
        (first, rows)
    }

    /// Values of the functions of this or a lower degree over the same knots in span `k`: Piegl and Tiller, algorithm A2.2.
    fn within(&self, t: f64, k: usize, degree: usize) -> Vec<f64> {
        let mut n = vec![1.0; degree + 1];
        for j in 1..=degree {
            let mut saved = 0.0;
            for r in 0..j {
                let (right, left) = (self.values[k + r + 1], self.values[k + 1 + r - j]);
                let part = n[r] / (right - left);
                n[r] = saved + (right - t) * part;
                saved = (t - left) * part;
            }
            n[j] = saved;
        }
        n
    }

    /// Parameter values at which the control points act most: the mean of the `degree` knots inside of each.
    pub fn greville(&self) -> Vec<f64> {
        let p = self.degree.max(1);
        (0..self.count()).map(|i| self.values[i + 1..=i + p].iter().sum::<f64>() / p as f64).collect()
    }

    /// These knots and `t`.
    ///
    /// # Errors
    /// [`KnotError`] where `t` then stands too often, or is not inside the domain.
    pub fn with(&self, t: f64) -> Result<Knots, KnotError> {
        let (from, to) = self.domain();
        let mut values = self.values.clone();
        let index = values.partition_point(|k| *k <= t);
        if t.is_nan() || t < from || t > to {
            return Err(KnotError::Order { index, value: t });
        }
        values.insert(index, t);
        Knots::new(self.degree, values)
    }

    /// Every knot once more, for one degree more.
    pub(super) fn elevated(&self) -> Knots {
        let values = self.values.chunk_by(|a, b| a == b).flat_map(|g| std::iter::repeat_n(g[0], g.len() + 1));
        Knots { degree: self.degree + 1, values: values.collect() }
    }

    /// Without the knot number `index`; `None` if that is an end or too few are left.
    pub(super) fn without(&self, index: usize) -> Option<Knots> {
        let mut values = self.values.clone();
        (index < values.len()).then(|| values.remove(index));
        let knots = Knots::new(self.degree, values).ok()?;
        (knots.domain() == self.domain()).then_some(knots)
    }
}
