//! Polynomials of two variables in Bernstein form.

use trueness_geom::space::Vector;
use trueness_geom::spline::value::{Mass, Value};

/// Coefficients in Bernstein form of both directions, row after row.
#[derive(Clone, Debug)]
pub(crate) struct Net<V> {
    pub(crate) counts: [usize; 2],
    pub(crate) values: Vec<V>,
}

/// What is combined linearly: numbers and vectors.
pub(crate) trait Coefficient: Copy {
    /// The neutral element of addition.
    fn zero() -> Self;
    /// `self + weight · other`.
    fn plus(self, weight: f64, other: Self) -> Self;
}

impl Coefficient for f64 {
    fn zero() -> f64 {
        0.0
    }
    fn plus(self, weight: f64, other: f64) -> f64 {
        self + weight * other
    }
}

impl Coefficient for Vector {
    fn zero() -> Vector {
        [0.0; 3]
    }
    fn plus(self, weight: f64, other: Vector) -> Vector {
        std::array::from_fn(|k| self[k] + weight * other[k])
    }
}

impl Coefficient for Mass<3> {
    fn zero() -> Mass<3> {
        Mass::ZERO
    }
    fn plus(self, weight: f64, other: Mass<3>) -> Mass<3> {
        Value::plus(self, weight, other)
    }
}

impl<V: Copy> Net<V> {
    /// Start and step of row or column `line` along direction `k`, and how many such there are.
    pub(super) fn along(&self, k: usize) -> ([usize; 2], usize) {
        let [p, q] = self.counts;
        if k == 0 { ([1, q], q) } else { ([q, 1], p) }
    }

    pub(super) fn map<T>(&self, f: impl Fn(&V) -> T) -> Net<T> {
        Net { counts: self.counts, values: self.values.iter().map(f).collect() }
    }

    /// The product of two nets.
    pub(super) fn product<T: Copy, W: Coefficient>(&self, other: &Net<T>, by: impl Fn(V, T) -> W) -> Net<W> {
        let [[m, n], [r, s]] = [self.counts, other.counts].map(|c| c.map(|x| x - 1));
        let rows = shares(m, r);
        let columns = shares(n, s);
        let counts = [m + r + 1, n + s + 1];
        let mut values = vec![W::zero(); counts[0] * counts[1]];
        for i in 0..=m {
            for j in 0..=n {
                let own = self.values[i * (n + 1) + j];
                for k in 0..=r {
                    let row = rows[i * (r + 1) + k];
                    for l in 0..=s {
                        let share = row * columns[j * (s + 1) + l];
                        let sum = &mut values[(i + k) * counts[1] + j + l];
                        *sum = sum.plus(share, by(own, other.values[k * (s + 1) + l]));
                    }
                }
            }
        }
        Net { counts, values }
    }
}

impl<V: Coefficient> Net<V> {
    /// The derivative by the share of the way along a direction.
    pub(super) fn derivative(&self, k: usize) -> Net<V> {
        let n = self.counts[k];
        let mut counts = self.counts;
        counts[k] = n.max(2) - 1;
        if n == 1 {
            return Net { counts, values: vec![V::zero(); self.values.len()] };
        }
        let step = if k == 0 { self.counts[1] } else { 1 };
        let at = |i: usize, j: usize| i * self.counts[1] + j;
        let by = (n - 1) as f64;
        let values = (0..counts[0])
            .flat_map(|i| (0..counts[1]).map(move |j| at(i, j)))
            .map(|a| V::zero().plus(by, self.values[a + step].plus(-1.0, self.values[a])))
            .collect();
        Net { counts, values }
    }

    /// Both halves along a direction, by the pyramid of de Casteljau.
    pub(crate) fn halves(&self, k: usize) -> [Net<V>; 2] {
        let (mut first, mut second) = (self.clone(), self.clone());
        let n = self.counts[k];
        let ([start, step], lines) = self.along(k);
        for line in 0..lines {
            let at = |i: usize| line * start + i * step;
            for level in 1..n {
                for i in 0..n - level {
                    let sum = second.values[at(i)].plus(1.0, second.values[at(i + 1)]);
                    second.values[at(i)] = V::zero().plus(0.5, sum);
                }
                first.values[at(level)] = second.values[at(0)];
            }
        }
        [first, second]
    }
}

/// `C(m, i)·C(r, k) / C(m + r, i + k)` for all `i` and `k`.
fn shares(m: usize, r: usize) -> Vec<f64> {
    let [a, b, all] = [m, r, m + r].map(binomials);
    (0..=m).flat_map(|i| (0..=r).map(move |k| (i, k))).map(|(i, k)| a[i] * b[k] / all[i + k]).collect()
}

/// Row `n` of Pascal's triangle.
fn binomials(n: usize) -> Vec<f64> {
    let mut row = vec![1.0; n + 1];
    for k in 1..=n {
        row[k] = row[k - 1] * (n + 1 - k) as f64 / k as f64;
    }
    row
}

impl Net<f64> {
    pub(super) fn greatest(&self) -> f64 {
        self.values.iter().fold(0.0, |m: f64, x| m.max(x.abs()))
    }

