//! One way of writing, tried on the first lines: which of them are rows, which the header, and what the cells are.

use super::{
    cell::{Class, Separator, cells, class, filled, is_comment, is_end},
    header::{Axes, Header, Name},
    row::Layout,
};
use crate::number::count;

/// A row of the sample.
pub(super) struct Line<'a> {
    /// Its number, from 0.
    pub index: usize,
    pub text: &'a [u8],
    pub cells: Vec<&'a [u8]>,
    pub classes: Vec<Class>,
}

/// A way of writing and what it makes of the sample.
pub(super) struct Tried<'a> {
    /// Separator and decimal point.
    pub dialect: (Separator, u8),
    /// Index of the first row.
    pub start: usize,
    /// The rows: all lines from `start` on that are neither blank nor comments.
    pub rows: Vec<Line<'a>>,
    /// Cells of a row, those at the end that are empty in every row not counted.
    pub width: usize,
    /// The line that names the columns.
    pub header: Option<Header>,
    /// Number of points as announced.
    pub announced: Option<u64>,
    /// Lines with two numbers or more.
    pub numeric: usize,
}

/// Whether a line has nothing on it.
pub(super) fn is_blank_line(line: &[u8]) -> bool {
    line.trim_ascii().is_empty()
}

impl<'a> Line<'a> {
    fn of(index: usize, text: &'a [u8], (separator, point): (Separator, u8)) -> Line<'a> {
        // A quote that is not closed: the row will be refused.
        let cells = cells(text, separator).unwrap_or_else(|| vec![text]);
        let classes = cells.iter().map(|c| class(c, point)).collect();
        Line { index, text, cells, classes }
    }
    fn numbers(&self) -> usize {
        self.count(&[Class::Number])
    }
    fn count(&self, kinds: &[Class]) -> usize {
        self.classes.iter().filter(|c| kinds.contains(c)).count()
    }
    fn filled(&self) -> usize {
        filled(&self.cells)
    }
    /// A row of cells like those of other rows, or of nothing but numbers.
    fn is_row(&self, width: usize, kinds: &[Class]) -> bool {
        let numbers = self.count(kinds);
        numbers > 0 && (self.cells.len() == width || self.filled() == width)
            || numbers > 1 && numbers == self.filled()
    }
    /// Every cell is a mark for a missing value, or empty, but not all are empty.
    fn is_gap(&self, width: usize) -> bool {
        self.filled() > 0 && self.cells.len() == width && self.classes.iter().all(|c| *c == Class::Missing)
    }
    /// Cells that may have been meant as numbers, and hardly a word among them: a row to be refused by its place.
    fn is_broken(&self, width: usize) -> bool {
        let [words, unreadable] = [Class::Word, Class::Unreadable].map(|kind| self.count(&[kind]));
        let starts = self.text.trim_ascii().first().is_some_and(|b| b.is_ascii_digit() || b"+-.".contains(b));
        // One cell of all the text: a quote was not closed.
        let open = self.cells.len() == 1
            && self.text.contains(&b'"')
            && self.text.iter().any(|b| self.separates(*b));
        open && starts
            || self.filled() > 1
                && unreadable > 0
                && (words == 0 || words < unreadable && self.cells.len() == width)
    }
    /// A line drawn with characters.
    fn is_rule(&self) -> bool {
        let drawn =
            |b: &u8| matches!(b, b'-' | b'=' | b'_' | b'+' | b'|' | b'~' | b'*') || self.separates(*b);
        let dashes = self.text.iter().filter(|b| matches!(b, b'-' | b'=' | b'_' | b'~' | b'*')).count();
        dashes > 2 * self.cells.len() && self.text.iter().all(drawn)
    }
    fn separates(&self, byte: u8) -> bool {
        matches!(byte, b' ' | b'\t' | b'\r' | b';' | b',')
    }
}

impl<'a> Tried<'a> {
    /// `None` if no line has two cells with numbers, or with what may have been meant as such.
    pub fn new(dialect: (Separator, u8), lines: &[&'a [u8]]) -> Option<Tried<'a>> {
        let said: Vec<Line> = lines
            .iter()
            .enumerate()
            .filter(|(_, l)| !is_blank_line(l) && !is_comment(l.trim_ascii(), dialect.0))
            .map(|(i, l)| Line::of(i, l, dialect))
            .collect();
        let numeric = said.iter().filter(|l| l.numbers() >= 2).count();
        // Where no line has two numbers, cells that may have been meant as such show the rows, to be refused by their place.
        let kinds: &[Class] =
            if numeric > 0 { &[Class::Number] } else { &[Class::Number, Class::Unreadable] };
        let rows = said.iter().filter(|l| l.count(kinds) >= 2);
        let most = most_frequent(rows.map(|l| l.cells.len()))?;
        let first = said.iter().position(|l| l.is_row(most, kinds)).unwrap_or(0);
        let header = named(dialect.0, lines, said[first].index);
        let mut start = match &header {
            Some(header) if !header.comment => {
                said.iter().position(|l| l.index > header.line).unwrap_or(first)
            }
            // Rows of nothing but marks for missing values, or of what is meant as numbers, are rows as well.
            _ => {
                let row = |l: &Line| l.is_gap(most) || l.is_broken(most);
                said[..first].iter().rposition(|l| !row(l)).map_or(0, |before| before + 1)
            }
        };
        let (units, skipped) = between(&said[start..=first], dialect.0);
        start += skipped;
        let mut header =
            header.or_else(|| unnamed(dialect.0, lines, &said[..start], said[start].index, most));
        if let (Some(header), Some(units)) = (&mut header, units) {
            header.take_units(&units);
        }
        let announced = match &said[..start] {
            [only] if header.is_none() => count(only.text.trim_ascii()),
            _ => None,
        };
        let start_line = said[start].index;
        let mut rows: Vec<Line> = said.into_iter().skip(start).collect();
        rows.retain(|l| announced.is_none() || count(l.text.trim_ascii()).is_none());
        let filled = rows.iter().filter(|l| l.cells.len() <= most).map(Line::filled).max().unwrap_or(most);
        let width = header.as_ref().map_or(filled, |h| filled.max(h.names.len().min(most)));
        let rows = rows.into_iter().filter(|l| l.filled() > 0 && !is_end(l.text)).collect();
        Some(Tried { dialect, start: start_line, rows, width, header, announced, numeric })
    }

    /// The layout that takes these columns.
    pub fn layout(&self, end: u8, columns: &[usize]) -> Layout {
        let layout = Layout::of(self.dialect.0, self.dialect.1, end, columns);
        Layout { width: Some(self.width), announced: self.announced.is_some(), ..layout }
    }

    /// Cells that are numbers.
    pub fn numbers(&self) -> usize {
        self.rows.iter().map(Line::numbers).sum()
    }

    /// What the cells of a column are, row by row.
    pub fn column(&self, i: usize) -> impl Iterator<Item = Class> {
        self.rows.iter().map(move |l| l.classes.get(i).copied().unwrap_or(Class::Missing))
    }

    /// The text of the cells of a column.
    pub fn texts(&self, i: usize) -> impl Iterator<Item = &'a [u8]> {
        self.rows.iter().map(move |l| l.cells.get(i).copied().unwrap_or_default())
    }

    /// Equally many cells in every row, and none of them numbers separated by blanks: what stands between is no alignment.
    pub fn clearly_parted(&self) -> bool {
        let even = |l: &Line| l.cells.len() == self.rows[0].cells.len();
        let blanks = |c: &&[u8]| c.contains(&b' ') && c.iter().any(u8::is_ascii_digit);
        self.rows.iter().all(even) && !self.rows.iter().any(|l| l.cells.iter().any(&blanks))
    }
}

/// The most frequent number, the larger of equals.
fn most_frequent(numbers: impl Iterator<Item = usize>) -> Option<usize> {
    let mut all: Vec<usize> = numbers.collect();
    all.sort_unstable();
    all.chunk_by(|a, b| a == b).map(|same| (same.len(), same[0])).max().map(|(_, n)| n)
}

/// The last line before `first` that names x and y: in words, not numbers.
fn named(separator: Separator, lines: &[&[u8]], first: usize) -> Option<Header> {
    let names = |(i, line): (usize, &&[u8])| {
        let comment = is_comment(line.trim_ascii(), separator);
        let header = Header::of(i, line, comment, separator)?;
        let words = header.names.iter().all(|n| class(n.text.as_bytes(), b'.') != Class::Number);
        (words && matches!(header.axes(), Axes::Named(_))).then_some(header)
    };
    lines[..first].iter().enumerate().rev().find_map(names)
}

/// Names that are not those of x and y: the last line before the rows, of as many cells as they, or the line before it
/// where that holds units. A comment of so many words is prose unless it names some coordinate.
fn unnamed(
    separator: Separator,
    lines: &[&[u8]],
    said: &[Line],
    start: usize,
    width: usize,
) -> Option<Header> {
    let words = |h: &Header| {
        let word = |n: &Name| class(n.text.as_bytes(), b'.') == Class::Word || n.text.is_empty();
        width > 1 && h.names.len() == width && h.names.iter().all(word)
    };
    let comment = lines[..start].iter().rposition(|l| is_comment(l.trim_ascii(), separator));
    let mut plain = said.iter().rev().filter(|l| !l.is_rule());
    let last = plain.next();
    if let Some(i) = comment.filter(|i| last.is_none_or(|l| l.index < *i)) {
        return Header::of(i, lines[i], true, separator).filter(|h| words(h) && h.axes() != Axes::Unnamed);
    }
    let header = |l: &Line| Header::of(l.index, l.text, false, separator).filter(words);
    let mut found = header(last?)?;
    if found.is_units() {
        let units = found.clone();
        found = plain.next().and_then(header).unwrap_or(found);
        found.take_units(&units);
    }
    Some(found)
}

/// The units and how many lines stand between a header and the rows: a line of units, lines drawn with characters.
fn between(said: &[Line], separator: Separator) -> (Option<Header>, usize) {
    let mut units = None;
    for (i, line) in said.iter().enumerate() {
        let header = Header::of(line.index, line.text, false, separator);
        match header.filter(Header::is_units) {
            Some(header) => units = Some(header),
            None if line.is_rule() => {}
            None => return (units, i),
        }
    }
    (units, said.len().saturating_sub(1))
}
