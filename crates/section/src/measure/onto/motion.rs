//! Motions in a plane.

use super::super::nominal::Outline;
use crate::model::result::{Geometry, Segment};
use trueness_geom::spline::curve::Curve;

/// A turn about a center, then a shift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneMotion {
    /// The place that it turns about.
    pub center: [f64; 2],
    /// Angle that it turns by, radians, counter-clockwise.
    pub turn: f64,
    /// Where the center goes.
    pub shift: [f64; 2],
}

impl PlaneMotion {
    /// None, about a center.
    pub fn about(center: [f64; 2]) -> PlaneMotion {
        PlaneMotion { center, turn: 0.0, shift: [0.0; 2] }
    }

    /// Where a place goes.
    pub fn apply(&self, p: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = libm::sincos(self.turn);
        let d = [p[0] - self.center[0], p[1] - self.center[1]];
        let turned = [cos * d[0] - sin * d[1], sin * d[0] + cos * d[1]];
        [0, 1].map(|k| self.center[k] + self.shift[k] + turned[k])
    }

    /// The motion back.
    pub fn inverse(&self) -> PlaneMotion {
        PlaneMotion { center: self.moved_center(), turn: -self.turn, shift: self.shift.map(|x| 0.0 - x) }
    }

    /// Rows of the matrix that takes x, y, 1 to the place that it goes to.
    pub fn rows(&self) -> [[f64; 3]; 2] {
        let (sin, cos) = libm::sincos(self.turn);
        let [x, y] = self.apply([0.0; 2]);
        [[cos, -sin, x], [sin, cos, y]]
    }

    pub(super) fn moved_center(&self) -> [f64; 2] {
        [0, 1].map(|k| self.center[k] + self.shift[k])
    }

    /// A length of the size of the coordinates.
    pub(super) fn far(&self) -> f64 {
        libm::hypot(self.center[0], self.center[1])
    }

    /// This motion, then a small one: two shifts and a turn about where the center went.
    pub(super) fn then(&self, by: [f64; 3]) -> PlaneMotion {
        let shift = [self.shift[0] + by[0], self.shift[1] + by[1]];
        PlaneMotion { shift, turn: self.turn + by[2], ..*self }
    }
}

impl Segment {
    /// The same segment where a motion brings it.
    pub fn moved(&self, motion: &PlaneMotion) -> Segment {
        let geometry = match &self.geometry {
            Geometry::Line => Geometry::Line,
            Geometry::Arc { center, radius, start, sweep } => Geometry::Arc {
                center: motion.apply(*center),
                radius: *radius,
                start: start + motion.turn,
                sweep: *sweep,
            },
            Geometry::Spline { curve, deviation } => {
                let points = curve.points().iter().map(|p| motion.apply(*p)).collect();
                // As many points as before fit the knots.
                let moved = Curve::new(curve.knots().clone(), points).unwrap_or_else(|_| curve.clone());
                Geometry::Spline { curve: moved, deviation: *deviation }
            }
        };
        let [start, end] = [self.start, self.end].map(|p| motion.apply(p));
        Segment { geometry, start, end, ..self.clone() }
    }
}

impl Outline {
    /// The same outline where a motion brings it.
    pub fn moved(&self, motion: &PlaneMotion) -> Outline {
        Outline { segments: self.segments.iter().map(|s| s.moved(motion)).collect(), closed: self.closed }
    }
}
