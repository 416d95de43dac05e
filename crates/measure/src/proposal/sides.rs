//! Which sides of two features a dimension between them goes to: files state the two faces and a number.

use trueness_geom::shape::Shape;
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm};

/// Where the middle of a feature lies, and how far its surface is off that.
enum Middle {
    Plane(Point, Vector),
    Axis(Point, Vector, f64),
    Center(Point, f64),
}

fn middle(shape: &Shape) -> Option<Middle> {
    Some(match *shape {
        Shape::Plane { point, normal } => Middle::Plane(point, normal),
        Shape::Cylinder { point, direction, radius } => Middle::Axis(point, direction, radius),
        Shape::Sphere { center, radius } => Middle::Center(center, radius),
        _ => return None,
    })
}

/// How far two middles are apart, and the sum of what both surfaces are off them.
fn apart(a: &Middle, b: &Middle) -> Option<(f64, f64)> {
    let across = |p: Point, way: Vector, q: Point| norm(cross(minus(q, p), way));
    let over = |p: Point, normal: Vector, q: Point| dot(minus(q, p), normal).abs();
    Some(match (a, b) {
        (Middle::Plane(..), Middle::Plane(..)) => return None,
        (Middle::Plane(p, n), Middle::Axis(q, _, r) | Middle::Center(q, r))
        | (Middle::Axis(q, _, r) | Middle::Center(q, r), Middle::Plane(p, n)) => (over(*p, *n, *q), *r),
        (Middle::Axis(p, way, r), Middle::Axis(q, _, s) | Middle::Center(q, s))
        | (Middle::Center(q, s), Middle::Axis(p, way, r)) => (across(*p, *way, *q), r + s),
        (Middle::Center(p, r), Middle::Center(q, s)) => (norm(minus(*q, *p)), r + s),
    })
}

/// The sides that a dimension with these limits goes to, where the middles of the features do not keep them.
pub(super) fn between(from: &Shape, to: &Shape, [least, greatest]: [f64; 2]) -> Option<&'static str> {
    let (middles, off) = apart(&middle(from)?, &middle(to)?)?;
    let keeps = |x: f64| (least..=greatest).contains(&x);
    match keeps(middles) {
        true => None,
        false if keeps(middles + off) => Some("far side to far side"),
        false if keeps(middles - off) => Some("near side to near side"),
        false => None,
    }
}
