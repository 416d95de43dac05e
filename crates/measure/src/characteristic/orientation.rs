//! What parallelism, perpendicularity and angularity have in common: a zone whose angle to the datum is exact.
//!
//! ISO 1101:2017, 17.10 to 17.12. The zone of a surface, and of a line without the sign ∅, lies between two parallel planes; with ∅ it is
//! a cylinder. A single datum holds its angle; what turns about the datum stays free, and the least zone over these turns is the value.
//! Further datums lock these turns (datum systems of ISO 5459:2011): the zone then has one exact direction, and the value is the zone in
//! it. Its angle about the first datum is the exact one of the drawing. It is along or across the direction that the second datum gives,
//! where the plan says no other.

use super::exact::FILED_ANGLE;
use super::kind::{Measuring, Question, Refusal, WITH_DIRECTION, is_axis, refuse};
use super::located::system;
use super::material::{Axis, oriented};
use super::reason::{Impossible, NotMeasured};
use super::value::{Missing, Value};
use crate::requirement::Basic;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use trueness_document::plan::Class;
use trueness_geom::rigid::Rigid;
use trueness_geom::space::{Vector, dot, least_axis, minus, plus, times};
use trueness_geom::zone::datum::{AS_DRAWN, Datum, Freedom, System};
use trueness_geom::zone::{slab, slab_at_angle, tube, tube_at_angle};

/// The angle between the zone (its planes, or its axis) and what stands for it in the zone functions: a normal's complement.
fn complement(angle: f64) -> f64 {
    // Exactly 0 and exactly a right angle must stay so: they choose the zones with nothing left free.
    if angle == 0.0 {
        FRAC_PI_2
    } else if angle == FRAC_PI_2 {
        0.0
    } else {
        FRAC_PI_2 - angle
    }
}

/// The angle between the feature's axis and the datum's direction.
fn to_direction(angle: f64, datum: Class) -> f64 {
    if datum == Class::Plane { complement(angle) } else { angle }
}

/// Whether the zone of an axis is a cylinder, where the plan does not say: where the datum gives its direction.
fn diametral(given: Option<bool>, angle: f64, datum: Class) -> bool {
    given.unwrap_or(to_direction(angle, datum) == 0.0)
}

/// Whether the zone of a feature at `angle` to its first datum is a cylinder.
pub(super) fn of_cylinder(q: &Question, angle: f64) -> bool {
    let datum = q.datums().first().copied().unwrap_or(Class::Plane);
    q.feature().is_ok_and(|f| f.class != Class::Plane) && diametral(q.spec.diametral, angle, datum)
}

pub(super) fn check(q: &Question, angle: f64) -> Result<(), Refusal> {
    let class = q.class(&WITH_DIRECTION)?;
    let datum = q.system(&WITH_DIRECTION)?;
    if class == Class::Plane && q.spec.diametral == Some(true) {
        return refuse("diametral", "the zone of a plane is no cylinder");
    }
    if is_axis(class) && !diametral(q.spec.diametral, angle, datum) && to_direction(angle, datum) == 0.0 {
        return refuse(
            "diametral",
            "a zone between two planes along the datum needs a direction indicator, which is not built yet",
        );
    }
    let zone = diametral(q.spec.diametral, angle, datum);
    if q.spec.material.is_some() && !(class == Class::Cylinder && zone) {
        return refuse(
            "material",
            "a material requirement is evaluated for the axis of a cylinder in a zone with ∅",
        );
    }
    if q.spec.basic.turn.is_some() && q.spec.datums.len() < 2 {
        return refuse("basic", "a turn is counted from the direction of a second datum; name one");
    }
    Ok(())
}

/// The value for a feature that stands at `angle` (radians) to the first datum.
pub(super) fn measure(m: &Measuring, angle: f64) -> Result<Value, Missing> {
    let feature = m.feature();
    let system = system(m)?;
    let (datum_class, direction) = first_direction(&system)?;
    let points = feature.zoned()?;
    let mut value = Value::default();
    if feature.class == Class::Plane || !diametral(m.spec.diametral, angle, datum_class) {
        // The normal of the zone's planes: they stand to a datum plane as their normals do, to an axis as its complement.
        let to_normal = if datum_class == Class::Plane { angle } else { complement(angle) };
        let zone = match (to_normal, locked(m, &system, true, to_normal, &mut value)?) {
            (0.0, _) => slab(&points, direction)?,
            (_, Some(normal)) => slab(&points, normal)?,
            (to_normal, None) => slab_at_angle(&points, direction, to_normal)?,
        };
        value.value = zone.width;
        value.witness = vec![points[zone.high], points[zone.low]];
        return Ok(value);
    }
    let to_direction = to_direction(angle, datum_class);
    if m.spec.boundary.is_some() {
        let locked = locked(m, &system, false, to_direction, &mut value)?;
        let fixed = locked.or((to_direction == 0.0).then_some(direction));
        let found = bounded(m, direction, fixed, to_direction)?;
        return Ok(Value { notes: value.notes, ..found });
    }
    let zone = match (to_direction, locked(m, &system, false, to_direction, &mut value)?) {
        (0.0, _) => tube(&points, direction)?,
        (_, Some(direction)) => tube(&points, direction)?,
        (to_direction, None) => tube_at_angle(&points, direction, to_direction)?,
    };
    value.witness = zone.touching.iter().map(|i| points[*i]).collect();
    value.value = zone.diameter;
    Ok(value)
}

