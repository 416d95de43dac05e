//! Datums and datum systems: elements associated with measured features, and the frame that they make.
//!
//! ISO 5459:2011. A single datum is the situation feature of an ideal element associated with the feature. In a system the
//! second datum keeps the first one's attitude, the third keeps that of both. Planes by minimum zone touch the material from
//! outside; by least squares they lie amid the points. A common datum is made of several features at once.

mod associate;
mod common;
mod frame;
mod joint;

use super::ZoneError;
use crate::fit::FitError;
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::shape::{Kind, Shape};
use crate::space::{Point, Vector, cross, dot, minus, plus, times};
use associate::associate;
use common::Common;
use frame::State;

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
    /// Its points, millimetres.
    pub points: &'a [Point],
    /// What it is: plane, line, cylinder, cone, circle or sphere.
    pub kind: Kind,
    /// Of a plane, a direction out of the material; its length does not matter.
    pub outward: Vector,
}

/// Why there is no datum system. Datums are counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum DatumError {
    /// No element could be associated.
    #[error("datum {datum}: {error}", datum = datum + 1)]
    Fit {
        /// Which datum.
        datum: usize,
        /// Why.
        error: FitError,
    },
    /// No zone could be found.
    #[error("datum {datum}: {error}", datum = datum + 1)]
    Zone {
        /// Which datum.
        datum: usize,
        /// Why.
        error: ZoneError,
    },
    /// It holds nothing that the datums before it leave free.
    #[error("datum {datum} holds nothing that the datums before it leave free (it stands at {degrees:.3}° to the first)", datum = datum + 1)]
    Idle {
        /// Which datum.
        datum: usize,
        /// Its angle to the first datum.
        degrees: f64,
    },
    /// It is neither parallel nor perpendicular to those before it.
    #[error("datum {datum} stands at {degrees:.3}° to those before it; only datums parallel or perpendicular to each other are evaluated", datum = datum + 1)]
    Oblique {
        /// Which datum.
        datum: usize,
        /// Its angle to the first datum.
        degrees: f64,
    },
    /// The features of a common datum do not go together.
    #[error("common datum {datum}: {what}", datum = datum + 1)]
    Common {
        /// Which datum.
        datum: usize,
        /// Why.
        what: &'static str,
    },
    /// The combination has no rule here.
    #[error("a datum system of {what} is not evaluated")]
    Unsupported {
        /// What it is made of.
        what: &'static str,
    },
}

/// Motions that a datum system leaves free, along and about the axes of its frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Freedom {
    /// Shifts along x, y, z.
    pub shift: [bool; 3],
    /// Turns about x, y, z.
    pub turn: [bool; 3],
}

impl Freedom {
    /// Everything is held.
    pub const NONE: Freedom = Freedom { shift: [false; 3], turn: [false; 3] };
    /// Nothing is held.
    pub const ALL: Freedom = Freedom { shift: [true; 3], turn: [true; 3] };
    /// Whether everything is held.
    pub fn is_none(&self) -> bool {
        *self == Freedom::NONE
    }
}

/// The frame of up to three datums.
///
/// A first plane gives z, into the material, and the origin's height; a first axis gives z and the origin's place across it.
/// A second plane gives x, into the material; of a second axis the origin's place, and of a third axis or center the
/// direction of x, towards it. y makes the frame right-handed.
#[derive(Clone, Debug, PartialEq)]
pub struct System {
    /// Takes measured coordinates to those of the frame.
    pub frame: Rigid,
    /// What the datums leave free.
    pub free: Freedom,
    /// The datums.
    pub datums: Vec<Datum>,
}

/// Angle in radians within which datums count as parallel or perpendicular as drawn: a measured part is off by its own
/// deviations, which are far smaller, and a drawing's other angles are far larger.
pub const AS_DRAWN: f64 = 5.0 * std::f64::consts::PI / 180.0;

impl System {
    /// Associates the datums one after the other, each in the attitude that those before it leave, and makes their frame.
    /// A datum has one feature, or as a common datum (`A-B`) two or three: coaxial cylinders or lines, coplanar planes, or
    /// two opposite planes, associated at once. Every point of them counts alike.
    ///
    /// Cost: some passes over the points of each datum.
    ///
    /// # Errors
    /// [`DatumError`]: points that make no element, a datum that is parallel to one that it should stand across, features
    /// that make no common datum, more than three datums.
    ///
    /// ```
    /// use trueness_geom::progress::Silent;
    /// use trueness_geom::shape::Kind;
    /// use trueness_geom::zone::datum::{Datum, Rule, Source, System};
    /// // Two lines of one axis, the second one leaning by its own.
    /// let (a, b) = ([[0.0, 0.0, 0.0], [0.0, 0.0, 10.0]], [[0.0, 0.1, 90.0], [0.0, -0.1, 100.0]]);
    /// let line = |points| Source { points, kind: Kind::Line, outward: [0.0; 3] };
    /// let system = System::associated(&[vec![line(&a), line(&b)]], Rule::Gaussian, &Silent)?;
    /// let Datum::Axis { direction, .. } = system.datums[0] else { unreachable!() };
    /// // Slope of the straight line of least squares through the four: −1 / 8200.
    /// assert!((direction[1] / direction[2] + 1.0 / 8200.0).abs() < 1e-9);
    /// # Ok::<(), trueness_geom::zone::datum::DatumError>(())
    /// ```
    pub fn associated(
        sources: &[Vec<Source>],
        rule: Rule,
        progress: &dyn Progress,
    ) -> Result<System, DatumError> {
        let mut datums = Vec::new();
        for (datum, features) in sources.iter().enumerate() {
            let held = match datum {
                0 => Held::Nothing,
                _ => System::of(&datums)?.held(),
            };
            datums.push(match features.as_slice() {
                [one] => associate(datum, one, rule, held, progress)?,
                sources => Common { datum, sources, rule, held, progress }.associated()?,
            });
        }
        System::of(&datums)
    }

    /// The frame of datums that stand parallel or perpendicular to each other.
    ///
    /// # Errors
    /// [`DatumError`]: as for [`System::associated`].
    pub fn of(datums: &[Datum]) -> Result<System, DatumError> {
        let mut state = State::default();
        for (datum, d) in datums.iter().enumerate() {
            state.take(datum, d)?;
        }
        state.finished(datums)
    }

    fn held(&self) -> Held {
        let [x, _, z] = self.frame.rotation();
        if self.free.turn[2] { Held::Along(z) } else { Held::All([x, cross(z, x), z]) }
    }
}

/// The attitude that earlier datums hold.
#[derive(Clone, Copy)]
enum Held {
    Nothing,
    Along(Vector),
    All([Vector; 3]),
}

/// The direction nearest to `direction` among those held, or the angle to the first of them.
fn nearest(held: &[Vector], direction: Vector) -> Result<Vector, f64> {
    let angle = |v: &Vector| libm::acos(dot(*v, direction).abs().min(1.0));
    match held.iter().find(|v| angle(v) <= AS_DRAWN) {
        Some(v) => Ok(times(dot(*v, direction).signum(), *v)),
        None => Err(held.last().map_or(0.0, angle)),
    }
}

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
        _ => None,
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
        _ => None,
    }
}

/// Center of an element that counts as a point.
pub fn center(shape: &Shape) -> Option<Point> {
    match *shape {
        Shape::Sphere { center, .. } => Some(center),
        _ => None,
    }
}
