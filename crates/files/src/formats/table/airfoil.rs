//! Airfoils as collections publish them: a title, and rows of x and y in shares of the chord.
//!
//! | form | rows |
//! |---|---|
//! | Selig's | from the trailing edge over the leading one and back |
//! | Lednicer's | two counts, then the upper and the lower side, each from the leading edge |
//!
//! A title may have several lines. It may look like a row (`NACA 0012`, `0.12 0.5`), like names of columns (`CLARK Y`) or like the number of
//! points (`0012`). Only the rows behind it tell: all have two numbers, in the order of one of the forms.

use super::cell::cell_number;
use super::stream::TextPoints;
use crate::{
    Place, Warning,
    error::{Located, Result},
    lines::{line_end, without_mark},
};
use trueness_geom::{cloud::PointStream, space::Point};

/// A file of fewer rows is not taken for an airfoil.
const MIN_AIRFOIL_ROWS: usize = 8;
/// An end of a side lies within this share of the chord from the leading or trailing edge.
const MAX_EDGE_SHARE: f64 = 0.1;
/// A step along a side may go back by this share of the chord.
const MAX_BACKSTEP_SHARE: f64 = MAX_EDGE_SHARE * MAX_EDGE_SHARE;
/// A profile is no thicker than this share of its chord.
const MAX_THICKNESS_SHARE: f64 = 0.6;

/// A file in one of the forms.
#[derive(Debug, PartialEq)]
pub(super) struct Airfoil {
    /// Its text without title and counts. The two sides of Lednicer's form are one row around the profile.
    pub text: Vec<u8>,
    pub warning: Warning,
    /// For each line of this text, its number in the file; both count from 1.
    pub file_lines: Vec<u64>,
}

/// A warning shows this many characters of the title.
const MAX_TITLE_LENGTH: usize = 60;

/// A file in one of the forms; `None` for any other text.
pub(super) fn plain(text: &[u8]) -> Option<Airfoil> {
    let end = line_end(text);
    let lines: Vec<&[u8]> = without_mark(text).split(|b| *b == end).collect();
    let filled: Vec<usize> = (0..lines.len()).filter(|i| !lines[*i].trim_ascii().is_empty()).collect();
    // After the title come only rows of two numbers.
    let words = filled.iter().rposition(|i| row(lines[*i]).is_none()).map_or(0, |last| last + 1);
    let values: Vec<[f64; 2]> = filled[words..].iter().filter_map(|i| row(lines[*i])).collect();
    // The last line of the title may look like a row.
    let starts = || (0..=1).filter(|more| *more < values.len());
    let two_sides = starts().find_map(|more| Some((more, lednicer(&values[more..])?)));
    let around = || starts().find(|more| is_selig(&values[*more..])).filter(|more| words + more > 0);
    let named = filled[..words].iter().any(|i| names_columns(lines[*i]));
    let (more, upper) = match two_sides {
        Some((more, upper)) => (more, Some(upper)),
        None => (around().filter(|_| !named)?, None),
    };
    let (title, rows) = filled.split_at(words + more);
    let values = &values[more..];
    let mut order: Vec<usize> = (0..lines.len()).collect();
    let mut kept = lines.clone();
    title.iter().for_each(|i| kept[*i] = b"");
    if let Some(upper) = upper {
        // Both sides begin with the leading edge.
        let once = usize::from(values[1] == values[1 + upper]);
        rows[..=once].iter().for_each(|i| kept[*i] = b"");
        let around = (1 + once..=upper).rev().chain(1 + upper..rows.len());
        for (place, k) in rows[1 + once..].iter().zip(around) {
            (kept[*place], order[*place]) = (lines[rows[k]], rows[k]);
        }
    }
    let form = if upper.is_some() { "Lednicer" } else { "Selig" };
    let title: Vec<String> =
        title.iter().map(|i| String::from_utf8_lossy(lines[*i].trim_ascii()).into_owned()).collect();
    let shown = title.join(" / ").chars().take(MAX_TITLE_LENGTH).collect();
    let warning = Warning::Airfoil { form, title: (!title.is_empty()).then_some(shown) };
    let file_lines = order.iter().map(|i| *i as u64 + 1).collect();
    Some(Airfoil { text: kept.join(&end), warning, file_lines })
}

