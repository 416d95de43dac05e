//! What parallelism, perpendicularity and angularity have in common: a zone whose angle to the datum is exact.
//!
//! ISO 1101:2017, 17.10 to 17.12. The zone of a surface, and of a line without the sign ∅, lies between two parallel planes;
//! with ∅ it is a cylinder. A single datum holds its angle; what turns about the datum stays free, and the least zone over
//! these turns is the value.

use super::located::single;
use super::{Measuring, Missing, Question, Refusal, Value, is_axis, refuse};
use crate::plan::Class;
use std::f64::consts::FRAC_PI_2;
use trueness_geom::zone::datum::Datum;
use trueness_geom::zone::{slab, slab_at_angle, tube, tube_at_angle};

/// Keys of the three kinds, without `basic`.
pub(super) const KEYS: &[&str] = &["tolerance", "datums", "datum_method", "diametral"];

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

pub(super) fn check(q: &Question, angle: f64) -> Result<(), Refusal> {
    let class = q.class(&[Class::Plane, Class::Line, Class::Cylinder, Class::Cone])?;
    let datum = q.datum(&[Class::Plane, Class::Line, Class::Cylinder, Class::Cone])?;
    if class == Class::Plane && q.spec.diametral == Some(true) {
        return refuse("diametral", "the zone of a plane is no cylinder");
    }
    if is_axis(class) && !diametral(q.spec.diametral, angle, datum) && to_direction(angle, datum) == 0.0 {
        return refuse(
            "diametral",
            "a zone between two planes along the datum needs a further direction, which is not built yet",
        );
    }
    q.feature()?;
    Ok(())
}

/// The value for a feature that stands at `angle` (radians) to the datum.
pub(super) fn measure(m: &Measuring, angle: f64) -> Result<Value, Missing> {
    let feature = m.feature();
    let (datum_class, direction) = match single(m)? {
        Datum::Plane { normal, .. } => (Class::Plane, normal),
        Datum::Axis { direction, .. } => (Class::Line, direction),
        Datum::Point(_) => return Err(Missing::Impossible("a center gives no direction".into())),
    };
    let points = feature.zoned()?;
    if feature.class == Class::Plane || !diametral(m.spec.diametral, angle, datum_class) {
        // The normal of the zone's planes: they stand to a datum plane as their normals do, to an axis as its complement.
        let to_normal = if datum_class == Class::Plane { angle } else { complement(angle) };
        let zone = match to_normal {
            0.0 => slab(&points, direction)?,
            to_normal => slab_at_angle(&points, direction, to_normal)?,
        };
        return Ok(Value {
            value: zone.width,
            witness: vec![points[zone.high], points[zone.low]],
            ..Value::default()
        });
    }
    let zone = match to_direction(angle, datum_class) {
        0.0 => tube(&points, direction)?,
        to_direction => tube_at_angle(&points, direction, to_direction)?,
    };
    let witness = zone.touching.iter().map(|i| points[*i]).collect();
    Ok(Value { value: zone.diameter, diametral: true, witness, ..Value::default() })
}
