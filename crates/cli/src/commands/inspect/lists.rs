//! The characteristics of one or several parts as CSV and as JUnit XML.

use super::part::Part;
use crate::console::cell;
use trueness_document::compare::{RegionRecord, ToleranceShares};
use trueness_document::inspect::{CharacteristicRecord, FeatureRecord, InspectDocument, MeasuredPlace};
use trueness_document::{ReasonKind, Verdict, VerdictReason};

/// What the deviations from the reference are called beside the characteristics.
pub(super) const DEVIATION: &str = "deviation";

/// The deviations from the reference, where they are judged: the share of points within the tolerance; with regions one of each, and
/// of all other points where there are such.
pub(super) fn judged(document: &InspectDocument) -> Vec<(String, &ToleranceShares, Verdict)> {
    let Some(deviation) = &document.deviation else { return vec![] };
    let regions = &deviation.regions;
    let of = |r: &'_ RegionRecord| format!("{DEVIATION} {}", r.id);
    let mut all: Vec<_> = regions.iter().map(|r| (of(r), &r.tolerance, r.verdict)).collect();
    if let (Some(t), Some(verdict)) = (&deviation.tolerance, deviation.verdict) {
        match regions.is_empty() {
            true => all.push((DEVIATION.into(), t, verdict)),
            false => all.extend(deviation.others_verdict.map(|own| (DEVIATION.into(), t, own))),
        }
    }
    all
}

/// The names of the columns.
const HEAD: [&str; 23] = [
    "part",
    "id",
    "kind",
    "feature",
    "datums",
    "nominal",
    "lower",
    "upper",
    "value",
    "unit",
    "uncertainty",
    "verdict",
    "utilisation",
    "reason",
    "interval_from",
    "interval_to",
    "modifiers",
    "x",
    "y",
    "z",
    "dx",
    "dy",
    "dz",
];

/// The cells of a line.
type Row = [String; 23];

/// What the alignment is called beside the characteristics.
const ALIGNMENT: &str = "alignment";

/// What a feature is called beside the characteristics.
const FEATURE: &str = "feature";

/// What a part without results is called beside them.
const PART: &str = "part";

/// What a reference that was not read in whole is called beside them.
const REFERENCE: &str = "reference";

/// What is called so that the points cover too little of the reference, where each region stands for itself.
const COVERAGE: &str = "coverage";

/// What leaves the whole part undecided beside characteristics and deviations: what it is called, and why, in one text.
fn open(document: &InspectDocument) -> Vec<(&'static str, String)> {
    let mut all = vec![];
    let doubts: Vec<&str> = document.alignment.doubts().map(|d| d.text.as_str()).collect();
    if !doubts.is_empty() {
        all.push((ALIGNMENT, doubts.join("; ")));
    }
    let own = document.verdict_reasons.iter().filter(|r| *r.kind == ReasonKind::IncompleteReference);
    all.extend(own.map(|r| (REFERENCE, r.text.clone())));
    if let Some(deviation) = document.deviation.as_ref().filter(|d| !d.regions.is_empty()) {
        let lacks =
            |r: &&VerdictReason| matches!(*r.kind, ReasonKind::Coverage | ReasonKind::CoverageUnknown);
        all.extend(deviation.verdict_reasons.iter().filter(lacks).map(|r| (COVERAGE, r.text.clone())));
    }
    all
}

/// Why the deviations are undecided, in one text.
fn undecided(document: &InspectDocument) -> Option<String> {
    let deviation = document.deviation.as_ref().filter(|d| d.verdict == Some(Verdict::Undecided))?;
    let texts: Vec<&str> = deviation.verdict_reasons.iter().map(|r| r.text.as_str()).collect();
    Some(texts.join("; "))
}

