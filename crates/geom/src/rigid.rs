//! Rigid motions of space: a rotation and a translation.
//!
//! A motion is named target first. `reference_from_measured` takes coordinates of the measured frame to those of the reference
//! frame. In `a_from_c = a_from_b.after(&b_from_c)` the frames that meet have the same name.

use crate::space::{MIN_COORDINATE, Point, Vector, cross, dot, minus, norm, plus, times, unit};

/// A rotation followed by a translation: `x` goes to `R x + t`. Millimeters.
///
/// The rotation is orthonormal and right-handed to a few units in the last place: every constructor sees to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigid {
    rows: [Vector; 3],
    translation: Vector,
}

/// Why numbers are no rigid motion.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum RigidError {
    /// A number is NaN or infinite.
    #[error("the number in row {row}, column {column} is not finite")]
    NotFinite {
        /// Row from 0.
        row: usize,
        /// Column from 0.
        column: usize,
    },
    /// The last row of a 4×4 matrix is not 0 0 0 1.
    #[error(
        "the last row is not 0 0 0 1; give the matrix row by row, with the translation in the last column"
    )]
    LastRow,
    /// The matrix scales all directions alike.
    #[error("it scales lengths by {factor}; a rigid motion leaves them as they are")]
    Scale {
        /// The factor.
        factor: f64,
    },
    /// The matrix mirrors.
    #[error("it mirrors the part: its determinant is negative")]
    Mirror,
    /// The first three columns are not at right angles to each other and of length 1.
    #[error("its rotation is off by {off} from one; give the numbers with more digits")]
    NotRotation {
        /// Largest entry of `Rᵀ R − 1`.
        off: f64,
    },
}

/// Largest entry of `Rᵀ R − 1` at which a matrix still counts as a rotation whose numbers were rounded to six digits.
const MAX_ROTATION_ROUNDING: f64 = 1e-5;