    /// The least coefficient.
    pub(super) fn least(&self) -> f64 {
        self.values.iter().copied().fold(f64::INFINITY, f64::min)
    }

    pub(super) fn has_one_sign(&self, noise: f64) -> bool {
        one_sign(self.values.iter().copied(), noise)
    }

    /// Least and greatest derivative along a direction, by the coefficients.
    pub(super) fn steps(&self, k: usize) -> [f64; 2] {
        let ([start, step], lines) = self.along(k);
        let n = self.counts[k];
        let mut range = if n == 1 { [0.0; 2] } else { [f64::INFINITY, f64::NEG_INFINITY] };
        for line in 0..lines {
            for i in 1..n {
                let at = line * start + i * step;
                let by = (n - 1) as f64 * (self.values[at] - self.values[at - step]);
                range = [range[0].min(by), range[1].max(by)];
            }
        }
        range
    }

    /// The mean of the derivatives along a direction.
    pub(super) fn middle_step(&self, k: usize) -> f64 {
        let [low, high] = self.steps(k);
        0.5 * (low + high)
    }

    /// Greatest second difference along a direction.
    pub(super) fn bend(&self, k: usize) -> f64 {
        let ([start, step], lines) = self.along(k);
        let mut most = 0.0f64;
        for line in 0..lines {
            for i in 2..self.counts[k] {
                let at = |i: usize| self.values[line * start + i * step];
                most = most.max((at(i) - 2.0 * at(i - 1) + at(i - 2)).abs());
            }
        }
        most
    }
}

/// Degree up to which a place is found without allocating.
const MAX_DEGREE_ON_STACK: usize = 8;

/// The moment and the mass.
type Four = [f64; 4];

impl Net<Mass<3>> {
    /// Value and derivatives by `u`, `v`, `uu`, `uv` and `vv` at shares of the way.
    pub(super) fn six(&self, [s, t]: [f64; 2]) -> [Mass<3>; 6] {
        let [p, q] = self.counts;
        let mut rows = [[[0.0; 4]; 3]; MAX_DEGREE_ON_STACK + 1];
        let mut many;
        let rows: &mut [[Four; 3]] = if p <= MAX_DEGREE_ON_STACK + 1 {
            &mut rows[..p]
        } else {
            many = vec![[[0.0; 4]; 3]; p];
            &mut many
        };
        for (row, own) in rows.iter_mut().zip(self.values.chunks_exact(q)) {
            *row = three(own.iter().map(|m| [m.moment[0], m.moment[1], m.moment[2], m.mass]), q, t);
        }
        let [value, u, uu] = three(rows.iter().map(|r| r[0]), p, s);
        let [v, uv, _] = three(rows.iter().map(|r| r[1]), p, s);
        let [vv, _, _] = three(rows.iter().map(|r| r[2]), p, s);
        [value, u, v, uu, uv, vv].map(|[x, y, z, mass]| Mass { moment: [x, y, z], mass })
    }
}

/// Value, first and second derivative of a polynomial by its `n` coefficients.
#[inline]
fn three(coefficients: impl Iterator<Item = Four>, n: usize, t: f64) -> [Four; 3] {
    let mut own = [[0.0; 4]; MAX_DEGREE_ON_STACK + 1];
    let mut many;
    let own: &mut [Four] = if n <= MAX_DEGREE_ON_STACK + 1 {
        &mut own[..n]
    } else {
        many = vec![[0.0; 4]; n];
        &mut many
    };
    own.iter_mut().zip(coefficients).for_each(|(own, c)| *own = c);
    let degree = n - 1;
    for level in 1..degree.max(2) - 1 {
        for i in 0..n - level {
            own[i] = between(own[i], t, own[i + 1]);
        }
    }
    match (degree, &*own) {
        (0, [a, ..]) => [*a, [0.0; 4], [0.0; 4]],
        (1, [a, b, ..]) => [between(*a, t, *b), step(*a, *b, 1.0), [0.0; 4]],
        (_, [a, b, c, ..]) => {
            let (left, right) = (between(*a, t, *b), between(*b, t, *c));
            let second = step(step(*a, *b, 1.0), step(*b, *c, 1.0), (degree * (degree - 1)) as f64);
            [between(left, t, right), step(left, right, degree as f64), second]
        }
        _ => [[0.0; 4]; 3],
    }
}

#[inline]
fn between(a: Four, t: f64, b: Four) -> Four {
    let s = 1.0 - t;
    [s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2], s * a[3] + t * b[3]]
}

/// `factor·(b − a)`.
#[inline]
fn step(a: Four, b: Four, factor: f64) -> Four {
    [factor * (b[0] - a[0]), factor * (b[1] - a[1]), factor * (b[2] - a[2]), factor * (b[3] - a[3])]
}

/// Whether all numbers have one sign and are beyond the rounding.
pub(super) fn one_sign(mut values: impl Iterator<Item = f64>, noise: f64) -> bool {
    let Some(first) = values.next() else { return false };
    first.abs() > noise && values.all(|x| x.abs() > noise && (x > 0.0) == (first > 0.0))
}
