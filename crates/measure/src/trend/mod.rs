//! One plan over many parts: from their results to the course of each characteristic.

mod contradiction;
mod deviation;
mod map;

pub use map::{map, mesh};

use std::collections::BTreeSet;
use trueness_document::inspect::{CharacteristicRecord, Counts, InspectDocument};
use trueness_document::place_map::{PlaceMap, TrendMap};
use trueness_document::trend::{
    Control, IndexRecord, OutOfControl, PartRecord, ResultInput, RuleRecord, SCHEMA, TrendDocument,
    TrendError, TrendRecord,
};
use trueness_document::{UNITS, VERSION, Verdict, overall};
use trueness_geom::stats::process::{ControlChart, Index, Rule, Signal};

/// Confidence of the intervals.
const CONFIDENCE: f64 = 0.95;

/// The trend of results, in the order of their making; `inputs` are their files.
///
/// # Errors [`TrendError`]: no results, one given twice (by the SHA-256 of its file), one that contradicts itself. Characteristics are
/// missing, or not the same as in the first result.
pub fn document(inputs: Vec<ResultInput>, results: &[InspectDocument]) -> Result<TrendDocument, TrendError> {
    let first = results.first().ok_or(TrendError::None)?;
    for (index, input) in inputs.iter().enumerate() {
        let same = |i: &ResultInput| i.sha256.is_some() && i.sha256 == input.sha256;
        if let Some(first) = inputs[..index].iter().position(same) {
            return Err(TrendError::Twice { index, first });
        }
    }
    for (index, result) in results.iter().enumerate() {
        if let Some(what) = contradiction::contradiction(result) {
            return Err(TrendError::Changed { index, what });
        }
    }
    for (index, other) in results.iter().enumerate().skip(1) {
        if let Some(what) = difference(first, other) {
            return Err(TrendError::Different { index, what });
        }
    }
    let (map, map_reason) = map_of(results)?;
    let mut warnings = Vec::new();
    let texts = |d: &InspectDocument| d.plan.sha256.clone();
    if results.iter().any(|d| texts(d).is_some() && texts(first).is_some() && texts(d) != texts(first)) {
        warnings.push("the plans are not the same text, but their characteristics are the same".into());
    }
    let own = |d: &InspectDocument| d.inputs.first().map(|i| i.path.clone());
    let distinct: BTreeSet<Option<String>> = results.iter().map(own).collect();
    let name = |(n, d): (usize, &InspectDocument)| {
        let of_result = inputs.get(n).map(|i| i.path.clone());
        let name = if distinct.len() == results.len() { own(d).or(of_result) } else { of_result };
        let deviation = d.deviation.as_ref().and_then(|c| c.verdict);
        PartRecord { name: name.unwrap_or_default(), verdict: d.verdict, deviation }
    };
    let parts: Vec<PartRecord> = results.iter().enumerate().map(name).collect();
    let records = (0..first.characteristics.len()).map(|n| {
        let of: Vec<&CharacteristicRecord> = results.iter().map(|d| &d.characteristics[n]).collect();
        record(&of)
    });
    let characteristics: Vec<TrendRecord> = records.chain(deviation::records(results)?).collect();
    Ok(TrendDocument {
        schema: SCHEMA.into(),
        version: VERSION.into(),
        units: UNITS.into(),
        title: first.title.clone(),
        in_control: characteristics.iter().all(|c| c.out_of_control.is_empty()),
        verdict: overall(parts.iter().map(|p| p.verdict)),
        inputs,
        parts,
        warnings,
        confidence: CONFIDENCE,
        characteristics,
        map,
        map_reason,
    })
}

/// The map over all parts, or why there is none.
fn map_of(results: &[InspectDocument]) -> Result<(Option<TrendMap>, Option<String>), TrendError> {
    if let Some(n) = results.iter().position(|d| d.deviation_map.is_none()) {
        let what = "holds no deviations at places; `trueness inspect --places --json` writes them";
        return Ok((None, Some(format!("result {} of {} {what}", n + 1, results.len()))));
    }
    let maps: Vec<&PlaceMap> = results.iter().filter_map(|d| d.deviation_map.as_ref()).collect();
    let tolerance = results.first().and_then(|d| d.scale.as_ref()?.tolerance);
    let found = map::map(&maps, tolerance).map_err(|index| TrendError::Different {
        index,
        what: "its places are not those of the first result: the reference is another".into(),
    });
    Ok((found?, None))
}

