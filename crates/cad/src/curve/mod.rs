//! Curves of edges: places and derivatives by a parameter, as ISO 10303-42 states them.
//!
//! | kind | place at `t` |
//! |---|---|
//! | line | `origin + t·direction` (the direction has the length that the file gives it) |
//! | circle | `radius·(cos t, sin t, 0)` in its frame; ellipse with a radius of each axis |
//! | hyperbola | `(a·cosh t, b·sinh t, 0)` |
//! | parabola | `(f·t², 2·f·t, 0)` with the focal distance `f` |
//! | spline, rational | clamped B-splines by their knots |
//! | polyline | straight from point to point, one unit of `t` for each |
//! | joined | several curves one after another, one unit of `t` for each |

mod bezier;
mod conic;
mod corners;
mod evaluate;
mod extent;
mod feet;
mod part;
mod placed;
mod sample;
#[cfg(test)]
mod tests;

pub use feet::CurveFeet;
pub use part::Foot;

use crate::frame::Frame;
use trueness_geom::space::{Point, Vector};
use trueness_geom::spline::curve::Curve as Spline;
use trueness_geom::spline::rational::Rational;

/// A curve in space, without ends where its kind has none.
#[derive(Clone, Debug, PartialEq)]
pub enum Curve {
    /// A straight line.
    Line {
        /// Its place at 0.
        origin: Point,
        /// Its derivative.
        direction: Vector,
    },
    /// A circle about the third axis of its frame.
    Circle {
        /// Its center and plane.
        frame: Frame,
        /// Above 0.
        radius: f64,
    },
    /// An ellipse in the plane of the first two axes of its frame.
    Ellipse {
        /// Its center and axes.
        frame: Frame,
        /// Half its extent along the first and the second axis.
        radii: [f64; 2],
    },
    /// The branch of a hyperbola that lies along the first axis of its frame.
    Hyperbola {
        /// Center and axes.
        frame: Frame,
        /// Half axes along the first and the second axis.
        radii: [f64; 2],
    },
    /// A parabola that opens along the first axis of its frame.
    Parabola {
        /// Its vertex and axes.
        frame: Frame,
        /// Distance of the focus from the vertex.
        focal: f64,
    },
    /// A B-spline without weights.
    Spline(Spline<Point>),
    /// A rational B-spline.
    Rational(Rational<3>),
    /// Straight pieces between at least two points.
    Polyline(Vec<Point>),
    /// Curves one after another, each ends where the next begins; at least one.
    Joined(Vec<Span>),
}

/// A curve between two parameters; the first may be the greater one.
#[derive(Clone, Debug, PartialEq)]
pub struct Span {
    /// The whole curve.
    pub curve: Curve,
    /// Parameters of its start and its end. For a closed curve an end may lie up to one turn after the start.
    pub range: [f64; 2],
}
