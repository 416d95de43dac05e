//! Large sparse systems with an unknown for each vertex of a mesh.
//!
//! Neighbors are gathered into groups of about seven, these into groups of groups, until few are left. Slow changes over the
//! mesh are found among the groups, fast ones by a sweep over the vertices. One round of that is the preconditioner of an
//! iteration for matrices that need not be symmetric. The number of rounds hardly depends on the size of the mesh.
//!
//! Sources: Vaněk, Mandel, Brezina, Algebraic multigrid by smoothed aggregation for second and fourth order elliptic problems,
//! Computing 56, 1996. Van der Vorst, Bi-CGSTAB, SIAM Journal on Scientific and Statistical Computing 13, 1992.

use super::sparse::Sparse;
use crate::progress::{Cancelled, Progress};

/// Unknowns that are solved for at once.
const MAX_DIRECT_UNKNOWNS: usize = 300;
/// Neighbors with an entry below this share of the root of both diagonals do not count for groups. Each next round halves it.
const MIN_STRONG_ENTRY: f64 = 0.08;
/// Weight of the smoothing of groups.
const GROUP_SMOOTHING: f64 = 2.0 / 3.0;
/// Unknowns with more neighbors have no part in the smoothing. Through each of them all its neighbors would be coupled in the
/// next level, a square of their number.
const MAX_SMOOTHED_NEIGHBORS: usize = 100;
/// Most cycles of the solver.
const MAX_CYCLES: usize = 200;

/// A matrix prepared for solving.
pub struct Multigrid {
    levels: Vec<Level>,
    last: Dense,
}

struct Level {
    matrix: Sparse,
    diagonal: Vec<f64>,
    /// From groups to their members, and back.
    down: Sparse,
    up: Sparse,
}

impl Multigrid {
    /// The solver of a matrix with a positive diagonal in which each unknown is about a mean of its neighbors.
    ///
    /// Cost: linear; memory about three times that of the matrix.
    pub fn new(matrix: Sparse) -> Multigrid {
        let (mut levels, mut matrix, mut strong) = (vec![], matrix, MIN_STRONG_ENTRY);
        while matrix.rows() > MAX_DIRECT_UNKNOWNS {
            let diagonal = matrix.diagonal();
            let (group, groups) = gathered(&matrix, &diagonal, strong);
            // Unknowns that hardly hang together are left to the sweeps: nothing is below.
            let hangs_together = 10 * groups <= 9 * matrix.rows();
            let down = match hangs_together {
                true => smoothed(&matrix, &diagonal, &group, groups),
                false => Sparse::new(matrix.rows(), 0, &[]),
            };
            let up = down.transposed();
            let next = up.product(&matrix.product(&down));
            levels.push(Level { matrix, diagonal, down, up });
            (matrix, strong) = (next, 0.5 * strong);
        }
        Multigrid { levels, last: Dense::new(&matrix) }
    }

