//! Axes of curves and surfaces, and the placements of parts.
//!
//! A mirrored part has left-handed frames: places follow `origin + a·x + b·y + c·z` all the same, and only the normal
//! `∂u × ∂v` changes its side. [`Brep::add`](crate::brep::Brep::add) turns the faces that this touches.

use trueness_geom::space::{Point, Vector, cross, dot, least_axis, minus, plus, times, unit};

/// Orthonormal axes at an origin; right-handed, or left-handed within a mirrored part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Where the axes meet, millimeters.
    pub origin: Point,
    /// Unit vectors x, y, z.
    pub axes: [Vector; 3],
}

impl Frame {
    /// The right-handed frame with `z` along its third axis and its first axis as near to `x` as it can be.
    /// Without `x`, or where it is along `z`, a direction at right angles is chosen. `None` where `z` has no direction.
    ///
    /// ```
    /// use trueness_cad::frame::Frame;
    /// let frame = Frame::new([0.0; 3], [0.0, 0.0, 2.0], Some([1.0, 0.0, 1.0])).unwrap();
    /// assert_eq!(frame.axes, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    /// assert!(Frame::new([0.0; 3], [0.0; 3], None).is_none());
    /// ```
    pub fn new(origin: Point, z: Vector, x: Option<Vector>) -> Option<Frame> {
        let (z, _) = unit(z)?;
        let flat = |v: Vector| unit(minus(v, times(dot(v, z), z))).map(|(v, _)| v);
        let x = x.and_then(unit).and_then(|(x, _)| flat(x)).or_else(|| flat(least_axis(z)))?;
        Some(Frame { origin, axes: [x, cross(z, x), z] })
    }

    /// Coordinates of a place along the axes.
    pub fn local(&self, p: Point) -> Point {
        let q = minus(p, self.origin);
        self.axes.map(|a| dot(a, q))
    }

    /// The place with these coordinates.
    pub fn place(&self, local: Point) -> Point {
        plus(self.origin, self.vector(local))
    }

    /// The vector with these components.
    pub fn vector(&self, [a, b, c]: Vector) -> Vector {
        let [x, y, z] = self.axes;
        std::array::from_fn(|k| a * x[k] + b * y[k] + c * z[k])
    }

    /// Whether the axes are left-handed.
    pub fn is_mirrored(&self) -> bool {
        let [x, y, z] = self.axes;
        dot(cross(x, y), z) < 0.0
    }
}

/// Where a part stands: turned or mirrored, scaled alike in all directions, then shifted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Rows of an orthogonal matrix; its determinant is −1 for a mirrored part.
    pub rows: [Vector; 3],
    /// Above 0; 1 for a part of the size that it has.
    pub scale: f64,
    /// Millimeters.
    pub shift: Vector,
}

impl Placement {
    /// Where it was.
    pub const IDENTITY: Placement =
        Placement { rows: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], scale: 1.0, shift: [0.0; 3] };

    /// The placement that brings `from` onto `to`; both may be mirrored.
    pub fn between(from: &Frame, to: &Frame) -> Placement {
        let rows = std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..3).map(|k| to.axes[k][i] * from.axes[k][j]).sum())
        });
        let turned = Placement { rows, scale: 1.0, shift: [0.0; 3] };
        Placement { shift: minus(to.origin, turned.vector(from.origin)), ..turned }
    }

    /// A direction after it, of the length that it had.
    pub fn direction(&self, v: Vector) -> Vector {
        self.rows.map(|row| dot(row, v))
    }

    /// A vector after it, scaled.
    pub fn vector(&self, v: Vector) -> Vector {
        times(self.scale, self.direction(v))
    }

    /// A place after it.
    pub fn point(&self, p: Point) -> Point {
        plus(self.vector(p), self.shift)
    }

    /// A frame after it.
    pub fn frame(&self, frame: &Frame) -> Frame {
        Frame { origin: self.point(frame.origin), axes: frame.axes.map(|a| self.direction(a)) }
    }

    /// First `inner`, then `self`.
    pub fn after(&self, inner: &Placement) -> Placement {
        let rows = std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..3).map(|k| self.rows[i][k] * inner.rows[k][j]).sum())
        });
        Placement { rows, scale: self.scale * inner.scale, shift: self.point(inner.shift) }
    }

    /// Whether it mirrors.
    pub fn is_mirrored(&self) -> bool {
        let [x, y, z] = self.rows;
        dot(cross(x, y), z) < 0.0
    }

    /// Rows of the 3 × 4 matrix: turned and scaled, then shifted.
    pub fn matrix(&self) -> [[f64; 4]; 3] {
        std::array::from_fn(|i| {
            let [a, b, c] = times(self.scale, self.rows[i]);
            [a, b, c, self.shift[i]]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_geom::space::norm;

    #[test]
    fn placements_follow_one_another_and_bring_frames_onto_frames() {
        let a = Frame::new([1.0, 2.0, 3.0], [1.0, 1.0, 0.3], Some([0.0, 0.0, 1.0])).unwrap();
        let mut b = Frame::new([-4.0, 0.5, 9.0], [0.2, -1.0, 0.7], None).unwrap();
        b.axes[1] = times(-1.0, b.axes[1]);
        let there = Placement { scale: 1.0, ..Placement::between(&a, &b) };
        assert!(there.is_mirrored() && b.is_mirrored() && !a.is_mirrored());
        let p = [0.3, -7.0, 2.0];
        assert!(norm(minus(there.point(a.place(p)), b.place(p))) < 1e-14);
        let twice = Placement { rows: a.axes, scale: 2.5, shift: [1.0, 1.0, 2.0] };
        let both = twice.after(&there);
        assert!(norm(minus(both.point(p), twice.point(there.point(p)))) < 1e-13);
        assert!((both.scale - 2.5).abs() < 1e-15 && both.is_mirrored());
    }
}
