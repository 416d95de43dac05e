//! Parallelism: ISO 1101:2017, 17.10. ASME Y14.5-2018, section 9 agrees for surfaces and axes.

use super::kind::{Characteristic, Measuring, Question, Refusal};
use super::orientation;
use super::value::{Missing, Value};

/// The width, with the sign ∅ the diameter, of the least zone parallel to the datum.
#[derive(Debug)]
pub struct Parallelism;

impl Characteristic for Parallelism {
    fn word(&self) -> &'static str {
        "parallelism"
    }
    fn symbol(&self) -> &'static str {
        "∥"
    }
    fn standard(&self) -> &'static str {
        "ISO 1101:2017, 17.10"
    }
    fn keys(&self) -> &'static [&'static str] {
        &["tolerance", "datums", "datum_method", "diametral", "material"]
    }
    fn diametral(&self, q: &Question, _: bool) -> bool {
        orientation::of_cylinder(q, 0.0)
    }
    fn check(&self, q: &Question) -> Result<(), Refusal> {
        orientation::check(q, 0.0)
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        orientation::measure(m, 0.0)
    }
}
