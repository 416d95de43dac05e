//! The curve on a surface over a straight line between two parameters.
//!
//! Within a cell of knots the surface is a polynomial of degree `p` by `u` and `q` by `v`. So over a line it is one of degree
//! `p + q`. Its Bézier points are sums of the surface's blossoms at the ends (Ramshaw 1989), with positive weights that sum to
//! 1: nothing is approximated.

use super::super::basis::Knots;
use super::super::curve::Curve;
use super::super::pyramid::blossom;
use super::super::value::Value;
use super::tensor::Surface;

/// Places nearer to each other on the line than this share of it are one.
const SAME_LINE_PLACE: f64 = 1e-12;

impl<V: Value> Surface<V> {
    /// The curve `S(from + t (to − from))` for `t` from 0 to 1, exactly. It is a B-spline of degree `p + q`, with a knot `p +
    /// q` times where the line crosses one of the surface.
    ///
    /// Both ends must lie in the domain. Cost: `(p + q)²` blossoms for each cell that the line passes.
    ///
    /// ```
    /// use trueness_geom::spline::{basis::Knots, surface::Surface};
    /// let knots = || Knots::uniform(2, 2, 0.0, 2.0);
    /// let points = (0..16).map(|k| [f64::from(k / 4), f64::from(k % 4), f64::from(k * k % 7)]).collect();
    /// let surface = Surface::new([knots(), knots()], points).unwrap();
    /// let curve = surface.over_line([0.2, 0.0], [1.8, 2.0]);
    /// let (on_curve, on_surface) = (curve.at(0.75), surface.at(1.4, 1.5));
    /// assert!((0..3).all(|k| (on_curve[k] - on_surface[k]).abs() < 1e-14));
    /// ```
    pub fn over_line(&self, from: [f64; 2], to: [f64; 2]) -> Curve<V> {
        let knots = self.knots();
        let degree = knots[0].degree() + knots[1].degree();
        let at = |t: f64| -> [f64; 2] { std::array::from_fn(|k| from[k] + t * (to[k] - from[k])) };
        let cuts = crossings(knots, from, to);
        let ends = || [0.0].into_iter().chain(cuts.iter().copied());
        let mut points = vec![];
        for (start, end) in ends().zip(ends().skip(1).chain([1.0])) {
            // The end of a piece is the start of the next.
            points.pop();
            points.extend(self.piece(at(start), at(end)));
        }
        let inner: Vec<f64> = cuts.iter().flat_map(|t| std::iter::repeat_n(*t, degree)).collect();
        let values = [vec![0.0; degree + 1], inner, vec![1.0; degree + 1]].concat();
        Curve::over_knots(Knots::of_sorted(degree, values), points)
    }

    /// Bézier points of the surface over a line within one cell.
    fn piece(&self, from: [f64; 2], to: [f64; 2]) -> Vec<V> {
        let ([p, q], [_, n]) = (self.knots().each_ref().map(Knots::degree), self.counts());
        let [i, j] = [0, 1].map(|k| self.knots()[k].span(0.5 * (from[k] + to[k])));
        let arguments = |k: usize, degree: usize, ends: usize| -> Vec<f64> {
            (0..degree).map(|a| if a < ends { to[k] } else { from[k] }).collect()
        };
        let [u, v] = self.knots().each_ref().map(Knots::values);
        // The blossoms of each row with none of the arguments at the end, one, and so on.
        let rows: Vec<Vec<V>> = (0..=q)
            .map(|ends| {
                let arguments = arguments(1, q, ends);
                let row = |r: usize| blossom(v, &self.points()[r * n..][..n], j, &arguments);
                let mut of_rows = vec![V::ZERO; self.counts()[0]];
                (i - p..=i).for_each(|r| of_rows[r] = row(r));
                of_rows
            })
            .collect();
        (0..=p + q)
            .map(|k| {
                (k.saturating_sub(q)..=k.min(p)).fold(V::ZERO, |sum, of_u| {
                    let weight = choose(p, of_u) * choose(q, k - of_u) / choose(p + q, k);
                    sum.plus(weight, blossom(u, &rows[k - of_u], i, &arguments(0, p, of_u)))
                })
            })
            .collect()
    }
}

/// Where a line crosses inner knots, as shares of its length, ascending; not at its ends.
fn crossings(knots: &[Knots; 2], from: [f64; 2], to: [f64; 2]) -> Vec<f64> {
    let of = |k: usize| knots[k].distinct().into_iter().map(move |knot| (knot - from[k]) / (to[k] - from[k]));
    let mut all: Vec<f64> =
        of(0).chain(of(1)).filter(|t| (SAME_LINE_PLACE..=1.0 - SAME_LINE_PLACE).contains(t)).collect();
    all.sort_by(f64::total_cmp);
    all.dedup_by(|b, a| *b - *a < SAME_LINE_PLACE);
    all
}

/// Binomial coefficients.
fn choose(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |c, i| c * (n - i) as f64 / (i + 1) as f64)
}