impl Rigid {
    /// The motion that moves nothing.
    pub const IDENTITY: Rigid =
        Rigid { rows: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], translation: [0.0; 3] };

    /// The motion with this rotation, given by its rows, and this translation.
    ///
    /// Numbers that were rounded to six digits are accepted; the rotation nearest to them is taken.
    ///
    /// # Errors
    /// [`RigidError`], except for `LastRow`.
    ///
    /// ```
    /// use trueness_geom::rigid::Rigid;
    /// let turn = Rigid::new([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]], [10.0, 0.0, 0.0])?;
    /// assert_eq!(turn.point([1.0, 0.0, 0.0]), [10.0, 1.0, 0.0]);
    /// # Ok::<(), trueness_geom::rigid::RigidError>(())
    /// ```
    pub fn new(rotation: [Vector; 3], translation: Vector) -> Result<Rigid, RigidError> {
        for (row, (r, t)) in rotation.iter().zip(translation).enumerate() {
            if let Some(column) = [r[0], r[1], r[2], t].iter().position(|x| !x.is_finite()) {
                return Err(RigidError::NotFinite { row, column });
            }
        }
        let columns = transposed(rotation);
        let lengths = columns.map(norm);
        let factor = lengths.iter().sum::<f64>() / 3.0;
        let uneven =
            |k: usize| (dot(columns[k], columns[(k + 1) % 3]).abs()).max((lengths[k] - factor).abs());
        let skew = (0..3).map(uneven).fold(0.0, f64::max);
        if (factor - 1.0).abs() > MAX_ROTATION_ROUNDING
            && skew <= MAX_ROTATION_ROUNDING * factor.max(1.0) * factor
        {
            return Err(RigidError::Scale { factor });
        }
        let entry = |i: usize, j: usize| (dot(columns[i], columns[j]) - f64::from(u8::from(i == j))).abs();
        let off = (0..9).map(|k| entry(k / 3, k % 3)).fold(0.0, f64::max);
        if off > MAX_ROTATION_ROUNDING {
            return Err(RigidError::NotRotation { off });
        }
        if dot(columns[0], cross(columns[1], columns[2])) < 0.0 {
            return Err(RigidError::Mirror);
        }
        Ok(Rigid { rows: nearest_rotation(rotation), translation })
    }

    /// The motion that a 4×4 matrix in rows stands for, acting on columns `(x, y, z, 1)`.
    ///
    /// # Errors
    /// [`RigidError`]: see [`Rigid::new`].
    ///
    /// ```
    /// use trueness_geom::rigid::{Rigid, RigidError};
    /// let mut m = Rigid::IDENTITY.matrix();
    /// m[0][3] = 5.0;
    /// assert_eq!(Rigid::from_matrix(m)?.point([1.0, 2.0, 3.0]), [6.0, 2.0, 3.0]);
    /// m[3][0] = 5.0;
    /// assert_eq!(Rigid::from_matrix(m), Err(RigidError::LastRow));
    /// # Ok::<(), RigidError>(())
    /// ```
    pub fn from_matrix(m: [[f64; 4]; 4]) -> Result<Rigid, RigidError> {
        if m[3] != [0.0, 0.0, 0.0, 1.0] {
            return Err(RigidError::LastRow);
        }
        let row = |k: usize| [m[k][0], m[k][1], m[k][2]];
        Rigid::new([row(0), row(1), row(2)], [m[0][3], m[1][3], m[2][3]])
    }

    /// The 4×4 matrix, in rows.
    pub fn matrix(&self) -> [[f64; 4]; 4] {
        let row = |k: usize| {
            let [a, b, c] = self.rows[k];
            [a, b, c, self.translation[k]]
        };
        [row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]]
    }

    /// The translation by `v`.
    pub fn translation_by(v: Vector) -> Rigid {
        Rigid { translation: v, ..Rigid::IDENTITY }
    }

    /// The rotation by the vector `v`, whose length is the angle in radians, about an axis along `v` through `center`.
    /// The zero vector stands for no rotation.
    ///
    /// ```
    /// use trueness_geom::rigid::Rigid;
    /// let half = Rigid::rotation_about([1.0, 0.0, 0.0], [0.0, 0.0, std::f64::consts::PI]);
    /// let p = half.point([3.0, 0.0, 7.0]);
    /// assert!((p[0] + 1.0).abs() < 1e-15 && p[1].abs() < 1e-15 && p[2] == 7.0);
    /// ```
    pub fn rotation_about(center: Point, v: Vector) -> Rigid {
        let angle = norm(v);
        // Rodrigues: 1 + sin(a)/a [v] + (1 - cos a)/a² [v]²; the half angle keeps the digits of small ones.
        let (first, second) = if angle > 0.0 {
            let half = libm::sin(0.5 * angle) / angle;
            (libm::sin(angle) / angle, 2.0 * half * half)
        } else {
            (1.0, 0.5)
        };
        let column = |k: usize| {
            let e = axis(k);
            plus(plus(e, times(first, cross(v, e))), times(second, cross(v, cross(v, e))))
        };
        let rows = nearest_rotation(transposed([column(0), column(1), column(2)]));
        let turned = rows.map(|r| dot(r, center));
        Rigid { rows, translation: minus(center, turned) }
    }

    /// The motion that takes the frame with origin `origin` and right-handed axes to coordinates in that frame. The origin goes
    /// to zero, a point along the first axis to the x axis. `None` where `z` and `toward` do not span a plane. The third axis
    /// is along `z`, the first in the half plane of `toward`.
    pub fn into_frame(origin: Point, z: Vector, toward: Vector) -> Option<Rigid> {
        let (w, _) = unit(z)?;
        let (t, _) = unit(toward)?;
        let flat = minus(t, times(dot(t, w), w));
        let (u, length) = unit(flat)?;
        if length < 1e-12 {
            return None;
        }
        let rows = nearest_rotation([u, cross(w, u), w]);
        Some(Rigid { rows, translation: rows.map(|r| -dot(r, origin)) })
    }

    /// The motion with these rows, which are a rotation but for roundings, that takes `from` to `to`.
    #[inline(always)]
    pub(crate) fn of_rotation(rows: [Vector; 3], from: Point, to: Point) -> Rigid {
        Rigid { rows, translation: minus(to, rows.map(|r| dot(r, from))) }
    }

    /// The rows of the rotation.
    pub fn rotation(&self) -> [Vector; 3] {
        self.rows
    }
    /// The translation: where the origin goes.
    pub fn translation(&self) -> Vector {
        self.translation
    }

    /// Where the motion takes a place. Coordinates below [`MIN_COORDINATE`] are 0: they are what rounding left of it, and no search
    /// takes them.
    ///
    /// ```
    /// use trueness_geom::rigid::Rigid;
    /// let shift = Rigid::translation_by([1.0, 0.0, -1e-60]);
    /// assert_eq!(shift.point([2.0, 1e-50, 0.0]), [3.0, 1e-50, 0.0]);
    /// ```
    #[inline(always)]
    pub fn point(&self, p: Point) -> Point {
        let [x, y, z] = plus(self.vector(p), self.translation);
        let told = |x: f64| if x.abs() < MIN_COORDINATE { 0.0 } else { x };
        [told(x), told(y), told(z)]
    }
    /// The direction after the motion: only the rotation acts.
    #[inline(always)]
    pub fn vector(&self, v: Vector) -> Vector {
        [dot(self.rows[0], v), dot(self.rows[1], v), dot(self.rows[2], v)]
    }

    /// The motion back.
    pub fn inverse(&self) -> Rigid {
        let rows = transposed(self.rows);
        Rigid { rows, translation: rows.map(|r| -dot(r, self.translation)) }
    }

    /// First `first`, then this: `a_from_b.after(&b_from_c)` is `a_from_c`.
    ///
    /// ```
    /// use trueness_geom::rigid::Rigid;
    /// let turn = Rigid::rotation_about([0.0; 3], [0.1, 0.2, 0.3]);
    /// let back = turn.inverse().after(&turn);
    /// assert!(back.angle() < 1e-15);
    /// ```
    pub fn after(&self, first: &Rigid) -> Rigid {
        let columns = transposed(first.rows).map(|c| self.vector(c));
        Rigid { rows: nearest_rotation(transposed(columns)), translation: self.point(first.translation) }
    }

    /// Angle of the rotation, radians, 0 to π.
    pub fn angle(&self) -> f64 {
        let r = &self.rows;
        let sine = norm([r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]]);
        libm::atan2(sine, r[0][0] + r[1][1] + r[2][2] - 1.0)
    }

    /// Length of the way that the motion moves `p`.
    pub fn displacement(&self, p: Point) -> f64 {
        norm(minus(self.point(p), p))
    }
}

