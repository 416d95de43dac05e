//! The document of an inspection for people.

use super::features;
use crate::commands::compare::{along, coverage, outliers, regions};
use crate::inputs;
use crate::layout::{self, names, sentence};
use crate::number::{POINTS, counted, fixed, grouped, scientific, short, short_signed, six_digits};
use std::fmt::Write;
use trueness::tasks::inspect::Part;
use trueness_document::Verdict;
use trueness_document::compare::Comparison;
use trueness_document::inspect::{CharacteristicRecord, FrameSource, InspectDocument};

/// What there is to say of a part for people; of one of several it names the part. `verbose`: all of it, a line for each thing.
pub fn table(part: &Part, one_of_several: bool, verbose: bool) -> String {
    match part {
        Part::Inspected(done) => inspected(&done.document, one_of_several.then(|| part.name()), verbose),
        Part::Failed(failed) if one_of_several => format!("! {}: not inspected\n", failed.name),
        // It was told as an error.
        Part::Failed(_) => String::new(),
    }
}

/// The document for people; `part` is what one of several parts is called.
fn inspected(document: &InspectDocument, part: Option<&str>, verbose: bool) -> String {
    let mut out = inputs::notes(&document.inputs);
    let heading: Vec<&str> = document.title.as_deref().into_iter().chain(part).collect();
    if !heading.is_empty() {
        let _ = writeln!(out, "{}", heading.join("   "));
    }
    let alignment = &document.alignment;
    if let Some(rms) = alignment.rms {
        let greatest =
            alignment.greatest.map_or_else(String::new, |g| format!(", greatest distance {}", short(g)));
        let excess =
            alignment.excess.map_or_else(String::new, |x| format!(", greatest excess {}", short_signed(x)));
        // What lies on datums has no rms of its own.
        let of = if alignment.method == "datum" { " from a best fit of" } else { "," };
        let _ = writeln!(out, "aligned by {}{of} rms {}{greatest}{excess}", alignment.method, short(rms));
    }
    for warning in &alignment.warnings {
        out += &sentence(&format!("! alignment: {}", warning.text), verbose);
    }
    let head = ["id", "kind", "feature", "datums", "allowed", "value", "used", "verdict"];
    let mut rows = vec![head.map(String::from).to_vec()];
    rows.extend(document.characteristics.iter().map(row));
    if rows.len() > 1 {
        out += &layout::table(&rows, 4);
    }
    out += &explanations(document, verbose);
    for c in &document.characteristics {
        let is_open = matches!(c.verdict, Verdict::Fail | Verdict::Undecided);
        out += &place(c).filter(|_| verbose || is_open).map_or_else(String::new, |p| sentence(&p, verbose));
    }
    if verbose {
        out += &features::table(&document.features);
    }
    if let Some(c) = &document.deviation {
        deviation(&mut out, c, verbose);
    }
    let n = &document.counts;
    let deviations = document.deviation.as_ref().and_then(|c| c.verdict);
    let deviations = deviations.map_or_else(String::new, |v| format!("; deviations {}", v.word()));
    let unreliable = document.alignment.doubts().next().is_some();
    let unreliable = if unreliable { "; alignment cannot be relied on" } else { "" };
    out += &sentence(
        &format!(
            "{}: {} pass, {} fail, {} undecided, {} not measured{deviations}{unreliable}; decision rule {}; mm, degrees",
            document.verdict.word(),
            n.pass,
            n.fail,
            n.undecided,
            n.not_measured,
            document.decision_rule
        ),
        verbose,
    );
    out
}

/// Why characteristics have no value, and what is said of them: each once, with all that it concerns. What is said of a feature concerns all of
/// its characteristics.
fn explanations(document: &InspectDocument, verbose: bool) -> String {
    let mut all: Vec<(&str, &str, Vec<&str>)> = vec![];
    for c in &document.characteristics {
        let reason = c.reason.iter().map(|r| ("!", r.as_str()));
        for (mark, text) in reason.chain(c.notes.iter().map(|n| (" ", n.as_str()))) {
            match all.iter_mut().find(|n| (n.0, n.1) == (mark, text)) {
                Some((_, _, ids)) => ids.push(&c.id),
                None => all.push((mark, text, vec![&c.id])),
            }
        }
    }
    all.sort_by_key(|(mark, ..)| *mark == " ");
    let line = |(mark, text, ids): (&str, &str, Vec<&str>)| {
        sentence(&format!("{mark} {}: {text}", names(&ids, verbose)), verbose)
    };
    all.into_iter().map(line).collect()
}

/// How far the feature of a position or profile is from its true place, along each axis of the frame.
fn place(c: &CharacteristicRecord) -> Option<String> {
    let place = c.place.as_ref()?;
    // As drawn, where it is; a model in single precision has 51.999999602 for 52.
    let drawn = |exact: f64| written((1e4 * exact).round() / 1e4);
    let all = place.coordinates().map(|(name, exact, measured, off)| {
        format!("d{name} {} ({} for {})", short_signed(off), fixed(measured, 4), drawn(exact))
    });
    let all: Vec<String> = all.collect();
    let frame = match *place.frame {
        FrameSource::Datums => c.datums.join(" | "),
        FrameSource::Plan => "the plan's frame".into(),
        FrameSource::Aligned => "the model's coordinates".into(),
    };
    (!all.is_empty()).then(|| format!("  {}: {} in {frame}", c.id, all.join(", ")))
}

