//! Normals and curvatures: the first and second fundamental form.

use super::Surface;
use crate::space::{Point, Vector, cross, dot, norm, plus, times, unit};

/// Normal and curvatures of a surface at a place. Lengths in millimeters, curvatures in their reciprocal.
///
/// The normal is that of the derivative by `u` times the derivative by `v`. A curvature is positive where the surface bends
/// towards the normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// The unit normal.
    pub normal: Vector,
    /// Mean of the principal curvatures.
    pub mean: f64,
    /// Product of the principal curvatures.
    pub gaussian: f64,
    /// The principal curvatures and their directions: the greater one first.
    pub principal: [Principal; 2],
}

/// A principal curvature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Principal {
    /// The curvature.
    pub curvature: f64,
    /// Unit tangent of the surface in which it bends so. Where both are equal, any two that stand at right angles.
    pub direction: Vector,
}

impl Bend {
    /// From the derivatives by `u` and `v`: first `[u, v]`, second `[uu, uv, vv]`. `None` where the first ones span no plane, or
    /// a number is not finite.
    pub fn new(first: [Vector; 2], second: [Vector; 3]) -> Option<Bend> {
        let [su, sv] = first;
        let (x, length) = unit(su)?;
        let (normal, area) = unit(cross(su, sv))?;
        // Below this the plane is rounding.
        if area <= 4.0 * f64::EPSILON * length * norm(sv) {
            return None;
        }
        let y = cross(normal, x);
        let [l, m, n] = second.map(|s| dot(s, normal));
        // In the frame x, y: u runs along x; v = (a x + b y).
        let (a, b) = (dot(sv, x), dot(sv, y));
        let xx = l / (length * length);
        let xy = (m / length - a * xx) / b;
        let yy = (n - a * a * xx - 2.0 * a * b * xy) / (b * b);
        let mean = 0.5 * (xx + yy);
        let (difference, spread) = (0.5 * (xx - yy), libm::hypot(0.5 * (xx - yy), xy));
        // The eigenvector that is not a difference of nearly equal numbers.
        let (c, s) = if difference >= 0.0 { (difference + spread, xy) } else { (xy, spread - difference) };
        let along = unit(plus(times(c, x), times(s, y))).map_or(x, |(d, _)| d);
        let found = Bend {
            normal,
            mean,
            gaussian: xx * yy - xy * xy,
            principal: [
                Principal { curvature: mean + spread, direction: along },
                Principal { curvature: mean - spread, direction: cross(normal, along) },
            ],
        };
        (found.mean.is_finite() && found.gaussian.is_finite() && spread.is_finite()).then_some(found)
    }
}

impl Surface<Point> {
    /// Unit normal at `u`, `v`; `None` where the derivatives span no plane.
    pub fn normal(&self, u: f64, v: f64) -> Option<Vector> {
        let d = self.derivatives(u, v, 1);
        unit(cross(d[1][0], d[0][1])).map(|(n, _)| n)
    }
    /// Normal and curvatures at `u`, `v`; `None` where the derivatives span no plane.
    pub fn bend(&self, u: f64, v: f64) -> Option<Bend> {
        let d = self.derivatives(u, v, 2);
        Bend::new([d[1][0], d[0][1]], [d[2][0], d[1][1], d[0][2]])
    }
}
