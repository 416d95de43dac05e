//! Neville's and de Boor's pyramids: the same linear interpolations, between other knots.

use super::value::Value;

/// The polynomial of least degree through `values` at `knots`, at `t`: Neville's pyramid of Lagrange interpolation.
///
/// `None` where the two lists differ in length or are empty, or two knots are equal. Cost: the square of the number.
///
/// Three mass points on a half circle give it exactly:
/// ```
/// use trueness_geom::spline::{pyramid::neville, value::Mass};
/// let points = [([-1.0, 0.0], 2.0), ([0.0, 1.0], 1.0), ([1.0, 0.0], 2.0)].map(|(p, m)| Mass::new(p, m));
/// let [x, y] = neville(&[-1.0, 0.0, 1.0], &points, 0.3).unwrap().place().unwrap();
/// assert!((x * x + y * y - 1.0).abs() < 1e-15);
/// ```
pub fn neville<V: Value>(knots: &[f64], values: &[V], t: f64) -> Option<V> {
    if knots.len() != values.len() {
        return None;
    }
    let mut row = values.to_vec();
    for width in 1..row.len() {
        for i in 0..row.len() - width {
            let length = knots[i + width] - knots[i];
            if length == 0.0 {
                return None;
            }
            row[i] = row[i].between((t - knots[i]) / length, row[i + 1]);
        }
    }
    row.first().copied()
}

/// The blossom (polar form) of the piece of a spline over the knot span `span`, at `arguments`, as many as the degree. It is de
/// Boor's pyramid with an argument of its own for every level. With equal arguments it is the curve itself.
///
/// `knots[span] < knots[span + 1]` must hold, with `degree` knots and control points on either side; the callers of
/// this crate see to it.
pub(super) fn blossom<V: Value>(knots: &[f64], points: &[V], span: usize, arguments: &[f64]) -> V {
    let degree = arguments.len();
    let mut row: Vec<V> = points[span - degree..=span].to_vec();
    for (level, t) in arguments.iter().enumerate() {
        for j in 0..degree - level {
            let i = span - degree + level + 1 + j;
            let (from, to) = (knots[i], knots[i + degree - level]);
            row[j] = row[j].between((t - from) / (to - from), row[j + 1]);
        }
    }
    row[0]
}