fn axis(k: usize) -> Vector {
    std::array::from_fn(|i| f64::from(u8::from(i == k)))
}

fn transposed(m: [Vector; 3]) -> [Vector; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}

/// The rotation nearest to a matrix that is one but for roundings. Newton's iteration of the polar decomposition finds it
/// (Higham, Computing the polar decomposition, SIAM J. Sci. Stat. Comput. 7, 1986), which converges quadratically.
fn nearest_rotation(mut m: [Vector; 3]) -> [Vector; 3] {
    for _ in 0..3 {
        // The rows of the inverse transposed are the cross products over the determinant, which is 1 nearly.
        let cofactors = [cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])];
        let inverse = 1.0 / dot(m[0], cofactors[0]);
        m = std::array::from_fn(|i| times(0.5, plus(m[i], times(inverse, cofactors[i]))));
    }
    m
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    fn random_motion(random: &mut Random) -> Rigid {
        let mut v = || std::array::from_fn(|_| random.unit() * 4.0 - 2.0);
        let (center, turn): (Vector, Vector) = (v(), v());
        Rigid::rotation_about(center, turn).after(&Rigid::translation_by(v()))
    }

    fn off(m: &Rigid) -> f64 {
        let r = m.rotation();
        let entry = |i: usize, j: usize| (dot(r[i], r[j]) - f64::from(u8::from(i == j))).abs();
        (0..9).map(|k| entry(k / 3, k % 3)).fold(0.0, f64::max)
    }

    #[test]
    fn inverses_products_and_matrices_agree() {
        let random = &mut Random::new(5);
        let mut long = Rigid::IDENTITY;
        for _ in 0..200 {
            let (a, b) = (random_motion(random), random_motion(random));
            let p: Point = std::array::from_fn(|_| random.unit() * 100.0);
            let near = |x: Point, y: Point| norm(minus(x, y)) < 1e-12;
            assert!(near(a.after(&b).point(p), a.point(b.point(p))));
            assert!(near(a.inverse().point(a.point(p)), p));
            let m = a.matrix();
            let by_hand: Point =
                std::array::from_fn(|i| (0..3).map(|j| m[i][j] * p[j]).sum::<f64>() + m[i][3]);
            assert!(near(by_hand, a.point(p)));
            assert!(near(Rigid::from_matrix(m).unwrap().point(p), a.point(p)));
            long = a.after(&long);
            assert!(off(&long) < 2e-15, "{}", off(&long));
        }
    }

    #[test]
    fn angles_are_those_of_the_rotation_vector() {
        for angle in [1e-12, 1e-6, 0.3, 1.5, 3.0, 3.1] {
            let turn = Rigid::rotation_about([1.0, 2.0, 3.0], times(angle / 3.0, [1.0, -2.0, 2.0]));
            assert!((turn.angle() - angle).abs() <= 4e-16 * angle.max(1.0), "{angle}");
            // The axis through the center stays.
            assert!(turn.displacement([2.0, 0.0, 5.0]) < 2e-15);
        }
    }

    #[test]
    fn frames_put_the_origin_at_zero() {
        let frame = Rigid::into_frame([1.0, 2.0, 3.0], [0.0, 2.0, 0.0], [1.0, 5.0, 0.0]).unwrap();
        assert!(norm(frame.point([1.0, 2.0, 3.0])) < 1e-15);
        assert!(norm(minus(frame.vector([0.0, 1.0, 0.0]), [0.0, 0.0, 1.0])) < 1e-15);
        assert!(norm(minus(frame.vector([1.0, 0.0, 0.0]), [1.0, 0.0, 0.0])) < 1e-15);
        assert_eq!(Rigid::into_frame([0.0; 3], [0.0, 2.0, 0.0], [0.0, 5.0, 0.0]), None);
    }

    #[test]
    fn rounded_numbers_are_accepted_and_wrong_ones_named() {
        let exact = Rigid::rotation_about([0.0; 3], [0.4, -0.9, 0.2]);
        let rounded = exact.rotation().map(|r| r.map(|x| (x * 1e6).round() / 1e6));
        let taken = Rigid::new(rounded, [0.0; 3]).unwrap();
        assert!(off(&taken) < 2e-15);
        assert!(taken.after(&exact.inverse()).angle() < 2e-6);
        let with = |f: &dyn Fn(Vector) -> Vector| Rigid::new(exact.rotation().map(f), [0.0; 3]);
        assert!(
            matches!(with(&|r| times(25.4, r)), Err(RigidError::Scale { factor }) if (factor - 25.4).abs() < 1e-9)
        );
        assert_eq!(with(&|r| [-r[0], r[1], r[2]]), Err(RigidError::Mirror));
        assert!(matches!(with(&|r| [r[0] + 0.01, r[1], r[2]]), Err(RigidError::NotRotation { .. })));
        assert!(matches!(
            with(&|_| [0.0; 3]),
            Err(RigidError::Scale { .. } | RigidError::NotRotation { .. })
        ));
        let nan = Rigid::new([[1.0, 0.0, 0.0], [0.0, f64::NAN, 0.0], [0.0, 0.0, 1.0]], [0.0; 3]);
        assert_eq!(nan, Err(RigidError::NotFinite { row: 1, column: 1 }));
    }
}
