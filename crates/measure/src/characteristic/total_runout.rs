//! Total run-out: ISO 1101:2017, 17.17. ASME Y14.5-2018, section 12, agrees.

use super::kind::{Characteristic, Measuring, Question, Refusal, WITH_AXIS, refuse};
use super::located::single;
use super::reason::Impossible;
use super::value::{Missing, Value};
use trueness_document::plan::Class;
use trueness_geom::space::{cross, dot, minus, norm};
use trueness_geom::zone::datum::Datum;

/// Of a cylinder, the range of the distances of all its points from the datum axis (radial); of a plane across the datum
/// axis, the range of their places along it (axial).
#[derive(Debug)]
pub struct TotalRunout;

impl Characteristic for TotalRunout {
    fn word(&self) -> &'static str {
        "total-runout"
    }
    fn symbol(&self) -> &'static str {
        "⌰"
    }
    fn standard(&self) -> &'static str {
        "ISO 1101:2017, 17.17"
    }
    fn keys(&self) -> &'static [&'static str] {
        &["tolerance", "datums", "datum_method", "direction"]
    }
    fn check(&self, q: &Question) -> Result<(), Refusal> {
        let class = q.class(&[Class::Cylinder, Class::Plane])?;
        if class == Class::Cylinder && q.spec.axial {
            return refuse("direction", "the total run-out of a cylinder is radial");
        }
        q.datum(&WITH_AXIS).map(|_| ())
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        reading(m, single(m)?, m.feature().class == Class::Plane)
    }
}

/// The range that an indicator reads at all points while the part turns about the datum axis.
pub(super) fn reading(m: &Measuring, datum: Datum, axial: bool) -> Result<Value, Missing> {
    let Datum::Axis { point, direction } = datum else {
        return Err(Impossible::DatumIsNoAxis.into());
    };
    let points = m.feature().own_points()?;
    let read = |p: &[f64; 3]| {
        let q = minus(*p, point);
        if axial { dot(q, direction) } else { norm(cross(q, direction)) }
    };
    let (high, most) = super::value::greatest(points.iter().map(read))?;
    let (low, least) = super::value::greatest(points.iter().map(|p| -read(p)))?;
    Ok(Value { value: most + least, witness: vec![points[high], points[low]], ..Value::default() })
}
