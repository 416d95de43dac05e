//! The elements as users know them.

use super::ellipse;
use super::kind::Kind;
use crate::frame::Pose;
use crate::space::{Point, Vector, cross, dot, least_axis, minus, norm, plus, times, unit};

/// A fitted element, millimeters and radians. Directions are unit vectors whose component of largest magnitude
/// is positive, except a cone's, which points from the apex into the cone.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)] // the fields are named as in every textbook
pub enum Shape {
    /// Line in the plane z = 0. `point` is the foot of the points' mean.
    Line2 { point: Point, direction: Vector },
    /// Line in space. `point` is the foot of the points' mean.
    Line { point: Point, direction: Vector },
    /// Plane. `point` is the foot of the points' mean.
    Plane { point: Point, normal: Vector },
    /// Circle in the plane z = 0.
    Circle2 { center: Point, radius: f64 },
    /// Circle in space.
    Circle { center: Point, normal: Vector, radius: f64 },
    /// Ellipse in the plane z = 0; `direction` is that of the longer half axis.
    Ellipse2 { center: Point, direction: Vector, major_radius: f64, minor_radius: f64 },
    /// Sphere.
    Sphere { center: Point, radius: f64 },
    /// Cylinder. `point` is the foot of the points' mean on the axis.
    Cylinder { point: Point, direction: Vector, radius: f64 },
    /// Cone. `radius` is that at `point`, the foot of the points' mean on the axis.
    Cone { apex: Point, direction: Vector, half_angle: f64, point: Point, radius: f64 },
    /// Torus.
    Torus { center: Point, direction: Vector, major_radius: f64, minor_radius: f64 },
}

/// One parameter of a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Parameter {
    /// Millimeters or radians.
    Number(f64),
    /// A place in millimeters or a unit direction.
    Vector([f64; 3]),
}

/// Numbers of the shape that has the most: a cone.
pub(crate) const MAX_SHAPE_NUMBERS: usize = 11;

