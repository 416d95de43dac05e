//! Starts for surfaces of revolution: which directions could be the axis, and where does it lie?
//!
//! The points are condensed once into the covariance of their first and second powers. The best algebraic cylinder for any
//! direction has |q⊥|² linear in the coordinates across. The best body of revolution has |q⊥|² a parabola along the axis
//! besides. Either costs a few dozen operations, so the whole half sphere of directions can be looked through. The cylinder
//! part follows D. Eberly, "Fitting 3D data with a cylinder" (2003).

use super::sample::mean;
use crate::frame::Pose;
use crate::space::{Point, Vector, dot, minus, plus, times};
use std::sync::LazyLock;

/// Mean and covariances of the coordinates `p` and of the products `q = (xx, xy, xz, yy, yz, zz)`.
pub(super) struct Powers {
    mean: Point,
    product_mean: [f64; 6],
    linear: [[f64; 3]; 3],
    mixed: [[f64; 6]; 3],
    square: [[f64; 6]; 6],
}

/// A direction with the axis point and the numbers of its best algebraic body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    pub pose: Pose,
    /// Mean square of |q⊥|² about the body, divided by 4 times its mean |q⊥|²: near the mean square distance.
    pub error: f64,
    /// Mean of |q⊥|² about the axis.
    pub radius_squared: f64,
}

/// The profiles that the square of the distance from the axis may have along the axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Profile {
    /// Constant: cylinders.
    Constant,
    /// A parabola: near enough for tori.
    Parabola,
    /// A parabola that opens along the axis: cones. A ring and a point, or two rings, lie on a sphere too, which is a
    /// parabola about any axis; but that one closes.
    Opening,
}

