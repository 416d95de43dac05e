//! Sums of products of a patch's residuals, and what they are expected to be for any covariance.

use crate::fit::Scatter;
use crate::space::{Point, dot, minus, norm};

/// Degree of the polynomial. With the quadratic one a cylinder with a radius of ten spacings shows a third more noise than it
/// has.
const POLYNOMIAL_DEGREE: usize = 4;
/// Coefficients of the polynomial.
const POLYNOMIAL_TERMS: usize = (POLYNOMIAL_DEGREE + 1) * (POLYNOMIAL_DEGREE + 2) / 2;
/// Distances in spacings by which products are summed: 0, then each rounded to a whole number. Beyond these lags sums hold little but
/// chance.
pub(super) const LAG_COUNT: usize = 7;
/// Distances in spacings by which covariances are told apart: 0, then steps of this width.
const COVARIANCE_BIN_WIDTH: f64 = 0.25;
/// Number of these distances: covariances reach ten spacings.
pub(super) const COVARIANCE_BINS: usize = 41;
/// Length that rounding leaves of a column of length 1 that the columns before it hold.
const MAX_DEPENDENT_LENGTH: f64 = 1e-8;

/// The sums of a patch.
#[derive(Clone, Debug)]
pub(super) struct Moments {
    /// For each lag the sum of the products of two residuals, over ordered pairs.
    pub products: [f64; LAG_COUNT],
    /// The contribution of covariance 1 of one bin to each of these sums.
    pub expected: [[f64; COVARIANCE_BINS]; LAG_COUNT],
    /// Ordered pairs of points in each bin.
    pub pairs: [f64; COVARIANCE_BINS],
    /// Points in each bin about the center of the patch.
    pub about_center: [f64; COVARIANCE_BINS],
    /// Points, and those that the polynomial leaves free.
    pub points: f64,
    pub free: f64,
    /// Distance of neighbors, millimeters.
    pub spacing: f64,
}

/// The middle of a bin, in spacings.
pub(super) fn middle(bin: usize) -> f64 {
    if bin == 0 { 0.0 } else { (bin as f64 - 0.5) * COVARIANCE_BIN_WIDTH }
}

impl Moments {
    /// The moments of a patch whose first point is the center. `None` where it has fewer than `size` points or they lie on a
    /// line. `heights` are the places' distances from a surface; without them, those over the plane of the patch.
    pub(super) fn of(places: &[Point], heights: Option<&[f64]>, size: usize) -> Option<Moments> {
        if places.len() < size {
            return None;
        }
        let spacing = spacing(places)?;
        let (polynomial, own) = polynomial(places)?;
        let terms = polynomial.first()?.len();
        let residuals = residuals(&polynomial, heights.unwrap_or(&own));
        let mut all = Moments {
            products: [0.0; LAG_COUNT],
            expected: [[0.0; COVARIANCE_BINS]; LAG_COUNT],
            pairs: [0.0; COVARIANCE_BINS],
            about_center: [0.0; COVARIANCE_BINS],
            points: places.len() as f64,
            free: (places.len() - terms) as f64,
            spacing,
        };
        let pairs = Pairs::of(places, spacing);
        let half = pairs.half_products(&polynomial, terms);
        pairs.each(|i, j, bin, lag| {
            let both = if i == j { 1.0 } else { 2.0 };
            if let Some(lag) = lag {
                all.products[lag] += both * residuals[i] * residuals[j];
            }
            let Some(bin) = bin else { return };
            all.pairs[bin] += both;
            if i == 0 {
                all.about_center[bin] += 1.0;
            }
            for (l, half) in half.iter().enumerate() {
                // The element (i, j) of P B P, B being 1 for the pairs of the lag.
                let projected = inner(&polynomial[i], &half[j]) + inner(&half[i], &polynomial[j]);
                all.expected[l][bin] += both * (f64::from(u8::from(lag == Some(l))) - projected);
            }
        });
        Some(all)
    }
}

