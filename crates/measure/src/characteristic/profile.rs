//! What the profiles of a line and of a surface have in common: the zone about a theoretically exact geometry.

use super::exact::beside_nominal;
use super::kind::{Measuring, Question, Refusal, refuse};
use super::located::frame;
use super::reason::Impossible;
use super::value::{Missing, Value};
use crate::requirement::ZoneOffset;
use trueness_document::plan::Class;
use trueness_geom::feature::{Nominal, NominalSurface};
use trueness_geom::rigid::Rigid;
use trueness_geom::zone::datum::Freedom;
use trueness_geom::zone::motion::{Placed, Search};

/// Refuses features without a theoretically exact surface, and offsets of which it is not known what is out of the material.
pub(super) fn check(q: &Question) -> Result<(), Refusal> {
    let class = q.class(&[Class::Plane, Class::Cylinder, Class::Cone, Class::Sphere])?;
    let feature = q.feature()?;
    if !feature.has_nominal() {
        return refuse("feature", "its feature needs `nominal`, the theoretically exact surface");
    }
    if matches!(q.spec.offset, ZoneOffset::By(_)) && class != Class::Plane && feature.internal.is_none() {
        let what = "an offset is counted out of the material; give its feature `internal = true` (a bore) or `internal = false`";
        return refuse("offset", what);
    }
    Ok(())
}

/// The theoretically exact surface.
pub(super) fn surface(m: &Measuring) -> Result<NominalSurface, Missing> {
    let nominal = m.feature().nominal.as_ref();
    let none = || Impossible::NoExactSurface.into();
    nominal.and_then(Nominal::surface).ok_or_else(none)
}

/// The search for the least zone: held by the frame where the plan gives one, else with these motions about the nominal place.
pub(super) fn search(m: &Measuring, without_frame: Freedom) -> Result<Search, Missing> {
    let (start, free) = match m.spec.frame {
        Some(_) => frame(m)?,
        None => (Rigid::IDENTITY, without_frame),
    };
    // Distances grow away from the axis or center: of a bore, into the material.
    let outward = if m.feature().internal == Some(true) { -1.0 } else { 1.0 };
    let (middle, floating) = match m.spec.offset {
        ZoneOffset::None => (0.0, false),
        ZoneOffset::By(offset) => (outward * offset, false),
        ZoneOffset::Free => (0.0, true),
    };
    Ok(Search { start, free, middle, floating, outer: false })
}

/// The value of a zone that was found: its width.
pub(super) fn value(m: &Measuring, found: &Placed, at: impl Fn(usize) -> usize) -> Result<Value, Missing> {
    let points = m.feature().own_points()?;
    Ok(Value {
        value: 2.0 * found.half,
        witness: vec![points[at(found.max.1)], points[at(found.min.1)]],
        parts: vec![("max", found.max.0), ("min", found.min.0)],
        place: beside_nominal(m),
        ..Value::default()
    })
}