fn products(p: Point) -> [f64; 6] {
    let [x, y, z] = p;
    [x * x, x * y, x * z, y * y, y * z, z * z]
}
fn product_form(w: Vector) -> [f64; 6] {
    let [x, y, z] = w;
    [x * x, 2.0 * x * y, 2.0 * x * z, y * y, 2.0 * y * z, z * z]
}
fn dot6(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

impl Powers {
    pub(super) fn of(points: &[Point]) -> Powers {
        let mean = mean(points);
        let share = 1.0 / points.len() as f64;
        let mut product_mean = [0.0; 6];
        for &p in points {
            let q = products(minus(p, mean));
            for k in 0..6 {
                product_mean[k] += share * q[k];
            }
        }
        let (mut linear, mut mixed, mut square) = ([[0.0; 3]; 3], [[0.0; 6]; 3], [[0.0; 6]; 6]);
        for &p in points {
            let p = minus(p, mean);
            let all = products(p);
            let q: [f64; 6] = std::array::from_fn(|k| all[k] - product_mean[k]);
            for i in 0..3 {
                for j in 0..3 {
                    linear[i][j] += share * p[i] * p[j];
                }
                for j in 0..6 {
                    mixed[i][j] += share * p[i] * q[j];
                }
            }
            for i in 0..6 {
                for j in 0..6 {
                    square[i][j] += share * q[i] * q[j];
                }
            }
        }
        Powers { mean, product_mean, linear, mixed, square }
    }

    /// The best algebraic body about the third of the directions `axes`.
    pub(super) fn axis(&self, axes: [Vector; 3], profile: Profile) -> Option<Axis> {
        let [u, v, w] = axes;
        let along = product_form(w);
        let across: [f64; 6] = std::array::from_fn(|k| f64::from(matches!(k, 0 | 3 | 5)) - along[k]);
        let covariance = |b: &[f64; 6]| -> [f64; 6] { std::array::from_fn(|i| dot6(&self.square[i], b)) };
        let with_linear = |b: &[f64; 6]| -> Vector { std::array::from_fn(|i| dot6(&self.mixed[i], b)) };
        let spread = |a: Vector, b: Vector| dot(a, self.linear.map(|row| dot(row, b)));
        // Columns: u and v, and for a parabola also w and w²; the mean is already taken out.
        let (m, f) = (spread, with_linear(&across));
        let center;
        let error;
        match profile {
            Profile::Constant => {
                let (uu, uv, vv) = (m(u, u), m(u, v), m(v, v));
                let (fu, fv) = (dot(f, u), dot(f, v));
                let det = uu * vv - uv * uv;
                if det.is_nan() || det <= 1e-14 * (uu + vv) * (uu + vv) {
                    return None;
                }
                let (cu, cv) = ((vv * fu - uv * fv) / det, (uu * fv - uv * fu) / det);
                error = dot6(&across, &covariance(&across)) - (cu * fu + cv * fv);
                center = [0.5 * cu, 0.5 * cv];
            }
            Profile::Parabola | Profile::Opening => {
                let g = with_linear(&along);
                let mut normal: Vec<Vec<f64>> =
                    axes.iter().map(|&a| axes.iter().map(|&b| m(a, b)).collect()).collect();
                for (row, &a) in normal.iter_mut().zip(&axes) {
                    row.push(dot(g, a));
                }
                let aa = dot6(&along, &covariance(&along));
                normal.push(vec![dot(g, u), dot(g, v), dot(g, w), aa]);
                let right = vec![dot(f, u), dot(f, v), dot(f, w), dot6(&along, &covariance(&across))];
                let mut x = crate::num::dense::solve(normal.clone(), right.clone());
                if profile == Profile::Opening && x.as_ref().is_none_or(|x| x[3] < 0.0) {
                    normal.truncate(3);
                    normal.iter_mut().for_each(|row| row.truncate(3));
                    x = crate::num::dense::solve(normal, right[..3].to_vec());
                }
                let x = x?;
                let explained: f64 = x.iter().zip(&right).map(|(a, b)| a * b).sum();
                error = dot6(&across, &covariance(&across)) - explained;
                center = [0.5 * x[0], 0.5 * x[1]];
            }
        }
        let radius_squared =
            dot6(&across, &self.product_mean) + center[0] * center[0] + center[1] * center[1];
        let origin = plus(self.mean, plus(times(center[0], u), times(center[1], v)));
        Some(Axis {
            pose: Pose { origin, axes },
            error: error.max(0.0) / (4.0 * radius_squared.max(1e-30)),
            radius_squared,
        })
    }

    /// The best axis for each of an even grid of directions and for those in `first`.
    pub(super) fn grid(&self, profile: Profile, first: &[Vector]) -> Vec<Axis> {
        let directions = first.iter().copied().chain(directions());
        let axes = directions.filter_map(|w| self.axis(Pose::along(self.mean, w).axes, profile));
        axes.filter(|a| a.error.is_finite()).collect()
    }

    /// At most `count` axes that are best among their neighbors, best first. `first` are directions that are
    /// looked at besides the grid.
    pub(super) fn axes(&self, profile: Profile, first: &[Vector], count: usize) -> Vec<Axis> {
        let mut valleys = Vec::with_capacity(count);
        for axis in apart(self.grid(profile, first), count) {
            valleys.extend(self.refined(axis, profile, &valleys));
        }
        apart(valleys, count)
    }

    /// A few Newton steps on the direction, by differences; `None` where they lead into one of the `known` valleys and to
    /// nothing better.
    fn refined(&self, mut best: Axis, profile: Profile, known: &[Axis]) -> Option<Axis> {
        let mut h = 0.02;
        for _ in 0..4 {
            let at = |a: f64, b: f64| self.axis(best.pose.moved([0.0; 3], [a, b], 0.0).axes, profile);
            let error = |a: f64, b: f64| at(a, b).map_or(f64::INFINITY, |x| x.error);
            let (e0, xp, xm, yp, ym) =
                (best.error, error(h, 0.0), error(-h, 0.0), error(0.0, h), error(0.0, -h));
            let xy = error(h, h);
            let (gx, gy) = ((xp - xm) / (2.0 * h), (yp - ym) / (2.0 * h));
            let (hxx, hyy) = ((xp - 2.0 * e0 + xm) / (h * h), (yp - 2.0 * e0 + ym) / (h * h));
            let hxy = (xy - xp - yp + e0) / (h * h);
            let det = hxx * hyy - hxy * hxy;
            if !(det > 0.0 && hxx > 0.0) {
                break;
            }
            let step = [-(hyy * gx - hxy * gy) / det, -(hxx * gy - hxy * gx) / det];
            let Some(next) = at(step[0].clamp(-0.3, 0.3), step[1].clamp(-0.3, 0.3)) else { break };
            if next.error >= best.error {
                break;
            }
            best = next;
            if known.iter().any(|k| !apart_from(k, &best) && k.error <= best.error) {
                return None;
            }
            h *= 0.2;
        }
        Some(best)
    }
}

/// The best `count` of the axes that are not of one valley, best first.
fn apart(mut rest: Vec<Axis>, count: usize) -> Vec<Axis> {
    let mut chosen = Vec::with_capacity(count);
    while chosen.len() < count {
        let Some(&best) = rest.iter().min_by(|a, b| a.error.total_cmp(&b.error)) else { break };
        rest.retain(|axis| apart_from(&best, axis));
        chosen.push(best);
    }
    chosen
}

/// Whether two axes are of two valleys: their directions differ by more than 12°.
fn apart_from(a: &Axis, b: &Axis) -> bool {
    /// Cosine of 12°.
    const OTHER_VALLEY_COSINE: f64 = 0.978;
    dot(a.pose.axes[2], b.pose.axes[2]).abs() < OTHER_VALLEY_COSINE
}

/// Directions of the even grid over the half sphere: about 15° apart.
const GRID_DIRECTIONS: usize = 80;

/// The directions of the grid.
pub(super) fn directions() -> impl Iterator<Item = Vector> {
    static ALL: LazyLock<[Vector; GRID_DIRECTIONS]> = LazyLock::new(|| std::array::from_fn(grid_direction));
    ALL.iter().copied()
}

/// The `k`-th direction of the grid: a spiral of the golden angle.
fn grid_direction(k: usize) -> Vector {
    let z = (k as f64 + 0.5) / GRID_DIRECTIONS as f64;
    let across = (1.0 - z * z).sqrt();
    let angle = k as f64 * (3.0 - 5f64.sqrt()) * std::f64::consts::PI;
    [across * libm::cos(angle), across * libm::sin(angle), z]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::cross;

    #[test]
    fn a_cylinder_is_found_from_its_points() {
        let pose = Pose::along([0.1, 0.2, -0.1], [0.3, -0.5, 0.8]);
        let points: Vec<Point> = (0..90)
            .map(|k| {
                let (a, z) = (0.9 * f64::from(k), (0.37 * f64::from(k)).sin());
                let q = plus(times(0.4 * a.cos(), pose.axes[0]), times(0.4 * a.sin(), pose.axes[1]));
                plus(pose.origin, plus(q, times(z, pose.axes[2])))
            })
            .collect();
        let best = Powers::of(&points).axes(Profile::Constant, &[], 3)[0];
        let off = cross(best.pose.axes[2], pose.axes[2]);
        assert!(dot(off, off).sqrt() < 1e-3, "{best:?}");
        assert!((best.radius_squared - 0.16).abs() < 1e-2);
    }
}
