//! Ideal elements that share an axis or an attitude, associated with several features at once.
//!
//! The unknowns are small motions of the frame that all elements share, and one size a feature. The size is the radius of a
//! cylinder, the height of a plane. Least squares go by Levenberg and Marquardt's steps (D. W. Marquardt, 1963). The least
//! greatest distance is found by a sequence of linear programs, each within a box that grows while the linear model holds. (R.
//! Fletcher, Practical Methods of Optimization, 1987, section 14.) They go over a working set that takes in the points that
//! stick out most.

use super::Source;
use crate::fit::{Function, HIDDEN_FALL, MAX_JOINING_POINTS, MAX_POINTS_ALL_WORKING, lowest};
use crate::frame::Pose;
use crate::num::dense::solve;
use crate::progress::Progress;
use crate::shape::Kind;
use crate::space::{Aabb, Point, Vector, minus, plus, times};
use crate::zone::ZoneError;

/// Most features that one datum is made of.
pub(super) const MAX_COMMON_FEATURES: usize = 3;
/// Unknowns: shifts along x and y, tilts towards x and y, the sizes.
const JOINT_UNKNOWNS: usize = 4 + MAX_COMMON_FEATURES;

/// The form that the elements share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// An axis: z of the frame. Cylinders of any radii, and lines.
    Axis,
    /// A normal: z of the frame. Planes at any heights.
    Planes,
}

/// Elements in one frame, in the coordinates of the points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stand {
    pub pose: Pose,
    /// Radius or height of each; heights are along z from the frame's origin.
    pub sizes: [f64; MAX_COMMON_FEATURES],
}

/// The features of one datum, seen from their middle and at unit size, so that neither place nor size costs digits.
pub(super) struct Joint<'a> {
    form: Form,
    sources: &'a [Source<'a>],
    points: Vec<(usize, Point)>,
    center: Point,
    scale: f64,
    free: [bool; JOINT_UNKNOWNS],
}

/// Steps below this are in the reach of rounding: the sum of squares no longer shows them.
const HIDDEN_SQUARES_STEP: f64 = 1e-9;

