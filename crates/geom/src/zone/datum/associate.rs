//! Ideal elements associated with datum features.

use super::attitude::{AS_DRAWN, Held, nearest};
use super::frame::misfit;
use super::{Datum, DatumError, Rule, Source};
use crate::fit::{self, Method, Options};
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::shape::{Kind, Shape};
use crate::space::{Point, Vector, dot, least_axis, minus, plus, times, unit};
use crate::zone::ZoneError;
use crate::zone::mean::mean;
use crate::zone::planes::{slab, slab_at_angle};
use std::f64::consts::FRAC_PI_2;

/// The datum of a feature, in the attitude that earlier datums hold.
pub(super) fn associate(
    datum: usize,
    source: &Source,
    rule: Rule,
    held: Held,
    progress: &dyn Progress,
) -> Result<Datum, DatumError> {
    let failed = |error| DatumError::Fit { datum, error };
    let method = match rule {
        Rule::Gaussian => Method::Gaussian,
        Rule::MinimumZone => Method::MinimumZone,
    };
    let fitted = |points: &[Point], kind, method| {
        let options = Options { method, ..Options::default() };
        fit::fit(points, kind, &options, progress).map(|f| f.shape).map_err(failed)
    };
    let free = fitted(source.points, source.kind, Method::Gaussian)?;
    if let Some(center) = free.center() {
        return Ok(Datum::Point(match rule {
            Rule::Gaussian => center,
            Rule::MinimumZone => {
                let shape = fitted(source.points, source.kind, method)?;
                shape.center().unwrap_or(center)
            }
        }));
    }
    let Some(direction) = free.direction() else {
        return Err(DatumError::Unsupported { what: "an element without direction or center" });
    };
    let is_plane = matches!(free, Shape::Plane { .. });
    let wanted = match held {
        Held::Nothing => None,
        Held::Along(z) => match nearest(&[z], direction) {
            Ok(v) => Some(v),
            Err(angle) if is_plane && (angle - FRAC_PI_2).abs() <= AS_DRAWN => {
                return across(datum, source, rule, z, direction);
            }
            Err(angle) => return Err(misfit(datum, angle)),
        },
        Held::All(axes) => {
            let found = nearest(&axes, direction);
            Some(found.map_err(|angle| DatumError::Oblique { datum, degrees: angle.to_degrees() })?)
        }
    };
    match (wanted, is_plane) {
        (None, true) => {
            let normal = fitted(source.points, source.kind, method)?.direction();
            let normal = normal.unwrap_or(direction);
            Ok(touching(source, outside(normal, source.outward), rule))
        }
        (Some(normal), true) => Ok(touching(source, outside(normal, source.outward), rule)),
        (None, false) => {
            let shape = fitted(source.points, source.kind, method)?;
            let point = shape.foot().unwrap_or([0.0; 3]);
            Ok(Datum::Axis { point, direction: shape.direction().unwrap_or(direction) })
        }
        (Some(direction), false) => along(source, direction, |flat| fitted(flat, Kind::Circle2, method)),
    }
}

/// A plane perpendicular to what is held.
fn across(
    datum: usize,
    source: &Source,
    rule: Rule,
    axis: Vector,
    near: Vector,
) -> Result<Datum, DatumError> {
    let failed = |error| DatumError::Zone { datum, error };
    let normal = match rule {
        Rule::MinimumZone => slab_at_angle(source.points, axis, FRAC_PI_2).map_err(failed)?.normal,
        Rule::Gaussian => {
            least_squares_across(source.points, axis, near).ok_or(failed(ZoneError::NoDirection))?
        }
    };
    Ok(touching(source, outside(normal, source.outward), rule))
}

/// The direction across `axis` that is nearest to `near`.
pub(super) fn across_normal(axis: Vector, near: Vector) -> Option<Vector> {
    unit(minus(near, times(dot(near, axis), axis))).map(|n| n.0)
}

/// Normal of the least-squares plane among those parallel to `axis`: the least scatter of the points seen along it.
fn least_squares_across(points: &[Point], axis: Vector, near: Vector) -> Option<Vector> {
    let [u, v, _] = Rigid::into_frame([0.0; 3], axis, near)?.rotation();
    let mean = mean(points);
    let (mut uu, mut uv, mut vv) = (0.0, 0.0, 0.0);
    for p in points {
        let q = minus(*p, mean);
        let (a, b) = (dot(q, u), dot(q, v));
        (uu, uv, vv) = (uu + a * a, uv + a * b, vv + b * b);
    }
    // The axis of the greater moment lies in the plane; half the angle of the double-angle form has no quarter to choose.
    let angle = 0.5 * libm::atan2(2.0 * uv, uu - vv);
    let normal = plus(times(-libm::sin(angle), u), times(libm::cos(angle), v));
    unit(normal).map(|n| n.0)
}

/// An axis along `direction`, where the feature seen along it is a circle.
fn along(
    source: &Source,
    direction: Vector,
    circle: impl Fn(&[Point]) -> Result<Shape, DatumError>,
) -> Result<Datum, DatumError> {
    if !matches!(source.kind, Kind::Cylinder | Kind::Circle) {
        if source.kind == Kind::Line {
            return Ok(Datum::Axis { point: mean(source.points), direction });
        }
        return Err(DatumError::Unsupported { what: "a second axis that is neither a cylinder nor a line" });
    }
    let middle = mean(source.points);
    let Some(seen) = Rigid::into_frame(middle, direction, least_axis(direction)) else {
        return Err(DatumError::Unsupported { what: "an axis without direction" });
    };
    let flat: Vec<Point> =
        source.points.iter().map(|p| seen.point(*p)).map(|[x, y, _]| [x, y, 0.0]).collect();
    let Shape::Circle2 { center, .. } = circle(&flat)? else {
        return Err(DatumError::Unsupported { what: "an axis that is no circle from its end" });
    };
    Ok(Datum::Axis { point: seen.inverse().point(center), direction })
}

/// The plane of this normal: through the mean, or touching the material from outside.
fn touching(source: &Source, normal: Vector, rule: Rule) -> Datum {
    let point = match (rule, slab(source.points, normal)) {
        (Rule::MinimumZone, Ok(zone)) => source.points[zone.high],
        _ => mean(source.points),
    };
    Datum::Plane { point, normal }
}

pub(super) fn outside(normal: Vector, outward: Vector) -> Vector {
    if dot(normal, outward) < 0.0 { times(-1.0, normal) } else { normal }
}
