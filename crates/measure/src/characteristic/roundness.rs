//! Roundness: ISO 1101:2017, 17.4; ISO 12181-1. ASME Y14.5-2018, 8.4.3 (circularity) agrees.

use super::kind::{Characteristic, Measuring, Question, Refusal};
use super::value::{Missing, Value};
use trueness_document::plan::Class;

/// The difference of radius of the two nearest concentric circles that hold the profile of one section between them. The
/// profile lies in the section plane: points in space are projected onto their least-squares plane.
#[derive(Debug)]
pub struct Roundness;

impl Characteristic for Roundness {
    fn word(&self) -> &'static str {
        "roundness"
    }
    fn symbol(&self) -> &'static str {
        "○"
    }
    fn standard(&self) -> &'static str {
        "ISO 1101:2017, 17.4; ISO 12181-1:2011"
    }
    fn keys(&self) -> &'static [&'static str] {
        &["tolerance", "method"]
    }
    fn check(&self, q: &Question) -> Result<(), Refusal> {
        q.class(&[Class::Circle]).map(|_| ())
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        let feature = m.feature();
        Ok(feature.form(&feature.profile(m.spec.form, m.progress)?))
    }
}
