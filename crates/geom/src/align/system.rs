//! The normal equations of a small rigid motion, and what they say about the freedom of the fit.
//!
//! The six unknowns are a rotation vector about a center and a translation. Rotations are counted in units of the
//! points' root mean square distance from the center, so that all six have the size of a displacement.

use crate::parallel::prelude::*;
use crate::space::{Point, Vector, cross, dot, least_axis, minus, times, unit};

/// The constraint of a point: the shape of the surface where it is nearest.
#[derive(Clone, Copy, Debug)]
pub(super) enum Constraint {
    /// Inside a facet with this unit normal: along that.
    Plane(Vector),
    /// On an edge with this unit direction: across that.
    Line(Vector),
    /// At a corner: every way.
    Point,
}

/// One point: `away` is to vanish, as far as it is held. With these the equations are those of Newton for half the squared
/// distance: its second derivative is the projection on what holds. With the direction of `away` alone, points beside
/// sharp edges swing to and fro.
#[derive(Clone, Copy, Debug)]
pub(super) struct Equation {
    pub point: Point,
    /// From its closest place.
    pub away: Vector,
    pub hold: Constraint,
    pub weight: f64,
}

impl Equation {
    /// The directions along which it is held, and how many there are.
    #[inline(always)]
    fn directions(&self) -> ([Vector; 3], usize) {
        match self.hold {
            Constraint::Plane(n) => ([n, n, n], 1),
            Constraint::Line(t) => {
                let axis = least_axis(t);
                let a = unit(cross(t, axis)).map_or(axis, |a| a.0);
                ([a, cross(t, a), t], 2)
            }
            Constraint::Point => ([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], 3),
        }
    }
}

/// Six numbers: rotation times radius, translation.
pub(super) type Six = [f64; 6];
/// Six rows.
pub(super) type SixBySix = [Six; 6];

/// Sums over all equations.
#[derive(Clone, Debug)]
pub(super) struct System {
    pub center: Point,
    pub radius: f64,
    pub matrix: SixBySix,
    pub right: Six,
    /// Sum of the weights, of weights squared, of weighted squared residuals.
    pub weight: f64,
    pub weight_squared: f64,
    pub squares: f64,
}

/// Equations added in one go: sums do not depend on the number of threads.
const EQUATIONS_PER_SUM: usize = 4096;

impl System {
    /// Adds up the equations of `items` about `center`; those of weight 0 do not count.
    pub fn new<T: Sync>(
        items: &[T],
        equation: impl Fn(&T) -> Equation + Sync,
        center: Point,
        radius: f64,
    ) -> System {
        let empty = || System {
            center,
            radius,
            matrix: [[0.0; 6]; 6],
            right: [0.0; 6],
            weight: 0.0,
            weight_squared: 0.0,
            squares: 0.0,
        };
        let add = |part: &[T]| {
            let mut s = empty();
            for item in part {
                let e = equation(item);
                if e.weight > 0.0 {
                    s.add(&e);
                }
            }
            s
        };
        let parts: Vec<System> = items.par_chunks(EQUATIONS_PER_SUM).map(add).collect();
        let mut sum = parts.into_iter().fold(empty(), |mut sum, part| {
            for i in 0..6 {
                for j in 0..=i {
                    sum.matrix[i][j] += part.matrix[i][j];
                }
                sum.right[i] += part.right[i];
            }
            sum.weight += part.weight;
            sum.weight_squared += part.weight_squared;
            sum.squares += part.squares;
            sum
        });
        for i in 0..6 {
            for j in i + 1..6 {
                sum.matrix[i][j] = sum.matrix[j][i];
            }
        }
        sum
    }

    #[inline(always)]
    fn add(&mut self, e: &Equation) {
        let (directions, count) = e.directions();
        for direction in &directions[..count] {
            let row = slope(e.point, *direction, self.center, self.radius);
            let residual = dot(e.away, *direction);
            for i in 0..6 {
                for j in 0..=i {
                    self.matrix[i][j] += e.weight * row[i] * row[j];
                }
                self.right[i] -= e.weight * row[i] * residual;
            }
            self.squares += e.weight * residual * residual;
        }
        self.weight += e.weight;
        self.weight_squared += e.weight * e.weight;
    }

    /// Root of the mean square residual.
    pub fn rms(&self) -> f64 {
        (self.squares / self.weight).sqrt()
    }

    /// The number of equal weights that would say as much.
    pub fn count(&self) -> f64 {
        self.weight * self.weight / self.weight_squared
    }
}

/// How far a unit of each unknown moves `point` along `direction`.
#[inline(always)]
pub(super) fn slope(point: Point, direction: Vector, center: Point, radius: f64) -> Six {
    let turn = times(1.0 / radius, cross(minus(point, center), direction));
    [turn[0], turn[1], turn[2], direction[0], direction[1], direction[2]]
}

