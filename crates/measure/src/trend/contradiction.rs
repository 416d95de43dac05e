//! What no inspection writes: the document was changed since.

use std::collections::BTreeSet;
use trueness_document::inspect::{CharacteristicRecord, Counts, InspectDocument, ZoneForm};
use trueness_document::{UNITS, Verdict, overall};

/// Units of values.
const VALUE_UNITS: [&str; 3] = ["mm", "deg", "1"];

/// The first thing in which a result contradicts itself.
pub(super) fn contradiction(result: &InspectDocument) -> Option<String> {
    if result.units != UNITS {
        return Some(format!("its units are \"{}\", not \"{UNITS}\"", result.units));
    }
    let mut known = BTreeSet::new();
    let all = &result.characteristics;
    if let Some(c) = all.iter().find(|c| !known.insert(&c.id)) {
        return Some(format!("it has two characteristics \"{}\"", c.id));
    }
    if let Some((c, what)) = all.iter().find_map(|c| Some((c, wrong(c).or_else(|| misjudged(c))?))) {
        return Some(format!("characteristic \"{}\" has {what}", c.id));
    }
    let count = |verdict| all.iter().filter(|c| c.verdict == verdict).count() as u64;
    let counted = Counts {
        pass: count(Verdict::Pass),
        fail: count(Verdict::Fail),
        undecided: count(Verdict::Undecided),
        not_measured: count(Verdict::NotMeasured),
    };
    if result.counts != counted {
        return Some("its counts are not those of its characteristics".into());
    }
    if !result.verdict_reasons.is_empty() {
        let own = result.verdict;
        let what = || format!("its verdict is \"{}\", but there are reasons for \"undecided\"", own.word());
        return (own != Verdict::Undecided).then(what);
    }
    let deviations = result.deviation.as_ref().and_then(|d| d.verdict);
    let unreliable = result.alignment.doubts().next().map(|_| Verdict::Undecided);
    let worst = overall(all.iter().map(|c| c.verdict).chain(deviations).chain(unreliable));
    (result.verdict != worst).then(|| {
        let [own, worst] = [result.verdict, worst].map(Verdict::word);
        format!("its verdict is \"{own}\", but the worst in it is \"{worst}\"")
    })
}

/// A number or unit that a characteristic cannot have.
fn wrong(c: &CharacteristicRecord) -> Option<String> {
    if !VALUE_UNITS.contains(&c.unit.as_str()) {
        return Some(format!("the unit \"{}\", not {}", c.unit, VALUE_UNITS.join(", ")));
    }
    if let Some(lower) = c.lower.filter(|l| *l > c.upper) {
        return Some(format!("the lower limit {lower} above the upper one {}", c.upper));
    }
    if let Some(value) = c.value.filter(|v| *v < -hair(*v) && *c.zone != ZoneForm::Value) {
        return Some(format!("the value {value}, but no zone is narrower than 0"));
    }
    if let Some(u) = c.uncertainty.filter(|u| *u < 0.0) {
        return Some(format!("the negative uncertainty {u}"));
    }
    let [from, to] = c.interval.filter(|[from, to]| from > to)?;
    Some(format!("an interval from {from} to {to}, which ends before it begins"))
}

/// A verdict that does not go with value and limits.
fn misjudged(c: &CharacteristicRecord) -> Option<String> {
    let what = match (c.verdict, c.value) {
        (Verdict::NotMeasured, None) => return None,
        (_, None) => "without a value",
        (Verdict::NotMeasured, Some(_)) => "with a value",
        (verdict, Some(x)) => {
            let [lower, upper] = [c.lower.map_or(f64::INFINITY, |l| x - l), c.upper - x];
            match verdict {
                Verdict::Pass if lower.min(upper) < -hair(x) => "with a value beyond its limits",
                Verdict::Fail if lower.min(upper) > hair(x) => "with a value within its limits",
                _ => return None,
            }
        }
    };
    Some(format!("the verdict \"{}\" {what}", c.verdict.word()))
}

/// What rounding does to a value: limits in degrees are rounded on their own.
fn hair(x: f64) -> f64 {
    1e-9 * x.abs().max(1e-3)
}
