//! Surfaces of placed parts.

use super::kinds::Surface;
use crate::frame::Placement;
use trueness_geom::spline::surface::Nurbs;

impl Surface {
    /// The surface of a placed part. Parameters keep their meaning, and are scaled where they are lengths; under a mirror the
    /// normal `∂u × ∂v` lies on the other side of the material.
    pub fn placed(&self, at: &Placement) -> Surface {
        let s = at.scale;
        match self {
            Surface::Plane(frame) => Surface::Plane(at.frame(frame)),
            Surface::Cylinder { frame, radius } => {
                Surface::Cylinder { frame: at.frame(frame), radius: s * radius }
            }
            Surface::Cone { frame, radius, half_angle } => {
                Surface::Cone { frame: at.frame(frame), radius: s * radius, half_angle: *half_angle }
            }
            Surface::Sphere { frame, radius } => {
                Surface::Sphere { frame: at.frame(frame), radius: s * radius }
            }
            Surface::Torus { frame, major, minor } => {
                Surface::Torus { frame: at.frame(frame), major: s * major, minor: s * minor }
            }
            Surface::Spline(nurbs) => {
                let points: Vec<_> =
                    nurbs.control_points().into_iter().map(|(p, w)| (at.point(p), w)).collect();
                Nurbs::weighted(nurbs.knots().clone(), &points)
                    .map_or_else(|_| self.clone(), |n| Surface::Spline(Box::new(n)))
            }
            Surface::Extrusion { curve, direction } => {
                Surface::Extrusion { curve: Box::new(curve.placed(at)), direction: at.vector(*direction) }
            }
            Surface::Revolution { curve, origin, axis } => {
                // A mirror turns the sense of rotation: about the opposite axis the angle keeps its meaning.
                let sense = if at.is_mirrored() { -1.0 } else { 1.0 };
                Surface::Revolution {
                    curve: Box::new(curve.placed(at)),
                    origin: at.point(*origin),
                    axis: at.direction(axis.map(|a| sense * a)),
                }
            }
            Surface::Offset { basis, distance } => {
                let sense = if at.is_mirrored() { -s } else { s };
                Surface::Offset { basis: Box::new(basis.placed(at)), distance: sense * distance }
            }
        }
    }

    /// What both parameters are multiplied with when a part is scaled by `scale`: 1 but where they are lengths.
    pub fn parameter_scales(&self, scale: f64) -> [f64; 2] {
        match self {
            Surface::Plane(_) => [scale, scale],
            Surface::Cylinder { .. } | Surface::Cone { .. } => [1.0, scale],
            Surface::Offset { basis, .. } => basis.parameter_scales(scale),
            _ => [1.0, 1.0],
        }
    }
}
