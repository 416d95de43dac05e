//! Linear algebra of a few unknowns: dense matrices of at most nine rows.

#![allow(clippy::needless_range_loop, reason = "matrices are read by row and column")]

/// Lower triangle `L` of `L Lᵀ = a`, or `None` where `a` is not positive definite to working accuracy. Its diagonal
/// holds the reciprocals: they are what is multiplied by, and dividing takes long.
///
/// A pivot that lost all but [`f64::EPSILON`] of its diagonal entry counts as zero: the rows then say nothing
/// about that unknown.
pub fn cholesky<const N: usize>(a: &[[f64; N]; N]) -> Option<[[f64; N]; N]> {
    let mut l = [[0.0; N]; N];
    for i in 0..N {
        for j in 0..=i {
            let sum: f64 = (0..j).map(|k| l[i][k] * l[j][k]).sum();
            let rest = a[i][j] - sum;
            if i == j {
                if rest.is_nan() || rest.is_infinite() || rest <= 4.0 * f64::EPSILON * a[i][i] {
                    return None;
                }
                l[i][i] = 1.0 / rest.sqrt();
            } else {
                l[i][j] = rest * l[j][j];
            }
        }
    }
    Some(l)
}

/// Solution of `L Lᵀ x = b` for `L` as [`cholesky`] gives it.
pub fn cholesky_solve<const N: usize>(l: &[[f64; N]; N], b: &[f64; N]) -> [f64; N] {
    let mut x = *b;
    for i in 0..N {
        let sum: f64 = (0..i).map(|k| l[i][k] * x[k]).sum();
        x[i] = (x[i] - sum) * l[i][i];
    }
    for i in (0..N).rev() {
        let sum: f64 = (i + 1..N).map(|k| l[k][i] * x[k]).sum();
        x[i] = (x[i] - sum) * l[i][i];
    }
    x
}

/// Inverse of the positive definite `a`, or `None` as in [`cholesky`]. Rows and columns are brought to a unit
/// diagonal first, so that unknowns of different units do not disturb each other.
pub fn inverse<const N: usize>(a: &[[f64; N]; N]) -> Option<[[f64; N]; N]> {
    let scale: [f64; N] = std::array::from_fn(|i| 1.0 / a[i][i].sqrt());
    if scale.iter().any(|s| !s.is_finite()) {
        return None;
    }
    let even: [[f64; N]; N] = std::array::from_fn(|i| std::array::from_fn(|j| a[i][j] * scale[i] * scale[j]));
    let l = cholesky(&even)?;
    let mut inverse = [[0.0; N]; N];
    for j in 0..N {
        let mut unit = [0.0; N];
        unit[j] = 1.0;
        let column = cholesky_solve(&l, &unit);
        for i in 0..N {
            inverse[i][j] = column[i] * scale[i] * scale[j];
        }
    }
    Some(inverse)
}

/// Solution of the square system `a x = b` by elimination with row exchange, or `None` where a pivot is zero
/// or not finite. `a` holds `n` rows of `n` numbers.
pub fn solve(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Option<Vec<f64>> {
    let n = b.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()))?;
        if a[pivot][k] == 0.0 || !a[pivot][k].is_finite() {
            return None;
        }
        a.swap(k, pivot);
        b.swap(k, pivot);
        for i in k + 1..n {
            let factor = a[i][k] / a[k][k];
            if factor != 0.0 {
                let (upper, lower) = a.split_at_mut(i);
                for (x, y) in lower[0][k..].iter_mut().zip(&upper[k][k..]) {
                    *x -= factor * y;
                }
                b[i] -= factor * b[k];
            }
        }
    }
    for k in (0..n).rev() {
        let sum: f64 = (k + 1..n).map(|j| a[k][j] * b[j]).sum();
        b[k] = (b[k] - sum) / a[k][k];
    }
    b.iter().all(|x| x.is_finite()).then_some(b)
}

/// Eigenvalues in ascending order and their unit eigenvectors (as rows) of a symmetric 3×3 matrix.
///
/// Jacobi's rotations: small eigenvalues keep their digits better than in any formula by roots of the cubic.
pub fn eigen(mut a: [[f64; 3]; 3]) -> ([f64; 3], [[f64; 3]; 3]) {
    let mut rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for _ in 0..30 {
        let off = a[0][1].abs() + a[0][2].abs() + a[1][2].abs();
        if off <= f64::EPSILON * 1e-3 * (a[0][0].abs() + a[1][1].abs() + a[2][2].abs()) {
            break;
        }
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q] == 0.0 {
                continue;
            }
            let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let t = theta.signum() / (theta.abs() + libm::hypot(theta, 1.0));
            let c = 1.0 / libm::hypot(t, 1.0);
            let s = t * c;
            for k in 0..3 {
                (a[k][p], a[k][q]) = (c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]);
            }
            for k in 0..3 {
                (a[p][k], a[q][k]) = (c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]);
                (rows[p][k], rows[q][k]) = (c * rows[p][k] - s * rows[q][k], s * rows[p][k] + c * rows[q][k]);
            }
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| a[i][i].total_cmp(&a[j][j]));
    (order.map(|i| a[i][i]), order.map(|i| rows[i]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_times_matrix_is_one() {
        let a = [[4.0, 1.0, 2.0e3], [1.0, 3.0, 0.5e3], [2.0e3, 0.5e3, 5.0e6]];
        let b = inverse(&a).unwrap();
        for i in 0..3 {
            for j in 0..3 {
                let x: f64 = (0..3).map(|k| a[i][k] * b[k][j]).sum();
                assert!((x - f64::from(i == j)).abs() < 1e-12 * a[2][2] / 1e3, "{i} {j} {x}");
            }
        }
        assert!(inverse(&[[1.0, 1.0], [1.0, 1.0]]).is_none());
    }

    #[test]
    fn elimination_exchanges_rows() {
        let x = solve(vec![vec![0.0, 2.0], vec![3.0, 1.0]], vec![4.0, 5.0]).unwrap();
        assert_eq!(x, vec![1.0, 2.0]);
        assert!(solve(vec![vec![1.0, 2.0], vec![2.0, 4.0]], vec![1.0, 1.0]).is_none());
    }

    #[test]
    fn eigenvectors_reproduce_the_matrix() {
        let a = [[2.0, -1.0, 0.3], [-1.0, 5.0, 0.7], [0.3, 0.7, 1e-3]];
        let (values, rows) = eigen(a);
        assert!(values[0] <= values[1] && values[1] <= values[2]);
        for i in 0..3 {
            for j in 0..3 {
                let x: f64 = (0..3).map(|k| values[k] * rows[k][i] * rows[k][j]).sum();
                assert!((x - a[i][j]).abs() < 1e-14);
            }
        }
    }
}
