//! The spans of a sequence of knots, and the polynomials that the basis functions are on each.

use super::basis::Knots;

/// The spans between distinct knots, each with a coordinate of its own from −1 to 1.
///
/// Within a span the `degree + 1` functions that are not 0 are polynomials of that coordinate. Spans with many places, such as
/// the points of a scan, are summed by powers of the place.
#[derive(Clone, Debug)]
pub struct Spans {
    degree: usize,
    /// Distinct knots.
    limits: Vec<f64>,
    /// Index of the first function of each span.
    first: Vec<usize>,
    /// `(degree + 1)²` numbers of each span: row `a` has the coefficients of function `first + a`, lowest power first.
    coefficients: Vec<f64>,
    /// Spans a unit of the parameter, were they equal.
    rate: f64,
}

impl Spans {
    /// The spans of these knots.
    pub fn new(knots: &Knots) -> Spans {
        let (limits, p) = (knots.distinct(), knots.degree());
        let mut first = vec![];
        let mut coefficients = vec![];
        for w in limits.windows(2) {
            let (middle, half) = (0.5 * (w[0] + w[1]), 0.5 * (w[1] - w[0]));
            let (index, rows) = knots.derivatives(middle, p);
            first.push(index);
            for a in 0..=p {
                let mut factor = 1.0;
                for (k, row) in rows.iter().enumerate() {
                    factor *= if k == 0 { 1.0 } else { half / k as f64 };
                    coefficients.push(row[a] * factor);
                }
            }
        }
        let rate = first.len() as f64 / (limits[limits.len() - 1] - limits[0]);
        Spans { degree: p, limits, first, coefficients, rate }
    }
    /// Degree of the functions.
    pub fn degree(&self) -> usize {
        self.degree
    }
    /// Number of spans.
    pub fn count(&self) -> usize {
        self.first.len()
    }
    /// Index of the first function that is not 0 on a span.
    pub fn first(&self, span: usize) -> usize {
        self.first[span]
    }
    /// Ends of a span.
    pub fn limits(&self, span: usize) -> (f64, f64) {
        (self.limits[span], self.limits[span + 1])
    }
    /// Half the length of a span: what a step of 1 of its coordinate is.
    pub fn half(&self, span: usize) -> f64 {
        0.5 * (self.limits[span + 1] - self.limits[span])
    }
    /// The polynomials of a span, as the field of this name has them.
    pub fn polynomials(&self, span: usize) -> &[f64] {
        let size = (self.degree + 1) * (self.degree + 1);
        &self.coefficients[span * size..(span + 1) * size]
    }
    /// The span of a parameter and its coordinate there; outside of the domain those of the nearer end.
    #[inline]
    pub fn locate(&self, t: f64) -> (usize, f64) {
        self.locate_among(t, 0, self.first.len() - 1)
    }
    /// The span of a parameter; outside of the domain that of the nearer end.
    #[inline]
    pub fn span_of(&self, t: f64) -> usize {
        self.span_among(t, 0, self.first.len() - 1)
    }
    /// The span of a parameter and its coordinate there, among the spans from `first` to `last`: at their ends seen from within.
    #[inline]
    pub(super) fn locate_among(&self, t: f64, first: usize, last: usize) -> (usize, f64) {
        let k = self.span_among(t, first, last);
        let (from, to) = self.limits(k);
        (k, ((2.0 * t - from - to) / (to - from)).clamp(-1.0, 1.0))
    }
    #[inline]
    fn span_among(&self, t: f64, first: usize, last: usize) -> usize {
        let mut k = ((t - self.limits[0]) * self.rate).clamp(first as f64, last as f64) as usize;
        while k > first && t < self.limits[k] {
            k -= 1;
        }
        while k < last && t >= self.limits[k + 1] {
            k += 1;
        }
        k
    }
}
