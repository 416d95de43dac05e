//! Profile of a surface: ISO 1101:2017, 17.8; ISO 1660. ASME Y14.5-2018, section 11, agrees for equally disposed zones.

use super::kind::{Characteristic, Measuring, Question, Refusal, refuse};
use super::located::frame;
use super::value::{Missing, Value};
use crate::plan::Class;
use trueness_geom::feature::Nominal;
use trueness_geom::rigid::Rigid;
use trueness_geom::space::{Point, Vector};
use trueness_geom::zone::datum::Freedom;
use trueness_geom::zone::motion::{Search, placed};

/// Twice the greatest distance of the points from the theoretically exact surface: the width of the zone that lies evenly
/// about it. Without datums the surface may lie anywhere, and the least over all motions near the nominal place is the value;
/// a frame holds it where the plan says.
#[derive(Debug)]
pub struct SurfaceProfile;

impl Characteristic for SurfaceProfile {
    fn word(&self) -> &'static str {
        "surface-profile"
    }
    fn symbol(&self) -> &'static str {
        "⌓"
    }
    fn standard(&self) -> &'static str {
        "ISO 1101:2017, 17.8; ISO 1660:2017"
    }
    fn keys(&self) -> &'static [&'static str] {
        &["tolerance", "frame"]
    }
    fn check(&self, q: &Question) -> Result<(), Refusal> {
        q.class(&[Class::Plane, Class::Cylinder, Class::Cone, Class::Sphere])?;
        if !q.feature()?.has_nominal() {
            return refuse("feature", "its feature needs `nominal`, the theoretically exact surface");
        }
        Ok(())
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        let feature = m.feature();
        let Some(surface) = feature.nominal.as_ref().and_then(Nominal::surface) else {
            return Err(Missing::Impossible("the feature has no theoretically exact surface".into()));
        };
        let (start, free) = match m.spec.frame {
            Some(_) => frame(m)?,
            None => (Rigid::IDENTITY, Freedom::ALL),
        };
        let distance = |_: usize, p: Point| -> Option<(f64, Vector)> { surface.distance(p) };
        let points = feature.taken()?;
        let search = Search { start, free, middle: 0.0, floating: false, outer: false };
        let found = placed(points, &distance, &search, m.progress)?;
        Ok(Value {
            value: 2.0 * found.half,
            witness: vec![points[found.max.1], points[found.min.1]],
            parts: vec![("max", found.max.0), ("min", found.min.0)],
            ..Value::default()
        })
    }
}
