//! Symmetric matrices over a net of control points, where only near neighbors have an entry.

use trueness_geom::num::banded::Banded;
use trueness_geom::space::Point;

/// A symmetric matrix over a net. Each control point `(i, j)` has an entry with `(i + a, j + b)`.
/// `a` goes from 0 to the first reach, and `b` is within the second one. The other half follows from symmetry; of
/// `a = 0` only `b ≥ 0` is used.
///
/// Memory: `8 (p + 1) (2 q + 1)` bytes for each control point.
#[derive(Clone, Debug)]
pub(super) struct Stencil {
    pub counts: [usize; 2],
    reach: [usize; 2],
    entries: Vec<f64>,
}

impl Stencil {
    pub(super) fn new(counts: [usize; 2], reach: [usize; 2]) -> Stencil {
        let size = (reach[0] + 1) * (2 * reach[1] + 1);
        Stencil { counts, reach, entries: vec![0.0; counts[0] * counts[1] * size] }
    }

    /// The entries of control point number `k` that are `a` rows farther; that with the same column stands in the middle.
    pub(super) fn row(&mut self, k: usize, a: usize) -> &mut [f64] {
        let wide = 2 * self.reach[1] + 1;
        let start = (k * (self.reach[0] + 1) + a) * wide;
        &mut self.entries[start..start + wide]
    }

    /// The entry of control point number `k` with itself.
    pub(super) fn diagonal(&self, k: usize) -> f64 {
        let wide = 2 * self.reach[1] + 1;
        self.entries[k * (self.reach[0] + 1) * wide + self.reach[1]]
    }

    /// Adds another matrix over the same net.
    pub(super) fn add(&mut self, other: &Stencil) {
        self.entries.iter_mut().zip(&other.entries).for_each(|(a, b)| *a += b);
    }

    pub(super) fn trace(&self) -> f64 {
        (0..self.counts[0] * self.counts[1]).map(|k| self.diagonal(k)).sum()
    }

    /// Calls `each` with numbers `k ≤ l` of two control points and their entry.
    fn for_each(&self, mut each: impl FnMut(usize, usize, f64)) {
        let ([m, n], [p, q]) = (self.counts, self.reach);
        let wide = 2 * q + 1;
        for i in 0..m {
            for j in 0..n {
                let k = i * n + j;
                for a in 0..=p.min(m - 1 - i) {
                    let from = if a == 0 { j } else { j.saturating_sub(q) };
                    let row = &self.entries[(k * (p + 1) + a) * wide..][..wide];
                    for other in from..=(j + q).min(n - 1) {
                        each(k, (i + a) * n + other, row[other + q - j]);
                    }
                }
            }
        }
    }

    /// The matrix times a vector for each control point.
    pub(super) fn times(&self, x: &[Point]) -> Vec<Point> {
        let mut out = vec![[0.0; 3]; x.len()];
        self.for_each(|k, l, e| {
            for d in 0..3 {
                out[k][d] += e * x[l][d];
                if k != l {
                    out[l][d] += e * x[k][d];
                }
            }
        });
        out
    }

    /// `self` and the others times their weights, as a matrix for the solver.
    pub(super) fn with(&self, others: &[(f64, &Stencil)]) -> Banded {
        let order = Order::new(self.counts);
        let mut band = Banded::new(self.counts[0] * self.counts[1], order.width(self.reach));
        let mut add = |weight: f64, from: &Stencil| {
            from.for_each(|k, l, e| {
                let (a, b) = (order.of(k), order.of(l));
                *band.entry(a.max(b), a.min(b)) += weight * e;
            });
        };
        add(1.0, self);
        for (weight, other) in others.iter().filter(|(weight, _)| *weight > 0.0) {
            add(*weight, other);
        }
        band
    }
}

/// Numbers of the control points as the solver has them: the direction of fewer ones runs first, so that the band is narrow.
#[derive(Clone, Copy, Debug)]
pub(super) struct Order {
    counts: [usize; 2],
    turned: bool,
}

impl Order {
    pub(super) fn new(counts: [usize; 2]) -> Order {
        Order { counts, turned: counts[0] < counts[1] }
    }
    /// The solver's number of control point `k`.
    pub(super) fn of(self, k: usize) -> usize {
        let [m, n] = self.counts;
        if self.turned { k % n * m + k / n } else { k }
    }
    /// Width of the band.
    pub(super) fn width(self, reach: [usize; 2]) -> usize {
        let [m, n] = self.counts;
        if self.turned { reach[1] * m + reach[0] } else { reach[0] * n + reach[1] }
    }
}
