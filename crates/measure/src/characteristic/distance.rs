//! Distance of a feature from a datum: a linear dimension other than a size (ISO 14405-2:2018).
//!
//! ISO 14405-2 shows that a plus-minus distance between features is ambiguous; what is taken here is stated.

use super::kind::{Allowed, Characteristic, Measuring, Question, Refusal, refuse};
use super::located::single;
use super::value::{Missing, Value};
use trueness_document::tolerance_class::Table;
use trueness_geom::space::{cross, dot, minus, norm};
use trueness_geom::zone::datum::Datum;

/// From the feature's middle to the datum plane, axis or center, across it. The middle is the mean of a plane's or line's points, that of
/// an axis over the extent of its points, or a center.
#[derive(Debug)]
pub struct Distance;

impl Characteristic for Distance {
    fn word(&self) -> &'static str {
        "distance"
    }
    fn standard(&self) -> &'static str {
        "ISO 14405-2:2018"
    }
    fn keys(&self) -> &'static [&'static str] {
        &["nominal", "upper", "lower", "class", "datums", "datum_method"]
    }
    fn allowed(&self) -> Allowed {
        Allowed::Between
    }
    fn class_table(&self) -> Option<Table> {
        Some(Table::Linear)
    }
    fn check(&self, q: &Question) -> Result<(), Refusal> {
        q.feature()?;
        match q.datums().as_slice() {
            [] => refuse("kind", "it needs the feature that it is measured from: datums = [\"A\"]"),
            [_] => Ok(()),
            _ => refuse("datums", "it is measured from one feature"),
        }
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        let middle = m.feature().middle()?;
        let value = match single(m)? {
            Datum::Plane { point, normal } => dot(minus(middle, point), normal).abs(),
            Datum::Axis { point, direction } => norm(cross(minus(middle, point), direction)),
            Datum::Point(point) => norm(minus(middle, point)),
        };
        Ok(Value { value, witness: vec![middle], ..Value::default() })
    }
}