/// Eigenvalues, ascending, and unit eigenvectors of a symmetric matrix, by Jacobi's rotations.
pub(super) fn eigen_six(a: &SixBySix) -> (Six, SixBySix) {
    let (mut a, mut rows) = (*a, [[0.0; 6]; 6]);
    for (k, row) in rows.iter_mut().enumerate() {
        row[k] = 1.0;
    }
    for _ in 0..40 {
        let off: f64 = (0..6).flat_map(|i| (0..i).map(move |j| (i, j))).map(|(i, j)| a[i][j].abs()).sum();
        let on: f64 = (0..6).map(|i| a[i][i].abs()).sum();
        if off <= f64::EPSILON * 1e-2 * on {
            break;
        }
        for p in 0..6 {
            for q in p + 1..6 {
                if a[p][q] != 0.0 {
                    rotate(&mut a, &mut rows, p, q);
                }
            }
        }
    }
    let mut order = [0, 1, 2, 3, 4, 5];
    order.sort_by(|&i, &j| a[i][i].total_cmp(&a[j][j]));
    (order.map(|i| a[i][i]), order.map(|i| rows[i]))
}

/// A symmetric matrix of fewer rows; the others stand above all its eigenvalues.
pub(super) fn padded(count: usize, of: &dyn Fn(usize, usize) -> f64) -> SixBySix {
    let trace: f64 = (0..count).map(|k| of(k, k)).sum();
    let above = 4.0 * (1.0 + trace);
    std::array::from_fn(|i| {
        std::array::from_fn(|j| match i < count && j < count {
            true => of(i, j),
            false => f64::from(u8::from(i == j)) * above,
        })
    })
}

/// One rotation in the plane of `p` and `q` that makes their common entry zero.
fn rotate(a: &mut SixBySix, rows: &mut SixBySix, p: usize, q: usize) {
    let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    // Beyond the range of squares: no rotation.
    let t = 1f64.copysign(theta) / (theta.abs() + (theta * theta + 1.0).sqrt());
    let c = 1.0 / (t * t + 1.0).sqrt();
    let s = t * c;
    for k in 0..6 {
        (a[k][p], a[k][q]) = (c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]);
    }
    for k in 0..6 {
        (a[p][k], a[q][k]) = (c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]);
        (rows[p][k], rows[q][k]) = (c * rows[p][k] - s * rows[q][k], s * rows[p][k] + c * rows[q][k]);
    }
}

/// Share of the greatest eigenvalue below which a direction counts as undetermined by arithmetic: no step is made along it.
const UNDETERMINED_SHARE: f64 = 1e-12;

/// The matrix taken apart.
pub(super) struct Spectrum {
    pub values: Six,
    pub vectors: SixBySix,
    /// Number of directions, from the least, along which no step is made.
    pub fixed: usize,
    /// How many of them were taken out before.
    pub stay: usize,
}

impl Spectrum {
    /// The spectrum of the matrix of a system.
    pub fn of(system: &System) -> Spectrum {
        Spectrum::without(system, &[])
    }

    /// The spectrum of the rest of the matrix without these orthonormal directions, which stand first, below all others.
    pub fn without(system: &System, directions: &[Six]) -> Spectrum {
        let mut matrix = system.matrix;
        for d in directions {
            let along: Six = std::array::from_fn(|i| (0..6).map(|j| matrix[i][j] * d[j]).sum());
            let twice: f64 = (0..6).map(|i| along[i] * d[i]).sum();
            for i in 0..6 {
                for j in 0..6 {
                    matrix[i][j] += twice * d[i] * d[j] - along[i] * d[j] - d[i] * along[j];
                }
            }
        }
        let trace: f64 = (0..6).map(|k| matrix[k][k]).sum();
        for d in directions {
            for i in 0..6 {
                for j in 0..6 {
                    matrix[i][j] -= (1.0 + trace) * d[i] * d[j];
                }
            }
        }
        let (values, vectors) = eigen_six(&matrix);
        let fixed = values.iter().filter(|&&v| v <= UNDETERMINED_SHARE * values[5]).count();
        Spectrum { values, vectors, fixed: fixed.max(directions.len()), stay: directions.len() }
    }

    /// The step that solves the equations best, none along the first `fixed` directions.
    pub fn solve(&self, right: &Six, fixed: usize) -> Six {
        let mut x = [0.0; 6];
        for k in fixed.max(self.fixed)..6 {
            let along: f64 = (0..6).map(|i| self.vectors[k][i] * right[i]).sum();
            for i in 0..6 {
                x[i] += along / self.values[k] * self.vectors[k][i];
            }
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    #[test]
    fn eigenvectors_reproduce_the_matrix() {
        let random = &mut Random::new(4);
        let b: SixBySix = std::array::from_fn(|_| std::array::from_fn(|_| random.unit() - 0.5));
        let a: SixBySix =
            std::array::from_fn(|i| std::array::from_fn(|j| (0..6).map(|k| b[i][k] * b[j][k]).sum()));
        let (values, rows) = eigen_six(&a);
        assert!(values.windows(2).all(|v| v[0] <= v[1]));
        for i in 0..6 {
            for j in 0..6 {
                let x: f64 = (0..6).map(|k| values[k] * rows[k][i] * rows[k][j]).sum();
                assert!((x - a[i][j]).abs() < 1e-14);
            }
        }
    }
}
