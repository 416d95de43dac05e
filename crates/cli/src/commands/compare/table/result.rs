//! The result in some ten lines: files, alignment, what was compared and covered, the deviations with their worst places, the verdict.

use super::full;
use super::line::{file, line, short as file_name, verdict};
use crate::console::columns;
use crate::number::{FACETS, POINTS, counted, grouped, short, short_signed};
use trueness_document::compare::{
    CompareDocument, Comparison, CoverageRecord, ExtremeRecord, SignBy, ToleranceShares,
};
use trueness_document::{InputRecord, Role, Verdict, percent};

/// The whole text.
pub fn text(d: &CompareDocument, places: bool) -> String {
    let mut out = String::new();
    for input in &d.inputs {
        out.push_str(&of_file(input));
    }
    if let Some(a) = &d.alignment {
        let left_out = match a.left_out {
            0 => String::new(),
            n => format!(", {} left out", counted(n, POINTS)),
        };
        let settled = if a.converged { "" } else { ", not settled" };
        let what =
            format!("best fit to {}: rms {} mm{left_out}{settled}", file_name(&a.reference), short(a.rms));
        out.push_str(&line("aligned", &what));
        for warning in &a.warnings {
            out.push_str(&line("!", &format!("alignment: {}", warning.text)));
        }
    }
    match &d.comparisons[..] {
        [only] => one(&mut out, d, only),
        several => ranking(&mut out, d, several),
    }
    if places {
        d.comparisons.iter().for_each(|c| out.push_str(&full::worst(d, c)));
    }
    out.push_str(&verdict(d.verdict, &d.verdict_reasons));
    out
}

/// A file in a line, and in one more each what was odd about it.
fn of_file(input: &InputRecord) -> String {
    let name = match input.role {
        Role::Measured => "measured",
        Role::Reference => "reference",
        Role::Mesh => "mesh",
    };
    let facets = input.facets.map(|f| format!(", {}", counted(f, FACETS))).unwrap_or_default();
    let size = input.bounds.as_ref().map(|b| {
        let [l, w, h] = [0, 1, 2].map(|k| size(b.max[k] - b.min[k]));
        format!(", {l} × {w} × {h} mm")
    });
    // Files in millimeters need no word on it.
    let unit = match input.unit_assumed.as_str() {
        "mm" => String::new(),
        unit => format!(", read in {unit}"),
    };
    let what = format!("{}{facets}{}{unit}", counted(input.points, POINTS), size.unwrap_or_default());
    let mut out = file(name, &input.path, &what);
    out.extend(input.reading().map(|r| line("", &r)));
    out.extend(input.warnings.iter().map(|w| line("!", w)));
    out
}

/// The side of a box, with three digits at least.
fn size(x: f64) -> String {
    if x >= 0.1 || x == 0.0 { format!("{x:.1}") } else { short(x) }
}

/// One reference.
fn one(out: &mut String, d: &CompareDocument, c: &Comparison) {
    for warning in &c.warnings {
        out.push_str(&line("!", &warning.text));
    }
    out.extend(unsound(c).map(|text| line("!", &text)));
    out.push_str(&line("points", &points(c)));
    if let Some(a) = &c.along {
        out.push_str(&line("along", &full::along(a)));
    }
    if let Some(o) = &c.outliers {
        out.push_str(&line("outliers", &full::outliers(o)));
    }
    if let Some(covered) = &c.coverage {
        out.push_str(&line("covered", &coverage(covered)));
    }
    let s = &c.deviation.all;
    let number = |x: Option<f64>| x.map_or_else(|| "–".into(), short);
    let mean = s.mean.map_or_else(|| "–".into(), short_signed);
    let what = format!("{mean} mm, σ {}, rms {}", number(s.std_dev), number(s.rms));
    out.push_str(&line("mean", &what));
    for (name, extreme) in [("lowest", &c.lowest), ("highest", &c.highest)] {
        out.extend(extreme.map(|e| line(name, &place(&e))));
    }
    if let Some(r) = &c.reverse {
        let what = format!("Hausdorff distance {} mm, mean {} mm", number(r.hausdorff), number(r.mean));
        out.push_str(&line("both ways", &what));
    }
    if let Some(p) = &c.paper_vs_exact {
        let [differing, count] = [p.differing, p.count].map(grouped);
        let most = short(p.max_difference);
        let what =
            format!("{differing} of {count} points differ from the exact distance, by {most} mm at most");
        out.push_str(&line("paper", &what));
    }
    if let Some(r) = &c.research {
        out.push_str(&full::research(r));
    }
    match (&c.tolerance, c.regions.is_empty()) {
        (_, false) => out.push_str(&full::regions(c)),
        (Some(t), true) => out.push_str(&line("within", &within(t))),
        (None, true) => {}
    }
    let signless = *c.sign.method == SignBy::None;
    if signless && d.verdict.is_some() {
        out.push_str(&line("!", "the deviations have no sign"));
    }
}