impl Shape {
    /// Which element this is.
    pub fn kind(&self) -> Kind {
        match self {
            Shape::Line2 { .. } => Kind::Line2,
            Shape::Line { .. } => Kind::Line,
            Shape::Plane { .. } => Kind::Plane,
            Shape::Circle2 { .. } => Kind::Circle2,
            Shape::Circle { .. } => Kind::Circle,
            Shape::Ellipse2 { .. } => Kind::Ellipse2,
            Shape::Sphere { .. } => Kind::Sphere,
            Shape::Cylinder { .. } => Kind::Cylinder,
            Shape::Cone { .. } => Kind::Cone,
            Shape::Torus { .. } => Kind::Torus,
        }
    }
    /// Names and values of all parameters, in a fixed order.
    pub fn parameters(&self) -> Vec<(&'static str, Parameter)> {
        let mut all = Vec::with_capacity(5);
        self.each(|name, parameter| all.push((name, parameter)));
        all
    }
    /// Hands name and value of each parameter to `visit`, in their order.
    fn each(&self, mut visit: impl FnMut(&'static str, Parameter)) {
        let mut parameters = self.kind().parameters().iter();
        let mut next = |value| {
            if let Some((name, _)) = parameters.next() {
                visit(name, value);
            }
        };
        use Parameter::{Number, Vector};
        match *self {
            Shape::Line2 { point, direction } | Shape::Line { point, direction } => {
                next(Vector(point));
                next(Vector(direction));
            }
            Shape::Plane { point, normal } => {
                next(Vector(point));
                next(Vector(normal));
            }
            Shape::Circle2 { center, radius } | Shape::Sphere { center, radius } => {
                next(Vector(center));
                next(Number(radius));
            }
            Shape::Circle { center, normal, radius } => {
                next(Vector(center));
                next(Vector(normal));
                next(Number(radius));
            }
            Shape::Cylinder { point, direction, radius } => {
                next(Vector(point));
                next(Vector(direction));
                next(Number(radius));
            }
            Shape::Cone { apex, direction, half_angle, point, radius } => {
                next(Vector(apex));
                next(Vector(direction));
                next(Number(half_angle));
                next(Vector(point));
                next(Number(radius));
            }
            Shape::Ellipse2 { center, direction, major_radius, minor_radius }
            | Shape::Torus { center, direction, major_radius, minor_radius } => {
                next(Vector(center));
                next(Vector(direction));
                next(Number(major_radius));
                next(Number(minor_radius));
            }
        }
    }
    /// The parameters' numbers one after the other, and how many they are; zeros follow.
    pub(crate) fn flattened(&self) -> ([f64; MAX_SHAPE_NUMBERS], usize) {
        let (mut numbers, mut count) = ([0.0; MAX_SHAPE_NUMBERS], 0);
        let mut push = |x: f64| {
            numbers[count] = x;
            count += 1;
        };
        self.each(|_, parameter| match parameter {
            Parameter::Number(x) => push(x),
            Parameter::Vector(v) => v.into_iter().for_each(&mut push),
        });
        (numbers, count)
    }
    /// Distance of `p` from the element, positive on the outer side. That is away from the axis or center, along the normal of
    /// a plane, to the left of a line in the plane. For lines and circles in space it has no sign. Not a number where `p` is
    /// none.
    pub fn distance(&self, p: Point) -> f64 {
        match *self {
            Shape::Line2 { point, direction } => dot(minus(p, point), [-direction[1], direction[0], 0.0]),
            Shape::Line { point, direction } => off_axis(p, point, direction).0,
            Shape::Plane { point, normal } => dot(minus(p, point), normal),
            Shape::Circle2 { center, radius } => {
                let q = minus(p, center);
                norm([q[0], q[1], 0.0]) - radius
            }
            Shape::Circle { center, normal, radius } => {
                let (rho, z) = off_axis(p, center, normal);
                libm::hypot(rho - radius, z)
            }
            Shape::Ellipse2 { center, direction, major_radius, minor_radius } => {
                let q = Pose::flat(center, direction).local(p);
                ellipse::distance([major_radius, minor_radius], q)
            }
            Shape::Sphere { center, radius } => norm(minus(p, center)) - radius,
            Shape::Cylinder { point, direction, radius } => off_axis(p, point, direction).0 - radius,
            Shape::Cone { apex, point, direction, half_angle, radius } => {
                let (rho, z) = off_axis(p, point, direction);
                if is_beyond_apex(half_angle, radius, rho, z) {
                    return norm(minus(p, apex));
                }
                (rho - radius) * libm::cos(half_angle) - z * libm::sin(half_angle)
            }
            Shape::Torus { center, direction, major_radius, minor_radius } => {
                let (rho, z) = off_axis(p, center, direction);
                libm::hypot(rho - major_radius, z) - minor_radius
            }
        }
    }
    /// A normal of the element at the place of it nearest to `p`, not of unit length. It points to the side where distances are
    /// positive: the direction in which the distance grows. Zero where there are many.
    pub fn normal(&self, p: Point) -> Vector {
        match *self {
            Shape::Line2 { direction, .. } => [-direction[1], direction[0], 0.0],
            Shape::Line { point, direction } | Shape::Cylinder { point, direction, .. } => {
                across(p, point, direction)
            }
            Shape::Plane { normal, .. } => normal,
            Shape::Circle2 { center, .. } => {
                let q = minus(p, center);
                [q[0], q[1], 0.0]
            }
            Shape::Circle { center, normal: direction, radius: ring, .. }
            | Shape::Torus { center, direction, major_radius: ring, .. } => {
                let out = across(p, center, direction);
                let length = norm(out);
                if length == 0.0 { [0.0; 3] } else { minus(minus(p, center), times(ring / length, out)) }
            }
            Shape::Ellipse2 { center, direction, major_radius, minor_radius } => {
                let q = Pose::flat(center, direction).local(p);
                let [x, y] = ellipse::foot([major_radius, minor_radius], q[0], q[1]).normal;
                plus(times(x, direction), times(y, [-direction[1], direction[0], 0.0]))
            }
            Shape::Sphere { center, .. } => minus(p, center),
            Shape::Cone { apex, point, direction, half_angle, radius } => {
                let out = across(p, point, direction);
                if is_beyond_apex(half_angle, radius, norm(out), dot(minus(p, point), direction)) {
                    return minus(p, apex);
                }
                let (sin, cos) = libm::sincos(half_angle);
                minus(times(cos, out), times(sin * norm(out), direction))
            }
        }
    }
    /// Direction of the axis, line or normal of an element that has one.
    pub fn direction(&self) -> Option<Vector> {
        match *self {
            Shape::Plane { normal, .. } | Shape::Circle { normal, .. } => Some(normal),
            Shape::Line { direction, .. }
            | Shape::Line2 { direction, .. }
            | Shape::Cylinder { direction, .. }
            | Shape::Cone { direction, .. }
            | Shape::Torus { direction, .. } => Some(direction),
            Shape::Circle2 { .. } | Shape::Ellipse2 { .. } | Shape::Sphere { .. } => None,
        }
    }

    /// A point of the axis, line or plane.
    pub fn foot(&self) -> Option<Point> {
        match *self {
            Shape::Plane { point, .. }
            | Shape::Line { point, .. }
            | Shape::Line2 { point, .. }
            | Shape::Cylinder { point, .. }
            | Shape::Cone { point, .. } => Some(point),
            Shape::Circle { center, .. } | Shape::Torus { center, .. } => Some(center),
            Shape::Circle2 { .. } | Shape::Ellipse2 { .. } | Shape::Sphere { .. } => None,
        }
    }

    /// Center of an element that counts as a point.
    pub fn center(&self) -> Option<Point> {
        match *self {
            Shape::Sphere { center, .. } => Some(center),
            Shape::Line2 { .. }
            | Shape::Line { .. }
            | Shape::Plane { .. }
            | Shape::Circle2 { .. }
            | Shape::Circle { .. }
            | Shape::Ellipse2 { .. }
            | Shape::Cylinder { .. }
            | Shape::Cone { .. }
            | Shape::Torus { .. } => None,
        }
    }

    /// The frame that its places are told in: an origin and three axes. On a round element the third is the axis; the element
    /// does not determine which way the others look about it.
    pub fn frame(&self) -> (Point, [Vector; 3]) {
        const UP: Vector = [0.0, 0.0, 1.0];
        match *self {
            Shape::Line2 { point, direction }
            | Shape::Line { point, direction }
            | Shape::Cylinder { point, direction, .. }
            | Shape::Cone { point, direction, .. } => (point, axes_along(direction)),
            Shape::Plane { point, normal } => (point, axes_along(normal)),
            Shape::Circle2 { center, .. } | Shape::Sphere { center, .. } => (center, axes_along(UP)),
            Shape::Circle { center, normal, .. } => (center, axes_along(normal)),
            Shape::Ellipse2 { center, direction, .. } => (center, [direction, cross(UP, direction), UP]),
            Shape::Torus { center, direction, .. } => (center, axes_along(direction)),
        }
    }
    /// The two coordinates of the place nearest to `q`, which is told in the [frame](Shape::frame); they run as
    /// [`Kind::coordinates`] says. On an ellipse the first is the eccentric angle, and only the nearest place is known.
    pub fn coordinates(&self, q: Point) -> [f64; 2] {
        let turn = || libm::atan2(q[1], q[0]);
        match *self {
            Shape::Line2 { .. } | Shape::Line { .. } => [0.0, q[2]],
            Shape::Plane { .. } => [q[0], q[1]],
            Shape::Circle2 { .. } | Shape::Circle { .. } => [turn(), 0.0],
            Shape::Ellipse2 { major_radius, minor_radius, .. } => {
                [libm::atan2(q[1] / minor_radius, q[0] / major_radius), 0.0]
            }
            Shape::Cylinder { .. } => [turn(), q[2]],
            // There is no cone beyond its apex.
            Shape::Cone { half_angle, radius, .. } => [turn(), q[2].max(-radius / libm::tan(half_angle))],
            Shape::Sphere { .. } => [turn(), libm::atan2(q[2], libm::hypot(q[0], q[1]))],
            Shape::Torus { major_radius, .. } => {
                [turn(), libm::atan2(q[2], libm::hypot(q[0], q[1]) - major_radius)]
            }
        }
    }
    /// The place with these coordinates, told in the [frame](Shape::frame).
    pub fn at(&self, [u, v]: [f64; 2]) -> Point {
        let (sine, cosine) = libm::sincos(u);
        // Away from the axis by `r`, along it by `z`.
        let round = |r: f64, z: f64| [r * cosine, r * sine, z];
        match *self {
            Shape::Plane { .. } => [u, v, 0.0],
            Shape::Line2 { .. } | Shape::Line { .. } => [0.0, 0.0, v],
            Shape::Circle2 { radius, .. } | Shape::Circle { radius, .. } => round(radius, 0.0),
            Shape::Ellipse2 { major_radius, minor_radius, .. } => {
                [major_radius * cosine, minor_radius * sine, 0.0]
            }
            Shape::Cylinder { radius, .. } => round(radius, v),
            Shape::Cone { radius, half_angle, .. } => round(radius + v * libm::tan(half_angle), v),
            Shape::Sphere { radius, .. } => round(radius * libm::cos(v), radius * libm::sin(v)),
            Shape::Torus { major_radius, minor_radius, .. } => {
                round(major_radius + minor_radius * libm::cos(v), minor_radius * libm::sin(v))
            }
        }
    }
}

/// Three axes of which the last is `w`.
pub fn axes_along(w: Vector) -> [Vector; 3] {
    let (v, _) = unit(cross(w, least_axis(w))).unwrap_or(([0.0, 1.0, 0.0], 1.0));
    [cross(v, w), v, w]
}

/// From an axis to `p`.
fn across(p: Point, point: Point, direction: Vector) -> Vector {
    let q = minus(p, point);
    minus(q, times(dot(q, direction), direction))
}

/// Whether the apex is the place of a cone nearest to a point. The point lies `rho` off the axis and `z` along it from where
/// the radius is `radius`. Then the foot on the generator would lie beyond the apex.
fn is_beyond_apex(half_angle: f64, radius: f64, rho: f64, z: f64) -> bool {
    let (sin, cos) = libm::sincos(half_angle);
    (rho * sin + z * cos) * sin + radius * cos * cos < 0.0
}

/// Distance from an axis, and coordinate along it.
fn off_axis(p: Point, point: Point, direction: Vector) -> (f64, f64) {
    let q = minus(p, point);
    // The vector product keeps the digits of small distances; subtracting squares would not.
    (norm(cross(q, direction)), dot(q, direction))
}

#[cfg(test)]
mod tests {
    use super::super::{Coordinate, Quantity};
    use super::*;

