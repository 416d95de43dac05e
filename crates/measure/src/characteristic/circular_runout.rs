//! Circular run-out: ISO 1101:2017, 17.16. ASME Y14.5-2018, section 12, agrees.

use super::kind::{Characteristic, Measuring, Question, Refusal, WITH_AXIS};
use super::located::single;
use super::total_runout::reading;
use super::value::{Missing, Value};
use trueness_document::plan::Class;
use trueness_document::tolerance_class::Table;

/// In one section, the range of the distances from the datum axis (radial), or of the places along it (axial). The section
/// is a feature of its own: a circle.
#[derive(Debug)]
pub struct CircularRunout;

impl Characteristic for CircularRunout {
    fn word(&self) -> &'static str {
        "circular-runout"
    }
    fn symbol(&self) -> &'static str {
        "↗"
    }
    fn standard(&self) -> &'static str {
        "ISO 1101:2017, 17.16"
    }
    fn keys(&self) -> &'static [&'static str] {
        &["tolerance", "class", "datums", "datum_method", "direction"]
    }
    fn class_table(&self) -> Option<Table> {
        Some(Table::Runout)
    }
    fn check(&self, q: &Question) -> Result<(), Refusal> {
        q.class(&[Class::Circle])?;
        q.datum(&WITH_AXIS).map(|_| ())
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        reading(m, single(m)?, m.spec.axial)
    }
}
