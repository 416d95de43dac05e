//! One way of writing, tried on the first lines: which of them are rows, which the header, and what the cells are.

use super::{
    cell::{Class, Separator, class, is_comment, is_end},
    header::{Axes, Header, Name},
    length::{Counted, Length},
    line::{Line, is_blank_line},
    row::Layout,
    uneven::Kinds,
};
use crate::number::count;

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
    /// How long a row is.
    length: Length,
    /// The line that names the columns.
    pub header: Option<Header>,
    /// Number of points as announced.
    pub announced: Option<u64>,
    /// Lines with two numbers or more.
    pub numeric: usize,
}

impl<'a> Tried<'a> {
    /// `None` if no line has two cells with numbers, or with what may have been meant as such.
    pub fn new(dialect: (Separator, u8), lines: &[&'a [u8]]) -> Option<Tried<'a>> {
        let filled: Vec<Line> = lines
            .iter()
            .enumerate()
            .filter(|(_, l)| !is_blank_line(l) && !is_comment(l.trim_ascii(), dialect.0))
            .map(|(i, l)| Line::of(i, l, dialect))
            .collect();
        let numeric = filled.iter().filter(|l| l.numbers() >= 2).count();
        // Where no line has two numbers, cells that may have been meant as such show the rows, to be refused by their place.
        let kinds: &[Class] =
            if numeric > 0 { &[Class::Number] } else { &[Class::Number, Class::Unreadable] };
        let rows = || filled.iter().filter(|l| l.count(kinds) >= 2);
        // Text at the end of a row is as many cells as it has words, so that the last number shows which rows are alike.
        let last_number = |l: &&Line| l.classes.iter().rposition(|c| kinds.contains(c));
        let alike = most_frequent(rows().filter_map(|l| last_number(&l)))?;
        let by_blanks = dialect.0 == Separator::Blanks;
        let ended_alike = || rows().filter(|l| !by_blanks || last_number(l) == Some(alike));
        let most = most_frequent(ended_alike().map(|l| l.cells.len()))?;
        let varied = by_blanks && rows().any(|l| l.cells.len() != most);
        let text = varied && ended_alike().any(|l| l.classes.get(alike + 1) == Some(&Class::Word));
        let ending = text.then_some(alike);
        let first = filled.iter().position(|l| l.is_row(most, kinds)).unwrap_or(0);
        let header = named(dialect.0, lines, filled[first].index);
        let mut start = match &header {
            Some(header) if !header.comment => {
                filled.iter().position(|l| l.index > header.line).unwrap_or(first)
            }
            // Rows of nothing but marks for missing values, of what is meant as numbers, or of a cell too few are rows as well.
            _ => {
                let kinds = Kinds::of(&filled[first..], most, dialect.0, ending);
                let row = |l: &Line| l.is_gap(most) || l.is_broken(most) || kinds.nearly_fits(l);
                filled[..first].iter().rposition(|l| !row(l)).map_or(0, |before| before + 1)
            }
        };
        let (units, skipped) = between(&filled[start..=first], dialect.0);
        start += skipped;
        let mut header =
            header.or_else(|| unnamed(dialect.0, lines, &filled[..start], filled[start].index, most));
        if let (Some(header), Some(units)) = (&mut header, units) {
            header.take_units(&units);
        }
        let announced = match &filled[..start] {
            [only] if header.is_none() => count(only.text.trim_ascii()),
            _ => None,
        };
        let start_line = filled[start].index;
        let mut rows: Vec<Line> = filled.into_iter().skip(start).collect();
        rows.retain(|l| announced.is_none() || count(l.text.trim_ascii()).is_none());
        let filled = rows.iter().filter(|l| l.cells.len() <= most).map(Line::filled).max().unwrap_or(most);
        let width = header.as_ref().map_or(filled, |h| filled.max(h.names.len().min(most)));
        let rows: Vec<Line> = rows.into_iter().filter(|l| l.filled() > 0 && !is_end(l.text)).collect();
        let kinds = Kinds::of(&rows, most, dialect.0, ending);
        // Where all rows between blanks are alike, none may be shorter.
        let fixed = if by_blanks && !text { width } else { kinds.fixed };
        let length = Length { width, fixed, full: most, ends_in_number: kinds.ends_in_number() };
        Some(Tried { dialect, start: start_line, rows, width, length, header, announced, numeric })
    }

    /// The layout that takes these columns.
    pub fn layout(&self, end: u8, columns: &[usize]) -> Layout {
        let layout = Layout::of(self.dialect.0, self.dialect.1, end, columns);
        let fixed = self.length.fixed.max(layout.columns.len());
        let length = Some(Length { fixed, ..self.length });
        Layout { length, announced: self.announced.is_some(), ..layout }
    }

    /// The rows that have all of their cells.
    fn whole(&self) -> impl Iterator<Item = &Line<'a>> {
        let fits = |l: &&Line| {
            self.length.fits(&Counted::of(&l.cells, &self.length), self.dialect.0, self.dialect.1)
        };
        self.rows.iter().filter(fits)
    }

    /// Names that a header has at least: text between blanks is as many cells as it has words.
    pub fn least_names(&self) -> usize {
        if self.dialect.0 == Separator::Blanks { self.length.fixed } else { self.width }
    }

    /// Lines that are rows of several numbers, be the columns clear or not.
    pub fn rows_of_numbers(&self) -> impl Iterator<Item = usize> {
        self.whole().filter(|l| l.numbers() > 1).map(|l| l.index)
    }

    /// Cells that are numbers.
    pub fn numbers(&self) -> usize {
        self.rows.iter().map(Line::numbers).sum()
    }

    /// The kinds of the cells of a column, row by row.
    pub fn column(&self, i: usize) -> impl Iterator<Item = Class> {
        self.whole().map(move |l| l.classes.get(i).copied().unwrap_or(Class::Missing))
    }

    /// The text of the cells of a column.
    pub fn texts(&self, i: usize) -> impl Iterator<Item = &'a [u8]> {
        self.whole().map(move |l| l.cells.get(i).copied().unwrap_or_default())
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

/// Names other than those of x and y: the last line before the rows, with as many cells as these. Where that line holds units, the
/// one before it has the names. A comment of so many words is prose unless it names some coordinate.
fn unnamed(
    separator: Separator,
    lines: &[&[u8]],
    filled: &[Line],
    start: usize,
    width: usize,
) -> Option<Header> {
    let words = |h: &Header| {
        let word = |n: &Name| class(n.text.as_bytes(), b'.') == Class::Word || n.text.is_empty();
        width > 1 && h.names.len() == width && h.names.iter().all(word)
    };
    let comment = lines[..start].iter().rposition(|l| is_comment(l.trim_ascii(), separator));
    let mut plain = filled.iter().rev().filter(|l| !l.is_rule());
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
fn between(filled: &[Line], separator: Separator) -> (Option<Header>, usize) {
    let mut units = None;
    for (i, line) in filled.iter().enumerate() {
        let header = Header::of(line.index, line.text, false, separator);
        match header.filter(Header::is_units) {
            Some(header) => units = Some(header),
            None if line.is_rule() => {}
            None => return (units, i),
        }
    }
    (units, filled.len().saturating_sub(1))
}