    fn one_of_each() -> [Shape; 10] {
        let (c, w, flat) = ([1.0, 2.0, 3.0], [0.6, 0.0, 0.8], [0.8, 0.6, 0.0]);
        let cone = Shape::Cone {
            apex: minus(c, times(10.0, w)),
            direction: w,
            half_angle: 0.3,
            point: c,
            radius: 10.0 * libm::tan(0.3),
        };
        [
            Shape::Line2 { point: [1.0, 2.0, 0.0], direction: flat },
            Shape::Line { point: c, direction: w },
            Shape::Plane { point: c, normal: w },
            Shape::Circle2 { center: [1.0, 2.0, 0.0], radius: 4.0 },
            Shape::Circle { center: c, normal: w, radius: 4.0 },
            Shape::Ellipse2 {
                center: [1.0, 2.0, 0.0],
                direction: flat,
                major_radius: 5.0,
                minor_radius: 2.0,
            },
            Shape::Sphere { center: c, radius: 4.0 },
            Shape::Cylinder { point: c, direction: w, radius: 4.0 },
            cone,
            Shape::Torus { center: c, direction: w, major_radius: 9.0, minor_radius: 2.0 },
        ]
    }

    /// The list has every kind, each once.
    #[test]
    fn each_parameter_is_what_its_kind_says() {
        for shape in one_of_each() {
            let (parameters, quantities) = (shape.parameters(), shape.kind().parameters());
            assert_eq!(parameters.len(), quantities.len(), "{shape:?}");
            for ((name, value), (_, quantity)) in parameters.into_iter().zip(quantities) {
                let fits = match value {
                    Parameter::Number(_) => matches!(quantity, Quantity::Length | Quantity::Angle),
                    Parameter::Vector(v) if (norm(v) - 1.0).abs() < 1e-12 => *quantity == Quantity::Direction,
                    Parameter::Vector(_) => *quantity == Quantity::Place,
                };
                assert!(fits, "{shape:?}: {name}");
            }
        }
    }

