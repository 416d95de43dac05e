//! Cylindricity: ISO 1101:2017, 17.5; ISO 12180-1. ASME Y14.5-2018, 8.4.4 agrees.

use super::kind::{Characteristic, Measuring, Question, Refusal};
use super::value::{Missing, Value};
use trueness_document::plan::Class;
use trueness_geom::shape::Kind;

/// The difference of radius of the two nearest coaxial cylinders that hold the surface between them.
#[derive(Debug)]
pub struct Cylindricity;

impl Characteristic for Cylindricity {
    fn word(&self) -> &'static str {
        "cylindricity"
    }
    fn symbol(&self) -> &'static str {
        "⌭"
    }
    fn standard(&self) -> &'static str {
        "ISO 1101:2017, 17.5; ISO 12180-1:2011"
    }
    fn keys(&self) -> &'static [&'static str] {
        &["tolerance", "method"]
    }
    fn check(&self, q: &Question) -> Result<(), Refusal> {
        q.class(&[Class::Cylinder]).map(|_| ())
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        let feature = m.feature();
        Ok(feature.form(&feature.refitted(Kind::Cylinder, m.spec.form, m.progress)?))
    }
}
