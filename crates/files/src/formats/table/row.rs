//! One row of a table.

use crate::{
    error::Fault,
    number::{count, number},
};
use trueness_geom::space::Point;

/// What stands between the columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Separator {
    /// Any number of blanks and tabs.
    Blanks,
    /// This byte once, blanks around it paid no heed to. Columns may be empty or quoted.
    Byte(u8),
}

/// How rows are written, and what of them is wanted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Layout {
    pub separator: Separator,
    /// The decimal point: `.` or `,`.
    pub point: u8,
    /// For each column up to the last one wanted: the coordinate it is, or [`UNWANTED`].
    pub columns: Vec<u8>,
    /// x and y only.
    pub planar: bool,
    /// A row of one whole number announces so many rows, as in PTS files.
    pub announced: bool,
    /// The byte that ends lines.
    pub end: u8,
}

/// A column that is passed over.
pub(crate) const UNWANTED: u8 = 3;

impl Layout {
    /// The layout that takes these columns, counted from 0, for x, y and z.
    pub fn of(separator: Separator, point: u8, end: u8, wanted: &[usize]) -> Layout {
        let mut columns = vec![UNWANTED; wanted.iter().max().map_or(0, |m| m + 1)];
        for (axis, &column) in wanted.iter().enumerate().take(3) {
            columns[column] = axis as u8;
        }
        Layout { separator, point, columns, planar: wanted.len() == 2, announced: false, end }
    }

    /// The point of a line, `None` if it is blank or a comment, or what is wrong and at which byte of it.
    #[inline]
    pub fn row(&self, line: &[u8]) -> Result<Option<Point>, (usize, Fault)> {
        let mut point = [0.0; 3];
        let mut at = skip_blanks(line, 0, self.separator);
        for (i, &axis) in self.columns.iter().enumerate() {
            if i > 0 {
                match self.next_column(line, at) {
                    Some(next) => at = next,
                    None => return self.odd(line, at),
                }
            }
            if axis == UNWANTED {
                at = self.column_end(line, at);
                continue;
            }
            let start = at + usize::from(line.get(at) == Some(&b'"'));
            match number(line.get(start..).unwrap_or_default(), self.point) {
                Some((x, length)) if x.is_finite() => {
                    point[usize::from(axis)] = x;
                    at = start + length;
                    at += usize::from(line.get(at) == Some(&b'"'));
                }
                _ => return self.odd(line, at),
            }
        }
        // The last number must end where its column ends.
        match line.get(at) {
            Some(b) if !self.ends_column(*b) => self.odd(line, at),
            _ => Ok(Some(point)),
        }
    }

    fn ends_column(&self, byte: u8) -> bool {
        is_blank(byte) || self.separator == Separator::Byte(byte)
    }

    /// The start of the next column, `at` being the end of one.
    #[inline]
    fn next_column(&self, line: &[u8], at: usize) -> Option<usize> {
        let next = skip_blanks(line, at, self.separator);
        match self.separator {
            Separator::Blanks => (next > at && next < line.len()).then_some(next),
            Separator::Byte(b) => {
                (line.get(next) == Some(&b)).then(|| skip_blanks(line, next + 1, self.separator))
            }
        }
    }

    /// The end of a column that begins at `at` and is passed over.
    fn column_end(&self, line: &[u8], at: usize) -> usize {
        let rest = &line[at..];
        if let [b'"', inner @ ..] = rest {
            let close = memchr::memchr(b'"', inner).unwrap_or(inner.len());
            return (at + close + 2).min(line.len());
        }
        let ends = |b: &u8| match self.separator {
            Separator::Blanks => is_blank(*b),
            Separator::Byte(s) => *b == s,
        };
        at + rest.iter().position(ends).unwrap_or(rest.len())
    }

    /// A line that gives no point.
    #[cold]
    fn odd(&self, line: &[u8], at: usize) -> Result<Option<Point>, (usize, Fault)> {
        let text = line.trim_ascii();
        if text.is_empty() || is_comment(text, self.separator) || self.announced && count(text).is_some() {
            return Ok(None);
        }
        if text.iter().all(|b| self.ends_column(*b)) {
            // A spreadsheet writes rows of nothing but separators.
            return Ok(None);
        }
        let word = &line[at..self.column_end(line, at).max(at)];
        let value = number(word.trim_ascii(), self.point).map(|(x, _)| x);
        if value.is_some_and(|x| !x.is_finite()) {
            return Err((at, Fault::unexpected("a finite number", word)));
        }
        let wanted = self.columns.len();
        let expected = match (self.point, word.is_empty()) {
            (_, true) => format!("a number in each of {wanted} columns"),
            (b',', _) => "a number with a decimal comma".into(),
            _ => "a number with a decimal point".into(),
        };
        let found = if word.is_empty() { text } else { word };
        Err((at, Fault::unexpected(expected, found)))
    }

    /// All columns of a line as text, quotes taken off.
    pub fn words(separator: Separator, line: &[u8]) -> Vec<&[u8]> {
        let layout =
            Layout { separator, point: b'.', columns: vec![], planar: false, announced: false, end: b'\n' };
        let mut words = vec![];
        let mut at = skip_blanks(line, 0, separator);
        while at < line.len() || separator != Separator::Blanks {
            let end = layout.column_end(line, at.min(line.len()));
            words.push(unquoted(&line[at.min(line.len())..end]));
            match layout.next_column(line, end) {
                Some(next) => at = next,
                None => break,
            }
        }
        words
    }
}

fn unquoted(word: &[u8]) -> &[u8] {
    let word = word.trim_ascii();
    word.strip_prefix(b"\"").map_or(word, |w| w.strip_suffix(b"\"").unwrap_or(w))
}

#[inline(always)]
fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\r')
}

#[inline(always)]
fn skip_blanks(line: &[u8], mut at: usize, separator: Separator) -> usize {
    while let Some(&b) = line.get(at)
        && is_blank(b)
        && separator != Separator::Byte(b)
    {
        at += 1;
    }
    at
}

/// Whether a line, blanks before it taken off, is a comment.
pub(super) fn is_comment(line: &[u8], separator: Separator) -> bool {
    match line {
        [b'#' | b'%' | b'!' | b'\'', ..] | [b'/', b'/', ..] => true,
        [b';', ..] => separator != Separator::Byte(b';'),
        _ => false,
    }
}