/// A fault of the text in [`Airfoil`], at its line in the file.
pub(super) fn in_file(fault: Located, file_lines: &[u64]) -> Located {
    match fault.place {
        Place::Line(line) => {
            let at = usize::try_from(line).ok().and_then(|n| file_lines.get(n.wrapping_sub(1)));
            fault.fault.at_line(at.copied().unwrap_or(line))
        }
        _ => fault,
    }
}

/// Points of the text in [`Airfoil`].
pub(super) struct Around {
    pub points: TextPoints,
    pub file_lines: Vec<u64>,
}

impl PointStream for Around {
    type Error = Located;
    fn expected(&self) -> Option<u64> {
        self.points.expected()
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<()> {
        self.points.next_block(block).map_err(|fault| in_file(fault, &self.file_lines))
    }
}

/// The two numbers of a line that holds nothing else.
fn row(line: &[u8]) -> Option<[f64; 2]> {
    let parts = |b: &u8| b.is_ascii_whitespace() || *b == b',';
    let mut words = line.split(parts).filter(|w| !w.is_empty()).map(|w| cell_number(w, b'.'));
    let found = [words.next()??, words.next()??];
    words.next().is_none().then_some(found)
}

/// Whether a line names x and y.
fn names_columns(line: &[u8]) -> bool {
    let text = String::from_utf8_lossy(line).to_lowercase();
    let words = || text.split(|c: char| !c.is_alphanumeric());
    words().any(|w| w == "x") && words().any(|w| w == "y")
}

/// Least and greatest of one coordinate.
fn range(values: &[[f64; 2]], k: usize) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), p| (a.min(p[k]), b.max(p[k])))
}

/// Whether rows run from the greatest x to the least and back, and lie in a thin strip.
fn is_selig(values: &[[f64; 2]]) -> bool {
    let ((low, high), (bottom, top)) = (range(values, 0), range(values, 1));
    let (chord, n) = (high - low, values.len());
    if n < MIN_AIRFOIL_ROWS || chord <= 0.0 || top - bottom > MAX_THICKNESS_SHARE * chord {
        return false;
    }
    let Some(nose) = (0..n).min_by(|a, b| values[*a][0].total_cmp(&values[*b][0])) else { return false };
    let near = |p: &[f64; 2]| high - p[0] <= MAX_EDGE_SHARE * chord;
    let on = |w: &[[f64; 2]], sign: f64| sign * (w[1][0] - w[0][0]) >= -MAX_BACKSTEP_SHARE * chord;
    nose >= 2
        && nose + 2 < n
        && near(&values[0])
        && near(&values[n - 1])
        && values[..=nose].windows(2).all(|w| on(w, -1.0))
        && values[nose..].windows(2).all(|w| on(w, 1.0))
}

/// The number of rows of the upper side, in Lednicer's form. There the first row counts the rows of both sides, and each side runs from the
/// least x to the greatest.
fn lednicer(values: &[[f64; 2]]) -> Option<usize> {
    let ([upper, lower], rows) = (*values.first()?, &values[1..]);
    let whole = |x: f64| (2.0..1e6).contains(&x) && x.fract() == 0.0;
    if !whole(upper)
        || !whole(lower)
        || rows.len() < MIN_AIRFOIL_ROWS
        || (upper + lower) as usize != rows.len()
    {
        return None;
    }
    let sides = rows.split_at(upper as usize);
    let (low, high) = range(rows, 0);
    let chord = high - low;
    let rises = |side: &[[f64; 2]]| {
        let (first, last) = (side[0][0], side[side.len() - 1][0]);
        first - low <= MAX_EDGE_SHARE * chord
            && high - last <= MAX_EDGE_SHARE * chord
            && side.windows(2).all(|w| w[1][0] - w[0][0] >= -MAX_BACKSTEP_SHARE * chord)
    };
    (chord > 0.0 && rises(sides.0) && rises(sides.1)).then_some(upper as usize)
}

#[cfg(test)]
mod tests;
