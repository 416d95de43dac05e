//! Where on a segment the foot of a point is.

use super::facets::{angle, length};
use super::result::{Geometry, Segment};

impl Segment {
    /// Length from the segment's start to the place nearest to `point`, and the signed distance, positive to the left.
    ///
    /// The segment ends where it ends: the foot of a point beyond is the end.
    pub fn foot(&self, point: [f64; 2]) -> (f64, f64) {
        let minus = |a: [f64; 2], b: [f64; 2]| [a[0] - b[0], a[1] - b[1]];
        let signed = |place: [f64; 2], along: [f64; 2]| {
            let d = minus(point, place);
            let left = along[0] * d[1] - along[1] * d[0];
            if left < 0.0 { -libm::hypot(d[0], d[1]) } else { libm::hypot(d[0], d[1]) }
        };
        match &self.geometry {
            Geometry::Line => {
                let along = minus(self.end, self.start);
                let d = minus(point, self.start);
                let square = along[0] * along[0] + along[1] * along[1];
                let t = ((d[0] * along[0] + d[1] * along[1]) / square.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
                let place = [self.start[0] + t * along[0], self.start[1] + t * along[1]];
                (t * self.length, signed(place, along))
            }
            Geometry::Arc { center, radius, start, sweep } => {
                let (sin, cos) = libm::sincos(start + 0.5 * sweep);
                let turned = angle([cos, sin], minus(point, *center)) * sweep.signum();
                let half = 0.5 * sweep.abs();
                if turned.abs() <= half {
                    let off = (radius - length(*center, point)) * sweep.signum();
                    return (radius * (half + turned), off);
                }
                let at_end = turned > 0.0;
                let place = if at_end { self.end } else { self.start };
                let r = minus(place, *center);
                let along = [-r[1] * sweep.signum(), r[0] * sweep.signum()];
                (if at_end { self.length } else { 0.0 }, signed(place, along))
            }
            Geometry::Spline { curve, .. } => {
                let foot = curve.closest(point);
                let along = curve.derivative(foot.parameter, 1);
                (curve.length(curve.domain().0, foot.parameter), signed(foot.place, along))
            }
        }
    }

    /// The same segment run through from its end.
    pub fn reversed(self) -> Segment {
        let geometry = match self.geometry {
            Geometry::Line => Geometry::Line,
            Geometry::Arc { center, radius, start, sweep } => {
                Geometry::Arc { center, radius, start: start + sweep, sweep: -sweep }
            }
            Geometry::Spline { curve, deviation } => Geometry::Spline { curve: curve.reversed(), deviation },
        };
        let curvature = [-self.curvature[1], -self.curvature[0]];
        Segment { geometry, start: self.end, end: self.start, curvature, ..self }
    }

    /// Direction of the segment at its start and end; of no length where it has none.
    pub fn directions(&self) -> [[f64; 2]; 2] {
        match &self.geometry {
            Geometry::Line => [[self.end[0] - self.start[0], self.end[1] - self.start[1]]; 2],
            Geometry::Arc { start, sweep, .. } => [*start, start + sweep].map(|a| {
                let (sin, cos) = libm::sincos(a);
                [-sin * sweep.signum(), cos * sweep.signum()]
            }),
            Geometry::Spline { curve, .. } => {
                let (from, to) = curve.domain();
                [curve.derivative(from, 1), curve.derivative(to, 1)]
            }
        }
    }
}
