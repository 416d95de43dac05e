//! The thin-plate term: the integral of the squared second derivatives over the parameters.

use super::stencil::Stencil;
use trueness_geom::spline::spans::Spans;

/// The matrix `E` with `pᵀ E p = ∫∫ |S_uu|² + 2 |S_uv|² + |S_vv|²` for control points `p`.
pub(super) fn thin_plate(spans: &[Spans; 2], counts: [usize; 2]) -> Stencil {
    let [p, q] = [spans[0].degree(), spans[1].degree()];
    let u: [Vec<f64>; 3] = std::array::from_fn(|order| products(&spans[0], counts[0], order));
    let v: [Vec<f64>; 3] = std::array::from_fn(|order| products(&spans[1], counts[1], order));
    let mut energy = Stencil::new(counts, [p, q]);
    for i in 0..counts[0] {
        for j in 0..counts[1] {
            for a in 0..=p.min(counts[0] - 1 - i) {
                let row = energy.row(i * counts[1] + j, a);
                for other in j.saturating_sub(q)..=(j + q).min(counts[1] - 1) {
                    let of_v = j.min(other) * (q + 1) + j.abs_diff(other);
                    let of_u = i * (p + 1) + a;
                    row[other + q - j] =
                        u[2][of_u] * v[0][of_v] + 2.0 * u[1][of_u] * v[1][of_v] + u[0][of_u] * v[2][of_v];
                }
            }
        }
    }
    energy
}

/// Integrals of the products of two derivatives of this order: `degree + 1` of each function, with itself and the next ones.
fn products(spans: &Spans, count: usize, order: usize) -> Vec<f64> {
    let p = spans.degree();
    let mut out = vec![0.0; count * (p + 1)];
    for span in 0..spans.count() {
        let own = over_span(spans, span, order, (-1.0, 1.0));
        for a in 0..=p {
            for b in a..=p {
                out[(spans.first(span) + a) * (p + 1) + b - a] += own[a * (p + 1) + b];
            }
        }
    }
    out
}

/// Integrals of the squares of the functions.
pub(super) fn squares(spans: &Spans) -> Vec<f64> {
    let p = spans.degree();
    let count = spans.first(spans.count() - 1) + p + 1;
    products(spans, count, 0).chunks_exact(p + 1).map(|c| c[0]).collect()
}

/// Integrals of the products of two derivatives of this order, from one local coordinate of a span to another: `(degree + 1)²` numbers.
pub(super) fn over_span(spans: &Spans, span: usize, order: usize, (from, to): (f64, f64)) -> Vec<f64> {
    let p = spans.degree();
    let half = spans.half(span);
    let powers: Vec<f64> = (1..=2 * p + 1).map(|n| (power(to, n) - power(from, n)) / n as f64).collect();
    let scale = half * libm::pow(half, -2.0 * order as f64);
    let polynomials: Vec<Vec<f64>> =
        spans.polynomials(span).chunks_exact(p + 1).map(|c| derived(c, order)).collect();
    let mut out = Vec::with_capacity((p + 1) * (p + 1));
    for a in &polynomials {
        for b in &polynomials {
            let mut sum = 0.0;
            for (k, x) in a.iter().enumerate() {
                b.iter().enumerate().for_each(|(l, y)| sum += x * y * powers[k + l]);
            }
            out.push(scale * sum);
        }
    }
    out
}

fn power(x: f64, n: usize) -> f64 {
    (0..n).fold(1.0, |product, _| product * x)
}

/// The derivative of a polynomial.
fn derived(coefficients: &[f64], order: usize) -> Vec<f64> {
    let mut own = coefficients.to_vec();
    for _ in 0..order {
        own = own.iter().enumerate().skip(1).map(|(k, c)| k as f64 * c).collect();
    }
    own
}
