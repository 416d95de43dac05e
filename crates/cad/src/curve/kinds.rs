//! What kinds of curves there are.

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
