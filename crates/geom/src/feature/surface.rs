//! The theoretically exact surface of a nominal feature, without bounds.

use super::Nominal;
use crate::space::{Point, Vector, cross, dot, minus, norm, times, unit};

/// A surface that a nominal feature lies on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NominalSurface {
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
    pub fn surface(&self) -> Option<NominalSurface> {
        let way = |v: Vector| unit(v).map(|u| u.0);
        Some(match *self {
            Nominal::Plane { point, normal, .. } => NominalSurface::Plane(point, way(normal)?),
            Nominal::Cylinder { point, direction, radius, .. } => {
                NominalSurface::Cylinder(point, way(direction)?, radius)
            }
            Nominal::Cone { apex, direction, half_angle, .. } => {
                NominalSurface::Cone(apex, way(direction)?, half_angle)
            }
            Nominal::Sphere { center, radius } => NominalSurface::Sphere(center, radius),
            Nominal::Edge { .. } => return None,
        })
    }
}

impl NominalSurface {
    /// Signed distance of `p` (mm), positive along the normal of a plane and away from an axis or center, and its gradient, a
    /// unit vector. `None` on the axis or at the center, where the gradient has no direction, and where `p` is no number.
    pub fn distance(&self, p: Point) -> Option<(f64, Vector)> {
        let (distance, gradient) = match *self {
            NominalSurface::Plane(point, normal) => (dot(minus(p, point), normal), normal),
            NominalSurface::Sphere(center, radius) => {
                let (away, length) = unit(minus(p, center))?;
                (length - radius, away)
            }
            NominalSurface::Cylinder(point, direction, radius) => {
                let (radial, off) = radial(p, point, direction)?;
                (off - radius, radial)
            }
            NominalSurface::Cone(apex, direction, half_angle) => {
                let (radial, off) = radial(p, apex, direction)?;
                let (sine, cosine) = (libm::sin(half_angle), libm::cos(half_angle));
                let along = dot(minus(p, apex), direction);
                (off * cosine - along * sine, minus(times(cosine, radial), times(sine, direction)))
            }
        };
        distance.is_finite().then_some((distance, gradient))
    }

    /// Signed distance (mm) of `p` from the line in which the plane through it across `normal` (of length 1) meets the surface.
    /// Also its gradient in that plane, a unit vector. Signs as of [`NominalSurface::distance`].
    ///
    /// The foot is sought along the line's own normal, again and again. That is right for places that are nearer to the line
    /// than its radius of curvature. `None` where that does not settle, where the surface lies along the plane, and where `p`
    /// is no number.
    pub fn distance_within(&self, p: Point, normal: Vector) -> Option<(f64, Vector)> {
        let within = |gradient: Vector| unit(minus(gradient, times(dot(gradient, normal), normal)));
        let (mut away, _) = within(self.distance(p)?.1)?;
        let mut distance = 0.0;
        for _ in 0..MAX_FOOT_ROUNDS {
            let foot = minus(p, times(distance, away));
            let (off, gradient) = self.distance(foot)?;
            let (next, slope) = within(gradient)?;
            // Along the old normal onto the surface, then the normal there.
            let step = off / (slope * dot(next, away));
            distance += step;
            let turned = norm(minus(next, away));
            away = next;
            if step.abs() <= SETTLED_FOOT_STEP * (1.0 + distance.abs()) && turned <= SETTLED_FOOT_STEP {
                return distance.is_finite().then_some((distance, away));
            }
        }
        None
    }
}

/// Most rounds of the search for a foot: each gains as many digits as the distance is smaller than the radius of curvature.
const MAX_FOOT_ROUNDS: usize = 200;
/// Length of a step, and of a turn, up to which it is rounding.
const SETTLED_FOOT_STEP: f64 = 1e-14;

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
            NominalSurface::Plane([1.0, 2.0, 3.0], w),
            NominalSurface::Cylinder([1.0, 2.0, 3.0], w, 4.0),
            NominalSurface::Cone([1.0, 2.0, 3.0], w, 0.4),
            NominalSurface::Sphere([1.0, 2.0, 3.0], 4.0),
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

    /// In a plane across the axis a cone is a circle, in one along it two lines, a sphere a circle anywhere. A cylinder cut
    /// aslant is an ellipse, whose nearest point is sought among many.
    #[test]
    fn distances_within_a_plane_are_those_of_its_curve() {
        let z = [0.0, 0.0, 1.0];
        let near = |found: Option<(f64, Vector)>, wanted: f64| {
            assert!((found.unwrap().0 - wanted).abs() < 1e-12, "{found:?} {wanted}");
        };
        let cone = NominalSurface::Cone([0.0; 3], z, 0.4);
        near(cone.distance_within([3.0, 4.0, 10.0], z), 5.0 - 10.0 * libm::tan(0.4));
        // Along the axis the distance is that of the cone.
        near(
            cone.distance_within([4.0, 0.0, 10.0], [0.0, 1.0, 0.0]),
            cone.distance([4.0, 0.0, 10.0]).unwrap().0,
        );
        let sphere = NominalSurface::Sphere([1.0, 0.0, 0.0], 5.0);
        near(sphere.distance_within([1.0, 4.2, 3.0], z), 0.2);
        let slant = NominalSurface::Plane([0.0; 3], unit([3.0, 0.0, 4.0]).unwrap().0);
        near(slant.distance_within([1.0, 7.0, 2.0], z), 1.0 + 8.0 / 3.0);
        assert!(slant.distance_within([1.0, 7.0, 2.0], unit([3.0, 0.0, 4.0]).unwrap().0).is_none());
        // x² / 18 + y² / 9 = 1 in the plane's coordinates (x along the slope).
        let (cylinder, slope) =
            (NominalSurface::Cylinder([0.0; 3], z, 3.0), unit([1.0, 0.0, 1.0]).unwrap().0);
        let across = unit([1.0, 0.0, -1.0]).unwrap().0;
        for [a, b] in [[4.0, 1.2], [1.0, 3.2], [-3.5, -2.0], [4.3, 0.0]] {
            let p = plus(times(a, slope), [0.0, b, 0.0]);
            let far = |t: f64| libm::hypot(a - 18f64.sqrt() * libm::cos(t), b - 3.0 * libm::sin(t));
            // The nearest of many places, then of as many beside it.
            let nearest = |from: f64, step: f64| {
                let places = (0..=20_000).map(|k| from + step * f64::from(k));
                places.min_by(|s, t| far(*s).total_cmp(&far(*t))).unwrap()
            };
            let step = std::f64::consts::TAU / 20_000.0;
            let least = far(nearest(nearest(0.0, step) - step, 1e-4 * step));
            let (found, gradient) = cylinder.distance_within(p, across).unwrap();
            assert!(
                (found.abs() - least).abs() < 1e-12 && dot(gradient, across).abs() < 1e-12,
                "{found} {least}"
            );
            assert_eq!(found > 0.0, a * a / 18.0 + b * b / 9.0 > 1.0);
        }
    }
}
