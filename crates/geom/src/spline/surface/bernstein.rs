//! Lower bounds of the distance of a part of a surface from a point, by coefficients in Bernstein form.
//!
//! A polynomial on a rectangle is nowhere below the least of its Bernstein coefficients, and the surface lies within the hull
//! of its own. Two bounds follow. A plane runs through the best place at right angles to the way from the point to it. All of
//! the part lies behind that plane if its coefficients do. That does away at once with parts that bend away from the point, and
//! with a whole edge at one place. Parts folded into a plane or onto a line go too. And all of the part is farther than `r` if
//! no coefficient of `|X − p w|² − r² w²` is below 0. Where the surface bends towards the point this leaves a part that shrinks
//! with the square of a step. It leaves nothing of a sphere around its center. Neither bound asks that the surface has a
//! normal.

use super::super::value::Value;
use crate::space::{Aabb, Point, Vector, dot};

/// Rounding of a coefficient, as a share of the greatest of its kind: each is the sum of some dozens of products.
const COEFFICIENT_ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A part of a surface about a point in Bernstein form.
#[derive(Clone)]
pub(super) struct Bernstein {
    /// `X − p w` and `w`.
    moments: Net<4>,
    /// `|X − p w|²` and `w²`.
    squares: Net<2>,
    /// Rounding of the moments and of their squares.
    noise: [f64; 2],
}

/// Bernstein coefficients of both directions, row after row.
#[derive(Clone)]
struct Net<const D: usize> {
    counts: [usize; 2],
    values: Vec<[f64; D]>,
}

impl Bernstein {
    /// The part from `from` to `to` for coefficients of powers on `[−1, 1]²`, `q` to a row.
    pub(super) fn new(powers: Vec<[f64; 4]>, q: usize, from: [f64; 2], to: [f64; 2]) -> Bernstein {
        let counts = [powers.len() / q, q];
        let mut net = Net { counts, values: powers };
        for k in 0..2 {
            net.transform(k, &scaled(counts[k], from[k], to[k]));
        }
        let mut squares = net.squares();
        net.divide();
        squares.divide();
        let moment = |v: &[f64; 4]| v[0].abs().max(v[1].abs()).max(v[2].abs());
        let most = net.values.iter().map(moment).fold(0.0, f64::max);
        let square = squares.values.iter().map(|v| v[0].abs()).fold(0.0, f64::max);
        Bernstein {
            moments: net,
            squares,
            noise: [COEFFICIENT_ROUNDING * most, COEFFICIENT_ROUNDING * square],
        }
    }

    /// The box of the coefficients, which holds the part.
    pub(super) fn hull(powers: Vec<[f64; 4]>, q: usize, from: [f64; 2], to: [f64; 2]) -> Aabb {
        let counts = [powers.len() / q, q];
        let mut net = Net { counts, values: powers };
        for k in 0..2 {
            net.transform(k, &scaled(counts[k], from[k], to[k]));
        }
        net.divide();
        let places: Vec<Point> = net.values.iter().map(|[x, y, z, w]| [x / w, y / w, z / w]).collect();
        Aabb::of(&places)
    }

    /// Whether no place of the part is nearer to the point than `least`; `way` is the unit vector from the point to the best place.
    pub(super) fn is_beyond(&self, least: f64, way: Vector) -> bool {
        let in_half_space = |[x, y, z, w]: &[f64; 4]| dot([*x, *y, *z], way) >= least * w + self.noise[0];
        let square = least * least;
        least <= 0.0
            || self.moments.values.iter().all(in_half_space)
            || self.squares.values.iter().all(|[s, w]| *s >= square * w + self.noise[1])
    }

    /// The direction along which the square of the distance bends more: that in which a cut tells more.
    pub(super) fn bent(&self) -> usize {
        let [u, v] = [0, 1].map(|k| self.squares.bend(k));
        usize::from(v > u)
    }

    /// Both halves along a direction.
    pub(super) fn halves(&self, k: usize) -> [Bernstein; 2] {
        let [a, b] = self.moments.halves(k);
        let [c, d] = self.squares.halves(k);
        let noise = self.noise;
        [Bernstein { moments: a, squares: c, noise }, Bernstein { moments: b, squares: d, noise }]
    }
}

