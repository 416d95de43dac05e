//! A trend for people.

use crate::layout::{self, names, sentence};
use crate::number::{counted, fixed, short, six_digits};
use std::fmt::Write;
use trueness_document::Verdict;
use trueness_document::place_map::{MapPlace, TrendMap};
use trueness_document::trend::{IndexRecord, TrendDocument, TrendRecord};

/// The document for people.
pub fn text(document: &TrendDocument, verbose: bool) -> String {
    let mut out = String::new();
    if let Some(title) = &document.title {
        let _ = writeln!(out, "{title}");
    }
    for warning in &document.warnings {
        out += &sentence(&format!("! {warning}"), verbose);
    }
    out += &layout::table(&courses(&document.characteristics), 3);
    out += &layout::table(&capabilities(&document.characteristics), 1);
    let mut reasons: Vec<(&str, Vec<&str>)> = vec![];
    for c in &document.characteristics {
        for o in &c.out_of_control {
            let part = usize::try_from(o.part).ok().and_then(|n| document.parts.get(n));
            let name = part.map_or("", |p| &p.name);
            let text = format!("! {}: part {} ({name}) is {}", c.id, o.part + 1, o.rule.words());
            out += &sentence(&text, verbose);
        }
        if let Some(reason) = c.course_reason.as_ref().or(c.capability_reason.as_ref()) {
            match reasons.iter_mut().find(|r| r.0 == reason) {
                Some((_, ids)) => ids.push(&c.id),
                None => reasons.push((reason, vec![&c.id])),
            }
        }
    }
    for (reason, ids) in reasons {
        out += &sentence(&format!("  {}: {reason}", names(&ids, verbose)), verbose);
    }
    out.extend(document.map.as_ref().map(of_map));
    let passed = document.parts.iter().filter(|p| p.verdict == Verdict::Pass).count();
    let _ = writeln!(
        out,
        "{}: {}, {passed} of them pass; {}; intervals of {} %; mm, degrees",
        document.verdict.word(),
        counted(document.parts.len() as u64, ["part", "parts"]),
        if document.in_control { "in control" } else { "out of control" },
        100.0 * document.confidence
    );
    out
}

/// Where mean and spread over the part are greatest.
fn of_map(map: &TrendMap) -> String {
    let at = |place: Option<MapPlace>| match place {
        None => "–".into(),
        Some(MapPlace { position: [x, y, z], value, .. }) => {
            let [x, y, z] = [x, y, z].map(|x| fixed(x, 3));
            format!("{} at {x}, {y}, {z}", six_digits(value))
        }
    };
    let complete = counted(map.complete, ["place", "places"]);
    let mut out = format!(
        "map: {complete} with a value in every part, {} with some, {} with none\n",
        map.partial, map.without
    );
    for (name, of) in [("mean", &map.means), ("sigma", &map.std_devs)] {
        let _ = writeln!(out, "  {name}: greatest {}", at(of.greatest));
    }
    out
}

/// The course of each characteristic.
fn courses(all: &[TrendRecord]) -> Vec<Vec<String>> {
    let number = |x: Option<f64>| x.map_or_else(|| "–".into(), |x| fixed(x, 4));
    let kind =
        |c: &TrendRecord| format!("{}{}{}", c.symbol, if c.symbol.is_empty() { "" } else { " " }, c.kind);
    let head = ["id", "kind", "feature", "n", "mean", "sigma", "min", "max", "out"];
    let mut rows = vec![head.map(String::from).to_vec()];
    rows.extend(all.iter().map(|c| {
        let sigma = c.std_dev.map_or_else(|| "–".into(), short);
        let out = c.signaled().len().to_string();
        let numbers =
            [c.measured.to_string(), number(c.mean), sigma, number(c.min), number(c.max), out].to_vec();
        [vec![c.id.clone(), kind(c), c.feature.clone()], numbers].concat()
    }));
    rows
}

/// The indices of the characteristics that have some, with their intervals.
fn capabilities(all: &[TrendRecord]) -> Vec<Vec<String>> {
    let index = |i: Option<IndexRecord>| {
        let written =
            |i: IndexRecord| format!("{} ({}…{})", fixed(i.value, 2), fixed(i.low, 2), fixed(i.high, 2));
        i.map_or_else(|| "–".into(), written)
    };
    let of = |c: &TrendRecord| [c.cp, c.cpk, c.pp, c.ppk];
    let some = all.iter().filter(|c| of(c).iter().any(Option::is_some));
    let row = |c: &TrendRecord| [vec![c.id.clone()], of(c).map(index).to_vec()].concat();
    let mut rows: Vec<Vec<String>> = some.map(row).collect();
    if !rows.is_empty() {
        rows.insert(0, ["id", "Cp", "Cpk", "Pp", "Ppk"].map(String::from).to_vec());
    }
    rows
}
