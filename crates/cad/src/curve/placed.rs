//! Curves of placed parts.

use super::kinds::{Curve, Span};
use crate::frame::Placement;
use trueness_geom::spline::curve::Curve as Spline;
use trueness_geom::spline::rational::Rational;
use trueness_geom::spline::value::Mass;

impl Curve {
    /// The curve of a placed part; parameters stay as they are but for a scaled line, whose derivative is scaled.
    pub fn placed(&self, at: &Placement) -> Curve {
        let s = at.scale;
        match self {
            Curve::Line { origin, direction } => {
                Curve::Line { origin: at.point(*origin), direction: at.vector(*direction) }
            }
            Curve::Circle { frame, radius } => Curve::Circle { frame: at.frame(frame), radius: s * radius },
            Curve::Ellipse { frame, radii } => {
                Curve::Ellipse { frame: at.frame(frame), radii: radii.map(|r| s * r) }
            }
            Curve::Hyperbola { frame, radii } => {
                Curve::Hyperbola { frame: at.frame(frame), radii: radii.map(|r| s * r) }
            }
            Curve::Parabola { frame, focal } => Curve::Parabola { frame: at.frame(frame), focal: s * focal },
            Curve::Spline(spline) => {
                let points = spline.points().iter().map(|p| at.point(*p)).collect();
                Spline::new(spline.knots().clone(), points).map_or_else(|_| self.clone(), Curve::Spline)
            }
            Curve::Rational(rational) => {
                let masses = rational.masses();
                let place = |m: &Mass<3>| Mass {
                    moment: std::array::from_fn(|k| at.vector(m.moment)[k] + m.mass * at.shift[k]),
                    mass: m.mass,
                };
                let points = masses.points().iter().map(place).collect();
                Rational::of_masses(masses.knots().clone(), points)
                    .map_or_else(|_| self.clone(), Curve::Rational)
            }
            Curve::Polyline(points) => Curve::Polyline(points.iter().map(|p| at.point(*p)).collect()),
            Curve::Joined(spans) => Curve::Joined(spans.iter().map(|span| span.placed(at)).collect()),
        }
    }
}

impl Span {
    /// The span of a placed part.
    pub fn placed(&self, at: &Placement) -> Span {
        Span { curve: self.curve.placed(at), range: self.range }
    }
}
