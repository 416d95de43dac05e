//! Symmetric positive definite systems of any size.

/// The factor `L` of `L Lᵀ = a`, of a matrix given by its lower triangle, row after row, `n` numbers to a row.
///
/// The diagonal of the factor holds the reciprocals: they are what is multiplied by.
#[derive(Clone, Debug)]
pub struct Cholesky {
    n: usize,
    lower: Vec<f64>,
}

impl Cholesky {
    /// The factor, or `None` where the matrix is not positive definite to working accuracy. Takes `n³ / 6` products.
    pub fn new(mut a: Vec<f64>, n: usize) -> Option<Cholesky> {
        for i in 0..n {
            let (done, rest) = a.split_at_mut(i * n);
            let row = &mut rest[..n];
            for j in 0..i {
                let other = &done[j * n..j * n + j + 1];
                let sum: f64 = row[..j].iter().zip(other).map(|(x, y)| x * y).sum();
                row[j] = (row[j] - sum) * other[j];
            }
            let sum: f64 = row[..i].iter().map(|x| x * x).sum();
            let pivot = row[i] - sum;
            if pivot.is_nan() || pivot.is_infinite() || pivot <= 4.0 * f64::EPSILON * row[i] {
                return None;
            }
            row[i] = 1.0 / pivot.sqrt();
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
}
