//! The value of a characteristic.

use super::stop::Stop;
use crate::characteristic::{MeasuredFeature, Measuring, Missing, NotMeasured, Spec, Value};
use trueness_geom::progress::Progress;

/// The value of a characteristic, or why there is none.
pub(super) fn measured(
    spec: &Spec,
    features: &[MeasuredFeature],
    progress: &dyn Progress,
) -> Result<Result<Value, NotMeasured>, Stop> {
    let of = |numbers: &[usize]| -> Vec<&MeasuredFeature> { numbers.iter().map(|n| &features[*n]).collect() };
    let own = of(&spec.features);
    let datums: Vec<Vec<&MeasuredFeature>> = spec.datums.iter().map(|d| of(&d.features)).collect();
    let measuring = Measuring { spec, features: &own, datums: &datums, progress };
    match spec.kind.measure(&measuring) {
        Ok(value) if value.value.is_finite() => Ok(Ok(value)),
        Ok(_) => Ok(Err(NotMeasured::NoNumber)),
        Err(Missing::NotMeasured(reason)) => Ok(Err(reason)),
        Err(Missing::Cancelled) => Err(Stop::Cancelled),
        Err(Missing::Impossible(what)) => {
            let what = format!("characteristic \"{}\": {what}", spec.id);
            Err(Stop::Plan { span: spec.span.clone(), what })
        }
    }
}
