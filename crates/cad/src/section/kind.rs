//! What the section of a surface is.

use super::direction::{dropped, is_across, is_along};
use crate::frame::Frame;
use crate::surface::Surface;
use crate::trim::Trim;
use trueness_geom::plane::Plane;
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, plus, times, unit};

/// What a plane and a surface have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A line, or two that meet in a place.
    Line(Option<Point>),
    /// Center and radius.
    Circle(Point, f64),
    /// Another curve.
    Curve,
}

impl Kind {
    /// The kind near some places of the section; what is nearer than `tolerance` is the same.
    pub fn of(trim: &Trim, plane: &Plane, places: &[Point], tolerance: f64) -> Kind {
        let n = plane.normal;
        match trim.chart.surface() {
            Surface::Plane(_) => Kind::Line(None),
            Surface::Sphere { frame, radius } => {
                let h = plane.height(&frame.origin);
                Kind::Circle(dropped(plane, frame.origin), (radius * radius - h * h).max(0.0).sqrt())
            }
            Surface::Cylinder { frame, .. } if is_across(n, frame.axes[2]) => Kind::Line(None),
            Surface::Cylinder { frame, radius } => match is_along(n, frame.axes[2]) {
                true => Kind::Circle(dropped(plane, frame.origin), *radius),
                false => Kind::Curve,
            },
            Surface::Cone { frame, radius, half_angle } => {
                let slope = libm::tan(*half_angle);
                let apex = frame.place([0.0, 0.0, -radius / slope]);
                if plane.height(&apex).abs() <= tolerance {
                    return Kind::Line(Some(apex));
                }
                if !is_along(n, frame.axes[2]) {
                    return Kind::Curve;
                }
                let center = dropped(plane, frame.origin);
                let height = dot(minus(center, frame.origin), frame.axes[2]);
                Kind::Circle(center, (radius + height * slope).abs())
            }
            Surface::Torus { frame, major, minor } => {
                torus(frame, [*major, *minor], plane, places, tolerance)
            }
            Surface::Extrusion { direction, .. } => match unit(*direction) {
                Some((way, _)) if is_across(n, way) => Kind::Line(None),
                _ => Kind::Curve,
            },
            Surface::Revolution { origin, axis, .. } if is_along(n, *axis) => match places.first() {
                Some(first) => around(dropped(plane, *origin), *first),
                None => Kind::Curve,
            },
            Surface::Revolution { .. } | Surface::Spline(_) | Surface::Offset { .. } => Kind::Curve,
        }
    }
}

/// The circle about a center through a place.
fn around(center: Point, place: Point) -> Kind {
    Kind::Circle(center, norm(minus(place, center)))
}

fn torus(frame: &Frame, [major, minor]: [f64; 2], plane: &Plane, places: &[Point], tolerance: f64) -> Kind {
    let (n, axis) = (plane.normal, frame.axes[2]);
    let nearest = |offers: [(Point, f64); 2]| {
        let off = |(center, radius): &(Point, f64)| {
            places.iter().map(|p| (norm(minus(*p, *center)) - radius).abs()).fold(0.0, f64::max)
        };
        let [a, b] = offers;
        let (center, radius) = if off(&a) <= off(&b) { a } else { b };
        Kind::Circle(center, radius)
    };
    if is_along(n, axis) {
        let h = plane.height(&frame.origin);
        let reach = (minor * minor - h * h).max(0.0).sqrt();
        let center = dropped(plane, frame.origin);
        return nearest([(center, (major + reach).abs()), (center, (major - reach).abs())]);
    }
    if is_across(n, axis) && plane.height(&frame.origin).abs() <= tolerance {
        let way: Vector = cross(n, axis);
        let side = |sense: f64| (dropped(plane, plus(frame.origin, times(sense * major, way))), minor);
        return nearest([side(1.0), side(-1.0)]);
    }
    Kind::Curve
}