impl<const D: usize> Net<D> {
    /// Start and step of row or column `line` along direction `k`, and how many such there are.
    fn along(&self, k: usize) -> ([usize; 2], usize) {
        let [p, q] = self.counts;
        if k == 0 { ([1, q], q) } else { ([q, 1], p) }
    }

    fn transform(&mut self, k: usize, matrix: &[f64]) {
        let n = self.counts[k];
        let ([start, step], lines) = self.along(k);
        for line in 0..lines {
            let own: Vec<[f64; D]> = (0..n).map(|i| self.values[line * start + i * step]).collect();
            for (i, row) in matrix.chunks_exact(n).enumerate() {
                self.values[line * start + i * step] =
                    own.iter().zip(row).fold([0.0; D], |sum, (x, by)| sum.plus(*by, *x));
            }
        }
    }

    /// Divides scaled coefficients by the binomial coefficients.
    fn divide(&mut self) {
        let [a, b] = self.counts.map(|n| binomials(n - 1));
        for (n, value) in self.values.iter_mut().enumerate() {
            let by = 1.0 / (a[n / b.len()] * b[n % b.len()]);
            *value = value.map(|x| x * by);
        }
    }

    /// Greatest second difference along a direction.
    fn bend(&self, k: usize) -> f64 {
        let ([start, step], lines) = self.along(k);
        let mut most = 0.0f64;
        for line in 0..lines {
            for i in 2..self.counts[k] {
                let at = |i: usize| self.values[line * start + i * step][0];
                most = most.max((at(i) - 2.0 * at(i - 1) + at(i - 2)).abs());
            }
        }
        most
    }

    /// Both halves along a direction, by the pyramid of de Casteljau.
    fn halves(&self, k: usize) -> [Net<D>; 2] {
        let (mut first, mut second) = (self.clone(), self.clone());
        let n = self.counts[k];
        let ([start, step], lines) = self.along(k);
        for line in 0..lines {
            let at = |i: usize| line * start + i * step;
            for level in 1..n {
                for i in 0..n - level {
                    second.values[at(i)] = second.values[at(i)].between(0.5, second.values[at(i + 1)]);
                }
                first.values[at(level)] = second.values[at(0)];
            }
        }
        [first, second]
    }
}

impl Net<4> {
    /// `|X|²` and `w²` of scaled coefficients, scaled.
    fn squares(&self) -> Net<2> {
        let [p, q] = self.counts;
        let counts = [2 * p - 1, 2 * q - 1];
        let mut values = vec![[0.0; 2]; counts[0] * counts[1]];
        for (m, [x, y, z, w]) in self.values.iter().enumerate() {
            for (n, other) in self.values.iter().enumerate() {
                let at = (m / q + n / q) * counts[1] + m % q + n % q;
                values[at][0] += x * other[0] + y * other[1] + z * other[2];
                values[at][1] += w * other[3];
            }
        }
        Net { counts, values }
    }
}

/// Row `n` of Pascal's triangle.
fn binomials(n: usize) -> Vec<f64> {
    let mut row = vec![1.0; n + 1];
    for k in 1..=n {
        row[k] = row[k - 1] * (n + 1 - k) as f64 / k as f64;
    }
    row
}

/// The matrix from `n` coefficients of powers on `[−1, 1]` to those of Bernstein on `[from, to]`, times the binomial coefficients.
fn scaled(n: usize, from: f64, to: f64) -> Vec<f64> {
    let rows: Vec<Vec<f64>> = (0..n).map(binomials).collect();
    let mut matrix = vec![0.0; n * n];
    for power in 0..n {
        // `(from + (to − from) y)^power` has the coefficient `by` of `y^j`, and `y^j` that of `C(n − 1 − j, k − j)` of function `k`.
        let mut own = vec![0.0; power + 1];
        let mut by = 1.0;
        for j in 0..=power {
            own[j] = by * rows[power][j];
            by *= to - from;
        }
        let mut by = 1.0;
        for j in (0..=power).rev() {
            own[j] *= by;
            by *= from;
        }
        for (j, value) in own.iter().enumerate() {
            for k in j..n {
                matrix[k * n + power] += value * rows[n - 1 - j][k - j];
            }
        }
    }
    matrix
}