impl<'a> Joint<'a> {
    /// `shift` and `tilt`: what the frame may do, along and towards its x and y.
    pub(super) fn new(form: Form, sources: &'a [Source<'a>], shift: bool, tilt: [bool; 2]) -> Joint<'a> {
        let bounds = Aabb::of(sources.iter().flat_map(|s| s.points));
        let center = times(0.5, plus(bounds.min, bounds.max));
        let scale = 2.0 / bounds.diagonal().max(f64::MIN_POSITIVE);
        let seen = |(part, s): (usize, &Source<'a>)| -> Vec<(usize, Point)> {
            s.points.iter().map(|p| (part, times(scale, minus(*p, center)))).collect()
        };
        let free = std::array::from_fn(|k| match k {
            0 | 1 => shift,
            2 | 3 => tilt[k - 2],
            k => sources.get(k - 4).is_some_and(|s| form == Form::Planes || s.kind != Kind::Line),
        });
        let points = sources.iter().enumerate().flat_map(seen).collect();
        Joint { form, sources, points, center, scale, free }
    }

    /// The elements of all features about this axis or normal, through `at`, each of its mean size.
    pub(super) fn about(&self, at: Point, z: Vector, toward: Vector) -> Stand {
        let pose = Pose::toward(times(self.scale, minus(at, self.center)), z, toward);
        let mut stand = Stand { pose, sizes: [0.0; MAX_COMMON_FEATURES] };
        for (part, size) in stand.sizes.iter_mut().enumerate().take(self.sources.len()) {
            if self.free[4 + part] {
                let own = self.points.iter().filter(|(p, _)| *p == part);
                let (sum, count) =
                    own.fold((0.0, 0.0), |(sum, n), (_, q)| (sum + self.reading(&pose, *q), n + 1.0));
                *size = sum / f64::max(count, 1.0);
            }
        }
        stand
    }

    /// The quantity whose mean a size is: distance from the axis, or height.
    fn reading(&self, pose: &Pose, q: Point) -> f64 {
        let [x, y, z] = pose.local(q);
        if self.form == Form::Axis { libm::hypot(x, y) } else { z }
    }

    /// The stand in the coordinates of the points.
    pub(super) fn placed(&self, stand: &Stand) -> Stand {
        let origin = plus(self.center, times(1.0 / self.scale, stand.pose.origin));
        let pose = Pose { origin, axes: stand.pose.axes };
        Stand { pose, sizes: stand.sizes.map(|s| s / self.scale) }
    }

    /// Distance of a point from its feature's element, and its derivatives by the unknowns.
    fn distance(&self, stand: &Stand, (part, q): (usize, Point)) -> (f64, [f64; JOINT_UNKNOWNS]) {
        let [x, y, z] = stand.pose.local(q);
        let mut slope = [0.0; JOINT_UNKNOWNS];
        let (value, sized) = match self.form {
            Form::Axis => {
                let r = libm::hypot(x, y);
                let [a, b] = if r > 0.0 { [x / r, y / r] } else { [0.0; 2] };
                slope[..4].copy_from_slice(&[-a, -b, -a * z, -b * z]);
                (r, stand.sizes[part])
            }
            Form::Planes => {
                slope[2..4].copy_from_slice(&[x, y]);
                (z, stand.sizes[part])
            }
        };
        slope[4 + part] = -1.0;
        (value - sized, self.freed(slope))
    }

    /// The residuals of a point for least squares: of a line in space there are two.
    fn rows(&self, stand: &Stand, at: (usize, Point), mut visit: impl FnMut(f64, [f64; JOINT_UNKNOWNS])) {
        if self.form == Form::Axis && self.sources[at.0].kind == Kind::Line {
            let [x, y, z] = stand.pose.local(at.1);
            visit(x, self.freed([-1.0, 0.0, -z, 0.0, 0.0, 0.0, 0.0]));
            visit(y, self.freed([0.0, -1.0, 0.0, -z, 0.0, 0.0, 0.0]));
            return;
        }
        let (d, slope) = self.distance(stand, at);
        visit(d, slope);
    }

    fn freed(&self, mut x: [f64; JOINT_UNKNOWNS]) -> [f64; JOINT_UNKNOWNS] {
        x.iter_mut().zip(self.free).filter(|(_, free)| !free).for_each(|(x, _)| *x = 0.0);
        x
    }

    fn moved(&self, stand: &Stand, x: &[f64; JOINT_UNKNOWNS]) -> Stand {
        let pose = stand.pose.moved([x[0], x[1], 0.0], [x[2], x[3]], 0.0);
        Stand { pose, sizes: std::array::from_fn(|k| stand.sizes[k] + x[4 + k]) }
    }

    /// Sum of squares, at unit size.
    pub(super) fn square(&self, stand: &Stand) -> f64 {
        let mut sum = 0.0;
        self.points.iter().for_each(|at| self.rows(stand, *at, |d, _| sum += d * d));
        sum
    }

    /// The least-squares elements near `start`: every point counts alike. `None` where the points determine none.
    pub(super) fn least_squares(&self, start: &Stand) -> Option<Stand> {
        let (mut stand, mut square) = (*start, self.square(start));
        let (mut damping, mut last) = (0.0f64, f64::INFINITY);
        for _ in 0..200 {
            let Some(step) = self.step(&stand, damping) else {
                if damping > 1e6 {
                    return None;
                }
                damping = (8.0 * damping).max(1e-3);
                continue;
            };
            let length = step.iter().fold(0.0f64, |m, x| m.max(x.abs()));
            let next = self.moved(&stand, &step);
            let sum = self.square(&next);
            let unseen = damping == 0.0 && length < HIDDEN_SQUARES_STEP;
            if sum < square || unseen {
                (stand, square) = (next, sum);
                damping = if damping < 1e-6 { 0.0 } else { damping / 8.0 };
                if length <= HIDDEN_FALL || (unseen && length > 0.5 * last) {
                    break;
                }
                last = length;
            } else if length < HIDDEN_SQUARES_STEP || damping > 1e12 {
                break;
            } else {
                damping = (8.0 * damping).max(1e-3);
            }
        }
        square.is_finite().then_some(stand)
    }

    /// Marquardt's step; `None` where the points leave an unknown without influence.
    fn step(&self, stand: &Stand, damping: f64) -> Option<[f64; JOINT_UNKNOWNS]> {
        let mut normal = vec![vec![0.0; JOINT_UNKNOWNS]; JOINT_UNKNOWNS];
        let mut right = vec![0.0; JOINT_UNKNOWNS];
        for at in &self.points {
            self.rows(stand, *at, |d, g| {
                for ((row, sum), slope) in normal.iter_mut().zip(&mut right).zip(g) {
                    *sum -= slope * d;
                    row.iter_mut().zip(g).for_each(|(x, other)| *x += slope * other);
                }
            });
        }
        for (k, free) in self.free.into_iter().enumerate() {
            match free {
                true => normal[k][k] *= 1.0 + damping,
                false => normal[k][k] = 1.0,
            }
        }
        let x = solve(normal, right)?;
        let step: [f64; JOINT_UNKNOWNS] = std::array::from_fn(|k| x[k]);
        // Longer than the parts together: the normal matrix has lost its digits.
        step.iter().all(|x| x.abs() < 10.0).then_some(step)
    }

    /// The elements near `start` whose greatest distance from a point is the least.
    pub(super) fn least_greatest(&self, start: &Stand, progress: &dyn Progress) -> Result<Stand, ZoneError> {
        let stride = if self.points.len() <= MAX_POINTS_ALL_WORKING {
            1
        } else {
            self.points.len().div_ceil(MAX_POINTS_ALL_WORKING / 4)
        };
        let mut working: Vec<usize> = (0..self.points.len()).step_by(stride).collect();
        let mut stand = *start;
        for _ in 0..60 {
            if progress.cancelled() {
                return Err(ZoneError::Cancelled);
            }
            let half;
            (stand, half) = self.lowered(&working, stand).ok_or(ZoneError::NotSettled)?;
            let far = |i: usize| self.distance(&stand, self.points[i]).0.abs();
            let mut out: Vec<(f64, usize)> = (0..self.points.len())
                .map(|i| (far(i), i))
                .filter(|(d, _)| *d > half + HIDDEN_FALL)
                .collect();
            out.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            out.truncate(MAX_JOINING_POINTS);
            out.retain(|(_, i)| !working.contains(i));
            if out.is_empty() {
                return Ok(stand);
            }
            working.extend(out.into_iter().map(|(_, i)| i));
        }
        Err(ZoneError::NotSettled)
    }

    fn greatest(&self, working: &[usize], stand: &Stand) -> f64 {
        working.iter().fold(0.0, |m, &i| m.max(self.distance(stand, self.points[i]).0.abs()))
    }

    /// The working set's optimum near `stand`, and its greatest distance.
    fn lowered(&self, working: &[usize], mut stand: Stand) -> Option<(Stand, f64)> {
        let mut half = self.greatest(working, &stand);
        let mut reach = 4.0 * half.max(1e-12);
        for _ in 0..250 {
            let mut functions = Vec::with_capacity(2 * working.len());
            for &i in working {
                let (level, slope) = self.distance(&stand, self.points[i]);
                functions.push(Function { level, slope });
                functions.push(Function { level: -level, slope: slope.map(|x| -x) });
            }
            let program = lowest(&functions, reach)?;
            let fall = half - program.value;
            if fall <= HIDDEN_FALL || reach < 1e-15 {
                break;
            }
            // No function tells the program where held unknowns are: it leaves them at a side of the box.
            let step = self.freed(program.x);
            let next = self.moved(&stand, &step);
            let value = self.greatest(working, &next);
            let gain = (half - value) / fall;
            if gain > 0.75 {
                reach *= 4.0;
            } else if gain < 0.25 {
                let length = step.iter().fold(0.0f64, |m, x| m.max(x.abs()));
                reach = 0.25 * reach.min(length);
            }
            if value < half {
                (stand, half) = (next, value);
            }
        }
        Some((stand, half))
    }
}
