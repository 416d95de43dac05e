//! A right-handed frame, and small motions of it.
//!
//! A fit writes every element in a frame of its own: the axis (or normal) is the third axis, the center the origin. A step
//! shifts and tilts that frame by small amounts about where it is now. So no direction is singular, whatever way the element
//! lies.

use crate::space::{Point, Vector, cross, dot, least_axis, minus, plus, times, unit};

/// A right-handed orthonormal frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pose {
    /// Where the frame sits.
    pub origin: Point,
    /// Its axes u, v, w as rows.
    pub axes: [Vector; 3],
}

impl Pose {
    /// A frame at `origin` whose third axis is along `w`; the other two are chosen away from `w`.
    /// Falls back to the world's axes where `w` has no direction.
    pub(crate) fn along(origin: Point, w: Vector) -> Pose {
        let w = unit(w).map_or([0.0, 0.0, 1.0], |(w, _)| w);
        Pose::toward(origin, w, least_axis(w))
    }
    /// As [`Pose::along`], with the first axis as near to `u` as it can be.
    pub(crate) fn toward(origin: Point, w: Vector, u: Vector) -> Pose {
        let flat = minus(u, times(dot(u, w), w));
        let Some((u, _)) = unit(flat) else { return Pose::along(origin, w) };
        Pose { origin, axes: [u, cross(w, u), w] }
    }
    /// The frame of the plane z = 0, for elements in two dimensions.
    pub(crate) fn flat(origin: Point, u: Vector) -> Pose {
        Pose::toward(origin, [0.0, 0.0, 1.0], u)
    }
    /// Coordinates of `p` in this frame.
    pub(crate) fn local(&self, p: Point) -> Point {
        let q = minus(p, self.origin);
        self.axes.map(|a| dot(a, q))
    }
    /// The frame after the small motions `shift` (along its axes), `tilt` and `turn`.
    pub(crate) fn moved(&self, shift: Vector, tilt: [f64; 2], turn: f64) -> Pose {
        let Pose { origin, axes: [u, _, w] } = self.nudged(shift, tilt, turn);
        let w = unit(w).map_or(self.axes[2], |(w, _)| w);
        Pose::toward(origin, w, u)
    }
    /// As [`Pose::moved`] to first order: the axes are left a little too long.
    pub(crate) fn nudged(&self, shift: Vector, tilt: [f64; 2], turn: f64) -> Pose {
        let [u, v, w] = self.axes;
        let along = |[a, b, c]: Vector| plus(plus(times(a, u), times(b, v)), times(c, w));
        let [a, b] = tilt;
        Pose {
            origin: plus(self.origin, along(shift)),
            axes: [along([1.0, turn, -a]), along([-turn, 1.0, -b]), along([a, b, 1.0])],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::norm;

    #[test]
    fn frames_stay_orthonormal_and_right_handed() {
        let mut pose = Pose::along([1.0, 2.0, 3.0], [0.0, 0.0, 1.0]);
        for k in 0..200 {
            let x = f64::from(k);
            pose = pose.moved([0.1, -0.2, 0.3], [x.sin() * 0.2, x.cos() * 0.2], 0.3 * (2.0 * x).sin());
            for i in 0..3 {
                for j in 0..3 {
                    assert!((dot(pose.axes[i], pose.axes[j]) - f64::from(i == j)).abs() < 1e-15);
                }
            }
            assert!(norm(minus(cross(pose.axes[0], pose.axes[1]), pose.axes[2])) < 1e-15);
        }
    }

    #[test]
    fn a_tilt_leans_the_axis_as_named() {
        let pose = Pose::along([0.0; 3], [1.0, 1.0, 1.0]);
        let leaned = pose.moved([0.0; 3], [1e-3, 0.0], 0.0);
        assert!((dot(leaned.axes[2], pose.axes[0]) - 1e-3).abs() < 1e-8);
        assert!(dot(leaned.axes[2], pose.axes[1]).abs() < 1e-15);
    }
}
