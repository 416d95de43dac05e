//! Material requirements of a plan: the boundary that each sets (ISO 2692:2021).

use super::checker::Checker;
use crate::characteristic::{Characteristic, Size, Spec};
use crate::requirement::{Boundary, Feature, Limits};
use std::ops::Range;
use trueness_document::plan::{Class, MaterialWord, PlanError, PlanText};

/// The boundaries of all characteristics, once all are known: the limits of size stand in one characteristic, the
/// geometrical tolerance of a datum feature in another.
pub(super) fn resolve(
    checker: &Checker,
    written: &PlanText,
    features: &[Feature],
    specs: &mut [Spec],
) -> Result<(), PlanError> {
    let mut found = Vec::with_capacity(specs.len());
    for (spec, at) in specs.iter().zip(&written.characteristic) {
        let own = match (&at.value.material, spec.features.as_slice()) {
            (Some(material), [feature]) => {
                Some(boundary(checker, *feature, material.value, &material.span, features, specs)?)
            }
            _ => None,
        };
        let mut datums = Vec::with_capacity(spec.datums.len());
        for (n, datum) in spec.datums.iter().enumerate() {
            let span = at.value.datums.as_ref().and_then(|d| Some(&d.value.get(n)?.span)).unwrap_or(&at.span);
            datums.push(match (datum.material, datum.features.as_slice()) {
                (None, _) => None,
                (Some(word), [feature]) => {
                    let boundary = boundary(checker, *feature, word, span, features, specs)?;
                    let tolerance = own_tolerance(spec, n, *feature, word, specs);
                    Some(Boundary { size: boundary.virtual_size(tolerance), ..boundary })
                }
                (Some(_), _) => {
                    let what = "a material requirement on a common datum is not built yet";
                    return checker.wrong(span, what);
                }
            });
        }
        found.push((own, datums));
    }
    for (spec, (own, datums)) in specs.iter_mut().zip(found) {
        spec.boundary = own;
        for (datum, boundary) in spec.datums.iter_mut().zip(datums) {
            datum.boundary = boundary;
        }
    }
    Ok(())
}

/// The geometrical tolerance that adds to the virtual condition of a datum feature: one with the same requirement, to the
/// datums that stand before it (ISO 2692:2021); else 0.
fn own_tolerance(spec: &Spec, place: usize, feature: usize, word: MaterialWord, specs: &[Spec]) -> f64 {
    let before = || spec.datums[..place].iter().map(|d| &d.features);
    let of = specs.iter().find(|s| {
        s.features == [feature]
            && s.material == Some(word)
            && s.datums.len() == place
            && s.datums.iter().map(|d| &d.features).eq(before())
    });
    match of.map(|s| s.limits) {
        Some(Limits::Greatest(t)) => t,
        _ => 0.0,
    }
}

fn boundary(
    checker: &Checker,
    feature: usize,
    word: MaterialWord,
    span: &Range<usize>,
    features: &[Feature],
    specs: &[Spec],
) -> Result<Boundary, PlanError> {
    let Feature { id, class, internal, .. } = &features[feature];
    if *class != Class::Cylinder {
        let what =
            format!("feature \"{id}\" is a {}; a material requirement is for cylinders here", class.word());
        return checker.wrong(span, what);
    }
    let Some(internal) = *internal else {
        let what = format!(
            "of feature \"{id}\" it is not said on which side its material is; give it `internal = true` (a bore) or \
             `internal = false` (a shaft)"
        );
        return checker.wrong(span, what);
    };
    let sizes = specs.iter().filter(|s| s.kind.word() == Size.word() && s.features == [feature]);
    let mut limits: Option<(f64, f64)> = None;
    for size in sizes {
        let (lower, upper) = size.limits.range();
        let own = (lower.unwrap_or(0.0), upper);
        if limits.is_some_and(|l| l != own) {
            let what =
                format!("feature \"{id}\" has sizes with different limits; which are meant is not clear");
            return checker.wrong(span, what);
        }
        limits = Some(own);
    }
    let Some((lower, upper)) = limits else {
        let what = format!(
            "it goes by the limits of size of feature \"{id}\"; add a characteristic of kind \"size\""
        );
        return checker.wrong(span, what);
    };
    // Most material: the smallest bore, the largest shaft.
    let most = word == MaterialWord::M;
    let size = if internal == most { lower } else { upper };
    Ok(Boundary { word, around: internal != most, size })
}
