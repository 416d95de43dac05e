//! Small motions as twists of the frame of the reference, whatever center an equation has, and motions that may not happen.

use super::sample::{Measured, Samples};
use super::system::Six;
use crate::rigid::Rigid;
use crate::space::{Point, Vector, cross, minus, norm, plus, times, unit};

/// A small motion: a rotation vector, and what it moves the origin of the reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Twist {
    pub turn: Vector,
    pub at_origin: Vector,
}

impl Twist {
    /// The twist for a direction of unknowns about `center`, rotations counted at `radius`.
    pub fn of(six: &Six, center: Point, radius: f64) -> Twist {
        let turn: Vector = std::array::from_fn(|k| six[k] / radius);
        let shift: Vector = std::array::from_fn(|k| six[k + 3]);
        Twist { turn, at_origin: minus(shift, cross(turn, center)) }
    }

    /// A slide.
    pub fn slide(direction: Vector) -> Twist {
        Twist { turn: [0.0; 3], at_origin: direction }
    }

    /// A turn about an axis.
    pub fn about(point: Point, direction: Vector) -> Twist {
        Twist { turn: direction, at_origin: cross(point, direction) }
    }

    /// The direction of unknowns about `center`, of length 1.
    pub fn six(&self, center: Point, radius: f64) -> Six {
        let (turn, shift) = (times(radius, self.turn), plus(self.at_origin, cross(self.turn, center)));
        let size = (0..3).map(|k| turn[k] * turn[k] + shift[k] * shift[k]).sum::<f64>().sqrt();
        std::array::from_fn(|k| if k < 3 { turn[k] } else { shift[k - 3] } / size)
    }
}

/// Part of a direction that the directions before it must not hold, for it to be a new one.
const MIN_NEW_DIRECTION: f64 = 1e-6;

/// Orthonormal directions of unknowns about `center` that span the twists (Gram and Schmidt).
pub(super) fn directions(twists: &[Twist], center: Point, radius: f64) -> Vec<Six> {
    let mut all: Vec<Six> = vec![];
    for twist in twists {
        let mut six = twist.six(center, radius);
        for _ in 0..2 {
            for other in &all {
                let along = inner(&six, other);
                (0..6).for_each(|k| six[k] -= along * other[k]);
            }
        }
        let size = inner(&six, &six).sqrt();
        if size > MIN_NEW_DIRECTION {
            all.push(six.map(|x| x / size));
        }
    }
    all
}

/// The product of two directions.
pub(super) fn inner(a: &Six, b: &Six) -> f64 {
    (0..6).map(|k| a[k] * b[k]).sum()
}

/// Components of a motion that stay zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lock {
    /// Which: the translation of `center` along x, y, z of the reference, then the rotation vector's x, y, z.
    pub axes: [bool; 6],
    /// A point on the axis of the motion, in the frame of the reference, millimeters.
    pub center: Point,
    /// The pose that the motion begins at.
    pub start: Rigid,
}

impl Lock {
    /// The lock of a fit from `start`, about the mean of the measured.
    pub fn new(axes: [bool; 6], measured: &Measured, start: Rigid) -> Lock {
        let center = start.point(Samples::all(measured).moments().mean);
        Lock { axes, center, start }
    }

    /// The motion `pose` from the start: rotation vector, translation of the center.
    pub fn components(&self, pose: &Rigid) -> [Vector; 2] {
        let motion = pose.after(&self.start.inverse());
        [rotation_vector(&motion), minus(motion.point(self.center), self.center)]
    }

    /// The pose without the components that stay zero.
    pub(super) fn applied(&self, pose: &Rigid) -> Rigid {
        let [mut turn, mut shift] = self.components(pose);
        for k in 0..3 {
            shift[k] = if self.axes[k] { 0.0 } else { shift[k] };
            turn[k] = if self.axes[k + 3] { 0.0 } else { turn[k] };
        }
        let turned = Rigid::rotation_about(self.center, turn);
        Rigid::translation_by(shift).after(&turned).after(&self.start)
    }

    /// The motions that are locked at `pose`.
    pub(super) fn twists(&self, pose: &Rigid) -> Vec<Twist> {
        let center = pose.after(&self.start.inverse()).point(self.center);
        let axis = |k: usize| -> Vector { std::array::from_fn(|i| f64::from(u8::from(i == k))) };
        let slides = (0..3).filter(|&k| self.axes[k]).map(|k| Twist::slide(axis(k)));
        let turns = (0..3).filter(|&k| self.axes[k + 3]).map(|k| Twist::about(center, axis(k)));
        slides.chain(turns).collect()
    }
}

/// The rotation vector of a motion, of angle up to half a turn.
pub(super) fn rotation_vector(motion: &Rigid) -> Vector {
    let r = motion.rotation();
    let skew = [r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]];
    let angle = motion.angle();
    match unit(skew) {
        Some((axis, size)) if size > 1e-6 || angle < 1.0 => times(angle, axis),
        // Half a turn, but for rounding: the axis is the longest column of R + 1.
        _ if angle > 1.0 => {
            let column =
                |k: usize| -> Vector { std::array::from_fn(|i| r[i][k] + if i == k { 1.0 } else { 0.0 }) };
            let longest = (0..3).map(column).max_by(|a, b| norm(*a).total_cmp(&norm(*b)));
            longest.and_then(unit).map_or([0.0; 3], |u| times(angle, u.0))
        }
        _ => [0.0; 3],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotation_vectors_are_those_of_the_motion() {
        let mut turns: Vec<Vector> = vec![[0.0; 3], [1e-9, -2e-9, 0.0], [0.3, -0.2, 1.0], [2.0, 1.5, -1.7]];
        turns.push([std::f64::consts::PI, 0.0, 0.0]);
        for turn in turns {
            let found = rotation_vector(&Rigid::rotation_about([3.0, 2.0, 1.0], turn));
            let back = Rigid::rotation_about([0.0; 3], found).inverse();
            let left = back.after(&Rigid::rotation_about([0.0; 3], turn));
            assert!(left.displacement([1.0, 2.0, 3.0]) < 1e-12, "{turn:?} {found:?}");
        }
    }

    #[test]
    fn a_twist_is_the_same_about_every_center() {
        let twist = Twist::about([4.0, -2.0, 7.0], [0.0, 0.6, 0.8]);
        for center in [[0.0; 3], [5.0, 6.0, -3.0]] {
            let six = twist.six(center, 9.0);
            let again = Twist::of(&six, center, 9.0).six([1.0, 2.0, 3.0], 4.0);
            let known = twist.six([1.0, 2.0, 3.0], 4.0);
            assert!((0..6).all(|k| (again[k] - known[k]).abs() < 1e-12), "{again:?} {known:?}");
        }
    }
}
