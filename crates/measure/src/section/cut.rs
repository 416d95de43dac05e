//! Sections of CAD models as outlines of a nominal.

use trueness_cad::curve::{Curve, Span};
use trueness_cad::section;
use trueness_geom::plane::PlaneFrame;
use trueness_geom::spline::rational::Rational;
use trueness_section::{Outline, Segment};

/// An outline in the coordinates of its plane, whose frame is right-handed about the normal that it was cut with.
pub fn cut_outline(outline: &section::Outline, frame: &PlaneFrame) -> Outline {
    let segments = outline.pieces.iter().filter_map(|piece| segment(&piece.span, frame)).collect();
    Outline { segments, closed: outline.closed }
}

/// A line or an arc exactly; a spline by its control points.
fn segment(span: &Span, frame: &PlaneFrame) -> Option<Segment> {
    let [start, end] = span.ends().map(|p| frame.flat(p));
    match &span.curve {
        Curve::Circle { frame: own, radius } => {
            let center = frame.flat(own.origin);
            let angle = libm::atan2(start[1] - center[1], start[0] - center[0]);
            Some(Segment::arc(center, *radius, angle, span.range[1] - span.range[0]))
        }
        Curve::Spline(spline) => {
            let flat = |p: &[f64; 3]| {
                let [x, y] = frame.flat(*p);
                ([x, y, 0.0], 1.0)
            };
            let points: Vec<([f64; 3], f64)> = spline.points().iter().map(flat).collect();
            Segment::curve(&Rational::new(spline.knots().clone(), &points).ok()?, 0.0)
        }
        _ => Some(Segment::straight(start, end)),
    }
}
