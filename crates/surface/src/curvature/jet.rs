//! A jet: the height over a plane as a polynomial, fitted to the neighbors of a place.

use super::terms::{NoCurvature, unknowns};
use trueness_geom::noise::Noise;
use trueness_geom::space::{Point, Vector, cross, dot, least_axis, minus, plus, times, unit};
use trueness_geom::spline::surface::{Bend, Principal};

/// Cosine of the angle (15 degrees) between the frame's third axis and the fitted normal. Below it the frame is turned
/// to that normal and the jet fitted again. A height over a plane that stands obliquely needs a higher degree.
const MIN_UPRIGHT_COSINE: f64 = 0.965_925_826_289_068_3;
/// So often at most.
const MAX_FRAME_TURNS: usize = 4;
/// Greatest condition of a system whose answer is reported: a million times the rounding, and of the noise, would still be in it.
const MAX_CONDITION: f64 = 1e6;

/// The surface at a place, as found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet {
    /// Normal and curvatures.
    pub bend: Bend,
    /// Standard uncertainty of the mean curvature as the residuals tell it, 1/mm, for noise that is independent from
    /// point to point. Where the options state noise that neighbors share, it is the greater of that and the
    /// uncertainty that this noise makes.
    pub uncertainty: f64,
    /// Standard deviation of the neighbors from the jet, millimeters.
    pub residual: f64,
    /// Condition of the least-squares system in the Frobenius norm, coordinates being divided by the reach. It is at
    /// least the number of unknowns, and never less than the condition in the Euclidean norm.
    pub condition: f64,
    /// Distance of the farthest neighbor along the plane, millimeters.
    pub reach: f64,
    /// Neighbors, without the place itself.
    pub neighbors: u32,
}

impl Jet {
    /// The same seen from the other side.
    pub(super) fn turned(self) -> Jet {
        let Bend { normal, mean, gaussian, principal: [greater, lesser] } = self.bend;
        let turn = |p: Principal| Principal { curvature: -p.curvature, direction: p.direction };
        let principal = [turn(lesser), turn(greater)];
        Jet { bend: Bend { normal: times(-1.0, normal), mean: -mean, gaussian, principal }, ..self }
    }
}

/// Fits jets, one after the other, in the same memory.
pub(super) struct Fitter {
    degree: usize,
    pub(super) unknowns: usize,
    /// The neighbors of a place, relative to it.
    pub(super) around: Vec<Vector>,
    /// Columns of the system, and behind them the heights.
    pub(super) columns: Vec<f64>,
    /// The same in the frame.
    pub(super) local: Vec<Vector>,
    /// Inverse of the triangle, columns.
    inverse: Vec<f64>,
    /// First numbers of the reflections' vectors.
    pub(super) heads: Vec<f64>,
    noise: Option<Noise>,
}

impl Fitter {
    /// With noise that neighbors share, uncertainties are those of such noise.
    pub(super) fn new(degree: usize, noise: Option<Noise>) -> Fitter {
        let unknowns = unknowns(degree);
        Fitter {
            degree,
            unknowns,
            around: vec![],
            columns: vec![],
            local: vec![],
            inverse: vec![0.0; unknowns * unknowns],
            heads: vec![0.0; unknowns],
            noise: noise.filter(|noise| noise.points_per_independent > 1.0),
        }
    }

    /// Replaces the neighbors.
    pub(super) fn take(&mut self, place: Point, neighbors: impl Iterator<Item = Point>) {
        self.around.clear();
        self.around.extend(neighbors.map(|p| minus(p, place)));
    }

    /// The jet over the plane across `normal`, or across its own normal where that leans. The place itself is one of the data.
    pub(super) fn jet(&mut self, normal: Vector) -> Result<Jet, NoCurvature> {
        if self.around.len() < self.unknowns {
            return Err(NoCurvature::FewNeighbors);
        }
        let mut found = self.once(normal)?;
        for _ in 0..MAX_FRAME_TURNS {
            if found.1 >= MIN_UPRIGHT_COSINE {
                break;
            }
            found = self.once(found.0.bend.normal)?;
        }
        Ok(found.0)
    }

    /// The jet over the plane across `up`, and the cosine of its own normal with that.
    fn once(&mut self, up: Vector) -> Result<(Jet, f64), NoCurvature> {
        let undetermined = NoCurvature::Undetermined;
        let across = least_axis(up);
        let (x, _) = unit(minus(across, times(dot(across, up), up))).ok_or(undetermined)?;
        let y = cross(up, x);
        self.local.clear();
        self.local.push([0.0; 3]);
        self.local.extend(self.around.iter().map(|q| [dot(*q, x), dot(*q, y), dot(*q, up)]));
        let reach = self.local.iter().fold(0.0f64, |h, q| h.max(libm::hypot(q[0], q[1])));
        if !(reach > 0.0 && reach.is_finite()) {
            return Err(undetermined);
        }
        self.fill(1.0 / reach);
        let m = self.local.len();
        let squares = self.eliminate(m);
        let condition = self.invert(m).ok_or(undetermined)?;
        if condition.is_nan() || condition > MAX_CONDITION {
            return Err(undetermined);
        }
        let deviation = (squares / (m - self.unknowns) as f64).sqrt();
        let [_, fx, fy, xx, xy, yy] = self.coefficients(m);
        let world = |[a, b, c]: Vector| plus(times(a, x), plus(times(b, y), times(c, up)));
        let first = [world([1.0, 0.0, fx]), world([0.0, 1.0, fy])];
        let second = [2.0 * xx, xy, 2.0 * yy].map(|s| times(s / reach, up));
        let bend = Bend::new(first, second).ok_or(undetermined)?;
        // H = ((1 + fy²) fxx − 2 fx fy fxy + (1 + fx²) fyy) / 2 w³; the slopes are known far better than the second derivatives.
        let w2 = 1.0 + fx * fx + fy * fy;
        let w = w2.sqrt();
        let weights = [2.0 * (1.0 + fy * fy), -2.0 * fx * fy, 2.0 * (1.0 + fx * fx)];
        let weights = weights.map(|g| g / (2.0 * w2 * w * reach));
        let independent = deviation * self.spread(3, weights);
        let shared = |noise: Noise| noise.deviation / reach * self.shared(3, weights, &noise);
        let jet = Jet {
            bend,
            uncertainty: self.noise.map_or(independent, |noise| shared(noise).max(independent)),
            residual: reach * deviation,
            condition,
            reach,
            neighbors: self.around.len() as u32,
        };
        Ok((jet, 1.0 / w))
    }