/// One line a characteristic, one a feature, one for the deviations from the reference where they are judged, one for an alignment that cannot
/// be relied on, and one for a part without results; numbers with all digits (RFC 4180).
pub fn csv(parts: &[Part]) -> String {
    let mut out = HEAD.join(",") + "\r\n";
    let number = |x: Option<f64>| x.map_or_else(String::new, |x| x.to_string());
    for part in parts {
        let document = match part {
            Part::Inspected(document) => document,
            Part::Failed(failed) => {
                let mut cells: Row = Default::default();
                [cells[0], cells[1], cells[2]] = [failed.name.clone(), PART.into(), PART.into()];
                [cells[11], cells[13]] = [Verdict::NotMeasured.word().into(), failed.why.clone()];
                out.push_str(&cells.map(cell).join(","));
                out.push_str("\r\n");
                continue;
            }
        };
        for c in &document.characteristics {
            let place = |k: usize| c.place.as_ref().map(|p| p.measured[k]);
            let off = |k: usize| c.place.as_ref().and_then(|p| p.deviation[k]);
            let cells: Row = [
                part.name().into(),
                c.id.clone(),
                c.kind.clone(),
                c.feature.clone(),
                c.datums.join(" "),
                number(c.nominal),
                number(c.lower),
                c.upper.to_string(),
                number(c.value),
                c.unit.clone(),
                number(c.uncertainty),
                c.verdict.word().into(),
                number(c.utilization),
                c.reason.clone().unwrap_or_default(),
                number(c.interval.map(|i| i[0])),
                number(c.interval.map(|i| i[1])),
                c.modifiers.join("; "),
                number(place(0)),
                number(place(1)),
                number(place(2)),
                number(off(0)),
                number(off(1)),
                number(off(2)),
            ];
            out.push_str(&cells.map(cell).join(","));
            out.push_str("\r\n");
        }
        for f in &document.features {
            out.push_str(&feature(part.name(), f).map(cell).join(","));
            out.push_str("\r\n");
        }
        for (name, t, verdict) in judged(document) {
            let mut cells: Row = Default::default();
            cells[0] = part.name().into();
            [cells[1], cells[2]] = [name, DEVIATION.into()];
            cells[6] = (100.0 * t.required).to_string();
            cells[7] = "100".into();
            cells[8] = number(t.inside.map(|s| 100.0 * s));
            cells[9] = "%".into();
            cells[11] = verdict.word().into();
            let why = || undecided(document).filter(|_| verdict == Verdict::Undecided);
            cells[13] = t.inside_reason.clone().or_else(why).unwrap_or_default();
            out.push_str(&cells.map(cell).join(","));
            out.push_str("\r\n");
        }
        for (what, why) in open(document) {
            let mut cells: Row = Default::default();
            cells[0] = part.name().into();
            [cells[1], cells[2]] = [what.into(), what.into()];
            [cells[11], cells[13]] = [Verdict::Undecided.word().into(), why];
            out.push_str(&cells.map(cell).join(","));
            out.push_str("\r\n");
        }
    }
    out
}

/// A feature with its size and place, beside those that the model has.
fn feature(part: &str, f: &FeatureRecord) -> Row {
    let number = |x: Option<f64>| x.map_or_else(String::new, |x| x.to_string());
    let size = |p: &MeasuredPlace| p.diameter.or(p.angle);
    let mut cells: Row = Default::default();
    [cells[0], cells[1], cells[2], cells[3]] =
        [part.into(), f.id.clone(), FEATURE.into(), f.shape.to_string()];
    cells[5] = number(f.nominal.as_ref().and_then(size));
    cells[8] = number(f.measured.as_ref().and_then(size));
    cells[9] = if f.measured.is_some_and(|m| m.angle.is_some()) { "deg" } else { "mm" }.into();
    cells[13] = f.reason.clone().unwrap_or_default();
    for k in 0..3 {
        cells[17 + k] = number(f.measured.map(|m| m.place[k]));
        cells[20 + k] = number(f.measured.zip(f.nominal).map(|(m, n)| m.place[k] - n.place[k]));
    }
    cells
}

