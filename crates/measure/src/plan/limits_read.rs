//! Reading what is allowed: limits that no part could keep, or that say another thing than they seem to, are refused.

use super::checker::Checker;
use crate::characteristic::{Allowed, Characteristic};
use crate::requirement::Limits;
use std::ops::Range;
use trueness_document::plan::{At, CharacteristicText, PlanError};

/// A limit is meant as a size, not as a deviation, where the limits so read lie so many times nearer to the nominal value: no tolerance of a
/// drawing is a quarter of its size wide on purpose and as narrow as that by chance.
const SIZE_READING_RATIO: f64 = 4.0;

/// A number in the unit of the kind's values: angles and ratios are not lengths.
pub(super) fn number(checker: &Checker, at: &At<f64>, unit: &str, what: &str) -> Result<f64, PlanError> {
    in_unit(checker, unit).not_negative(at, what)
}

/// The checker for values in this unit.
fn in_unit<'a>(checker: &Checker<'a>, unit: &str) -> Checker<'a> {
    Checker { text: checker.text, unit: if unit == "mm" { checker.unit } else { 1.0 } }
}

pub(super) fn limits(
    checker: &Checker,
    w: &CharacteristicText,
    whole: &Range<usize>,
    kind: &dyn Characteristic,
    unit: &str,
) -> Result<Limits, PlanError> {
    let word = kind.word();
    match kind.allowed() {
        Allowed::Greatest => {
            if let Some([_, t]) = by_class(checker, w, kind, 0.0, ["tolerance"])? {
                return Ok(Limits::Greatest(t));
            }
            let Some(t) = &w.tolerance else {
                return checker
                    .wrong(whole, format!("{word} needs `tolerance`; add it, as in tolerance = 0.05"));
            };
            let width = number(checker, t, unit, "the tolerance")?;
            // A ratio may be 0, and with a material requirement the size gives the room.
            if width == 0.0 && unit != "1" && w.material.is_none() {
                let what = "the tolerance is 0, which no part keeps; give the width or diameter of the zone, above 0 (0 goes with `material`)";
                return checker.wrong(&t.span, what);
            }
            Ok(Limits::Greatest(width))
        }
        Allowed::Between => between(checker, w, whole, kind, unit),
    }
}

fn between(
    checker: &Checker,
    w: &CharacteristicText,
    whole: &Range<usize>,
    kind: &dyn Characteristic,
    unit: &str,
) -> Result<Limits, PlanError> {
    let word = kind.word();
    let signed = in_unit(checker, unit);
    let Some(nominal) = &w.nominal else {
        return checker.wrong(whole, format!("{word} needs `nominal`, `upper` and `lower`"));
    };
    let middle = signed.length(nominal, "the nominal value")?;
    if unit == "deg" && !(0.0..=90.0).contains(&nominal.value) {
        let folded = nominal.value.rem_euclid(180.0);
        let folded = folded.min(180.0 - folded);
        let what = format!(
            "the nominal angle is {}; angles are from 0 to 90 degrees, and this one is {} there",
            nominal.value,
            (folded * 1e9).round() / 1e9
        );
        return checker.wrong(&nominal.span, what);
    }
    if let Some([lower, upper]) = by_class(checker, w, kind, middle, ["upper", "lower"])? {
        return Ok(Limits::Between { nominal: middle, lower, upper });
    }
    let (Some(upper), Some(lower)) = (&w.upper, &w.lower) else {
        return checker.wrong(whole, format!("{word} needs `nominal`, `upper` and `lower`"));
    };
    let (l, u) = (
        signed.length(lower, "the lower limit deviation")?,
        signed.length(upper, "the upper limit deviation")?,
    );
    let (written, is_lower) = ([lower.value, upper.value], |meant: &[f64; 2]| meant[1] == upper.value);
    if let Some(meant) = absolute(nominal.value, written) {
        let span = if is_lower(&meant) { &lower.span } else { &upper.span };
        let [from, to] = written.map(|x| short(nominal.value + x));
        let what = format!(
            "upper and lower are deviations from the nominal value: {from} to {to} would be allowed; write upper = {}, lower = {}",
            short(meant[1]),
            short(meant[0])
        );
        return checker.wrong(span, what);
    }
    if unit == "mm" && middle > 0.0 && middle + l < 0.0 {
        let what = format!(
            "the lower limit is {}, below 0: {} beside a nominal value of {} is in another unit, or meant as a size",
            short(nominal.value + lower.value),
            lower.value,
            nominal.value
        );
        return checker.wrong(&lower.span, what);
    }
    if l > u {
        let what =
            format!("the lower limit deviation {} is above the upper one {}", lower.value, upper.value);
        return checker.wrong(&lower.span, what);
    }
    if l == u {
        let x = lower.value.abs();
        let remedy = match x > 0.0 {
            true => format!("write upper = {x}, lower = -{x}"),
            false => "give deviations that leave some room, as in upper = 0.1, lower = -0.1".into(),
        };
        let what = format!("both limit deviations are {}, which no part keeps; {remedy}", lower.value);
        return checker.wrong(&lower.span, what);
    }
    Ok(Limits::Between { nominal: middle, lower: l, upper: u })
}