    /// Powers of the scaled coordinates, column after column: 1, x, y, x², xy, y², …; then the heights.
    fn fill(&mut self, scale: f64) {
        let m = self.local.len();
        self.columns.clear();
        self.columns.resize((self.unknowns + 1) * m, 0.0);
        self.columns[..m].fill(1.0);
        // Each monomial is an earlier one times x, but for the powers of y.
        let mut before = 0;
        let mut next = 1;
        for degree in 1..=self.degree {
            for k in 0..=degree {
                let (done, rest) = self.columns.split_at_mut(next * m);
                let (from, axis) = if k < degree { (before + k, 0) } else { (before + k - 1, 1) };
                let lower = &done[from * m..(from + 1) * m];
                for ((value, lower), q) in rest[..m].iter_mut().zip(lower).zip(&self.local) {
                    *value = lower * (q[axis] * scale);
                }
                next += 1;
            }
            before += degree;
        }
        let heights = self.columns[next * m..].iter_mut();
        heights.zip(&self.local).for_each(|(value, q)| *value = q[2] * scale);
    }

    /// Householder's reflections: the triangle stands above the diagonal then, the turned heights behind it. Gives the sum of
    /// the squares that are left.
    fn eliminate(&mut self, m: usize) -> f64 {
        let n = self.unknowns;
        for k in 0..n {
            let (head, tail) = self.columns.split_at_mut((k + 1) * m);
            let pivot = &mut head[k * m + k..];
            let length = pivot.iter().map(|x| x * x).sum::<f64>().sqrt();
            self.heads[k] = 0.0;
            if length == 0.0 {
                continue;
            }
            let alpha = if pivot[0] > 0.0 { -length } else { length };
            pivot[0] -= alpha;
            self.heads[k] = pivot[0];
            // vᵀ v / 2 for v = a − α e.
            let half = -alpha * pivot[0];
            for column in tail.chunks_exact_mut(m) {
                let below = &mut column[k..];
                let share = below.iter().zip(&*pivot).map(|(a, v)| a * v).sum::<f64>() / half;
                below.iter_mut().zip(&*pivot).for_each(|(a, v)| *a -= share * v);
            }
            pivot[0] = alpha;
        }
        self.columns[n * m + n..].iter().map(|x| x * x).sum()
    }

    /// The inverse of the triangle, and the condition; `None` where there is none.
    fn invert(&mut self, m: usize) -> Option<f64> {
        let n = self.unknowns;
        let r = |i: usize, j: usize| self.columns[j * m + i];
        let (mut of_triangle, mut of_inverse) = (0.0, 0.0);
        for j in 0..n {
            if r(j, j) == 0.0 {
                return None;
            }
            let column = &mut self.inverse[j * n..(j + 1) * n];
            column.fill(0.0);
            column[j] = 1.0 / r(j, j);
            for i in (0..j).rev() {
                let sum: f64 = (i + 1..=j).map(|k| r(i, k) * column[k]).sum();
                column[i] = -sum / r(i, i);
            }
            of_triangle += (0..=j).map(|i| r(i, j) * r(i, j)).sum::<f64>();
            of_inverse += column.iter().map(|x| x * x).sum::<f64>();
        }
        Some((of_triangle * of_inverse).sqrt())
    }

    /// The first six coefficients.
    fn coefficients(&self, m: usize) -> [f64; 6] {
        let n = self.unknowns;
        let right = &self.columns[n * m..n * m + n];
        std::array::from_fn(|i| (i..n).map(|j| self.inverse[j * n + i] * right[j]).sum())
    }

    /// The weights of the turned data, from `first` on, in a sum of three coefficients from there on; those before are 0.
    pub(super) fn turned_weights(
        &self,
        first: usize,
        weights: [f64; 3],
    ) -> impl Iterator<Item = f64> + use<'_> {
        let n = self.unknowns;
        let row = move |j: usize| (0..3).map(|k| weights[k] * self.inverse[j * n + first + k]).sum();
        (first..n).map(row)
    }

    /// Standard deviation of a sum of coefficients from `first` on, for data of standard deviation 1.
    fn spread(&self, first: usize, weights: [f64; 3]) -> f64 {
        self.turned_weights(first, weights).map(|x| x * x).sum::<f64>().sqrt()
    }
}
