//! Normal equations under conditions that hold exactly.
//!
//! A condition as a squared distance of great weight loses the digits of all that the points hardly determine. An
//! example is the radius of a short fillet between long lines. It also holds steps back where it curves. Here the
//! weight is moderate, so that the matrix is definite. The multipliers of Lagrange make up for the rest (Nocedal and
//! Wright 2006, 16.2).

use trueness_geom::num::cholesky::Cholesky;

/// `M x = r` under `A x = c`, ready to be solved for any `r` and `c`.
pub(super) struct Constrained {
    factor: Cholesky,
    /// The rows of `A`.
    rows: Vec<Vec<f64>>,
    /// `M⁻¹ Aᵀ`, a row for each condition.
    solved: Vec<Vec<f64>>,
    /// Factor of `A M⁻¹ Aᵀ`; `None` without conditions.
    multipliers: Option<Cholesky>,
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

impl Constrained {
    /// `None` where the matrix is not positive definite, or the conditions repeat each other.
    pub(super) fn new(matrix: Vec<f64>, rows: &[Vec<f64>]) -> Option<Constrained> {
        let size = matrix.len().isqrt();
        let factor = Cholesky::new(matrix, size)?;
        let m = rows.len();
        let solved: Vec<Vec<f64>> = (rows.iter())
            .map(|row| {
                let mut x = row.clone();
                factor.solve(&mut x);
                x
            })
            .collect();
        let products = (0..m * m).map(|k| dot(&rows[k / m], &solved[k % m])).collect();
        let multipliers = if m > 0 { Some(Cholesky::new(products, m)?) } else { None };
        Some(Constrained { factor, rows: rows.to_vec(), solved, multipliers })
    }

    /// The solution.
    pub(super) fn solve(&self, right: &[f64], values: &[f64]) -> Vec<f64> {
        let mut x = right.to_vec();
        self.factor.solve(&mut x);
        let missing: Vec<f64> = self.rows.iter().zip(values).map(|(row, c)| c - dot(row, &x)).collect();
        self.shift(&mut x, missing);
        x
    }

    /// The least step, in the measure of the matrix, that changes the conditions by `values`.
    pub(super) fn restore(&self, values: Vec<f64>) -> Vec<f64> {
        let mut x = vec![0.0; self.solved.first().map_or(0, Vec::len)];
        self.shift(&mut x, values);
        x
    }

    fn shift(&self, x: &mut [f64], mut values: Vec<f64>) {
        let Some(multipliers) = &self.multipliers else { return };
        multipliers.solve(&mut values);
        for (by, row) in values.iter().zip(&self.solved) {
            x.iter_mut().zip(row).for_each(|(x, s)| *x += by * s);
        }
    }

    /// The standard deviation of a number that the unknowns move by `effect`, for a matrix of normal equations.
    pub(super) fn deviation(&self, effect: &[f64]) -> f64 {
        dot(&self.solve(effect, &vec![0.0; self.rows.len()]), effect).max(0.0).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// min (x² + y²) / 2 − x under x + 2 y = 3: the multiplier is (3 − 1) / 5.
    #[test]
    fn conditions_hold_exactly_and_variances_lie_along_them() {
        let rows = [vec![1.0, 2.0]];
        let system = Constrained::new(vec![1.0, 0.0, 0.0, 1.0], &rows).unwrap();
        let x = system.solve(&[1.0, 0.0], &[3.0]);
        assert!((x[0] - 1.4).abs() < 1e-15 && (x[1] - 0.8).abs() < 1e-15, "{x:?}");
        let x = system.restore(vec![5.0]);
        assert!((x[0] - 1.0).abs() < 1e-15 && (x[1] - 2.0).abs() < 1e-15, "{x:?}");
        // The variance lies along (2, −1) / √5.
        assert!((system.deviation(&[1.0, 0.0]) - 2.0 / 5f64.sqrt()).abs() < 1e-15);
        assert!(system.deviation(&[1.0, 2.0]) < 1e-7);
        assert!(Constrained::new(vec![1.0, 0.0, 0.0, 1.0], &[rows[0].clone(), rows[0].clone()]).is_none());
    }
}
