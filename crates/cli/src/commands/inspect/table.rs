//! The document of an inspection for people.

use super::part::{Part, name};
use crate::commands::compare::{along, coverage, outliers, regions};
use crate::console;
use crate::number::{POINTS, counted, fixed, grouped, signed, six_digits};
use crate::read;
use std::fmt::Write;
use trueness_inspect::results::compare::Comparison;
use trueness_inspect::results::inspect::{CharacteristicRecord, InspectDocument};

/// What there is to say of a part for people; of one of several it names the part.
pub fn table(part: &Part, one_of_several: bool) -> String {
    match part {
        Part::Inspected(document) => inspected(document, one_of_several),
        Part::Failed(failed) if one_of_several => format!("! {}: not inspected\n", failed.name),
        // It was told as an error.
        Part::Failed(_) => String::new(),
    }
}

/// The document for people.
fn inspected(document: &InspectDocument, one_of_several: bool) -> String {
    let mut out = read::notes(&document.inputs);
    let part = one_of_several.then(|| name(document).to_owned());
    let heading: Vec<String> = document.title.iter().cloned().chain(part).collect();
    if !heading.is_empty() {
        let _ = writeln!(out, "{}", heading.join("   "));
    }
    let alignment = &document.alignment;
    if let Some(rms) = alignment.rms {
        let greatest =
            alignment.greatest.map_or_else(String::new, |g| format!(", greatest distance {}", six_digits(g)));
        let excess =
            alignment.excess.map_or_else(String::new, |x| format!(", greatest excess {}", signed(x)));
        // What lies on datums has no rms of its own.
        let of = if alignment.method == "datum" { " from a best fit of" } else { "," };
        let _ =
            writeln!(out, "aligned by {}{of} rms {}{greatest}{excess}", alignment.method, six_digits(rms));
    }
    for warning in &alignment.warnings {
        let _ = writeln!(out, "! alignment: {}", warning.text);
    }
    let mut rows = vec![
        ["id", "kind", "feature", "datums", "allowed", "value", "used", "verdict"].map(String::from).to_vec(),
    ];
    rows.extend(document.characteristics.iter().map(row));
    if rows.len() > 1 {
        out.push_str(&console::columns(&rows));
    }
    // What is said of a feature concerns all of its characteristics.
    let mut notes: Vec<(&str, Vec<&str>)> = vec![];
    for c in &document.characteristics {
        if let Some(reason) = &c.reason {
            let _ = writeln!(out, "! {}: {reason}", c.id);
        }
        for note in &c.notes {
            match notes.iter_mut().find(|n| n.0 == note) {
                Some((_, ids)) => ids.push(&c.id),
                None => notes.push((note, vec![&c.id])),
            }
        }
    }
    for (note, ids) in notes {
        let _ = writeln!(out, "  {}: {note}", ids.join(", "));
    }
    if let Some(c) = &document.deviation {
        deviation(&mut out, c);
    }
    let n = &document.counts;
    let deviations = document.deviation.as_ref().and_then(|c| c.verdict);
    let deviations = deviations.map_or_else(String::new, |v| format!("; deviations {}", v.word()));
    let unreliable = document.alignment.doubts().next().is_some();
    let unreliable = if unreliable { "; alignment cannot be relied on" } else { "" };
    let _ = writeln!(
        out,
        "{}: {} pass, {} fail, {} undecided, {} not measured{deviations}{unreliable}; decision rule {}; mm, degrees",
        document.verdict.word(),
        n.pass,
        n.fail,
        n.undecided,
        n.not_measured,
        document.decision_rule
    );
    out
}

/// The deviations from the reference in a line, with what makes them doubtful.
fn deviation(out: &mut String, c: &Comparison) {
    let all = &c.deviation.all;
    let number = |x: Option<f64>| x.map_or_else(|| "–".into(), signed);
    let _ = write!(
        out,
        "deviation from {}: {}, {} to {}, mean {}, rms {}",
        c.reference,
        counted(all.count, POINTS),
        number(all.min),
        number(all.max),
        number(all.mean),
        all.rms.map_or_else(|| "–".into(), six_digits)
    );
    let excluded: u64 = c.excluded.values().sum();
    if excluded > 0 {
        let reasons = c.excluded.iter().filter(|(_, n)| **n > 0);
        let reasons: Vec<String> =
            reasons.map(|(reason, n)| format!("{} {}", grouped(*n), reason.replace('_', " "))).collect();
        let _ = write!(out, ", {} left out ({})", counted(excluded, POINTS), reasons.join(", "));
    }
    if let (Some(t), Some(verdict)) = (c.tolerance.as_ref().filter(|_| c.regions.is_empty()), c.verdict) {
        let inside = t.inside.map_or_else(|| "–".into(), |s| format!("{} %", fixed(100.0 * s, 3)));
        let _ = write!(out, "; {inside} within {}/{}", signed(t.lower), signed(t.upper));
        if t.required < 1.0 {
            let _ = write!(out, ", {} % asked", six_digits(100.0 * t.required));
        }
        let _ = write!(out, ": {}", verdict.word());
    }
    out.push('\n');
    if !c.regions.is_empty() {
        out.push_str(regions(c).trim_start());
    }
    if let Some(found) = &c.along {
        let _ = writeln!(out, "  along {}", along(found));
    }
    if let Some(found) = &c.outliers {
        let _ = writeln!(out, "  outliers by {}", outliers(found));
    }
    if let Some(covered) = &c.coverage {
        let _ = writeln!(out, "  not covered: {}", coverage(covered));
    }
    for warning in &c.warnings {
        let _ = writeln!(out, "! deviation: {}", warning.text);
    }
}

fn row(c: &CharacteristicRecord) -> Vec<String> {
    let sign = if c.diametral() { "∅" } else { "" };
    let allowed = match (c.nominal, c.lower) {
        (Some(nominal), Some(lower)) => {
            // The limit deviations as the plan has them, not the rounding of their sums.
            let deviation = |limit: f64| signed(((limit - nominal) * 1e12).round() / 1e12);
            format!("{} {}/{}", six_digits(nominal), deviation(lower), deviation(c.upper))
        }
        _ => match c.requirement() {
            Some((t, material)) => {
                format!("{sign}{} ({} {})", six_digits(c.upper), six_digits(t), material.symbol())
            }
            None => format!("{sign}{}", six_digits(c.upper)),
        },
    };
    let value = c.value.map_or_else(|| "–".into(), |v| fixed(v, if c.unit == "1" { 3 } else { 6 }));
    let value = match (c.uncertainty, c.interval, c.noise_bias) {
        // Noise adds to it: the true value lies to one side.
        (Some(_), Some([from, to]), Some(_)) => {
            format!("{value} ({} to {})", six_digits(from), six_digits(to))
        }
        (Some(u), _, _) if c.value.is_some() => format!("{value} ± {}", six_digits(u)),
        _ => value,
    };
    let used = c.utilization.map_or_else(String::new, |u| format!("{} %", fixed(100.0 * u, 1)));
    let kind = format!("{}{}{}", c.symbol, if c.symbol.is_empty() { "" } else { " " }, c.kind_in_full());
    vec![
        c.id.clone(),
        kind,
        c.feature.clone(),
        c.datums.join(" "),
        allowed,
        value,
        used,
        c.verdict.word().into(),
    ]
}
