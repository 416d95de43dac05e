//! Angle between a feature and a datum: an angular dimension (ISO 14405-3:2016).

use super::kind::{Allowed, Characteristic, Measuring, Question, Refusal, WITH_DIRECTION};
use super::located::single;
use super::reason::Impossible;
use super::value::{Missing, Value};
use trueness_document::plan::{Class, TextureWord};
use trueness_document::tolerance_class::Table;
use trueness_geom::shape::derived::angle;
use trueness_geom::zone::datum::Datum;

/// The angle, 0 to 90 degrees, between the associated planes or axes.
#[derive(Debug)]
pub struct Angle;

impl Characteristic for Angle {
    fn word(&self) -> &'static str {
        "angle"
    }
    fn standard(&self) -> &'static str {
        "ISO 14405-3:2016"
    }
    fn keys(&self) -> &'static [&'static str] {
        &["nominal", "upper", "lower", "class", "length", "datums", "datum_method"]
    }
    fn allowed(&self) -> Allowed {
        Allowed::Between
    }
    fn unit(&self, _: TextureWord) -> &'static str {
        "deg"
    }
    fn class_table(&self) -> Option<Table> {
        Some(Table::Angular)
    }
    fn check(&self, q: &Question) -> Result<(), Refusal> {
        q.class(&WITH_DIRECTION)?;
        q.datum(&WITH_DIRECTION).map(|_| ())
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        let feature = m.feature();
        let own = feature.direction()?;
        let (other, plane) = match single(m)? {
            Datum::Plane { normal, .. } => (normal, true),
            Datum::Axis { direction, .. } => (direction, false),
            Datum::Point(_) => return Err(Impossible::CenterWithoutDirection.into()),
        };
        let between = angle(own, other).to_degrees();
        let value = if plane == (feature.class == Class::Plane) { between } else { 90.0 - between };
        Ok(Value { value, witness: vec![feature.middle()?], ..Value::default() })
    }
}