/// How many count, and how many do not, by reason.
fn points(c: &Comparison) -> String {
    let excluded: u64 = c.excluded.values().sum();
    let reasons = c.excluded.iter().filter(|(_, n)| **n > 0);
    let reasons: Vec<String> =
        reasons.map(|(reason, n)| format!("{} {}", grouped(*n), reason.replace('_', " "))).collect();
    let left_out = match excluded {
        0 => String::new(),
        n => format!(", {} excluded ({})", grouped(n), reasons.join(", ")),
    };
    let uncertain = match c.surfaces.map_or(0, |s| s.uncertain) {
        0 => String::new(),
        n => format!(", {} with a nearest place that may not be the only one", grouped(n)),
    };
    format!("{} compared{left_out}{uncertain}", grouped(c.deviation.all.count))
}

/// How much of the reference is covered, and how much must be.
fn coverage(c: &CoverageRecord) -> String {
    let share = c.covered_share().map_or_else(
        || c.uncovered_share_reason.clone().unwrap_or_default(),
        |share| format!("{} of the reference", percent(share)),
    );
    let reach = format!("within {} mm of a point", short(c.reach));
    match c.required.filter(|least| *least > 0.0) {
        Some(least) => format!("{share}, {reach}; a pass needs {}", percent(least)),
        None => format!("{share}, {reach}"),
    }
}

fn place(e: &ExtremeRecord) -> String {
    let [x, y, z] = e.point.map(short);
    format!("{} mm at {x}, {y}, {z}", short_signed(e.deviation))
}

fn within(t: &ToleranceShares) -> String {
    let share = |x: Option<f64>| x.map_or_else(|| "–".into(), percent);
    let asked = if t.required < 1.0 { format!(", {} asked", percent(t.required)) } else { String::new() };
    format!(
        "{} within {} … {} mm{asked}; {} above, {} below",
        share(t.inside),
        short_signed(t.lower),
        short_signed(t.upper),
        share(t.above),
        share(t.below)
    )
}

/// What is wrong with a reference, in a line.
fn unsound(c: &Comparison) -> Option<String> {
    let signs = match *c.sign.method {
        SignBy::None => "no signs".into(),
        method => format!("signs by {}", method.name()),
    };
    (!c.soundness.sound).then(|| format!("the reference is not sound ({}); {signs}", full::unsound(c)))
}

/// Several references: a row each, the best first.
fn ranking(out: &mut String, d: &CompareDocument, several: &[Comparison]) {
    for c in several {
        let name = file_name(&c.reference);
        let lines = c.warnings.iter().map(|w| w.text.clone()).chain(unsound(c));
        lines.for_each(|text| out.push_str(&line("!", &format!("{name}: {text}"))));
    }
    let (judged, told) = (d.verdict.is_some(), several.iter().any(|c| c.coverage.is_some()));
    let mut head = vec!["rank", "reference", "points", "mean", "σ", "rms", "lowest", "highest"];
    head.extend(told.then_some("covered"));
    if judged {
        head.extend(["within", "verdict"]);
    }
    let mut rows = vec![head.into_iter().map(String::from).collect::<Vec<String>>()];
    let mut order: Vec<&Comparison> = several.iter().collect();
    order.sort_by_key(|c| c.rank);
    let share = |x: Option<f64>| x.map_or_else(|| "–".into(), percent);
    for c in order {
        let s = &c.deviation.all;
        let mut row = vec![c.rank.to_string(), tail(file_name(&c.reference)), grouped(s.count)];
        let numbers = [s.mean, s.std_dev, s.rms, s.min, s.max];
        row.extend(numbers.map(|x| x.map_or_else(|| "–".into(), short)));
        if told {
            row.push(share(c.coverage.as_ref().and_then(CoverageRecord::covered_share)));
        }
        if judged {
            row.push(share(c.tolerance.as_ref().filter(|_| c.regions.is_empty()).and_then(|t| t.inside)));
            row.push(c.verdict.map_or("–", Verdict::word).into());
        }
        rows.push(row);
    }
    out.push_str(&columns(&rows));
}

/// Columns of a name in the ranking, at most: the table is then no wider than a page.
const MAX_RANKED_NAME_COLUMNS: usize = 22;

/// The end of a name, which tells files of one kind apart.
fn tail(name: &str) -> String {
    let all: Vec<char> = name.chars().collect();
    match all.len() > MAX_RANKED_NAME_COLUMNS {
        true => std::iter::once('…')
            .chain(all[all.len() - MAX_RANKED_NAME_COLUMNS + 1..].iter().copied())
            .collect(),
        false => name.to_string(),
    }
}
