//! What kinds of surfaces there are.

use crate::curve::Curve;
use crate::frame::Frame;
use trueness_geom::space::{Point, Vector};
use trueness_geom::spline::surface::Nurbs;

/// A surface, without bounds where its kind has none.
#[derive(Clone, Debug, PartialEq)]
pub enum Surface {
    /// The plane of the first two axes.
    Plane(Frame),
    /// A cylinder about the third axis.
    Cylinder {
        /// Its axis.
        frame: Frame,
        /// Above 0.
        radius: f64,
    },
    /// A cone about the third axis; both nappes have parameters, faces lie on one.
    Cone {
        /// Its axis; the origin lies where the radius is `radius`.
        frame: Frame,
        /// At `v = 0`, not below 0.
        radius: f64,
        /// Between the axis and the surface, radians, within ±π/2; the radius grows along the axis where it is above 0.
        half_angle: f64,
    },
    /// A sphere.
    Sphere {
        /// Its center; the third axis points to the pole at `v = π/2`.
        frame: Frame,
        /// Above 0.
        radius: f64,
    },
    /// A torus about the third axis. Where the minor radius exceeds the major one it would meet itself on the axis; it is then the part
    /// where `R + r·cos v` is not below 0, from one pole on the axis to the other: an apple, or a lemon where the major radius is
    /// below 0 (the inner part of a spindle torus of radii −R and r).
    Torus {
        /// Its center and axis.
        frame: Frame,
        /// Radius of the circle of centers; greater than −r.
        major: f64,
        /// Radius of the tube.
        minor: f64,
    },
    /// A B-spline surface, rational or not.
    Spline(Box<Nurbs>),
    /// A curve that moves along a direction.
    Extrusion {
        /// At `v = 0`.
        curve: Box<Curve>,
        /// Derivative by `v`.
        direction: Vector,
    },
    /// A curve that turns about an axis.
    Revolution {
        /// At `u = 0`.
        curve: Box<Curve>,
        /// A place on the axis.
        origin: Point,
        /// Unit vector along the axis.
        axis: Vector,
    },
    /// All places of another surface, moved along its normal.
    Offset {
        /// The other surface.
        basis: Box<Surface>,
        /// How far, millimeters; against the normal where it is below 0.
        distance: f64,
    },
}

/// What a surface is, as documents and reports name it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum SurfaceKind {
    /// See [`Surface::Plane`]; so with the others.
    Plane,
    /// A cylinder.
    Cylinder,
    /// A cone.
    Cone,
    /// A sphere.
    Sphere,
    /// A torus.
    Torus,
    /// A B-spline.
    Spline,
    /// An extruded curve.
    Extrusion,
    /// A turned curve.
    Revolution,
    /// An offset of another surface.
    Offset,
}
