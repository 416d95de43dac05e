//! Entities, and how a file lays them out.

use super::super::step::real;
use super::text::{PARAMETER_COLUMNS, SECTION_COLUMN};
use std::io::{self, Write};

/// An entity.
#[derive(Default)]
pub(super) struct Entry {
    /// Its number in the standard.
    pub(super) kind: u32,
    /// Its level.
    pub(super) level: usize,
    /// Number of the entry, from 0, that holds its matrix.
    pub(super) matrix: Option<usize>,
    /// Its status: blank, part of others, use, hierarchy; two digits each.
    pub(super) status: &'static str,
    /// Its parameters, after its number.
    pub(super) parameters: Vec<String>,
}

/// Writes the file of a model with its description and name. `most` is its greatest coordinate.
pub(super) fn file(
    out: &mut dyn Write,
    description: &str,
    name: &str,
    most: f64,
    entries: &[Entry],
) -> io::Result<()> {
    let global = lines(&header(name, most), SECTION_COLUMN);
    writeln!(out, "{description:<72}S{:>7}", 1)?;
    for (n, line) in global.iter().enumerate() {
        writeln!(out, "{line:<72}G{:>7}", n + 1)?;
    }
    let parameters: Vec<Vec<String>> = entries
        .iter()
        .map(|e| {
            let number = std::iter::once(e.kind.to_string());
            lines(&number.chain(e.parameters.iter().cloned()).collect::<Vec<_>>(), PARAMETER_COLUMNS)
        })
        .collect();
    let mut first = 1;
    for (n, (entry, own)) in entries.iter().zip(&parameters).enumerate() {
        let (kind, count, line) = (entry.kind, own.len(), 2 * n + 1);
        let matrix = entry.matrix.map_or(0, |m| 2 * m + 1);
        // Entity, where its parameters start, no structure, line font, level, view, matrix, labels; status.
        writeln!(
            out,
            "{kind:>8}{first:>8}{:>8}{:>8}{:>8}{:>8}{matrix:>8}{:>8}{:>8}D{line:>7}",
            0,
            0,
            entry.level,
            0,
            0,
            if entry.status.is_empty() { "00000000" } else { entry.status }
        )?;
        writeln!(
            out,
            "{kind:>8}{:>8}{:>8}{count:>8}{:>8}{:>8}{:>8}{:>8}{:>8}D{:>7}",
            0,
            0,
            0,
            "",
            "",
            "",
            0,
            line + 1
        )?;
        first += count;
    }
    let mut number = 0;
    for (n, line) in parameters.iter().enumerate().flat_map(|(n, own)| own.iter().map(move |l| (n, l))) {
        number += 1;
        writeln!(out, "{line:<64}{:>8}P{number:>7}", 2 * n + 1)?;
    }
    let totals = format!("S{:>7}G{:>7}D{:>7}P{number:>7}", 1, global.len(), 2 * entries.len());
    writeln!(out, "{totals:<72}T{:>7}", 1)
}

/// Items with a comma after each, the last with a semicolon, in lines of `width` columns at most. No item is cut.
fn lines(items: &[String], width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for (n, item) in items.iter().enumerate() {
        let sign = if n + 1 == items.len() { ';' } else { ',' };
        let last = lines.len() - 1;
        if lines[last].len() + item.len() + 1 > width {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            line.push_str(item);
            line.push(sign);
        }
    }
    lines
}

fn text(s: &str) -> String {
    format!("{}H{s}", s.len())
}

/// The global section of a model known by `name`, whose greatest coordinate is `most`.
fn header(name: &str, most: f64) -> Vec<String> {
    let date = text("19700101.000000");
    vec![
        text(","),
        text(";"),
        text(name),
        text(&format!("{name}.igs")),
        text("trueness"),
        text("trueness"),
        // Bits of an integer, powers of ten and digits of both kinds of real numbers.
        "32".into(),
        "38".into(),
        "6".into(),
        "308".into(),
        "15".into(),
        text(name),
        real(1.0),
        // Millimeters.
        "2".into(),
        text("MM"),
        "1".into(),
        real(0.01),
        date.clone(),
        real(1e-6),
        real(most),
        text(""),
        text(""),
        // Version 5.3, no drafting standard.
        "11".into(),
        "0".into(),
        date,
    ]
}