/// What distinguishes the characteristics of a result from those of the first one.
fn difference(first: &InspectDocument, other: &InspectDocument) -> Option<String> {
    let ids =
        |d: &InspectDocument| -> Vec<String> { d.characteristics.iter().map(|c| c.id.clone()).collect() };
    let (here, there) = (ids(other), ids(first));
    if let Some(id) = there.iter().find(|id| !here.contains(id)) {
        return Some(format!("characteristic \"{id}\" of the first result is missing"));
    }
    if let Some(id) = here.iter().find(|id| !there.contains(id)) {
        return Some(format!("characteristic \"{id}\" is not in the first result"));
    }
    if here != there {
        return Some("the characteristics stand in another order than in the first result".into());
    }
    other.characteristics.iter().zip(&first.characteristics).find_map(|(c, f)| {
        let number = |x: Option<f64>| x.map_or_else(|| "none".into(), |x| x.to_string());
        // The greatest allowed value of a material requirement is that of each part; its tolerance is the plan's.
        let upper = |c: &CharacteristicRecord| if c.tolerance.is_some() { None } else { Some(c.upper) };
        let facts = [
            ("kind", c.kind.clone(), f.kind.clone()),
            ("feature", c.feature.clone(), f.feature.clone()),
            ("list of datums", c.datums.join(" "), f.datums.join(" ")),
            ("list of modifiers", c.modifiers.join(", "), f.modifiers.join(", ")),
            ("unit", c.unit.clone(), f.unit.clone()),
            ("nominal value", number(c.nominal), number(f.nominal)),
            ("tolerance", number(c.tolerance), number(f.tolerance)),
            ("lower limit", number(c.lower), number(f.lower)),
            ("upper limit", number(upper(c)), number(upper(f))),
        ];
        let (what, here, there) = facts.into_iter().find(|(_, a, b)| a != b)?;
        Some(format!("characteristic \"{}\": its {what} is {here}, in the first result {there}", c.id))
    })
}

/// One characteristic, of all parts in their order.
fn record(of: &[&CharacteristicRecord]) -> TrendRecord {
    let first = of[0];
    let values: Vec<Option<f64>> = of.iter().map(|c| c.value).collect();
    let places: Vec<usize> = (0..of.len()).filter(|n| values[*n].is_some()).collect();
    let there: Vec<f64> = values.iter().flatten().copied().collect();
    let count = |verdict| of.iter().filter(|c| c.verdict == verdict).count() as u64;
    let own_limits = of.iter().any(|c| c.upper != first.upper);
    let upper = Some(first.upper).filter(|_| !own_limits);
    let chart = ControlChart::of(&there);
    let capability = match (&chart, upper) {
        (Some(chart), Some(_)) => chart.capability(first.lower, upper, CONFIDENCE),
        _ => Default::default(),
    };
    let few = || format!("it needs at least two values, there are {}", there.len());
    let capability_reason = match &chart {
        None => Some(few()),
        Some(_) if own_limits => Some("a material requirement allows each part a value of its own".into()),
        Some(c) if c.std_dev == 0.0 || c.within == 0.0 => Some("the values do not vary".into()),
        Some(_) if first.lower.is_none() => Some("it has one limit: there is no Cp and no Pp".into()),
        Some(_) => None,
    };
    let number = |f: fn(&ControlChart) -> f64| chart.as_ref().map(f);
    let least = |pick: fn(f64, f64) -> f64| there.iter().copied().reduce(pick);
    let uncertainties: Vec<Option<f64>> = of.iter().map(|c| c.uncertainty).collect();
    let even = |c: &CharacteristicRecord| c.value.zip(c.uncertainty).map(|(v, u)| [v - u, v + u]);
    let intervals: Vec<Option<[f64; 2]>> = of.iter().map(|c| c.interval.or_else(|| even(c))).collect();
    TrendRecord {
        id: first.id.clone(),
        kind: first.kind.clone(),
        symbol: first.symbol.clone(),
        feature: first.feature.clone(),
        datums: first.datums.clone(),
        unit: first.unit.clone(),
        nominal: first.nominal,
        lower: first.lower,
        upper,
        verdicts: of.iter().map(|c| c.verdict).collect(),
        uncertainties: Some(uncertainties).filter(|all| all.iter().any(Option::is_some)),
        intervals: Some(intervals).filter(|all| all.iter().any(Option::is_some)),
        own_upper: own_limits.then(|| of.iter().map(|c| c.upper).collect()),
        counts: Counts {
            pass: count(Verdict::Pass),
            fail: count(Verdict::Fail),
            undecided: count(Verdict::Undecided),
            not_measured: count(Verdict::NotMeasured),
        },
        measured: there.len() as u64,
        mean: number(|c| c.mean).or_else(|| there.first().copied()),
        min: least(f64::min),
        max: least(f64::max),
        std_dev: number(|c| c.std_dev),
        std_dev_within: number(|c| c.within),
        control: chart.as_ref().map(|c| Control {
            lower: c.limits[0],
            center: c.mean,
            upper: c.limits[1],
            moving_range: c.moving_range,
            moving_range_upper: c.range_limit,
        }),
        course_reason: chart.is_none().then(few),
        out_of_control: chart.as_ref().map_or(vec![], |c| {
            let one = |s: &Signal| OutOfControl { part: places[s.index] as u64, rule: rule(s.rule) };
            c.signals.iter().map(one).collect()
        }),
        cp: capability.cp.map(index),
        cpk: capability.cpk.map(index),
        pp: capability.pp.map(index),
        ppk: capability.ppk.map(index),
        capability_reason,
        values,
    }
}

fn rule(rule: Rule) -> RuleRecord {
    match rule {
        Rule::Beyond => RuleRecord::Beyond,
        Rule::Range => RuleRecord::Range,
        Rule::Run => RuleRecord::Run,
        Rule::Steady => RuleRecord::Steady,
    }
}

fn index(index: Index) -> IndexRecord {
    IndexRecord { value: index.value, low: index.low, high: index.high }
}