/// The limit deviations that are meant, where some are written as sizes; lower and upper.
fn absolute(nominal: f64, [lower, upper]: [f64; 2]) -> Option<[f64; 2]> {
    let extent = |[l, u]: [f64; 2]| l.abs().max(u.abs());
    let (l, u) = (lower - nominal, upper - nominal);
    let own = extent([lower, upper]);
    [[l, u], [lower, u], [l, upper]]
        .into_iter()
        .find(|meant| nominal > 0.0 && meant[0] < meant[1] && SIZE_READING_RATIO * extent(*meant) <= own)
}

/// Without the digits of a difference that rounding made.
fn short(x: f64) -> f64 {
    (x * 1e9).round() / 1e9
}

/// Limit deviations by a tolerance class, where the plan gives one in place of the keys `instead`.
fn by_class<const N: usize>(
    checker: &Checker,
    w: &CharacteristicText,
    kind: &dyn Characteristic,
    nominal: f64,
    instead: [&str; N],
) -> Result<Option<[f64; 2]>, PlanError> {
    let (Some(class), Some(table)) = (&w.class, kind.class_table()) else {
        return match &w.length {
            Some(length) => checker.wrong(&length.span, "`length` goes with `class`"),
            None => Ok(None),
        };
    };
    let given = [("tolerance", &w.tolerance), ("upper", &w.upper), ("lower", &w.lower)];
    let given = given.into_iter().filter_map(|(key, at)| Some((key, at.as_ref()?)));
    if let Some((key, at)) = given.into_iter().find(|(key, _)| instead.contains(key)) {
        return checker.wrong(&at.span, format!("give `class` or `{key}`, not both"));
    }
    let length = match &w.length {
        Some(length) if !table.takes_length() => {
            return checker.wrong(&length.span, "the class of this kind goes by no length");
        }
        Some(length) => Some(checker.not_negative(length, "the length")?),
        None => None,
    };
    let limits = table.limits(&class.value, nominal, length);
    limits.map(Some).or_else(|e| checker.wrong(&class.span, e.to_string()))
}

#[cfg(test)]
mod tests {
    use super::absolute;

    /// Limits as sizes are told from deviations, whatever the nominal value; narrow sizes with wide deviations are left alone.
    #[test]
    fn limits_as_sizes_are_told_from_deviations() {
        for (nominal, written, meant) in [
            (10.0, [9.95, 10.05], Some([-0.05, 0.05])),
            (10.0, [10.01, 10.05], Some([0.01, 0.05])),
            (10.0, [-0.05, 10.05], Some([-0.05, 0.05])),
            (10.0, [9.95, 0.05], Some([-0.05, 0.05])),
            (90.0, [89.5, 90.5], Some([-0.5, 0.5])),
            (10.0, [-0.05, 0.05], None),
            (10.0, [0.01, 0.05], None),
            (0.1, [0.0, 0.1], None),
            (0.1, [-0.1, 0.1], None),
            (1.0, [-1.0, 1.0], None),
            (0.0, [-0.1, 0.1], None),
            (0.0, [0.0, 0.1], None),
        ] {
            let found = absolute(nominal, written).map(|m| m.map(|x| (x * 1e9).round() / 1e9));
            assert_eq!(found, meant, "{nominal} {written:?}");
        }
    }
}
