//! The datum system of a characteristic, from the measured datum features.

use super::kind::Measuring;
use super::measured_feature::MeasuredFeature;
use super::reason::{Impossible, NotMeasured};
use super::value::Missing;
use trueness_document::plan::Class;
use trueness_geom::fit::Method;
use trueness_geom::rigid::Rigid;
use trueness_geom::shape::Kind;
use trueness_geom::space::{dot, minus, times};
use trueness_geom::zone::datum::{Datum, DatumError, Freedom, Rule, Source, System};
use trueness_geom::zone::mean;

/// The frame in which true places are given, and what it leaves free: that of the datums, or the one that the plan gives.
pub(crate) fn frame(m: &Measuring) -> Result<(Rigid, Freedom), Missing> {
    match m.spec.frame {
        Some(frame) => Ok((frame, Freedom::NONE)),
        None => system(m).map(|s| (s.frame, s.free)),
    }
}

/// The only datum.
pub(super) fn single(m: &Measuring) -> Result<Datum, Missing> {
    let none = || Impossible::NoDatum.into();
    if let Some([first]) = m.datums.first().map(Vec::as_slice)
        && first.class == Class::Sphere
        && first.derived_datum()?.is_none()
    {
        let method = match m.spec.datum_rule {
            Rule::Gaussian => Method::Gaussian,
            Rule::MinimumZone => Method::MinimumZone,
        };
        let shape = first.refitted(Kind::Sphere, method, m.progress)?.shape;
        let center = shape.center().ok_or(NotMeasured::NoDatumCenter)?;
        return Ok(Datum::Point(center));
    }
    system(m)?.datums.first().copied().ok_or_else(none)
}

/// The system of all datums.
pub(super) fn system(m: &Measuring) -> Result<System, Missing> {
    if let [only] = m.datums
        && let [only] = only.as_slice()
        && let Some(datum) = only.derived_datum()?
    {
        return Ok(System::of(&[datum])?);
    }
    let mut sources: Vec<Vec<Source>> = Vec::with_capacity(m.datums.len());
    for datum in m.datums {
        let features = datum.iter().map(|f| datum_source(f, m.feature()));
        sources.push(features.collect::<Result<_, _>>()?);
    }
    let associated =
        System::associated(&sources, m.spec.datum_rule, m.progress).and_then(|system| faced(m, system));
    associated.map_err(|e| match (e.into(), e) {
        (_, DatumError::Across { .. } | DatumError::Oblique { .. })
            if m.spec.kind.keys().contains(&"frame") =>
        {
            NotMeasured::DatumOrFrame(e).into()
        }
        (missing, _) => missing,
    })
}

/// The system whose first axis goes the way that the model's does: an axis has no sense of its own.
fn faced(m: &Measuring, system: System) -> Result<System, DatumError> {
    let nominal = m.datums.first().and_then(|d| d.first()?.nominal.as_ref()?.direction());
    match (system.datums.first(), nominal) {
        (Some(Datum::Axis { point, direction }), Some(nominal)) if dot(*direction, nominal) < 0.0 => {
            let mut datums = system.datums.clone();
            datums[0] = Datum::Axis { point: *point, direction: times(-1.0, *direction) };
            System::of(&datums)
        }
        _ => Ok(system),
    }
}

/// The points of a datum feature. A plane that does not say where its material is has it on the side of the toleranced
/// feature.
pub fn datum_source<'a>(
    datum: &'a MeasuredFeature,
    toleranced: &MeasuredFeature,
) -> Result<Source<'a>, Missing> {
    let points = datum.own_points()?;
    let kind = match datum.class {
        Class::Plane => Kind::Plane,
        Class::Cylinder => Kind::Cylinder,
        Class::Cone => Kind::Cone,
        Class::Sphere => Kind::Sphere,
        Class::Point | Class::Line | Class::Circle | Class::Torus => Kind::Line,
    };
    let away = || minus(mean(points), mean(&toleranced.points));
    Ok(Source { points, kind, outward: datum.outward.unwrap_or_else(away) })
}
