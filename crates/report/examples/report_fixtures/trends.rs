//! Reports of trends: courses whose values are known.

use std::path::Path;
use trueness_document::inspect::{
    AlignmentRecord, CharacteristicRecord, Counts, InspectDocument, PlanRecord, SCHEMA, ZoneForm,
};
use trueness_document::trend::{ResultInput, TrendDocument};
use trueness_document::{Role, UNITS, VERSION, Verdict, Word};
use trueness_geom::num::random::Random;
use trueness_report::{ReportInput, ReportOptions};

/// All of them, into `folder`.
pub fn write_all(folder: &Path) {
    let options = ReportOptions::default();
    super::written(folder, "trend", page(&trend(&parts()), &options));
    super::written(folder, "trend_one", page(&trend(&parts()[..1]), &options));
    super::written(folder, "trend_long", page(&trend(&long(1000)), &options));
}

/// The report of a trend.
fn page(document: &TrendDocument, options: &ReportOptions) -> Vec<u8> {
    super::bytes(&ReportInput { result: document, objects: &[], marks: &[], options })
}

/// What was found of a characteristic on a part.
struct Found {
    id: &'static str,
    kind: &'static str,
    limits: (Option<f64>, f64),
    value: Option<f64>,
    uncertainty: Option<f64>,
}

/// One result a part.
fn trend(parts: &[Vec<Found>]) -> TrendDocument {
    let input = |n: usize| ResultInput {
        path: format!("results/part-{n:03}.json"),
        format: SCHEMA.into(),
        bytes: 4096,
        sha256: Some(format!("{n:04x}").repeat(16)),
        unit_assumed: UNITS.into(),
    };
    let results: Vec<InspectDocument> = parts.iter().enumerate().map(|(n, found)| result(n, found)).collect();
    trueness_measure::trend::document((0..parts.len()).map(input).collect(), &results).unwrap()
}

/// Fourteen parts: one too high, one undecided, one not measured, a drift; values that are all alike; a limit that is far off;
/// limits of a material requirement; an angle; a name that would be markup.
fn parts() -> Vec<Vec<Found>> {
    let heights =
        [10.02, 10.05, 9.98, 10.01, 10.11, 10.03, 9.96, 10.0, 10.02, 10.05, 10.21, 10.04, 10.0, 10.01];
    let one = |(n, height): (usize, &f64)| {
        let k = n as f64;
        let dimension = |id, kind, lower: f64, upper, value| Found {
            id,
            kind,
            limits: (Some(lower), upper),
            value: Some(value),
            uncertainty: None,
        };
        let form = |id, kind, upper, value| Found {
            id,
            kind,
            limits: (None, upper),
            value: Some(value),
            uncertainty: None,
        };
        let measured = Some(*height).filter(|_| n != 6);
        vec![
            Found {
                value: measured,
                uncertainty: measured.map(|_| 0.02),
                ..dimension("height", "distance", 9.9, 10.1, 0.0)
            },
            form("flat", "flatness", 0.05, 0.02 + 0.001 * k),
            form("alike", "roundness", 0.03, 0.0125),
            form("far", "cylindricity", 5.0, 0.012 + 0.001 * (k % 3.0)),
            form("own", "position", 0.2 + 0.01 * (k % 4.0), 0.1 + 0.008 * (k % 5.0)),
            dimension("<b>\"x\"&'", "angle", 44.5, 45.5, 45.0 + 0.02 * (k % 4.0)),
        ]
    };
    heights.iter().enumerate().map(one).collect()
}

