//! Perpendicularity: ISO 1101:2017, 17.11. ASME Y14.5-2018, section 9 agrees for surfaces and axes.

use super::kind::{Characteristic, Measuring, Question, Refusal};
use super::orientation;
use super::value::{Missing, Value};
use trueness_document::tolerance_class::Table;

/// The width, with the sign ∅ the diameter, of the least zone perpendicular to the datum.
#[derive(Debug)]
pub struct Perpendicularity;

impl Characteristic for Perpendicularity {
    fn word(&self) -> &'static str {
        "perpendicularity"
    }
    fn symbol(&self) -> &'static str {
        "⟂"
    }
    fn standard(&self) -> &'static str {
        "ISO 1101:2017, 17.11"
    }
    fn keys(&self) -> &'static [&'static str] {
        &["tolerance", "class", "length", "datums", "datum_method", "diametral", "material"]
    }
    fn class_table(&self) -> Option<Table> {
        Some(Table::Perpendicularity)
    }
    fn diametral(&self, q: &Question, _: bool) -> bool {
        orientation::of_cylinder(q, std::f64::consts::FRAC_PI_2)
    }
    fn check(&self, q: &Question) -> Result<(), Refusal> {
        orientation::check(q, std::f64::consts::FRAC_PI_2)
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        orientation::measure(m, std::f64::consts::FRAC_PI_2)
    }
}
