//! The characteristics of one or several parts as CSV and as JUnit XML.

use super::part::Part;
use trueness_document::compare::{RegionRecord, ToleranceShares};
use trueness_document::inspect::{CharacteristicRecord, FeatureRecord, InspectDocument, MeasuredPlace};
use trueness_document::{ReasonKind, Verdict, VerdictReason};
use trueness_files::write::{Csv, LineEnd, Xml};

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
const COLUMN_NAMES: [&str; 23] = [
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

/// One line a characteristic, one a feature, one for the deviations from the reference where they are judged. One is for an alignment
/// that cannot be relied on, one for a part without results. Numbers have all digits (RFC 4180).
pub fn csv(parts: &[Part]) -> Vec<u8> {
    let mut out = vec![];
    let mut csv = Csv::at_end_of(&mut out, LineEnd::CrLf);
    csv.row(COLUMN_NAMES);
    let number = |x: Option<f64>| x.map_or_else(String::new, |x| x.to_string());
    for part in parts {
        let document = match part {
            Part::Inspected(done) => &done.document,
            Part::Failed(failed) => {
                let mut cells: Row = Default::default();
                [cells[0], cells[1], cells[2]] = [failed.name.clone(), PART.into(), PART.into()];
                [cells[11], cells[13]] = [Verdict::NotMeasured.word().into(), failed.why()];
                csv.row(cells);
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
            csv.row(cells);
        }
        for f in &document.features {
            csv.row(feature(part.name(), f));
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
            csv.row(cells);
        }
        for (what, why) in open(document) {
            let mut cells: Row = Default::default();
            cells[0] = part.name().into();
            [cells[1], cells[2]] = [what.into(), what.into()];
            [cells[11], cells[13]] = [Verdict::Undecided.word().into(), why];
            csv.row(cells);
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

/// A test suite a part and a test case a characteristic. One is for the deviations where they are judged, one for an alignment that
/// cannot be relied on. What fails is a failure, what nobody can tell an error, as is a part without results; what was not measured is a
/// failure too: a merge must not pass on it.
pub fn junit(parts: &[Part]) -> String {
    let failed = |v: &Verdict| matches!(v, Verdict::Fail | Verdict::NotMeasured);
    let attributes = |parts: &[Part]| {
        let all: Vec<Verdict> = parts.iter().flat_map(verdicts).collect();
        let undecided = |v: &Verdict| *v == Verdict::Undecided;
        let count = |of: &dyn Fn(&Verdict) -> bool| all.iter().filter(|v| of(v)).count().to_string();
        [("tests", count(&|_| true)), ("failures", count(&failed)), ("errors", count(&undecided))]
    };
    let mut xml = Xml::new(2);
    xml.declaration(&[("encoding", "UTF-8".into())]);
    xml.element("testsuites", &attributes(parts), |xml| {
        for part in parts {
            let name = part.name();
            let [tests, failures, errors] = attributes(std::slice::from_ref(part));
            let attributes = [("name", name.into()), tests, failures, errors];
            xml.element("testsuite", &attributes, |xml| match part {
                Part::Inspected(done) => cases(xml, name, &done.document),
                Part::Failed(failed) => {
                    let why = format!("not inspected: {}", failed.why());
                    case(xml, name, PART, Some(("error", why)));
                }
            });
        }
    });
    xml.take()
}

/// The verdict of each test case; a part without results is one that nobody can tell.
fn verdicts(part: &Part) -> Vec<Verdict> {
    let Some(document) = part.document() else { return vec![Verdict::Undecided] };
    let own = document.characteristics.iter().map(|c| c.verdict);
    let open = open(document).into_iter().map(|_| Verdict::Undecided);
    own.chain(judged(document).into_iter().map(|j| j.2)).chain(open).collect()
}

/// The test cases of a part.
fn cases(xml: &mut Xml, name: &str, document: &InspectDocument) {
    for c in &document.characteristics {
        characteristic(xml, name, c);
    }
    for (name_of, t, verdict) in judged(document) {
        let share = t.inside.map_or_else(|| "no point".into(), |s| format!("{} % of the points", 100.0 * s));
        let said =
            format!("{share} within {} to {} mm, allowed {} to 100 %", t.lower, t.upper, 100.0 * t.required);
        let why = undecided(document).filter(|_| verdict == Verdict::Undecided);
        let said = why.map_or(said.clone(), |why| format!("{said}; {why}"));
        judged_case(xml, name, &name_of, verdict, &said);
    }
    for (what, why) in open(document) {
        judged_case(xml, name, what, Verdict::Undecided, &why);
    }
}

fn characteristic(xml: &mut Xml, class: &str, c: &CharacteristicRecord) {
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
    let name = format!("{} {} {}", c.id, c.kind_in_full(), c.feature);
    judged_case(xml, class, &name, c.verdict, &said);
}

/// A test case with a verdict.
fn judged_case(xml: &mut Xml, class: &str, name: &str, verdict: Verdict, said: &str) {
    let element = match verdict {
        Verdict::Pass => None,
        Verdict::Undecided => Some("error"),
        Verdict::Fail | Verdict::NotMeasured => Some("failure"),
    };
    let said = format!("{}: {said}", verdict.word());
    case(xml, class, name, element.map(|element| (element, said)));
}

/// A test case, with the element that says what is wrong with it.
fn case(xml: &mut Xml, class: &str, name: &str, wrong: Option<(&str, String)>) {
    let attributes = [("classname", class.into()), ("name", name.into())];
    match wrong {
        None => xml.empty("testcase", &attributes),
        Some((element, message)) => {
            xml.line("testcase", &attributes, |xml| xml.empty(element, &[("message", message)]));
        }
    }
}