/// Many parts with a drift.
fn long(count: usize) -> Vec<Vec<Found>> {
    let mut random = Random::new(5);
    let mut normal = move || (0..12).map(|_| random.unit()).sum::<f64>() - 6.0;
    let mut one = |n: usize| {
        let drift = 2e-5 * n as f64;
        let value = |mean: f64, sigma: f64, noise: f64| Some(mean + sigma * noise);
        vec![
            Found {
                id: "width",
                kind: "distance",
                limits: (Some(19.95), 20.05),
                value: value(19.99 + drift, 0.01, normal()),
                uncertainty: None,
            },
            Found {
                id: "round",
                kind: "roundness",
                limits: (None, 0.02),
                value: Some((0.008 + 0.002 * normal()).abs()).filter(|_| n % 97 != 5),
                uncertainty: None,
            },
        ]
    };
    (0..count).map(&mut one).collect()
}

fn result(number: usize, found: &[Found]) -> InspectDocument {
    let characteristics: Vec<CharacteristicRecord> = found.iter().map(characteristic).collect();
    let count = |v: Verdict| characteristics.iter().filter(|c| c.verdict == v).count() as u64;
    let worst = [Verdict::Fail, Verdict::Undecided, Verdict::NotMeasured, Verdict::Pass];
    InspectDocument {
        schema: SCHEMA.into(),
        version: VERSION.into(),
        units: UNITS.into(),
        title: Some("Bracket".into()),
        shared_noise: None,
        shared_noise_reason: None,
        plan: PlanRecord { path: "bracket.toml".into(), sha256: Some("a7".repeat(32)) },
        inputs: vec![super::record(Role::Measured, &format!("scans/part-{number:03}.stl"), 1000, Some(2000))],
        alignment: AlignmentRecord {
            method: "none".into(),
            transform: std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j)))),
            rms: None,
            mean_abs: None,
            greatest: None,
            excess: None,
            residuals: None,
            amplifications: None,
            left_out: None,
            iterations: None,
            converged: None,
            warnings: vec![],
        },
        features: vec![],
        deviation: None,
        deviation_reason: None,
        deviation_map: None,
        scale: None,
        decision_rule: "iso14253-1".into(),
        counts: Counts {
            pass: count(Verdict::Pass),
            fail: count(Verdict::Fail),
            undecided: count(Verdict::Undecided),
            not_measured: count(Verdict::NotMeasured),
        },
        verdict: worst.into_iter().find(|v| count(*v) > 0).unwrap(),
        verdict_reasons: vec![],
        characteristics,
    }
}

fn characteristic(f: &Found) -> CharacteristicRecord {
    let (lower, upper) = f.limits;
    let u = f.uncertainty.unwrap_or(0.0);
    let verdict = match f.value {
        None => Verdict::NotMeasured,
        Some(v) if v - u > upper || lower.is_some_and(|l| v + u < l) => Verdict::Fail,
        Some(v) if v + u > upper || lower.is_some_and(|l| v - u < l) => Verdict::Undecided,
        Some(_) => Verdict::Pass,
    };
    let own = f.id == "own";
    CharacteristicRecord {
        id: f.id.into(),
        kind: f.kind.into(),
        symbol: String::new(),
        feature: "top".into(),
        datums: if f.kind == "flatness" { vec![] } else { vec!["A".into()] },
        modifiers: if own { vec!["Ⓜ".into()] } else { vec![] },
        zone: Word(if lower.is_some() { ZoneForm::Value } else { ZoneForm::Width }),
        nominal: lower.map(|l| 0.5 * (l + upper)),
        tolerance: if own { Some(0.2) } else { lower.is_none().then_some(upper) },
        lower,
        upper,
        value: f.value,
        unit: if f.kind == "angle" { "deg" } else { "mm" }.into(),
        uncertainty: f.uncertainty,
        uncertainty_source: f.uncertainty.map(|_| "plan".into()),
        noise_bias: None,
        interval: None,
        decision_rule: "iso14253-1".into(),
        verdict,
        reason: f.value.is_none().then(|| "there are no points".into()),
        utilization: None,
        witness: vec![],
        anchor: None,
        parts: Default::default(),
        place: None,
        value_with_others: None,
        notes: vec![],
        standard: "ISO 1101:2017".into(),
    }
}
