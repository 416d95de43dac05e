//! Places and directions in a plane.

use trueness_geom::plane::Plane;
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, times};

/// A place moved into a plane of unit normal along it.
pub fn dropped(plane: &Plane, p: Point) -> Point {
    minus(p, times(plane.height(&p), plane.normal))
}

/// Whether unit vectors run along each other, up to rounding.
pub fn is_along(a: Vector, b: Vector) -> bool {
    norm(cross(a, b)) <= MAX_SINE_OF_LINE_DIRECTION
}

/// Whether they are at right angles, up to rounding.
pub fn is_across(a: Vector, b: Vector) -> bool {
    dot(a, b).abs() <= MAX_SINE_OF_LINE_DIRECTION
}

/// Sine of the angle within which directions are the same: a meter long, both ends of a line are then one atom apart.
const MAX_SINE_OF_LINE_DIRECTION: f64 = 1e-10;
