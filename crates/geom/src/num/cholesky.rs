//! Symmetric positive definite systems of any size.

/// The factor `L` of `L Lᵀ = a`, of a matrix given by its lower triangle, row after row, `n` numbers to a row.
///
/// The diagonal of the factor holds the reciprocals: they are what is multiplied by.
#[derive(Clone, Debug)]
pub struct Cholesky {
    n: usize,
    lower: Vec<f64>,
}

/// Rows whose entries are found side by side. Each entry is a sum in which every addition waits for the one before. So many
/// independent sums take little longer than one.
const ROWS_AT_ONCE: usize = 8;

/// The sum of products, in the order of the numbers.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// The entries of the next rows of the factor below the rows `done`. The entries of each row come one after the other, of all
/// rows at once.
fn against_done(done: &[f64], next: &mut [f64], columns: &mut [[f64; ROWS_AT_ONCE]], n: usize, rows: usize) {
    for j in 0..columns.len() {
        let (before, this) = columns.split_at_mut(j);
        let other = &done[j * n..j * n + j + 1];
        let mut sums = [-0.0; ROWS_AT_ONCE];
        for (column, y) in before.iter().zip(other) {
            sums.iter_mut().zip(column).for_each(|(s, x)| *s += x * y);
        }
        for r in 0..rows {
            next[r * n + j] = (next[r * n + j] - sums[r]) * other[j];
            this[0][r] = next[r * n + j];
        }
    }
}

impl Cholesky {
    /// The factor, or `None` where the matrix is not positive definite to working accuracy. Takes `n³ / 6` products.
    pub fn new(mut a: Vec<f64>, n: usize) -> Option<Cholesky> {
        let mut columns = vec![[0.0; ROWS_AT_ONCE]; n];
        for first in (0..n).step_by(ROWS_AT_ONCE) {
            let rows = ROWS_AT_ONCE.min(n - first);
            let (done, rest) = a.split_at_mut(first * n);
            against_done(done, rest, &mut columns[..first], n, rows);
            for r in 0..rows {
                let i = first + r;
                let (before, row) = rest.split_at_mut(r * n);
                let row = &mut row[..n];
                for j in first..i {
                    let other = &before[(j - first) * n..(j - first) * n + j + 1];
                    row[j] = (row[j] - dot(&row[..j], other)) * other[j];
                }
                let pivot = row[i] - dot(&row[..i], &row[..i]);
                if pivot.is_nan() || pivot.is_infinite() || pivot <= 4.0 * f64::EPSILON * row[i] {
                    return None;
                }
                row[i] = 1.0 / pivot.sqrt();
            }
        }
        Some(Cholesky { n, lower: a })
    }

    /// Solution of `a x = b`, written over `b`.
    pub fn solve(&self, b: &mut [f64]) {
        let n = self.n;
        for i in 0..n {
            let row = &self.lower[i * n..i * n + i];
            let sum: f64 = row.iter().zip(&b[..i]).map(|(x, y)| x * y).sum();
            b[i] = (b[i] - sum) * self.lower[i * n + i];
        }
        for i in (0..n).rev() {
            b[i] *= self.lower[i * n + i];
            let x = b[i];
            for (b, l) in b[..i].iter_mut().zip(&self.lower[i * n..i * n + i]) {
                *b -= l * x;
            }
        }
    }

    /// Entry of the diagonal of the inverse.
    pub fn inverse_diagonal(&self, i: usize) -> f64 {
        // The squared length of the solution of L x = e_i.
        let n = self.n;
        let mut x = vec![0.0; n];
        for r in i..n {
            let row = &self.lower[r * n + i..r * n + r];
            let sum: f64 = row.iter().zip(&x[i..r]).map(|(a, b)| a * b).sum();
            x[r] = (f64::from(r == i) - sum) * self.lower[r * n + r];
        }
        x.iter().map(|v| v * v).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    #[test]
    fn solves_what_was_multiplied() {
        let random = &mut Random::new(3);
        let n = 9;
        let factors: Vec<f64> = (0..n * n).map(|_| random.unit() - 0.5).collect();
        let entry = |i: usize, j: usize| {
            (0..n).map(|k| factors[i * n + k] * factors[j * n + k]).sum::<f64>() + f64::from(i == j)
        };
        let a: Vec<f64> = (0..n * n).map(|k| entry(k / n, k % n)).collect();
        let x: Vec<f64> = (0..n).map(|_| random.unit()).collect();
        let mut b: Vec<f64> = (0..n).map(|i| (0..n).map(|j| a[i * n + j] * x[j]).sum()).collect();
        let factor = Cholesky::new(a.clone(), n).unwrap();
        factor.solve(&mut b);
        assert!(b.iter().zip(&x).all(|(b, x)| (b - x).abs() < 1e-12));
        for i in 0..n {
            let mut e = vec![0.0; n];
            e[i] = 1.0;
            factor.solve(&mut e);
            assert!((e[i] - factor.inverse_diagonal(i)).abs() < 1e-12);
        }
        assert!(Cholesky::new(vec![1.0, 1.0, 1.0, 1.0], 2).is_none());
    }

    /// Rows side by side have the entries of rows one after the other, bit for bit, for numbers of rows around multiples of theirs.
    #[test]
    fn rows_side_by_side_are_rows_one_after_the_other() {
        let random = &mut Random::new(5);
        for n in [1, 2, 7, 8, 9, 15, 16, 17, 40] {
            let factors: Vec<f64> = (0..n * n).map(|_| random.unit() - 0.5).collect();
            let entry = |i: usize, j: usize| {
                (0..n).map(|k| factors[i * n + k] * factors[j * n + k]).sum::<f64>() + f64::from(i == j)
            };
            let a: Vec<f64> = (0..n * n).map(|k| entry(k / n, k % n)).collect();
            let mut plain = a.clone();
            for i in 0..n {
                for j in 0..=i {
                    let sum: f64 = (0..j).map(|k| plain[i * n + k] * plain[j * n + k]).sum();
                    let rest = plain[i * n + j] - sum;
                    plain[i * n + j] = if i == j { 1.0 / rest.sqrt() } else { rest * plain[j * n + j] };
                }
            }
            let found = Cholesky::new(a, n).unwrap().lower;
            for i in 0..n {
                for j in 0..=i {
                    assert_eq!(found[i * n + j].to_bits(), plain[i * n + j].to_bits(), "{n} {i} {j}");
                }
            }
        }
    }
}
