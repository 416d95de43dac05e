//! The elements as users know them.

use super::ellipse;
use super::kind::Kind;
use crate::frame::Pose;
use crate::space::{Point, Vector, cross, dot, minus, norm};

/// A fitted element, millimetres and radians. Directions are unit vectors whose component of largest magnitude
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
    /// Millimetres or radians.
    Number(f64),
    /// A place in millimetres or a unit direction.
    Vector([f64; 3]),
}

/// Numbers of the shape that has most: a cone.
pub(crate) const MOST_NUMBERS: usize = 11;

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
    /// Hands name and value of each parameter to `take`, in their order.
    fn each(&self, mut take: impl FnMut(&'static str, Parameter)) {
        use Parameter::{Number, Vector};
        match *self {
            Shape::Line2 { point, direction } | Shape::Line { point, direction } => {
                take("point", Vector(point));
                take("direction", Vector(direction));
            }
            Shape::Plane { point, normal } => {
                take("point", Vector(point));
                take("normal", Vector(normal));
            }
            Shape::Circle2 { center, radius } | Shape::Sphere { center, radius } => {
                take("center", Vector(center));
                take("radius", Number(radius));
            }
            Shape::Circle { center, normal, radius } => {
                take("center", Vector(center));
                take("normal", Vector(normal));
                take("radius", Number(radius));
            }
            Shape::Cylinder { point, direction, radius } => {
                take("point", Vector(point));
                take("direction", Vector(direction));
                take("radius", Number(radius));
            }
            Shape::Cone { apex, direction, half_angle, point, radius } => {
                take("apex", Vector(apex));
                take("direction", Vector(direction));
                take("half_angle", Number(half_angle));
                take("point", Vector(point));
                take("radius", Number(radius));
            }
            Shape::Ellipse2 { center, direction, major_radius, minor_radius }
            | Shape::Torus { center, direction, major_radius, minor_radius } => {
                take("center", Vector(center));
                take("direction", Vector(direction));
                take("major_radius", Number(major_radius));
                take("minor_radius", Number(minor_radius));
            }
        }
    }
    /// The parameters' numbers one after the other, and how many they are; zeros follow.
    pub(crate) fn flattened(&self) -> ([f64; MOST_NUMBERS], usize) {
        let (mut numbers, mut count) = ([0.0; MOST_NUMBERS], 0);
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
    /// Distance of `p` from the element, positive on the outer side: away from the axis or centre, along the
    /// normal of a plane, to the left of a line in the plane. For lines and circles in space it has no sign.
    /// Not a number where `p` is none.
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
            Shape::Cone { point, direction, half_angle, radius, .. } => {
                let (rho, z) = off_axis(p, point, direction);
                (rho - radius) * libm::cos(half_angle) - z * libm::sin(half_angle)
            }
            Shape::Torus { center, direction, major_radius, minor_radius } => {
                let (rho, z) = off_axis(p, center, direction);
                libm::hypot(rho - major_radius, z) - minor_radius
            }
        }
    }
}

/// Distance from an axis, and coordinate along it.
fn off_axis(p: Point, point: Point, direction: Vector) -> (f64, f64) {
    let q = minus(p, point);
    // The vector product keeps the digits of small distances; subtracting squares would not.
    (norm(cross(q, direction)), dot(q, direction))
}
