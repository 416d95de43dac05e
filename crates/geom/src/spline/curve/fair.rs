//! How much a curve bends: the integral of the squared second derivative, as a matrix over its control points.

use super::super::basis::Knots;

/// The symmetric matrix `E` with `pᵀ E p = ∫ |C''|²` for control points `p`: row `i` holds the entries of the columns
/// `i … i + degree`.
///
/// By Gauss and Legendre's rule with as many places per span as make it exact.
pub(super) fn bending(knots: &Knots) -> Vec<Vec<f64>> {
    let p = knots.degree();
    let mut rows = vec![vec![0.0; p + 1]; knots.count()];
    if p < 2 {
        return rows;
    }
    let rule = gauss(p - 1);
    for span in knots.distinct().windows(2) {
        let (middle, half) = (0.5 * (span[0] + span[1]), 0.5 * (span[1] - span[0]));
        for (x, w) in &rule {
            let (first, d) = knots.derivatives(middle + half * x, 2);
            for a in 0..=p {
                for b in a..=p {
                    rows[first + a][b - a] += half * w * d[2][a] * d[2][b];
                }
            }
        }
    }
    rows
}

/// Places and weights of Gauss and Legendre's rule on −1 … 1: roots of the Legendre polynomial by Newton's method.
fn gauss(count: usize) -> Vec<(f64, f64)> {
    let n = count.max(1);
    let root = |i: usize| {
        let mut x = libm::cos(std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5));
        let mut slope = 1.0;
        for _ in 0..100 {
            let (mut before, mut now) = (1.0, x);
            for k in 2..=n {
                let k = k as f64;
                (before, now) = (now, ((2.0 * k - 1.0) * x * now - (k - 1.0) * before) / k);
            }
            slope = n as f64 * (x * now - before) / (x * x - 1.0);
            let step = now / slope;
            x -= step;
            if step.abs() < 1e-16 {
                break;
            }
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..n).map(root).collect()
}