/// A test suite a part and a test case a characteristic, one for the deviations where they are judged and one for an alignment that
/// cannot be relied on. What fails is a failure, what nobody can tell an error, as is a part without results; what was
/// not measured is a failure too: a merge must not pass on it.
pub fn junit(parts: &[Part]) -> String {
    let failed = |v: &Verdict| matches!(v, Verdict::Fail | Verdict::NotMeasured);
    let attributes = |parts: &[Part]| {
        let all: Vec<Verdict> = parts.iter().flat_map(verdicts).collect();
        format!(
            "tests=\"{}\" failures=\"{}\" errors=\"{}\"",
            all.len(),
            all.iter().filter(|v| failed(v)).count(),
            all.iter().filter(|v| **v == Verdict::Undecided).count()
        )
    };
    let mut out = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    out.push_str(&format!("<testsuites {}>\n", attributes(parts)));
    for part in parts {
        let name = escaped(part.name());
        out.push_str(&format!("  <testsuite name=\"{name}\" {}>\n", attributes(std::slice::from_ref(part))));
        match part {
            Part::Inspected(document) => out.push_str(&cases(&name, document)),
            Part::Failed(failed) => {
                out.push_str(&error(&name, PART, &format!("not inspected: {}", failed.why)))
            }
        }
        out.push_str("  </testsuite>\n");
    }
    out.push_str("</testsuites>\n");
    out
}

/// The verdict of each test case; a part without results is one that nobody can tell.
fn verdicts(part: &Part) -> Vec<Verdict> {
    let Some(document) = part.document() else { return vec![Verdict::Undecided] };
    let own = document.characteristics.iter().map(|c| c.verdict);
    let open = open(document).into_iter().map(|_| Verdict::Undecided);
    own.chain(judged(document).into_iter().map(|j| j.2)).chain(open).collect()
}

/// The test cases of a part.
fn cases(name: &str, document: &InspectDocument) -> String {
    let mut out = String::new();
    for c in &document.characteristics {
        out.push_str(&characteristic(name, c));
    }
    for (name_of, t, verdict) in judged(document) {
        let share = t.inside.map_or_else(|| "no point".into(), |s| format!("{} % of the points", 100.0 * s));
        let said =
            format!("{share} within {} to {} mm, allowed {} to 100 %", t.lower, t.upper, 100.0 * t.required);
        let why = undecided(document).filter(|_| verdict == Verdict::Undecided);
        let said = why.map_or(said.clone(), |why| format!("{said}; {why}"));
        out.push_str(&case(name, &name_of, verdict, &said));
    }
    for (what, why) in open(document) {
        out.push_str(&case(name, what, Verdict::Undecided, &why));
    }
    out
}

fn characteristic(class: &str, c: &CharacteristicRecord) -> String {
    let said = match (c.value, &c.reason) {
        (Some(value), _) => {
            let lower = c.lower.map_or_else(String::new, |l| format!("{l} to "));
            format!("{value} {}, allowed {lower}{}", c.unit, c.upper)
        }
        (None, Some(reason)) => reason.clone(),
        (None, None) => String::new(),
    };
    let said = match c.verdict {
        // What leaves it open.
        Verdict::Undecided => [std::slice::from_ref(&said), &c.notes].concat().join("; "),
        _ => said,
    };
    case(class, &format!("{} {} {}", c.id, c.kind_in_full(), c.feature), c.verdict, &said)
}

fn case(class: &str, name: &str, verdict: Verdict, said: &str) -> String {
    let start = format!("    <testcase classname=\"{class}\" name=\"{}\"", escaped(name));
    let said = format!("{}: {said}", verdict.word());
    let message = escaped(&said);
    match verdict {
        Verdict::Pass => format!("{start}/>\n"),
        Verdict::Undecided => error(class, name, &said),
        Verdict::Fail | Verdict::NotMeasured => {
            format!("{start}><failure message=\"{message}\"/></testcase>\n")
        }
    }
}

/// A test case that nobody can tell.
fn error(class: &str, name: &str, said: &str) -> String {
    let [name, message] = [name, said].map(escaped);
    format!("    <testcase classname=\"{class}\" name=\"{name}\"><error message=\"{message}\"/></testcase>\n")
}

/// Text for an attribute of XML 1.0; characters that it cannot hold become U+FFFD.
pub(super) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\n' => out.push_str("&#10;"),
            '\t' => out.push_str("&#9;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_text_breaks_out_of_its_cell_or_attribute() {
        assert_eq!(escaped("<a b=\"c\">&\u{1}\n"), "&lt;a b=&quot;c&quot;&gt;&amp;\u{fffd}&#10;");
    }
}
