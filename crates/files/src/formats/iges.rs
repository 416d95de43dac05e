//! IGES 5.3 files: one B-spline surface (entity 128), millimetres.
//!
//! Lines have 80 columns: 64 to 72 of content, a letter for the section, a number. Control points run along `u` first. The dates are fixed,
//! so that the same surface gives the same bytes.

use super::step::real;
use crate::cad::SplineSurface;
use std::io::{self, Write};

/// Columns of a line of parameters.
const PARAMETERS: usize = 64;
/// Columns of a line of the global section.
const GLOBAL: usize = 72;

/// Writes the surface.
pub fn write(out: &mut dyn Write, surface: &SplineSurface) -> io::Result<()> {
    let parameters = lines(&numbers(surface), PARAMETERS);
    let global = lines(&header(surface), GLOBAL);
    writeln!(out, "{:<72}S{:>7}", "B-spline surface", 1)?;
    for (n, line) in global.iter().enumerate() {
        writeln!(out, "{line:<72}G{:>7}", n + 1)?;
    }
    let count = parameters.len();
    // Entity, where its parameters start, no structure, line font, level, view, matrix, labels; status.
    writeln!(
        out,
        "{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}D{:>7}",
        128, 1, 0, 0, 0, 0, 0, 0, "00000000", 1
    )?;
    writeln!(
        out,
        "{:>8}{:>8}{:>8}{count:>8}{:>8}{:>8}{:>8}{:>8}{:>8}D{:>7}",
        128, 0, 0, 0, "", "", "", 0, 2
    )?;
    for (n, line) in parameters.iter().enumerate() {
        writeln!(out, "{line:<64}{:>8}P{:>7}", 1, n + 1)?;
    }
    let totals = format!("S{:>7}G{:>7}D{:>7}P{count:>7}", 1, global.len(), 2);
    writeln!(out, "{totals:<72}T{:>7}", 1)
}

/// Items with a comma after each, the last with a semicolon, in lines of no more than `width` columns. No item is cut.
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

fn header(surface: &SplineSurface) -> Vec<String> {
    let most = surface.points.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
    let date = text("19700101.000000");
    vec![
        text(","),
        text(";"),
        text("surface"),
        text("surface.igs"),
        text("trueness"),
        text("trueness"),
        // Bits of an integer, powers of ten and digits of both kinds of real numbers.
        "32".into(),
        "38".into(),
        "6".into(),
        "308".into(),
        "15".into(),
        text("surface"),
        real(1.0),
        // Millimetres.
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

fn numbers(surface: &SplineSurface) -> Vec<String> {
    let ([m, n], [p, q]) = (surface.counts(), surface.degree);
    let mut all: Vec<String> = [128, m - 1, n - 1, p, q].map(|k| k.to_string()).to_vec();
    // Not closed in either direction, polynomial, not periodic.
    all.extend([0, 0, 1, 0, 0].map(|k| k.to_string()));
    all.extend(surface.knots.iter().flat_map(|k| k.iter().map(|t| real(*t))));
    all.extend(std::iter::repeat_n(real(1.0), m * n));
    all.extend((0..m * n).flat_map(|k| surface.point(k % m, k / m).map(real)));
    let domain = |k: usize| [surface.knots[k][surface.degree[k]], surface.knots[k][surface.counts()[k]]];
    all.extend([domain(0), domain(1)].concat().into_iter().map(real));
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_has_eighty_columns_and_every_number_its_digits() {
        let knots = [0.0, 0.0, 1e-7, 1e22, 1e22];
        let points: Vec<[f64; 3]> = (0..9).map(|k| [f64::from(k) / 3.0, -1e-300, 1.0]).collect();
        let surface = SplineSurface { degree: [1, 1], knots: [&knots, &knots], points: &points };
        let mut bytes = vec![];
        write(&mut bytes, &surface).unwrap();
        let file = String::from_utf8(bytes).unwrap();
        assert!(file.lines().all(|l| l.len() == 80));
        let parameters: String =
            file.lines().filter(|l| l.as_bytes()[72] == b'P').map(|l| l[..64].trim_end()).collect();
        let found: Vec<f64> =
            parameters.trim_end_matches(';').split(',').map(|x| x.parse().unwrap()).collect();
        assert_eq!(found.len(), 10 + 10 + 9 + 27 + 4);
        assert_eq!(found[10..15], knots);
        // The second point along u comes second.
        assert_eq!(found[29 + 3..29 + 6], points[3]);
        assert_eq!(found[56..], [0.0, 1e22, 0.0, 1e22]);
        let last = file.lines().last().unwrap();
        let lines = |section: u8| file.lines().filter(|l| l.as_bytes()[72] == section).count();
        assert_eq!(&last[..32], format!("S      1G{:>7}D      2P{:>7}", lines(b'G'), lines(b'P')));
    }
}