type Row = [f64; POLYNOMIAL_TERMS];

fn inner(a: &Row, b: &Row) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// The root of the area of a point, by the median distance from the center.
fn spacing(places: &[Point]) -> Option<f64> {
    let mut far: Vec<f64> = places[1..].iter().map(|p| norm(minus(*p, places[0]))).collect();
    far.sort_by(f64::total_cmp);
    let middle = far.len() / 2;
    let spacing = far[middle] * (std::f64::consts::PI / (middle as f64 + 1.5)).sqrt();
    (spacing > 0.0 && spacing.is_finite()).then_some(spacing)
}

/// Orthonormal columns that span the polynomials over the plane of the patch, as rows of the points, and the heights over it.
fn polynomial(places: &[Point]) -> Option<(Vec<Row>, Vec<f64>)> {
    let Scatter { mean, axes, .. } = Scatter::of(places);
    let local: Vec<[f64; 3]> = places.iter().map(|p| axes.map(|a| dot(a, minus(*p, mean)))).collect();
    let reach = local.iter().map(|q| q[1].abs().max(q[2].abs())).fold(0.0, f64::max);
    if !(reach > 0.0 && reach.is_finite()) {
        return None;
    }
    let mut columns: Vec<Vec<f64>> = vec![];
    for degree in 0..=POLYNOMIAL_DEGREE {
        for k in 0..=degree {
            let power = |q: &[f64; 3]| {
                let [x, y] = [q[1] / reach, q[2] / reach];
                (0..degree - k).map(|_| x).chain((0..k).map(|_| y)).product::<f64>()
            };
            let mut column: Vec<f64> = local.iter().map(power).collect();
            scale(&mut column, 0.0)?;
            // Twice is enough (W. Kahan).
            for _ in 0..2 {
                for before in &columns {
                    let share: f64 = column.iter().zip(before).map(|(a, b)| a * b).sum();
                    column.iter_mut().zip(before).for_each(|(a, b)| *a -= share * b);
                }
            }
            if scale(&mut column, MAX_DEPENDENT_LENGTH).is_some() {
                columns.push(column);
            }
        }
    }
    let row = |i: usize| std::array::from_fn(|k| columns.get(k).map_or(0.0, |c| c[i]));
    Some(((0..places.len()).map(row).collect(), local.iter().map(|q| q[0]).collect()))
}

/// Brings a column to length 1; `None` where it is no longer than `least`.
fn scale(column: &mut [f64], least: f64) -> Option<()> {
    let length = column.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length.is_nan() || length <= least {
        return None;
    }
    column.iter_mut().for_each(|x| *x /= length);
    Some(())
}

fn residuals(polynomial: &[Row], heights: &[f64]) -> Vec<f64> {
    let mut shares = [0.0; POLYNOMIAL_TERMS];
    for (row, height) in polynomial.iter().zip(heights) {
        shares.iter_mut().zip(row).for_each(|(s, q)| *s += q * height);
    }
    polynomial.iter().zip(heights).map(|(row, height)| height - inner(row, &shares)).collect()
}

/// Bins and lags of all pairs.
struct Pairs {
    count: usize,
    /// Bin and lag of `i ≤ j`, row after row; 255 beyond the last.
    kinds: Vec<[u8; 2]>,
}

/// Number of a bin or lag beyond the last one.
const NO_BIN: u8 = u8::MAX;

impl Pairs {
    fn of(places: &[Point], spacing: f64) -> Pairs {
        let mut kinds = Vec::with_capacity(places.len() * (places.len() + 1) / 2);
        for (i, p) in places.iter().enumerate() {
            kinds.push([0, 0]);
            for q in &places[i + 1..] {
                let apart = norm(minus(*p, *q)) / spacing;
                let [bin, lag] = [1.0 + (apart / COVARIANCE_BIN_WIDTH).floor(), apart.round().max(1.0)];
                let or_beyond = |x: f64, end: usize| if x < end as f64 { x as u8 } else { NO_BIN };
                kinds.push([or_beyond(bin, COVARIANCE_BINS), or_beyond(lag, LAG_COUNT)]);
            }
        }
        Pairs { count: places.len(), kinds }
    }

