//! Angularity: ISO 1101:2017, 17.12. ASME Y14.5-2018, section 9 agrees for surfaces and axes.

use super::kind::{Characteristic, Measuring, Question, Refusal, refuse};
use super::orientation;
use super::value::{Missing, Value};
use crate::requirement::Basic;

/// What stands for an angle that only the model tells: neither along nor across.
const NO_ANGLE: f64 = std::f64::consts::FRAC_PI_4;

/// The width, with the sign ∅ the diameter, of the least zone at the theoretically exact angle `basic.angle` to the datum.
#[derive(Debug)]
pub struct Angularity;

impl Characteristic for Angularity {
    fn word(&self) -> &'static str {
        "angularity"
    }
    fn symbol(&self) -> &'static str {
        "∠"
    }
    fn standard(&self) -> &'static str {
        "ISO 1101:2017, 17.12"
    }
    fn keys(&self) -> &'static [&'static str] {
        &["tolerance", "datums", "datum_method", "diametral", "basic", "material"]
    }
    fn diametral(&self, q: &Question, _: bool) -> bool {
        orientation::of_cylinder(q, q.spec.basic.angle.unwrap_or(0.0))
    }
    fn check(&self, q: &Question) -> Result<(), Refusal> {
        let angle = match q.spec.basic.angle {
            Some(angle) => angle,
            None if q.spec.basic_span.is_none() && q.is_of_model() => NO_ANGLE,
            None => return refuse("kind", "it needs the theoretically exact angle: basic = { angle = 60 }"),
        };
        if q.spec.basic.place.iter().any(Option::is_some) {
            return refuse("basic", "it takes an angle, and a turn with a second datum");
        }
        orientation::check(q, angle)
    }
    fn exact(&self, model: &Measuring) -> Option<Result<Basic, Missing>> {
        Some(orientation::exact(model))
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        orientation::measure(m, m.spec.basic.angle.unwrap_or(0.0))
    }
}