/// The deviations from the reference, with what makes them doubtful.
fn deviation(out: &mut String, c: &Comparison, verbose: bool) {
    let all = &c.deviation.all;
    let number = |x: Option<f64>| x.map_or_else(|| "–".into(), short_signed);
    let mut text = format!(
        "deviation from {}: {}, {} to {}, mean {}, rms {}",
        c.reference,
        counted(all.count, POINTS),
        number(all.min),
        number(all.max),
        number(all.mean),
        all.rms.map_or_else(|| "–".into(), short)
    );
    let excluded: u64 = c.excluded.values().sum();
    if excluded > 0 {
        let reasons = c.excluded.iter().filter(|(_, n)| **n > 0);
        let reasons: Vec<String> =
            reasons.map(|(reason, n)| format!("{} {}", grouped(*n), reason.replace('_', " "))).collect();
        let _ = write!(text, ", {} left out ({})", counted(excluded, POINTS), reasons.join(", "));
    }
    if let (Some(t), Some(verdict)) = (c.tolerance.as_ref().filter(|_| c.regions.is_empty()), c.verdict) {
        let inside = t.inside.map_or_else(|| "–".into(), |s| format!("{} %", fixed(100.0 * s, 3)));
        let _ = write!(text, "; {inside} within {}", deviations(t.lower, t.upper));
        if t.required < 1.0 {
            let _ = write!(text, ", {} % asked", six_digits(100.0 * t.required));
        }
        let _ = write!(text, ": {}", verdict.word());
    }
    *out += &sentence(&text, verbose);
    for reason in &c.verdict_reasons {
        *out += &sentence(&format!("! deviation: {}", reason.text), verbose);
    }
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
        *out += &sentence(&format!("! deviation: {}", warning.text), verbose);
    }
}

/// A number of the plan as it was written there.
pub(super) fn written(x: f64) -> String {
    let text = fixed(x, 9);
    text.trim_end_matches('0').trim_end_matches('.').replace("−0", if x == 0.0 { "0" } else { "−0" })
}

/// Two limit deviations.
fn deviations(lower: f64, upper: f64) -> String {
    let signed = |x: f64| format!("{}{}", if x > 0.0 { "+" } else { "" }, written(x));
    match lower == -upper {
        true => format!("±{}", written(upper)),
        false => format!("{}/{}", signed(lower), signed(upper)),
    }
}

/// Share of what is allowed; what is beyond does not look like all of it.
fn used(c: &CharacteristicRecord) -> String {
    let Some(share) = c.utilization.map(|u| 100.0 * u) else { return String::new() };
    match share > 100.0 && share < 100.5 {
        true => ">100 %".into(),
        false => format!("{} %", fixed(share, 0)),
    }
}

fn row(c: &CharacteristicRecord) -> Vec<String> {
    let sign = if c.diametral() { "∅" } else { "" };
    let decimals = c.decimals_in_table();
    let allowed = match (c.nominal, c.lower) {
        (Some(nominal), Some(lower)) => {
            // The limit deviations as the plan has them, not the rounding of their sums.
            let deviation = |limit: f64| ((limit - nominal) * 1e12).round() / 1e12;
            format!("{} {}", written(nominal), deviations(deviation(lower), deviation(c.upper)))
        }
        _ => match c.requirement() {
            Some((t, material)) => {
                format!("{sign}{} ({} {})", fixed(c.upper, decimals), written(t), material.symbol())
            }
            None => format!("{sign}{}", written(c.upper)),
        },
    };
    let value = c.value.map_or_else(
        || "–".into(),
        |v| match c.beyond_digits().filter(|_| c.verdict == Verdict::Fail) {
            // No digits tell it from its limit.
            Some(beyond) => {
                let sign = if beyond < 0.0 { '−' } else { '+' };
                format!("{} {sign} {}", written(v - beyond), scientific(beyond.abs(), 1))
            }
            None => fixed(v, decimals),
        },
    );
    let value = match (c.uncertainty, c.interval, c.noise_bias) {
        // Noise adds to it: the true value lies to one side.
        (Some(_), Some([from, to]), Some(_)) => {
            format!("{value} ({} to {})", fixed(from, decimals), fixed(to, decimals))
        }
        (Some(u), _, _) if c.value.is_some() => format!("{value} ± {}", fixed(u, decimals)),
        _ => value,
    };
    let kind = format!("{}{}{}", c.symbol, if c.symbol.is_empty() { "" } else { " " }, c.kind_in_full());
    vec![
        c.id.clone(),
        kind,
        c.feature.clone(),
        c.datums.join(" "),
        allowed,
        value,
        used(c),
        c.verdict.word().into(),
    ]
}