    /// Solves for `x`, which holds a first guess, until what is left of the right side is this share of it. The answer is the share that
    /// is left: more where rounding allows no better.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn solve(
        &self,
        right: &[f64],
        x: &mut [f64],
        accuracy: f64,
        progress: &dyn Progress,
    ) -> Result<f64, Cancelled> {
        let Some(first) = self.levels.first() else {
            x.copy_from_slice(right);
            self.last.solve(x);
            return Ok(0.0);
        };
        let size = dot(right, right).sqrt().max(f64::MIN_POSITIVE);
        let mut left: Vec<f64> = right.iter().zip(first.matrix.times(x)).map(|(b, a)| b - a).collect();
        let shadow = left.clone();
        let n = right.len();
        let (mut rho, mut alpha, mut omega) = (1.0, 1.0, 1.0);
        let (mut along, mut image) = (vec![0.0; n], vec![0.0; n]);
        let mut best = (dot(&left, &left).sqrt() / size, x.to_vec());
        for _ in 0..MAX_CYCLES {
            if progress.cancelled() {
                return Err(Cancelled);
            }
            let next = dot(&shadow, &left);
            if best.0 <= accuracy || next == 0.0 || omega == 0.0 {
                break;
            }
            let beta = next / rho * (alpha / omega);
            rho = next;
            for i in 0..n {
                along[i] = left[i] + beta * (along[i] - omega * image[i]);
            }
            let step = self.round(0, &along);
            image = first.matrix.times(&step);
            alpha = rho / dot(&shadow, &image);
            let half: Vec<f64> = left.iter().zip(&image).map(|(r, v)| r - alpha * v).collect();
            let second = self.round(0, &half);
            let turned = first.matrix.times(&second);
            omega = dot(&turned, &half) / dot(&turned, &turned).max(f64::MIN_POSITIVE);
            for i in 0..n {
                x[i] += alpha * step[i] + omega * second[i];
                left[i] = half[i] - omega * turned[i];
            }
            let now = dot(&left, &left).sqrt() / size;
            if now.is_nan() {
                break;
            }
            if now < best.0 {
                best = (now, x.to_vec());
            }
        }
        x.copy_from_slice(&best.1);
        Ok(best.0)
    }

    /// One round from this level downwards, from nothing.
    fn round(&self, level: usize, right: &[f64]) -> Vec<f64> {
        let Some(Level { matrix, diagonal, down, up }) = self.levels.get(level) else {
            let mut x = right.to_vec();
            self.last.solve(&mut x);
            return x;
        };
        let mut x = vec![0.0; right.len()];
        let sweep = |x: &mut [f64], i: usize| {
            let others: f64 = matrix.row(i).map(|(j, a)| a * x[j]).sum();
            x[i] += (right[i] - others) / diagonal[i];
        };
        (0..x.len()).for_each(|i| sweep(&mut x, i));
        let left: Vec<f64> = right.iter().zip(matrix.times(&x)).map(|(b, a)| b - a).collect();
        let coarse = self.round(level + 1, &up.times(&left));
        x.iter_mut().zip(down.times(&coarse)).for_each(|(x, c)| *x += c);
        (0..x.len()).rev().for_each(|i| sweep(&mut x, i));
        x
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The number of each unknown's group, and how many groups there are.
fn gathered(matrix: &Sparse, diagonal: &[f64], strong: f64) -> (Vec<usize>, usize) {
    /// Number of a group where there is none.
    const NO_GROUP: usize = usize::MAX;
    let near = |i: usize| {
        matrix.row(i).filter(move |(j, a)| *j != i && a.abs() > strong * (diagonal[i] * diagonal[*j]).sqrt())
    };
    let n = matrix.rows();
    let (mut group, mut groups) = (vec![NO_GROUP; n], 0);
    // Around each unknown with no neighbor in a group.
    for i in 0..n {
        if group[i] == NO_GROUP && near(i).all(|(j, _)| group[j] == NO_GROUP) {
            near(i).for_each(|(j, _)| group[j] = groups);
            group[i] = groups;
            groups += 1;
        }
    }
    // The others join the nearest one of these.
    let first = group.clone();
    for i in 0..n {
        if first[i] == NO_GROUP {
            let strongest =
                near(i).filter(|(j, _)| first[*j] != NO_GROUP).fold((NO_GROUP, 0.0), |best, (j, a)| {
                    if a.abs() > best.1 { (first[j], a.abs()) } else { best }
                });
            group[i] = strongest.0;
        }
    }
    for i in 0..n {
        if group[i] == NO_GROUP {
            near(i).for_each(|(j, _)| group[j] = if group[j] == NO_GROUP { groups } else { group[j] });
            group[i] = groups;
            groups += 1;
        }
    }
    (group, groups)
}

/// The shares that members take of their groups: all of their own, smoothed by one step over the neighbors where these are not
/// too many.
fn smoothed(matrix: &Sparse, diagonal: &[f64], group: &[usize], groups: usize) -> Sparse {
    let mut entries = vec![];
    for i in 0..matrix.rows() {
        entries.push((i as u32, group[i] as u32, 1.0));
        if matrix.row(i).nth(MAX_SMOOTHED_NEIGHBORS).is_some() {
            continue;
        }
        entries.extend(
            matrix.row(i).map(|(j, a)| (i as u32, group[j] as u32, -GROUP_SMOOTHING * a / diagonal[i])),
        );
    }
    Sparse::new(matrix.rows(), groups, &entries)
}

/// The factors of a small matrix, with rows exchanged.
struct Dense {
    n: usize,
    entries: Vec<f64>,
    order: Vec<usize>,
}

impl Dense {
    fn new(matrix: &Sparse) -> Dense {
        let n = matrix.rows();
        let mut a = vec![0.0; n * n];
        (0..n).for_each(|i| matrix.row(i).for_each(|(j, value)| a[i * n + j] = value));
        let mut order: Vec<usize> = (0..n).collect();
        for k in 0..n {
            let pivot = (k..n).fold(k, |p, i| if a[i * n + k].abs() > a[p * n + k].abs() { i } else { p });
            if pivot != k {
                order.swap(pivot, k);
                (0..n).for_each(|j| a.swap(pivot * n + j, k * n + j));
            }
            let (above, below) = a.split_at_mut((k + 1) * n);
            let row = &above[k * n..];
            for other in below.chunks_exact_mut(n) {
                // A column of zeros has nothing to take away.
                let share = if row[k] == 0.0 { 0.0 } else { other[k] / row[k] };
                other[k] = share;
                if share != 0.0 {
                    other[k + 1..].iter_mut().zip(&row[k + 1..]).for_each(|(o, r)| *o -= share * r);
                }
            }
        }
        Dense { n, entries: a, order }
    }

    fn solve(&self, x: &mut [f64]) {
        let n = self.n;
        let mut y: Vec<f64> = self.order.iter().map(|i| x[*i]).collect();
        for i in 0..n {
            y[i] -= dot(&self.entries[i * n..][..i], &y[..i]);
        }
        for i in (0..n).rev() {
            let row = &self.entries[i * n..][..n];
            let rest = y[i] - dot(&row[i + 1..], &y[i + 1..]);
            y[i] = if row[i] == 0.0 { 0.0 } else { rest / row[i] };
        }
        x.copy_from_slice(&y);
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::num::random::Random;
    use crate::progress::Silent;

    /// Means of neighbors on a grid with random weights that differ in both directions, some of them held from outside.
    fn net(side: usize, symmetric: bool, random: &mut Random) -> Sparse {
        let mut entries = vec![];
        let mut add = |i: usize, j: usize, random: &mut Random| {
            let one = 0.1 + random.unit();
            let other = if symmetric { one } else { 0.1 + random.unit() };
            for (a, b, w) in [(i, j, one), (j, i, other)] {
                entries.extend([(a as u32, b as u32, -w), (a as u32, a as u32, w)]);
            }
        };
        for i in 0..side {
            for j in 0..side {
                let k = i * side + j;
                if i + 1 < side {
                    add(k, k + side, random);
                }
                if j + 1 < side {
                    add(k, k + 1, random);
                }
            }
        }
        entries.extend((0..side).map(|j| (j as u32, j as u32, 1.0)));
        Sparse::new(side * side, side * side, &entries)
    }

    #[test]
    fn what_was_multiplied_is_found_again_in_few_rounds() {
        struct Rounds(std::sync::atomic::AtomicUsize);
        impl Progress for Rounds {
            fn cancelled(&self) -> bool {
                self.0.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                false
            }
        }
        let random = &mut Random::new(9);
        for symmetric in [true, false] {
            for side in [1, 2, 17, 60, 200] {
                let matrix = net(side, symmetric, random);
                let truth: Vec<f64> = (0..side * side).map(|_| random.unit()).collect();
                let right = matrix.times(&truth);
                let mut x = vec![0.0; truth.len()];
                let rounds = Rounds(std::sync::atomic::AtomicUsize::new(0));
                let left = Multigrid::new(matrix).solve(&right, &mut x, 1e-12, &rounds).unwrap();
                let worst = x.iter().zip(&truth).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
                assert!(left <= 1e-12 && worst < 1e-7, "{symmetric} {side}: {left} {worst}");
                let rounds = rounds.0.into_inner();
                assert!(rounds < 40, "{symmetric} {side}: {rounds}");
            }
        }
    }

    /// A hub with very many neighbors, each of which has two more: memory stays that of the matrix, and rounds are few.
    #[test]
    fn a_hub_does_not_fill_the_levels() {
        let n = 20_000u32;
        let mut entries = vec![(n, n, 1.0)];
        for i in 0..n {
            for (a, b) in [(i, (i + 1) % n), (i, n)] {
                entries.extend([(a, b, -1.0), (b, a, -1.0), (a, a, 1.0), (b, b, 1.0)]);
            }
        }
        let matrix = Sparse::new(n as usize + 1, n as usize + 1, &entries);
        let truth: Vec<f64> = (0..=n).map(|i| f64::from(i % 11)).collect();
        let right = matrix.times(&truth);
        let solver = Multigrid::new(matrix);
        let size = |m: &Sparse| (0..m.rows()).map(|i| m.row(i).count()).sum::<usize>();
        let total: usize = solver.levels.iter().map(|level| size(&level.matrix)).sum();
        assert!(total < 3 * size(&solver.levels[0].matrix), "{total}");
        let mut x = vec![0.0; truth.len()];
        solver.solve(&right, &mut x, 1e-12, &Silent).unwrap();
        assert!(x.iter().zip(&truth).all(|(a, b)| (a - b).abs() < 1e-7));
    }

    /// However many, they are not solved for at once.
    #[test]
    fn unknowns_that_do_not_hang_together_are_many_and_quick() {
        let n = 200_000;
        let entries: Vec<(u32, u32, f64)> = (0..n).map(|i| (i, i, 2.0 + f64::from(i % 7))).collect();
        let mut x = vec![0.0; n as usize];
        let right = vec![1.0; n as usize];
        let left = Multigrid::new(Sparse::new(n as usize, n as usize, &entries))
            .solve(&right, &mut x, 1e-12, &Silent)
            .unwrap();
        assert!(left <= 1e-12);
        assert!((0..n).all(|i| (x[i as usize] * (2.0 + f64::from(i % 7)) - 1.0).abs() < 1e-12));
    }

    #[test]
    fn small_systems_are_solved_with_rows_exchanged() {
        let entries = [(0, 1, 2.0), (1, 0, 3.0), (1, 1, 1.0), (2, 2, 4.0), (2, 0, 1.0)];
        let mut x = [0.0; 3];
        Multigrid::new(Sparse::new(3, 3, &entries)).solve(&[4.0, 5.0, 9.0], &mut x, 0.0, &Silent).unwrap();
        assert_eq!(x, [1.0, 2.0, 2.0]);
    }
}
