//! Starts for circles and spheres.

use super::scatter::Scatter;
use crate::num::dense;
use crate::space::{Point, dot, minus, plus, times};

/// Guards the division by a distance that may be zero: the derivative there is taken as zero.
pub(super) const MIN_DIVISOR: f64 = f64::MIN_POSITIVE;

/// Centers and radii of circles (`D = 2`) or spheres (`D = 3`) near the points. One is the algebraic fit of Kåsa, which is
/// right for wide arcs and too small for flat ones. The other is the osculating one of a parabola over the flattest direction,
/// which is right for flat ones.
pub(super) fn round_starts<const D: usize>(points: &[Point], scatter: &Scatter) -> Vec<(Point, f64)> {
    let mut starts = Vec::with_capacity(2);
    // Coordinates along the principal directions, the flattest first; the plane's own normal is left out.
    let axes = &scatter.axes[3 - D..];
    let local: Vec<[f64; D]> = points
        .iter()
        .map(|&p| {
            let q = minus(p, scatter.mean);
            std::array::from_fn(|k| dot(axes[k], q))
        })
        .collect();
    let place = |c: [f64; D]| (0..D).fold(scatter.mean, |p, k| plus(p, times(c[k], axes[k])));
    // |q|² = 2 c·q + (r² − |c|²)
    let whole = |q: &[f64; D]| {
        let mut columns = vec![1.0];
        columns.extend(q);
        (columns, q.iter().map(|x| x * x).sum::<f64>())
    };
    if let Some(x) = least_squares(local.iter().map(whole)) {
        let center: [f64; D] = std::array::from_fn(|k| x[k + 1] / 2.0);
        let square = x[0] + center.iter().map(|c| c * c).sum::<f64>();
        if square > 0.0 {
            starts.push((place(center), square.sqrt()));
        }
    }
    // h = a + b·t + κ/2 |t|²
    let cap = |q: &[f64; D]| {
        let mut columns = vec![1.0];
        columns.extend(&q[1..]);
        columns.push(0.5 * q[1..].iter().map(|x| x * x).sum::<f64>());
        (columns, q[0])
    };
    if let Some(x) = least_squares(local.iter().map(cap)) {
        let curvature = x[D];
        let radius = 1.0 / curvature.abs();
        if radius.is_finite() && radius < 1e6 {
            let mut center = [0.0; D];
            center[0] = x[0] + 1.0 / curvature;
            for k in 1..D {
                center[k] = -x[k] / curvature;
            }
            starts.push((place(center), radius));
        }
    }
    starts
}

/// Coefficients `x` that minimize Σ (columns·x − value)², by normal equations: good enough for a start.
/// `None` where the columns do not determine them.
pub(super) fn least_squares(rows: impl Iterator<Item = (Vec<f64>, f64)>) -> Option<Vec<f64>> {
    let mut normal: Vec<Vec<f64>> = Vec::new();
    let mut right: Vec<f64> = Vec::new();
    for (columns, value) in rows {
        if normal.is_empty() {
            normal = vec![vec![0.0; columns.len()]; columns.len()];
            right = vec![0.0; columns.len()];
        }
        for (i, a) in columns.iter().enumerate() {
            right[i] += a * value;
            for (j, b) in columns.iter().enumerate() {
                normal[i][j] += a * b;
            }
        }
    }
    if normal.is_empty() {
        return None;
    }
    dense::solve(normal, right)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::norm;

    #[test]
    fn points_on_a_sphere_give_that_sphere() {
        let (center, radius) = ([0.3, -0.2, 0.1], 0.7);
        let points: Vec<Point> = (0..40)
            .map(|k| {
                let (a, b) = (0.7 * f64::from(k), 0.3 * f64::from(k));
                plus(center, times(radius, [a.cos() * b.sin(), a.sin() * b.sin(), b.cos()]))
            })
            .collect();
        let starts = round_starts::<3>(&points, &Scatter::of(&points));
        let (c, r) = starts[0];
        assert!(norm(minus(c, center)) < 1e-12 && (r - radius).abs() < 1e-12);
    }

    #[test]
    fn a_flat_arc_gives_its_radius() {
        // 4° of a circle of radius 20: the parabola is the better of the two.
        let points: Vec<Point> = (0..30)
            .map(|k| {
                let a = 0.07 * f64::from(k) / 29.0;
                [20.0 * a.sin(), 20.0 * a.cos() - 20.0, 0.0]
            })
            .collect();
        let starts = round_starts::<2>(&points, &Scatter::flat(&points));
        assert!(starts.iter().any(|(_, r)| (r - 20.0).abs() < 0.2), "{starts:?}");
    }
}