    #[test]
    fn each_kind_once() {
        assert_eq!(one_of_each().map(|shape| shape.kind()), Kind::ALL);
    }

    #[test]
    fn a_normal_is_the_gradient_of_the_distance() {
        for shape in one_of_each() {
            for mut p in [[4.0, -2.0, 1.0], [-3.0, 7.0, 5.0], [1.5, 8.0, 2.0]] {
                if shape.kind().is_flat() {
                    p[2] = 0.0;
                }
                let gradient: Vector = std::array::from_fn(|k| {
                    let at =
                        |h: f64| shape.distance(std::array::from_fn(|j| p[j] + if j == k { h } else { 0.0 }));
                    (at(1e-5) - at(-1e-5)) / 2e-5
                });
                let (found, _) = unit(shape.normal(p)).unwrap();
                let flat = |k: usize| k == 2 && shape.kind().is_flat();
                for k in (0..3).filter(|k| !flat(*k)) {
                    assert!((found[k] - gradient[k]).abs() < 1e-8, "{shape:?} {found:?} {gradient:?}");
                }
            }
        }
    }

    #[test]
    fn places_lie_on_the_element_and_have_their_coordinates() {
        for shape in one_of_each() {
            let (origin, axes) = shape.frame();
            for (u, v) in [(0.3, 0.2), (-2.0, 1.1), (3.0, -0.7)] {
                let [u, v] = std::array::from_fn(|k| match shape.kind().coordinates()[k] {
                    Coordinate::None => 0.0,
                    _ => [u, v][k],
                });
                let q = shape.at([u, v]);
                let p = axes.iter().zip(q).fold(origin, |sum, (a, x)| plus(sum, times(x, *a)));
                assert!(shape.distance(p).abs() < 1e-12, "{shape:?} {p:?}");
                let back = shape.coordinates(q);
                assert!((back[0] - u).abs() < 1e-12 && (back[1] - v).abs() < 1e-12, "{shape:?} {back:?}");
            }
        }
    }
}
