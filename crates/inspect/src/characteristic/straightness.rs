//! Straightness: ISO 1101:2017, 17.2; ISO 12780-1. ASME Y14.5-2018, 8.4.1 agrees.

use super::kind::{Characteristic, Measuring, Question, Refusal};
use super::value::{Missing, Value};
use crate::plan::Class;
use crate::tolerance_class::Table;
use trueness_geom::fit::Method;
use trueness_geom::shape::Kind;

/// Of points in space: the diameter of the thinnest cylinder that holds an extracted median line (zone ∅). Of points of two
/// columns: the distance of the two nearest parallel lines in the plane that hold an extracted line.
#[derive(Debug)]
pub struct Straightness;

impl Characteristic for Straightness {
    fn word(&self) -> &'static str {
        "straightness"
    }
    fn symbol(&self) -> &'static str {
        "⏤"
    }
    fn standard(&self) -> &'static str {
        "ISO 1101:2017, 17.2; ISO 12780-1:2011"
    }
    fn keys(&self) -> &'static [&'static str] {
        &["tolerance", "class", "length", "method"]
    }
    fn class_table(&self) -> Option<Table> {
        Some(Table::Form)
    }
    fn check(&self, q: &Question) -> Result<(), Refusal> {
        q.class(&[Class::Line]).map(|_| ())
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        let feature = m.feature();
        let kind = if feature.planar { Kind::Line2 } else { Kind::Line };
        // A least-squares line in space has no least cylinder: twice the greatest distance from it.
        let fit = feature.refitted(kind, m.spec.form, m.progress)?;
        let mut value = feature.form(&fit);
        value.diametral = !feature.planar;
        if m.spec.form == Method::Gaussian && !feature.planar {
            value.notes.push("twice the greatest distance from the least-squares line".into());
        }
        Ok(value)
    }
}
