//! Flatness: ISO 1101:2017, 17.3; ISO 12781-1. ASME Y14.5-2018, 8.4.2 agrees.

use super::kind::{Characteristic, Measuring, Question, Refusal};
use super::value::{Missing, Value};
use trueness_document::plan::Class;
use trueness_document::tolerance_class::Table;
use trueness_geom::shape::Kind;

/// The distance of the two nearest parallel planes that hold the surface.
#[derive(Debug)]
pub struct Flatness;

impl Characteristic for Flatness {
    fn word(&self) -> &'static str {
        "flatness"
    }
    fn symbol(&self) -> &'static str {
        "⏥"
    }
    fn standard(&self) -> &'static str {
        "ISO 1101:2017, 17.3; ISO 12781-1:2011"
    }
    fn keys(&self) -> &'static [&'static str] {
        &["tolerance", "class", "length", "method"]
    }
    fn class_table(&self) -> Option<Table> {
        Some(Table::Form)
    }
    fn check(&self, q: &Question) -> Result<(), Refusal> {
        q.class(&[Class::Plane]).map(|_| ())
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        let feature = m.feature();
        Ok(feature.form(&feature.refitted(Kind::Plane, m.spec.form, m.progress)?))
    }
}
