//! An element made ready for being asked about many places.

use crate::shape::Shape;
use crate::space::{Point, Vector, cross, dot, minus, norm, times};

/// An element, with what all places have in common worked out for the usual ones.
#[derive(Clone, Copy, Debug)]
pub(super) enum Probe {
    Plane { point: Point, normal: Vector },
    Sphere { center: Point, radius: f64 },
    Cylinder { point: Point, axis: Vector, radius: f64 },
    Cone { apex: Point, point: Point, axis: Vector, radius: f64, sin: f64, cos: f64 },
    Torus { center: Point, axis: Vector, major: f64, minor: f64 },
    Other(Shape),
}

impl Probe {
    pub(super) fn new(shape: &Shape) -> Probe {
        match *shape {
            Shape::Plane { point, normal } => Probe::Plane { point, normal },
            Shape::Sphere { center, radius } => Probe::Sphere { center, radius },
            Shape::Cylinder { point, direction, radius } => {
                Probe::Cylinder { point, axis: direction, radius }
            }
            Shape::Cone { apex, direction, half_angle, point, radius } => {
                let (sin, cos) = libm::sincos(half_angle);
                Probe::Cone { apex, point, axis: direction, radius, sin, cos }
            }
            Shape::Torus { center, direction, major_radius, minor_radius } => {
                Probe::Torus { center, axis: direction, major: major_radius, minor: minor_radius }
            }
            other @ (Shape::Line2 { .. }
            | Shape::Line { .. }
            | Shape::Circle2 { .. }
            | Shape::Circle { .. }
            | Shape::Ellipse2 { .. }) => Probe::Other(other),
        }
    }
    /// Signed distance of `p`, as [`Shape::distance`].
    #[inline]
    pub(super) fn distance(&self, p: Point) -> f64 {
        // The vector product keeps the digits of small distances from an axis.
        let off = |point: Point, axis: Vector| {
            let q = minus(p, point);
            (norm(cross(q, axis)), dot(q, axis))
        };
        match *self {
            Probe::Plane { point, normal } => dot(minus(p, point), normal),
            Probe::Sphere { center, radius } => norm(minus(p, center)) - radius,
            Probe::Cylinder { point, axis, radius } => off(point, axis).0 - radius,
            Probe::Cone { apex, point, axis, radius, sin, cos } => {
                let (rho, z) = off(point, axis);
                if (rho * sin + z * cos) * sin + radius * cos * cos < 0.0 {
                    return norm(minus(p, apex));
                }
                (rho - radius) * cos - z * sin
            }
            Probe::Torus { center, axis, major, minor } => {
                let (rho, z) = off(center, axis);
                let e = rho - major;
                (e * e + z * z).sqrt() - minor
            }
            Probe::Other(shape) => shape.distance(p),
        }
    }
    /// A normal of the element at the place of it nearest to `p`, not of unit length; zero where there are many.
    #[inline]
    pub(super) fn normal(&self, p: Point) -> Vector {
        let across = |point: Point, axis: Vector| {
            let q = minus(p, point);
            minus(q, times(dot(q, axis), axis))
        };
        match *self {
            Probe::Plane { normal, .. } => normal,
            Probe::Sphere { center, .. } => minus(p, center),
            Probe::Cylinder { point, axis, .. } => across(point, axis),
            Probe::Cone { apex, point, axis, radius, sin, cos } => {
                let out = across(point, axis);
                if (norm(out) * sin + dot(minus(p, point), axis) * cos) * sin + radius * cos * cos < 0.0 {
                    return minus(p, apex);
                }
                minus(times(cos, out), times(sin * norm(out), axis))
            }
            Probe::Torus { center, axis, major, .. } => {
                let out = across(center, axis);
                let length = norm(out);
                if length == 0.0 { [0.0; 3] } else { minus(minus(p, center), times(major / length, out)) }
            }
            Probe::Other(shape) => shape.normal(p),
        }
    }
    /// The cosine of the angle between the unit vector `n` and the normal next to `p`, to whichever side; 0 where the
    /// normal is none.
    #[inline]
    pub(super) fn cosine(&self, p: Point, n: Vector) -> f64 {
        let normal = self.normal(p);
        let length = norm(normal);
        if length > 0.0 { (dot(n, normal) / length).abs() } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::one_of_each;
    use super::*;
    use crate::space::unit;

    /// The distance is that of the shape, the normal its gradient.
    #[test]
    fn distances_and_normals_are_those_of_the_shape() {
        for shape in one_of_each([1.0, 2.0, 3.0], [0.6, 0.0, 0.8], 0.4) {
            let probe = Probe::new(&shape);
            for p in [[4.0, -2.0, 1.0], [-3.0, 7.0, 5.0], [1.5, 8.0, 2.0]] {
                let gradient: Vector = std::array::from_fn(|k| {
                    let at = |h: f64| {
                        let mut q = p;
                        q[k] += h;
                        shape.distance(q)
                    };
                    (at(1e-5) - at(-1e-5)) / 2e-5
                });
                assert!((probe.distance(p) - shape.distance(p)).abs() < 1e-14, "{shape:?}");
                let found = unit(probe.normal(p)).unwrap().0;
                for k in 0..3 {
                    assert!((found[k] - gradient[k]).abs() < 1e-8, "{shape:?} {found:?} {gradient:?}");
                }
            }
        }
    }
}
