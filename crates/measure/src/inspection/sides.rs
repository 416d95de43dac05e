//! Tolerance classes on features whose side of the material is known.

use super::stop::Stop;
use crate::characteristic::{Characteristic, MeasuredFeature, Size, Spec};
use crate::plan::Plan;
use trueness_document::tolerance_class::wrong_side;
use trueness_geom::space::{dot, minus};
use trueness_geom::zone::mean;

/// Refuses classes of shafts on holes and of holes on shafts.
///
/// # Errors
/// [`Stop::Plan`]: the first of them.
pub(super) fn checked(plan: &Plan, features: &[MeasuredFeature]) -> Result<(), Stop> {
    for spec in plan.specs.iter().filter(|s| s.kind.word() == Size.word()) {
        let Some(class) = &spec.class else { continue };
        let of: Vec<&MeasuredFeature> = spec.features.iter().map(|n| &features[*n]).collect();
        let Some(internal) = internal(&of) else { continue };
        let names: Vec<&str> = of.iter().map(|t| t.id.as_str()).collect();
        if let Some(what) = wrong_side(class, internal, &names.join(" – ")) {
            return Err(Stop::Plan { span: span(spec), what: format!("size: {what}") });
        }
    }
    Ok(())
}

fn span(spec: &Spec) -> std::ops::Range<usize> {
    spec.class_span.clone()
}

/// Whether the material is around a feature, or beside both of two planes; `None` where that is not known.
fn internal(of: &[&MeasuredFeature]) -> Option<bool> {
    match of {
        [one] => one.inward,
        [a, b] => {
            let (out, back) = (a.outward?, b.outward?);
            let (first, second) = (a.own_points().ok()?, b.own_points().ok()?);
            let way = minus(mean(second), mean(first));
            let [from, to] = [dot(out, way), -dot(back, way)];
            (from * to > 0.0).then_some(from > 0.0)
        }
        _ => None,
    }
}
