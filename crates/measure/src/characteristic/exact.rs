//! The true place of a feature in a datum system: by coordinates, or, as the model has it, by an axis or a plane that stands along none of them.

use super::kind::{Measuring, is_axis};
use super::located::frame;
use super::value::{FrameOf, Missing, Place};
use crate::requirement::Basic;
use trueness_document::plan::Class;
use trueness_geom::feature::Nominal;
use trueness_geom::rigid::Rigid;
use trueness_geom::space::{Point, Vector, dot, minus, norm, plus, times, unit};

/// Angle, radians, up to which a direction of the model is that of a drawing: what single precision leaves of a direction in a file.
pub(super) const FILED_ANGLE: f64 = 1e-6;

/// Sine of the angle up to which coordinates still place it: as a model is drawn.
const NEARLY_ALONG_SINE: f64 = 1e-3;

/// The names of the coordinates.
pub const COORDINATES: [&str; 3] = ["x", "y", "z"];

/// The coordinate along which a direction goes most.
pub(super) fn largest(direction: Vector) -> usize {
    (0..3).fold(0, |best, k| if direction[k].abs() > direction[best].abs() { k } else { best })
}

/// The place of a feature in the datum system, all of it that places something.
pub(super) fn place_of(m: &Measuring) -> Result<Basic, Missing> {
    let (start, _) = frame(m)?;
    let feature = m.feature();
    let middle = start.point(feature.middle()?);
    let mut basic = Basic { place: middle.map(Some), ..Basic::default() };
    if feature.class != Class::Plane && !is_axis(feature.class) {
        return Ok(basic);
    }
    let direction = start.vector(feature.direction()?);
    let most = largest(direction);
    let across = (0..3).filter(|k| *k != most).fold(0.0, |s, k| libm::hypot(s, direction[k]));
    basic.oblique = (across > FILED_ANGLE).then_some([middle, direction]);
    if across > NEARLY_ALONG_SINE {
        basic.place = [None; 3];
    }
    let is_plane = feature.class == Class::Plane;
    for (k, x) in basic.place.iter_mut().enumerate() {
        *x = x.filter(|_| is_plane == (k == most));
    }
    Ok(basic)
}

/// Distance from the true place, and its gradient; signed where it is one coordinate or a plane.
pub(super) fn from_place(p: Point, basic: &Basic, class: Class) -> (f64, Vector) {
    if let Some([point, direction]) = basic.oblique {
        let off = minus(p, point);
        let along = dot(off, direction);
        return match class {
            Class::Plane => (along, direction),
            _ => away(minus(off, times(along, direction))),
        };
    }
    let place = basic.place;
    let off: Vector = std::array::from_fn(|k| place[k].map_or(0.0, |x| p[k] - x));
    if place.iter().flatten().count() == 1 {
        let gradient = place.map(|x| f64::from(u8::from(x.is_some())));
        return (off.iter().sum(), gradient);
    }
    away(off)
}

fn away(off: Vector) -> (f64, Vector) {
    let length = norm(off);
    (length, if length > 0.0 { times(1.0 / length, off) } else { [0.0; 3] })
}

/// The measured place beside the true one, in the frame that `motion` takes the aligned data to.
pub(super) fn compared_place(m: &Measuring, motion: Rigid) -> Option<Place> {
    let measured = motion.point(m.feature().middle().ok()?);
    let exact = match m.spec.basic.oblique {
        None => m.spec.basic.place,
        Some([point, direction]) => {
            let along = dot(minus(measured, point), direction);
            let foot = match m.feature().class {
                Class::Plane => minus(measured, times(along, direction)),
                _ => plus(point, times(along, direction)),
            };
            foot.map(Some)
        }
    };
    let of = if m.spec.frame.is_some() { FrameOf::Plan } else { FrameOf::Datums };
    Some(Place { frame: motion, of, measured, exact })
}

/// The measured place beside that of the nominal, which lies where it may lie anywhere else in the aligned data.
pub(super) fn beside_nominal(m: &Measuring) -> Option<Place> {
    let (feature, frame) = (m.feature(), m.spec.frame.unwrap_or(Rigid::IDENTITY));
    let middle = feature.middle().ok()?;
    let exact = frame.point(nearest(feature.nominal.as_ref()?, middle)?);
    let of = if m.spec.frame.is_some() { FrameOf::Plan } else { FrameOf::Aligned };
    Some(Place { frame, of, measured: frame.point(middle), exact: exact.map(Some) })
}

/// The place of a nominal that a measured place belongs to: its center, or the nearest place of its axis or plane.
pub(crate) fn nearest(nominal: &Nominal, place: Point) -> Option<Point> {
    let along = |point: Point, direction: Vector| {
        let (direction, _) = unit(direction)?;
        Some((direction, dot(minus(place, point), direction)))
    };
    Some(match nominal {
        Nominal::Plane { point, normal, .. } => {
            let (normal, off) = along(*point, *normal)?;
            minus(place, times(off, normal))
        }
        Nominal::Cylinder { point, direction, .. } | Nominal::Edge { point, direction, .. } => {
            let (direction, t) = along(*point, *direction)?;
            plus(*point, times(t, direction))
        }
        Nominal::Cone { apex, direction, .. } => {
            let (direction, t) = along(*apex, *direction)?;
            plus(*apex, times(t, direction))
        }
        Nominal::Sphere { center, .. } => *center,
    })
}
