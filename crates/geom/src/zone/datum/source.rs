//! Features that datums are made of, and the datums themselves.

use crate::shape::Kind;
use crate::space::{Point, Vector};

/// How an ideal element is associated with a feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Rule {
    /// Least squares.
    #[default]
    Gaussian,
    /// Minimum zone; planes touch the material from outside (ISO 5459:2011, A.2).
    MinimumZone,
}

/// A datum: what an associated element leaves of itself in a system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Datum {
    /// A plane; the normal points out of the material.
    Plane {
        /// A point of it.
        point: Point,
        /// Unit normal.
        normal: Vector,
    },
    /// An axis.
    Axis {
        /// A point of it.
        point: Point,
        /// Unit direction.
        direction: Vector,
    },
    /// A center.
    Point(Point),
}

/// The measured feature of a datum.
#[derive(Clone, Copy, Debug)]
pub struct Source<'a> {
    /// Its points, millimeters.
    pub points: &'a [Point],
    /// Its kind: plane, line, cylinder, cone, circle or sphere.
    pub kind: Kind,
    /// For a plane, a direction out of the material; its length does not matter.
    pub outward: Vector,
}
