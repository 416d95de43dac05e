//! Symmetric positive definite systems whose entries lie near the diagonal.
//!
//! The rows are cut into blocks of 32. All rows of a block hold the same columns, from the band's width before its first row to
//! its end. So products of two rows are products of slices. The rows of a block do not depend on each other left of it. They
//! are computed on all threads, each entry in one fixed order, so the bits are the same on any number.

use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress};
use crate::simd::widest::widest;

/// Rows of a block.
const ROWS_PER_BLOCK: usize = 32;

/// Why there is no factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BandedError {
    /// A pivot is not above rounding: the matrix is not positive definite to working accuracy.
    #[error("unknown {index} is not determined")]
    NotDefinite {
        /// Its row.
        index: usize,
    },
    /// Stopped through the progress argument.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// A symmetric matrix with no entry farther than `width` from the diagonal: its lower triangle.
///
/// Memory: `8 n (width + 32)` bytes.
#[derive(Clone, Debug)]
pub struct Banded {
    n: usize,
    width: usize,
    stride: usize,
    rows: Vec<f64>,
}

impl Banded {
    /// All zeros.
    pub fn new(n: usize, width: usize) -> Banded {
        let width = width.min(n.saturating_sub(1));
        let stride = width + ROWS_PER_BLOCK;
        Banded { n, width, stride, rows: vec![0.0; n * stride] }
    }
    /// Bytes that a matrix of this size takes; `None` where no number holds them.
    pub fn bytes(n: usize, width: usize) -> Option<usize> {
        n.checked_mul(width.min(n) + ROWS_PER_BLOCK)?.checked_mul(size_of::<f64>())
    }
    /// The entry of row `i` and column `j ≤ i`, no farther from the diagonal than the width.
    pub fn entry(&mut self, i: usize, j: usize) -> &mut f64 {
        let column = j + self.width - i / ROWS_PER_BLOCK * ROWS_PER_BLOCK;
        &mut self.rows[i * self.stride + column]
    }

    /// The factor `L` of `L Lᵀ`.
    ///
    /// Cost: `n width²` multiplications at most.
    ///
    /// # Errors
    /// [`BandedError`]: a pivot no greater than rounding leaves of its diagonal entry; cancelled.
    pub fn factor(self, progress: &dyn Progress) -> Result<Factor, BandedError> {
        let Banded { n, width, stride, mut rows } = self;
        for first in (0..n).step_by(ROWS_PER_BLOCK) {
            if progress.cancelled() {
                return Err(Cancelled.into());
            }
            let (done, rest) = rows.split_at_mut(first * stride);
            let count = ROWS_PER_BLOCK.min(n - first);
            let block = &mut rest[..count * stride];
            let from = first.saturating_sub(width);
            let left = |four: &mut [f64]| eliminate(four, stride, done, width, first, from);
            // Few products are not worth waking the other threads.
            if width >= 64 {
                block.par_chunks_mut(4 * stride).for_each(left);
            } else {
                block.chunks_mut(4 * stride).for_each(left);
            }
            triangle(block, stride, width, from + width - first, first)?;
        }
        Ok(Factor { n, width, stride, rows })
    }
}

widest! {
    /// Up to four rows of the block that starts at `first`: their entries in the columns `from … first`.
    fn eliminate [] [] (
        four: &mut [f64],
        stride: usize,
        done: &[f64],
        width: usize,
        first: usize,
        from: usize,
    ) = {
    let at = |column: usize| column + width - first;
    for j in from..first {
        let base = j / ROWS_PER_BLOCK * ROWS_PER_BLOCK;
        let row = &done[j * stride..(j + 1) * stride];
        let other = |column: usize| column + width - base;
        let length = j - from;
        let known = &row[other(from)..other(from) + length];
        let pivot = row[other(j)];
        let start = at(from);
        let mut rows = four.chunks_exact_mut(stride);
        match (rows.next(), rows.next(), rows.next(), rows.next()) {
            (Some(a), Some(b), Some(c), Some(d)) => {
                let parts = [
                    &a[start..start + length],
                    &b[start..start + length],
                    &c[start..start + length],
                    &d[start..start + length],
                ];
                let sums = dots(parts, known);
                for (row, sum) in [a, b, c, d].into_iter().zip(sums) {
                    row[start + length] = (row[start + length] - sum) * pivot;
                }
            }
            (a, b, c, _) => {
                for row in [a, b, c].into_iter().flatten() {
                    let part = &row[start..start + length];
                    let [sum, ..] = dots([part, part, part, part], known);
                    row[start + length] = (row[start + length] - sum) * pivot;
                }
            }
        }
    }
    }
}

/// The entries of a block right of its first row's column; `from` is where the columns before it start.
fn triangle(
    block: &mut [f64],
    stride: usize,
    width: usize,
    from: usize,
    first: usize,
) -> Result<(), BandedError> {
    let count = block.len() / stride;
    for i in 0..count {
        let (above, rest) = block.split_at_mut(i * stride);
        let row = &mut rest[..stride];
        for j in 0..i {
            let other = &above[j * stride..(j + 1) * stride];
            let sum = dot(&row[from..width + j], &other[from..width + j]);
            row[width + j] = (row[width + j] - sum) * other[width + j];
        }
        let own = &row[from..width + i];
        let pivot = row[width + i] - dot(own, own);
        if !pivot.is_finite() || pivot <= 16.0 * f64::EPSILON * row[width + i] {
            return Err(BandedError::NotDefinite { index: first + i });
        }
        row[width + i] = 1.0 / pivot.sqrt();
    }
    Ok(())
}

