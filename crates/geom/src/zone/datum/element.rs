//! What of an ideal element makes a datum: axis, foot, center.

use crate::shape::Shape;
use crate::space::{Point, Vector, minus, plus, times};

/// Mean of the points, summed from the first one so that no digit is lost far from the origin.
pub fn mean(points: &[Point]) -> Point {
    let Some(&first) = points.first() else { return [0.0; 3] };
    let sum = points.iter().fold([0.0; 3], |s, p| plus(s, minus(*p, first)));
    plus(first, times(1.0 / points.len() as f64, sum))
}

/// Direction of the axis, line or normal of an element that has one.
pub fn direction(shape: &Shape) -> Option<Vector> {
    match *shape {
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
pub fn foot(shape: &Shape) -> Option<Point> {
    match *shape {
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
pub fn center(shape: &Shape) -> Option<Point> {
    match *shape {
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