/// The angle of a feature to its first datum, and about that from the direction of the second.
pub(super) fn exact(m: &Measuring) -> Result<Basic, Missing> {
    let system = system(m)?;
    let (datum_class, direction) = first_direction(&system)?;
    let feature = m.feature();
    let own = feature.direction()?;
    let between = snapped(trueness_geom::shape::derived::angle(own, direction));
    let is_alike = (datum_class == Class::Plane) == (feature.class == Class::Plane);
    let mut basic =
        Basic { angle: Some(if is_alike { between } else { complement(between) }), ..Basic::default() };
    if m.datums.len() > 1 && !system.free.turn[2] {
        let [x, y, _] = system.frame.rotation();
        basic.turn = Some(snapped(libm::atan2(dot(own, y).abs(), dot(own, x).abs())));
    }
    Ok(basic)
}

/// Along and across are meant exactly, whatever single precision has left of them in a file.
fn snapped(angle: f64) -> f64 {
    [0.0, FRAC_PI_2].into_iter().find(|exact| (angle - exact).abs() < FILED_ANGLE).unwrap_or(angle)
}

fn first_direction(system: &System) -> Result<(Class, Vector), Missing> {
    match system.datums.first() {
        Some(Datum::Plane { normal, .. }) => Ok((Class::Plane, *normal)),
        Some(Datum::Axis { direction, .. }) => Ok((Class::Line, *direction)),
        _ => Err(Impossible::DatumWithoutDirection.into()),
    }
}

/// The value by the surface with a material requirement: of a cylinder along `fixed`, or where that is open, one that stands
/// at `polar` to the datum's `direction` and turns about it.
fn bounded(m: &Measuring, direction: Vector, fixed: Option<Vector>, polar: f64) -> Result<Value, Missing> {
    let feature = m.feature();
    let (middle, own) = (feature.middle()?, feature.direction()?);
    let none = [0.0; 3];
    let lost = NotMeasured::NoDirection;
    if let Some(fixed) = fixed {
        let start = Rigid::into_frame(middle, fixed, least_axis(fixed)).ok_or(lost)?;
        let free = Freedom { shift: [true, true, false], turn: [false; 3] };
        return oriented(m, start, free, Axis { point: none, direction: [0.0, 0.0, 1.0] });
    }
    let own = if dot(own, direction) < 0.0 { times(-1.0, own) } else { own };
    let start = Rigid::into_frame(middle, direction, own).ok_or(lost)?;
    // Along itself the boundary goes on and on: where it lies across the datum's direction, along x, a shift tells nothing.
    let free = Freedom { shift: [polar != FRAC_PI_2, true, true], turn: [false, false, true] };
    oriented(m, start, free, Axis { point: none, direction: [libm::sin(polar), 0.0, libm::cos(polar)] })
}

/// The direction of the zone (the normal of its `planes`, or its axis) at `polar` to the first datum, as the further datums
/// lock it; `None` where they leave it free to turn about the first.
fn locked(
    m: &Measuring,
    system: &System,
    planes: bool,
    polar: f64,
    value: &mut Value,
) -> Result<Option<Vector>, Missing> {
    if m.datums.len() < 2 || polar == 0.0 {
        return Ok(None);
    }
    if system.free.turn[2] {
        value.notes.push("the further datums lock the zone no further: it turns about the first".into());
        return Ok(None);
    }
    let [x, y, z] = system.frame.rotation();
    let feature = m.feature();
    let own = feature.direction()?;
    // Of an axis between planes, the normal of these lies in the plane of the axis and the first datum's direction.
    let own = match planes && feature.class != Class::Plane {
        true => minus(z, times(dot(z, own), own)),
        false => own,
    };
    let own = if dot(own, z) < 0.0 { times(-1.0, own) } else { own };
    let seen = libm::atan2(dot(own, y), dot(own, x));
    let candidates: Vec<f64> = match m.spec.basic.turn {
        None => (0..4).map(|k| f64::from(k) * FRAC_PI_2).collect(),
        Some(turn) => vec![turn, -turn, PI - turn, PI + turn],
    };
    let off = |azimuth: f64| {
        let difference = (seen - azimuth).rem_euclid(TAU);
        difference.min(TAU - difference)
    };
    let nearest = candidates.into_iter().min_by(|a, b| off(*a).total_cmp(&off(*b)));
    let azimuth = nearest
        .filter(|a| off(*a) <= AS_DRAWN)
        .ok_or_else(|| Missing::from(Impossible::NotAsDrawn { degrees: seen.to_degrees() }))?;
    let flat = plus(times(libm::cos(azimuth), x), times(libm::sin(azimuth), y));
    Ok(Some(plus(times(libm::cos(polar), z), times(libm::sin(polar), flat))))
}
