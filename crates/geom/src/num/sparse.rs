//! Sparse matrices of any size, row by row.

/// A sparse matrix: of each row the columns with an entry, ascending, and the entries.
#[derive(Clone, Debug, PartialEq)]
pub struct Sparse {
    starts: Vec<usize>,
    columns: Vec<u32>,
    values: Vec<f64>,
    /// Number of columns.
    width: usize,
}

impl Sparse {
    /// The matrix of entries as row, column, value; those of one place are added up in their order.
    ///
    /// Cost: linear, but for the sorting of each row.
    pub fn new(rows: usize, width: usize, entries: &[(u32, u32, f64)]) -> Sparse {
        let mut starts = vec![0; rows + 1];
        entries.iter().for_each(|(row, _, _)| starts[*row as usize + 1] += 1);
        (0..rows).for_each(|i| starts[i + 1] += starts[i]);
        let (mut next, mut sorted) = (starts.clone(), vec![(0u32, 0.0); entries.len()]);
        for (row, column, value) in entries {
            sorted[next[*row as usize]] = (*column, *value);
            next[*row as usize] += 1;
        }
        let mut all = Sparse { starts: vec![0], columns: vec![], values: vec![], width };
        for row in starts.windows(2) {
            let own = &mut sorted[row[0]..row[1]];
            own.sort_by_key(|(column, _)| *column);
            for same in own.chunk_by(|a, b| a.0 == b.0) {
                all.columns.push(same[0].0);
                all.values.push(same.iter().map(|(_, value)| value).sum());
            }
            all.starts.push(all.columns.len());
        }
        all
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of columns.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Columns and entries of a row.
    pub fn row(&self, i: usize) -> impl Iterator<Item = (usize, f64)> {
        let own = self.starts[i]..self.starts[i + 1];
        self.columns[own.clone()].iter().map(|c| *c as usize).zip(self.values[own].iter().copied())
    }

    /// The entries of the diagonal; 0 where there is none.
    pub fn diagonal(&self) -> Vec<f64> {
        let own = |i: usize| self.row(i).find(|(j, _)| *j == i).map_or(0.0, |(_, value)| value);
        (0..self.rows()).map(own).collect()
    }

    /// The matrix times a vector.
    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        (0..self.rows()).map(|i| self.row(i).map(|(j, value)| value * x[j]).sum()).collect()
    }

    /// The matrix with rows and columns exchanged.
    pub fn transposed(&self) -> Sparse {
        let mut entries = Vec::with_capacity(self.values.len());
        (0..self.rows())
            .for_each(|i| entries.extend(self.row(i).map(|(j, value)| (j as u32, i as u32, value))));
        Sparse::new(self.width, self.rows(), &entries)
    }

    /// The product of two matrices (Gustavson, Two fast algorithms for sparse matrices, ACM Transactions on Mathematical Software 4,
    /// 1978).
    pub fn product(&self, other: &Sparse) -> Sparse {
        let mut all = Sparse { starts: vec![0], columns: vec![], values: vec![], width: other.width };
        let mut sums = vec![0.0; other.width];
        let mut seen = vec![usize::MAX; other.width];
        for i in 0..self.rows() {
            let mut own = vec![];
            for (k, a) in self.row(i) {
                for (j, b) in other.row(k) {
                    if seen[j] != i {
                        seen[j] = i;
                        sums[j] = 0.0;
                        own.push(j as u32);
                    }
                    sums[j] += a * b;
                }
            }
            own.sort_unstable();
            all.values.extend(own.iter().map(|j| sums[*j as usize]));
            all.columns.extend(own);
            all.starts.push(all.columns.len());
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    #[test]
    fn products_are_those_of_full_matrices() {
        let random = &mut Random::new(1);
        let mut random_matrix = |rows: usize, width: usize| {
            let full: Vec<f64> = (0..rows * width)
                .map(|_| if random.unit() < 0.3 { (20.0 * random.unit()).round() - 10.0 } else { 0.0 })
                .collect();
            let mut entries = vec![];
            for (k, x) in full.iter().enumerate().filter(|(_, x)| **x != 0.0) {
                // In two parts.
                let place = ((k / width) as u32, (k % width) as u32);
                entries.extend([(place.0, place.1, x - 3.0), (place.0, place.1, 3.0)]);
            }
            (full, Sparse::new(rows, width, &entries))
        };
        let ((a, sparse_a), (b, sparse_b)) = (random_matrix(13, 9), random_matrix(9, 17));
        let product = sparse_a.product(&sparse_b);
        let turned = sparse_b.transposed().product(&sparse_a.transposed());
        for i in 0..13 {
            for j in 0..17 {
                let sum: f64 = (0..9).map(|k| a[i * 9 + k] * b[k * 17 + j]).sum();
                let own = |m: &Sparse, i, j| m.row(i).find(|(c, _)| *c == j).map_or(0.0, |(_, x)| x);
                assert_eq!((own(&product, i, j), own(&turned, j, i)), (sum, sum));
            }
        }
        let x: Vec<f64> = (0..9).map(f64::from).collect();
        let times: Vec<f64> = (0..13).map(|i| (0..9).map(|k| a[i * 9 + k] * x[k]).sum()).collect();
        assert_eq!(sparse_a.times(&x), times);
        assert_eq!((product.rows(), product.width()), (13, 17));
    }
}
