//! Where on a segment the foot of a point is.

use super::flat::{angle, distance};
use super::result::{Geometry, Segment};

/// The place of a segment nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentFoot {
    /// Its share of the segment's parameter, from 0 at the start to 1 at the end.
    pub share: f64,
    /// The place.
    pub place: [f64; 2],
    /// Direction of the segment there, of any length.
    pub along: [f64; 2],
    /// Distance of the point, positive to the left of the segment.
    pub distance: f64,
}

impl Segment {
    /// A segment that no points belong to, yet.
    pub(crate) fn bare(
        geometry: Geometry,
        [start, end]: [[f64; 2]; 2],
        length: f64,
        curvature: [f64; 2],
    ) -> Segment {
        Segment {
            geometry,
            start,
            end,
            length,
            count: 0,
            rms: 0.0,
            max: 0.0,
            curvature,
            uncertainty: None,
            length_uncertainty: None,
        }
    }

    /// A line that no points belong to.
    pub(crate) fn line(start: [f64; 2], end: [f64; 2]) -> Segment {
        Segment::bare(Geometry::Line, [start, end], distance(start, end), [0.0; 2])
    }

    /// Places whose box holds the segment.
    pub(crate) fn hull(&self) -> Vec<[f64; 2]> {
        let mut all = vec![self.start, self.end];
        match &self.geometry {
            Geometry::Line => {}
            Geometry::Arc { center, radius, .. } => {
                all.extend([-radius, *radius].map(|r| [center[0] + r, center[1] + r]));
            }
            Geometry::Spline { curve, .. } => all.extend(curve.points()),
        }
        all
    }

    /// The place at a share of its parameter, from 0 at its start to 1 at its end. For lines and arcs it is the share
    /// of the length.
    pub fn place(&self, share: f64) -> [f64; 2] {
        match &self.geometry {
            _ if share <= 0.0 => self.start,
            _ if share >= 1.0 => self.end,
            Geometry::Line => [0, 1].map(|k| self.start[k] + share * (self.end[k] - self.start[k])),
            Geometry::Arc { center, radius, start, sweep } => {
                let (sin, cos) = libm::sincos(start + share * sweep);
                [center[0] + radius * cos, center[1] + radius * sin]
            }
            Geometry::Spline { curve, .. } => {
                let (from, to) = curve.domain();
                curve.at(from + share * (to - from))
            }
        }
    }

    /// Its direction at a share of its parameter, of any length.
    pub(crate) fn direction(&self, share: f64) -> [f64; 2] {
        match &self.geometry {
            Geometry::Line => [self.end[0] - self.start[0], self.end[1] - self.start[1]],
            Geometry::Arc { start, sweep, .. } => {
                let (sin, cos) = libm::sincos(start + share * sweep);
                [-sin * sweep.signum(), cos * sweep.signum()]
            }
            Geometry::Spline { curve, .. } => {
                let (from, to) = curve.domain();
                curve.derivative(from + share * (to - from), 1)
            }
        }
    }

    /// Length from the segment's start to the place nearest to `point`, and the signed distance, positive to the left.
    ///
    /// The segment ends where it ends: the foot of a point beyond is the end.
    pub fn foot(&self, point: [f64; 2]) -> (f64, f64) {
        let foot = self.nearest(point);
        let to_there = match &self.geometry {
            Geometry::Spline { curve, .. } => {
                let (from, to) = curve.domain();
                curve.length(from, from + foot.share * (to - from))
            }
            _ => foot.share * self.length,
        };
        (to_there, foot.distance)
    }

    /// The place nearest to `point`.
    pub fn nearest(&self, point: [f64; 2]) -> SegmentFoot {
        let minus = |a: [f64; 2], b: [f64; 2]| [a[0] - b[0], a[1] - b[1]];
        let found = |share: f64, place: [f64; 2], along: [f64; 2]| {
            let d = minus(point, place);
            let left = along[0] * d[1] - along[1] * d[0];
            let size = libm::hypot(d[0], d[1]);
            SegmentFoot { share, place, along, distance: if left < 0.0 { -size } else { size } }
        };
        match &self.geometry {
            Geometry::Line => {
                let along = minus(self.end, self.start);
                let d = minus(point, self.start);
                let square = along[0] * along[0] + along[1] * along[1];
                let t = ((d[0] * along[0] + d[1] * along[1]) / square.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
                found(t, [self.start[0] + t * along[0], self.start[1] + t * along[1]], along)
            }
            Geometry::Arc { center, radius, start, sweep } => {
                let (sin, cos) = libm::sincos(start + 0.5 * sweep);
                let out = minus(point, *center);
                let turned = angle([cos, sin], out) * sweep.signum();
                let half = 0.5 * sweep.abs();
                if turned.abs() <= half {
                    let far = distance(*center, point);
                    // Every place is the nearest to the center; the middle stands for all.
                    let unit = if far > 0.0 { out.map(|x| x / far) } else { [cos, sin] };
                    let place = [center[0] + radius * unit[0], center[1] + radius * unit[1]];
                    let along = [-unit[1] * sweep.signum(), unit[0] * sweep.signum()];
                    let distance = (radius - far) * sweep.signum();
                    return SegmentFoot { share: 0.5 * (1.0 + turned / half), place, along, distance };
                }
                let at_end = turned > 0.0;
                let place = if at_end { self.end } else { self.start };
                let r = minus(place, *center);
                let along = [-r[1] * sweep.signum(), r[0] * sweep.signum()];
                found(if at_end { 1.0 } else { 0.0 }, place, along)
            }
            Geometry::Spline { curve, .. } => {
                let foot = curve.closest(point);
                let (from, to) = curve.domain();
                let share = (foot.parameter - from) / (to - from);
                found(share, foot.place, curve.derivative(foot.parameter, 1))
            }
        }
    }

    /// The part between two lengths along it, `from` below `to`.
    pub(crate) fn part(&self, from: f64, to: f64) -> Segment {
        let [from, to] = [from, to].map(|x| x.clamp(0.0, self.length));
        match &self.geometry {
            _ if from <= 0.0 && to >= self.length => self.clone(),
            Geometry::Line => {
                let [a, b] = [from, to].map(|x| self.place(x / self.length));
                Segment::line(a, b)
            }
            Geometry::Arc { center, radius, start, sweep } => {
                let [a, b] = [from, to].map(|x| sweep * x / self.length);
                Segment::arc(*center, *radius, start + a, b - a)
            }
            Geometry::Spline { curve, deviation } => {
                let (low, high) = curve.domain();
                let a = if from <= 0.0 { low } else { curve.parameter_at_length(from) };
                let b = if to >= self.length { high } else { curve.parameter_at_length(to) };
                match curve.part(a, b) {
                    Ok(part) => Segment::of_curve(part, *deviation),
                    // No longer than rounding: its ends.
                    Err(_) => Segment::line(curve.at(a), curve.at(b)),
                }
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
        [self.direction(0.0), self.direction(1.0)]
    }
}
