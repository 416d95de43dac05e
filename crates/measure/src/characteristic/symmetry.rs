//! Symmetry: ISO 1101:2017, 17.15. ASME Y14.5-2018 has position instead.

use super::kind::{Characteristic, Measuring, Question, Refusal};
use super::located::single;
use super::reason::Impossible;
use super::value::{Missing, Value};
use trueness_document::plan::Class;
use trueness_document::tolerance_class::Table;
use trueness_geom::space::{dot, minus};
use trueness_geom::zone::datum::Datum;

/// Twice the greatest distance of the feature from the datum plane. The feature is a median plane (over the extent of the
/// two planes that it is made of), a plane, a line or a center.
#[derive(Debug)]
pub struct Symmetry;

impl Characteristic for Symmetry {
    fn word(&self) -> &'static str {
        "symmetry"
    }
    fn symbol(&self) -> &'static str {
        "⌯"
    }
    fn standard(&self) -> &'static str {
        "ISO 1101:2017, 17.15"
    }
    fn keys(&self) -> &'static [&'static str] {
        &["tolerance", "class", "length", "datums", "datum_method"]
    }
    fn class_table(&self) -> Option<Table> {
        Some(Table::Symmetry)
    }
    fn check(&self, q: &Question) -> Result<(), Refusal> {
        q.class(&[Class::Plane, Class::Line, Class::Cylinder, Class::Circle, Class::Sphere, Class::Point])?;
        q.datum(&[Class::Plane]).map(|_| ())
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        let Datum::Plane { point, normal } = single(m)? else {
            return Err(Impossible::DatumIsNoPlane.into());
        };
        let points = m.feature().zoned()?;
        let (at, greatest) =
            super::value::greatest(points.iter().map(|p| dot(minus(*p, point), normal).abs()))?;
        Ok(Value { value: 2.0 * greatest, witness: vec![points[at]], ..Value::default() })
    }
}
