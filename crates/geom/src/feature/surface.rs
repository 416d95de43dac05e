//! The theoretically exact surface of a nominal feature, without bounds.

use super::Nominal;
use crate::space::{Point, Vector, cross, dot, minus, norm, times, unit};

/// A surface that a nominal feature lies on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    /// A plane with its unit normal.
    Plane(Point, Vector),
    /// A cylinder: a point of its axis, unit direction, radius.
    Cylinder(Point, Vector, f64),
    /// A cone: its tip, unit direction into it, half angle.
    Cone(Point, Vector, f64),
    /// A sphere: center and radius.
    Sphere(Point, f64),
}

impl Nominal {
    /// The surface that the feature lies on; `None` for an edge, and where a direction has no length.
    pub fn surface(&self) -> Option<Surface> {
        let way = |v: Vector| unit(v).map(|u| u.0);
        Some(match *self {
            Nominal::Plane { point, normal, .. } => Surface::Plane(point, way(normal)?),
            Nominal::Cylinder { point, direction, radius, .. } => {
                Surface::Cylinder(point, way(direction)?, radius)
            }
            Nominal::Cone { apex, direction, half_angle, .. } => {
                Surface::Cone(apex, way(direction)?, half_angle)
            }
            Nominal::Sphere { center, radius } => Surface::Sphere(center, radius),
            Nominal::Edge { .. } => return None,
        })
    }
}

impl Surface {
    /// Signed distance of `p` (mm), positive along the normal of a plane and away from an axis or center, and its gradient, a
    /// unit vector. `None` on the axis or at the center, where the gradient has no direction, and where `p` is no number.
    pub fn distance(&self, p: Point) -> Option<(f64, Vector)> {
        let (distance, gradient) = match *self {
            Surface::Plane(point, normal) => (dot(minus(p, point), normal), normal),
            Surface::Sphere(center, radius) => {
                let (away, length) = unit(minus(p, center))?;
                (length - radius, away)
            }
            Surface::Cylinder(point, direction, radius) => {
                let (radial, off) = radial(p, point, direction)?;
                (off - radius, radial)
            }
            Surface::Cone(apex, direction, half_angle) => {
                let (radial, off) = radial(p, apex, direction)?;
                let (sine, cosine) = (libm::sin(half_angle), libm::cos(half_angle));
                let along = dot(minus(p, apex), direction);
                (off * cosine - along * sine, minus(times(cosine, radial), times(sine, direction)))
            }
        };
        distance.is_finite().then_some((distance, gradient))
    }
}

/// Unit vector away from an axis, and the distance from it.
fn radial(p: Point, point: Point, direction: Vector) -> Option<(Vector, f64)> {
    let q = minus(p, point);
    // Taken twice: what is left along the axis after the first time is rounding.
    let once = minus(q, times(dot(q, direction), direction));
    let (away, _) = unit(minus(once, times(dot(once, direction), direction)))?;
    Some((away, norm(cross(q, direction))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::plus;

    /// The gradient is the slope of the distance.
    #[test]
    fn gradients_are_slopes() {
        let w = unit([1.0, 2.0, -2.0]).unwrap().0;
        let surfaces = [
            Surface::Plane([1.0, 2.0, 3.0], w),
            Surface::Cylinder([1.0, 2.0, 3.0], w, 4.0),
            Surface::Cone([1.0, 2.0, 3.0], w, 0.4),
            Surface::Sphere([1.0, 2.0, 3.0], 4.0),
        ];
        for surface in surfaces {
            for p in [[5.0, -3.0, 2.0], [-2.0, 7.0, 1.0], [9.0, 9.0, -9.0]] {
                let (_, gradient) = surface.distance(p).unwrap();
                assert!((norm(gradient) - 1.0).abs() < 1e-12);
                for (k, along) in gradient.into_iter().enumerate() {
                    let step: Vector = std::array::from_fn(|i| if i == k { 1e-5 } else { 0.0 });
                    let slope = (surface.distance(plus(p, step)).unwrap().0
                        - surface.distance(minus(p, step)).unwrap().0)
                        / 2e-5;
                    assert!((slope - along).abs() < 1e-8, "{surface:?} {p:?}");
                }
            }
        }
        assert!(surfaces[1].distance([1.0, 2.0, 3.0]).is_none());
    }
}
