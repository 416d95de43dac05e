//! Coaxiality and concentricity: ISO 1101:2017, 17.14. ASME Y14.5-2018 has position instead.

use super::kind::{Characteristic, Measuring, Question, Refusal, WITH_AXIS};
use super::located::single;
use super::reason::Impossible;
use super::value::{Missing, Value};
use trueness_document::plan::Class;
use trueness_geom::space::{cross, minus, norm};
use trueness_geom::zone::datum::Datum;

/// Twice the greatest distance of the feature's axis (both ends of the associated axis over the extent of the points; of a
/// line, all its points; of a circle, sphere or point, its center) from the datum axis.
#[derive(Debug)]
pub struct Coaxiality;

impl Characteristic for Coaxiality {
    fn word(&self) -> &'static str {
        "coaxiality"
    }
    fn symbol(&self) -> &'static str {
        "◎"
    }
    fn standard(&self) -> &'static str {
        "ISO 1101:2017, 17.14"
    }
    fn keys(&self) -> &'static [&'static str] {
        &["tolerance", "datums", "datum_method"]
    }
    fn diametral(&self, _: &Question, _: bool) -> bool {
        true
    }
    fn check(&self, q: &Question) -> Result<(), Refusal> {
        q.class(&[Class::Line, Class::Cylinder, Class::Cone, Class::Circle, Class::Sphere, Class::Point])?;
        q.datum(&WITH_AXIS).map(|_| ())
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        let Datum::Axis { point, direction } = single(m)? else {
            return Err(Impossible::DatumIsNoAxis.into());
        };
        let points = m.feature().zoned()?;
        let far = points.iter().map(|p| norm(cross(minus(*p, point), direction)));
        let (at, greatest) = super::value::greatest(far)?;
        Ok(Value { value: 2.0 * greatest, witness: vec![points[at]], ..Value::default() })
    }
}
