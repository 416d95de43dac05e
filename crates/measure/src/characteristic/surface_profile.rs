//! Profile of a surface: ISO 1101:2017, 17.8; ISO 1660. ASME Y14.5-2018, section 11, agrees for equally disposed zones.

use super::kind::{Characteristic, Measuring, Question, Refusal};
use super::profile::{check, search, surface, value};
use super::value::{Missing, Value};
use trueness_geom::space::{Point, Vector};
use trueness_geom::zone::datum::Freedom;
use trueness_geom::zone::motion::placed;

/// The width of the zone that lies evenly about the theoretically exact surface: twice the greatest distance of the points from
/// it. With an offset the zone lies about that offset (UZ), or about the one that makes it narrowest (OZ). Without datums the
/// surface may lie anywhere, and the least over all motions near the nominal place is the value; a frame holds it where the
/// plan says.
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
        &["tolerance", "frame", "offset"]
    }
    fn check(&self, q: &Question) -> Result<(), Refusal> {
        check(q)
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        let surface = surface(m)?;
        let distance = |_: usize, p: Point| -> Option<(f64, Vector)> { surface.distance(p) };
        let found = placed(m.feature().own_points()?, &distance, &search(m, Freedom::ALL)?, m.progress)?;
        value(m, &found, |i| i)
    }
}