/// Four products of slices of one length with `x`, in lanes that the compiler keeps side by side.
#[inline(always)]
fn dots(rows: [&[f64]; 4], x: &[f64]) -> [f64; 4] {
    let mut sums = [[0.0f64; 4]; 4];
    let whole = x.len() / 4 * 4;
    let [a, b, c, d] = rows.map(|r| &r[..whole]);
    let lanes = x[..whole].as_chunks::<4>().0.iter();
    let four = a
        .as_chunks::<4>()
        .0
        .iter()
        .zip(b.as_chunks::<4>().0)
        .zip(c.as_chunks::<4>().0)
        .zip(d.as_chunks::<4>().0);
    for (x, (((a, b), c), d)) in lanes.zip(four) {
        for k in 0..4 {
            sums[0][k] += a[k] * x[k];
            sums[1][k] += b[k] * x[k];
            sums[2][k] += c[k] * x[k];
            sums[3][k] += d[k] * x[k];
        }
    }
    std::array::from_fn(|r| {
        let [a, b, c, d] = sums[r];
        let rest: f64 = rows[r][whole..].iter().zip(&x[whole..]).map(|(a, b)| a * b).sum();
        (a + b) + (c + d) + rest
    })
}

/// Sum of products, in lanes that the compiler keeps side by side.
#[inline(always)]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0f64; 8];
    let (a, a_rest) = a.as_chunks::<8>();
    let (b, b_rest) = b.as_chunks::<8>();
    for (a, b) in a.iter().zip(b) {
        for k in 0..8 {
            sums[k] += a[k] * b[k];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}

/// The factor of a [`Banded`] matrix; its diagonal holds the reciprocals.
#[derive(Clone, Debug)]
pub struct Factor {
    n: usize,
    width: usize,
    stride: usize,
    rows: Vec<f64>,
}

impl Factor {
    /// The entries of row `i` left of the diagonal, the first column they belong to, and the reciprocal of the diagonal.
    fn row(&self, i: usize) -> (&[f64], usize, f64) {
        let base = i / ROWS_PER_BLOCK * ROWS_PER_BLOCK;
        let from = i.saturating_sub(self.width);
        let row = &self.rows[i * self.stride..(i + 1) * self.stride];
        let at = |column: usize| column + self.width - base;
        (&row[at(from)..at(i)], from, row[at(i)])
    }

    /// Solutions for `D` right sides at once, written over them.
    pub fn solve<const D: usize>(&self, b: &mut [[f64; D]]) {
        for i in 0..self.n {
            let (row, from, diagonal) = self.row(i);
            let mut sum = [0.0; D];
            for (l, x) in row.iter().zip(&b[from..i]) {
                (0..D).for_each(|d| sum[d] += l * x[d]);
            }
            (0..D).for_each(|d| b[i][d] = (b[i][d] - sum[d]) * diagonal);
        }
        for i in (0..self.n).rev() {
            let (row, from, diagonal) = self.row(i);
            let x = b[i].map(|x| x * diagonal);
            b[i] = x;
            for (l, y) in row.iter().zip(&mut b[from..i]) {
                (0..D).for_each(|d| y[d] -= l * x[d]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::cholesky::Cholesky;
    use crate::num::random::Random;
    use crate::progress::Silent;

    #[test]
    fn a_band_has_the_answers_of_the_full_matrix() {
        let random = &mut Random::new(5);
        for (n, width) in [(1, 0), (2, 1), (9, 8), (31, 4), (70, 0), (100, 33), (257, 70), (130, 129)] {
            let (mut band, mut full) = (Banded::new(n, width), vec![0.0; n * n]);
            for i in 0..n {
                for j in i.saturating_sub(width)..=i {
                    let x = if i == j { 1.0 + width as f64 } else { random.unit() - 0.5 };
                    *band.entry(i, j) = x;
                    full[i * n + j] = x;
                    full[j * n + i] = x;
                }
            }
            let b: Vec<[f64; 2]> = (0..n).map(|_| [random.unit(), random.unit()]).collect();
            let mut x = b.clone();
            band.factor(&Silent).unwrap().solve(&mut x);
            let dense = Cholesky::new(full, n).unwrap();
            for d in 0..2 {
                let mut y: Vec<f64> = b.iter().map(|b| b[d]).collect();
                dense.solve(&mut y);
                assert!(x.iter().zip(&y).all(|(x, y)| (x[d] - y).abs() < 1e-13), "{n} {width}");
            }
        }
    }

    #[test]
    fn what_is_not_definite_is_refused_with_its_row() {
        let mut band = Banded::new(3, 1);
        (0..3).for_each(|i| *band.entry(i, i) = 1.0);
        *band.entry(2, 1) = 1.0;
        assert_eq!(band.factor(&Silent).unwrap_err(), BandedError::NotDefinite { index: 2 });
    }
}
