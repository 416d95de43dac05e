//! Segments as Bézier curves, and the teeth of their curvature comb.

use std::f64::consts::{FRAC_PI_8, TAU};
use trueness_document::section::{GeometryRecord, SegmentRecord};
use trueness_geom::spline::curve::Curve;
use trueness_measure::section::curve;
use trueness_section::{Geometry, Segment};

/// What is drawn of a segment: straight lines through places, or cubic Bézier curves one after the other, ends shared.
#[derive(Clone, Debug, PartialEq)]
pub enum Path {
    /// Places.
    Straight(Vec<[f64; 2]>),
    /// Control points.
    Cubic(Vec<[f64; 2]>),
}

impl Path {
    /// Of a segment. Lines and cubic splines are exact. Arcs are in parts of up to an eighth of half a turn, which keep within 1e-7 of
    /// the radius. A part of the angle δ is off by 2/27 sin⁶(δ/4) / cos²(δ/4).
    pub fn of(segment: &SegmentRecord) -> Path {
        match &segment.geometry {
            GeometryRecord::Line { .. } => Path::Straight(vec![segment.start, segment.end]),
            GeometryRecord::Arc { center, radius, start_angle, sweep } => {
                Path::Cubic(arc(*center, *radius, *start_angle, *sweep))
            }
            GeometryRecord::Spline { .. } => match curve(segment) {
                Some(c) => Path::spline(&c),
                None => Path::Straight(vec![segment.start, segment.end]),
            },
        }
    }

    /// Of a segment of a nominal, in the same way.
    pub fn of_nominal(segment: &Segment) -> Path {
        match &segment.geometry {
            Geometry::Line => Path::Straight(vec![segment.start, segment.end]),
            Geometry::Arc { center, radius, start, sweep } => {
                Path::Cubic(arc(*center, *radius, *start, *sweep))
            }
            Geometry::Spline { curve, .. } => Path::spline(curve),
        }
    }

    fn spline(curve: &Curve<[f64; 2]>) -> Path {
        match curve.knots().degree() {
            3 => Path::Cubic(curve.bezier()),
            _ => Path::Straight(curve.sample(64 * curve.knots().distinct().len())),
        }
    }

    /// The places that bound it.
    pub fn places(&self) -> &[[f64; 2]] {
        match self {
            Path::Straight(places) | Path::Cubic(places) => places,
        }
    }
}

fn arc(center: [f64; 2], radius: f64, start: f64, sweep: f64) -> Vec<[f64; 2]> {
    let parts = (sweep.abs() / FRAC_PI_8).ceil().clamp(1.0, 1000.0);
    let step = sweep.clamp(-TAU, TAU) / parts;
    let handle = 4.0 / 3.0 * libm::tan(0.25 * step);
    let mut all = vec![];
    for i in 0..=parts as usize {
        let (sin, cos) = libm::sincos(start + step * i as f64);
        let place = |u: f64, v: f64| [center[0] + radius * u, center[1] + radius * v];
        if i > 0 {
            all.push(place(cos + handle * sin, sin - handle * cos));
        }
        all.push(place(cos, sin));
        if (i as f64) < parts {
            all.push(place(cos - handle * sin, sin + handle * cos));
        }
    }
    all
}

/// A tooth of a curvature comb.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tooth {
    /// Where it stands on the segment.
    pub at: [f64; 2],
    /// To the left of the segment, of length 1.
    pub normal: [f64; 2],
    /// Curvature there, positive where the segment turns to the left.
    pub curvature: f64,
}

/// Most teeth of a segment.
const MAX_TEETH: f64 = 400.0;

/// Teeth of a segment, about `step` apart, at both ends too; of a line none.
pub fn teeth(segment: &SegmentRecord, step: f64) -> Vec<Tooth> {
    let count = (segment.length / step).ceil().clamp(4.0, MAX_TEETH);
    match &segment.geometry {
        GeometryRecord::Line { .. } => vec![],
        GeometryRecord::Arc { center, radius, start_angle, sweep } => {
            let tooth = |i: usize| {
                let (sin, cos) = libm::sincos(start_angle + sweep * i as f64 / count);
                let left = -sweep.signum();
                Tooth {
                    at: [center[0] + radius * cos, center[1] + radius * sin],
                    normal: [left * cos, left * sin],
                    curvature: sweep.signum() / radius,
                }
            };
            (0..=count as usize).map(tooth).collect()
        }
        GeometryRecord::Spline { .. } => curve(segment).map_or(vec![], |c| along(&c, count)),
    }
}

/// Teeth at equal steps within each span.
fn along(curve: &Curve<[f64; 2]>, count: f64) -> Vec<Tooth> {
    let knots = curve.knots().distinct();
    let each = (count / (knots.len() - 1) as f64).ceil().max(2.0);
    let mut places: Vec<f64> = vec![];
    for w in knots.windows(2) {
        places.extend((0..each as usize).map(|i| w[0] + (w[1] - w[0]) * i as f64 / each));
    }
    places.extend(knots.last());
    let tooth = |t: f64| {
        let d = curve.derivative(t, 1);
        let speed = libm::hypot(d[0], d[1]);
        Some(Tooth { at: curve.at(t), normal: [-d[1] / speed, d[0] / speed], curvature: curve.curvature(t)? })
    };
    places.into_iter().filter_map(tooth).collect()
}