    /// Calls `visit` with both points, bin and lag of each pair `i ≤ j`.
    fn each(&self, mut visit: impl FnMut(usize, usize, Option<usize>, Option<usize>)) {
        let mut kinds = self.kinds.iter();
        for i in 0..self.count {
            for (j, [bin, lag]) in (i..self.count).zip(&mut kinds) {
                let known = |x: u8| (x != NO_BIN).then_some(usize::from(x));
                visit(i, j, known(*bin), known(*lag));
            }
        }
    }

    /// For each lag `B Q − Q (Qᵀ B Q) / 2`, with the columns `Q` and 1 in `B` for its pairs: `P B P = B − Q hᵀ − h Qᵀ` with that `h`.
    fn half_products(&self, polynomial: &[Row], terms: usize) -> Vec<Vec<Row>> {
        let mut all = vec![vec![[0.0; POLYNOMIAL_TERMS]; self.count]; LAG_COUNT];
        self.each(|i, j, _, lag| {
            let Some(lag) = lag else { return };
            let of_lag = &mut all[lag];
            of_lag[i].iter_mut().zip(&polynomial[j]).for_each(|(h, q)| *h += q);
            if i != j {
                of_lag[j].iter_mut().zip(&polynomial[i]).for_each(|(h, q)| *h += q);
            }
        });
        for of_lag in &mut all {
            let mut inside = [[0.0; POLYNOMIAL_TERMS]; POLYNOMIAL_TERMS];
            for (row, half) in polynomial.iter().zip(&*of_lag) {
                for (inside, q) in inside.iter_mut().zip(&row[..terms]) {
                    inside.iter_mut().zip(half).for_each(|(sum, h)| *sum += q * h);
                }
            }
            for (row, half) in polynomial.iter().zip(of_lag) {
                for (inside, q) in inside.iter().zip(row) {
                    half.iter_mut().zip(inside).for_each(|(h, k)| *h -= 0.5 * q * k);
                }
            }
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    /// The expectations of the sums, against the product of the matrices themselves.
    #[test]
    fn expected_sums_are_traces() {
        let mut random = Random::new(3);
        let places: Vec<Point> =
            (0..200).map(|_| [random.unit(), random.unit(), 0.1 * random.unit()]).collect();
        let all = Moments::of(&places, None, places.len()).unwrap();
        let (rows, _) = polynomial(&places).unwrap();
        let n = places.len();
        let projection = |i: usize, j: usize| f64::from(u8::from(i == j)) - inner(&rows[i], &rows[j]);
        let pairs = Pairs::of(&places, all.spacing);
        for (lag, bin) in [(0, 0), (1, 3), (2, 9), (3, 1), (6, 20)] {
            let mut chosen = [vec![0.0; n * n], vec![0.0; n * n]];
            pairs.each(|i, j, b, l| {
                for (matrix, is) in chosen.iter_mut().zip([l == Some(lag), b == Some(bin)]) {
                    matrix[i * n + j] = f64::from(u8::from(is));
                    matrix[j * n + i] = matrix[i * n + j];
                }
            });
            let product = |m: &[f64]| {
                let mut out = vec![0.0; n * n];
                for i in 0..n {
                    for k in 0..n {
                        let p = projection(i, k);
                        (0..n).for_each(|j| out[i * n + j] += p * m[k * n + j]);
                    }
                }
                out
            };
            let [one, other] = chosen.each_ref().map(|m| product(m));
            let trace: f64 =
                (0..n).map(|i| (0..n).map(|j| one[i * n + j] * other[j * n + i]).sum::<f64>()).sum();
            let found = all.expected[lag][bin];
            assert!((found - trace).abs() < 1e-9 * n as f64, "{lag} {bin}: {found} {trace}");
        }
    }
}
