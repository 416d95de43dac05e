//! The thinnest cylinder, of a given attitude, that holds all points: zones of an axis.

use super::azimuth::Cone;
use super::circle::smallest;
use super::error::{ZoneError, sane};
use crate::rigid::Rigid;
use crate::space::{Point, Vector, least_axis, plus, times, unit};

/// A cylinder that holds points.
#[derive(Clone, Debug, PartialEq)]
pub struct Tube {
    /// A point of its axis.
    pub point: Point,
    /// Unit direction of its axis.
    pub direction: Vector,
    /// Its diameter, millimeters: the value of a zone with the sign ∅.
    pub diameter: f64,
    /// Points on it: two or three.
    pub touching: Vec<usize>,
}

/// The thinnest cylinder along `direction` that holds `points` (mm): an axis parallel or perpendicular to a datum.
/// A few passes over the points.
///
/// # Errors
/// No points, a coordinate that is no number, a direction without length.
///
/// ```
/// let axis = [[0.0, 0.0, 0.0], [0.03, 0.04, 20.0]];
/// let zone = trueness_geom::zone::tube(&axis, [0.0, 0.0, 1.0])?;
/// assert!((zone.diameter - 0.05).abs() < 1e-15);
/// # Ok::<(), trueness_geom::zone::ZoneError>(())
/// ```
pub fn tube(points: &[Point], direction: Vector) -> Result<Tube, ZoneError> {
    sane(points)?;
    tube_along(points, direction).ok_or(ZoneError::NoDirection)
}

fn tube_along(points: &[Point], direction: Vector) -> Option<Tube> {
    let (direction, _) = unit(direction)?;
    let seen = Rigid::into_frame(points[0], direction, least_axis(direction))?;
    let [u, v, _] = seen.rotation();
    let flat: Vec<[f64; 2]> = points
        .iter()
        .map(|p| {
            let q = crate::space::minus(*p, points[0]);
            [crate::space::dot(q, u), crate::space::dot(q, v)]
        })
        .collect();
    let circle = smallest(&flat);
    let point = plus(points[0], plus(times(circle.center[0], u), times(circle.center[1], v)));
    Some(Tube { point, direction, diameter: 2.0 * circle.radius, touching: circle.touching })
}

/// The thinnest cylinder whose direction stands at `angle` (radians, 0 to π/2) to `axis` and is free to turn about it. It is
/// the angularity of an axis to a single datum (ISO 1101:2017, 17.12).
///
/// The least over the whole turn, to rounding. Some thousand passes over the points; meant for the points of an axis.
///
/// # Errors
/// No points, a coordinate that is no number, an axis without length.
pub fn tube_at_angle(points: &[Point], axis: Vector, angle: f64) -> Result<Tube, ZoneError> {
    sane(points)?;
    let cone = Cone::about(axis, angle).ok_or(ZoneError::NoDirection)?;
    let diameter = |direction: Vector| tube_along(points, direction).map_or(f64::INFINITY, |t| t.diameter);
    tube_along(points, cone.direction(cone.least(diameter))).ok_or(ZoneError::NoDirection)
}
