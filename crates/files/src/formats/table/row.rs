//! One row of a table.
//!
//! Numbers are parsed where they stand. A row that this way does not read (a comment, a quoted blank, a fault) is
//! cut into cells and looked at again. Where both ways read a row, they give the same numbers.

use super::cell::{
    Class, END_MARK, Separator, cell_end, cell_number, cells, class, is_comment, is_end, next_cell,
    run_together, skip_blanks,
};
use super::length::{Counted, Length};
use crate::{
    error::{Fault, quoted},
    number::{count, number},
};
use trueness_geom::space::Point;

/// How rows are written, and which of their columns are wanted.
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
    /// How long rows are; `None` leaves the end of a row alone.
    pub length: Option<Length>,
    /// The byte that ends lines.
    pub end: u8,
}

/// A column that is passed over.
pub(crate) const UNWANTED: u8 = 3;

/// The content of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Row {
    Point(Point),
    /// A blank line or a comment.
    Nothing,
    /// Separators without anything between them: spreadsheets write such rows behind the last, and a point whose every
    /// coordinate is missing looks the same. Or what ends the text.
    Hollow,
    /// So many rows follow.
    Announced(u64),
}

impl Layout {
    /// The layout that takes these columns, counted from 0, for x, y and z.
    pub fn of(separator: Separator, point: u8, end: u8, wanted: &[usize]) -> Layout {
        let mut columns = vec![UNWANTED; wanted.iter().max().map_or(0, |m| m + 1)];
        for (axis, &column) in wanted.iter().enumerate().take(3) {
            columns[column] = axis as u8;
        }
        Layout { separator, point, columns, planar: wanted.len() == 2, announced: false, length: None, end }
    }

    /// The content of a line, or its fault.
    #[inline]
    pub fn row(&self, line: &[u8]) -> Result<Row, Fault> {
        let mut point = [0.0; 3];
        let mut at = skip_blanks(line, 0, self.separator);
        for (i, &axis) in self.columns.iter().enumerate() {
            if i > 0 {
                match next_cell(line, at, self.separator) {
                    Some(next) => at = next,
                    None => return self.read_by_cells(line),
                }
            }
            if axis == UNWANTED {
                match cell_end(line, at, self.separator) {
                    Some(end) => at = end,
                    None => return self.read_by_cells(line),
                }
                continue;
            }
            let quote = usize::from(line.get(at) == Some(&b'"'));
            let start = at + quote;
            match number(line.get(start..).unwrap_or_default(), self.point) {
                // "1," is a number cut off, or followed by a comma that separates.
                Some((x, n))
                    if x.is_finite() && (self.point == b'.' || line.get(start + n - 1) != Some(&b',')) =>
                {
                    point[usize::from(axis)] = x;
                    at = start + n;
                }
                _ => return self.read_by_cells(line),
            }
            if quote == 1 {
                if line.get(at) != Some(&b'"') {
                    return self.read_by_cells(line);
                }
                at += 1;
            }
            if line.get(at).is_some_and(|b| !self.ends_number(*b)) {
                return self.read_by_cells(line);
            }
        }
        if self.tail(line, at) { Ok(Row::Point(point)) } else { self.read_by_cells(line) }
    }

    #[inline(always)]
    fn ends_number(&self, byte: u8) -> bool {
        super::cell::is_blank(byte) || self.separator.parts(byte)
    }

    /// Whether what follows the last wanted column, which ends at `at`, is as it should be.
    #[inline]
    fn tail(&self, line: &[u8], at: usize) -> bool {
        let Some(length) = &self.length else { return true };
        let counted = match skip_blanks(line, at, self.separator) >= line.len() {
            true => Some(Counted::from(self.columns.len())),
            false => self.counted(line, at, length),
        };
        counted.is_some_and(|row| length.fits(&row, self.separator, self.point))
    }

    /// The cells of a row whose last wanted one ends at `end`.
    fn counted<'a>(&self, line: &'a [u8], mut end: usize, length: &Length) -> Option<Counted<'a>> {
        let mut row = Counted::from(self.columns.len());
        while let Some(next) = next_cell(line, end, self.separator) {
            end = cell_end(line, next, self.separator)?;
            row.push(&line[next..end], length);
        }
        // Something behind a blank that no separator parts from the cell before.
        (skip_blanks(line, end, self.separator) >= line.len()).then_some(row)
    }

    /// A line that is not read at first sight.
    #[cold]
    fn read_by_cells(&self, line: &[u8]) -> Result<Row, Fault> {
        let text = line.trim_ascii();
        if text.is_empty() || is_comment(text, self.separator) {
            return Ok(Row::Nothing);
        }
        if let Some(n) = count(text).filter(|_| self.announced) {
            return Ok(Row::Announced(n));
        }
        if text.iter().all(|b| self.ends_number(*b)) || is_end(text) {
            return Ok(Row::Hollow);
        }
        if let [before @ .., END_MARK] = text {
            return self.row(before);
        }
        if text.contains(&0) {
            return Err(Fault::Zeros);
        }
        let Some(cells) = cells(line, self.separator) else {
            return Err(Fault::unexpected("a quote that is closed on the same line", text));
        };
        let row = self.length.map(|length| (Counted::of(&cells, &length), length));
        let unfit = row.filter(|(row, length)| !length.fits(row, self.separator, self.point));
        let fault = |(row, length): &(Counted, Length)| length.fault(row, self.separator, text);
        // A row that lacks a cell holds wrong numbers; one of too many first tells of the number that is cut in two.
        if let Some(short) = unfit.as_ref().filter(|(row, length)| length.is_short(row, self.separator)) {
            let together = cells.iter().find(|c| run_together(c).is_some());
            return Err(together.map_or_else(|| fault(short), |cell| self.fault(0, 0, cell)));
        }
        let mut point = [0.0; 3];
        for (i, &axis) in self.columns.iter().enumerate().filter(|(_, axis)| **axis != UNWANTED) {
            let cell = cells.get(i).copied().unwrap_or_default();
            let number = cell_number(cell, self.point);
            point[usize::from(axis)] = number.ok_or_else(|| self.fault(i, axis, cell))?;
        }
        unfit.as_ref().map_or(Ok(Row::Point(point)), |row| Err(fault(row)))
    }

    /// Fault and remedy of a cell that should hold a number.
    fn fault(&self, column: usize, axis: u8, cell: &[u8]) -> Fault {
        if let Some((what, remedy)) = run_together(cell) {
            return Fault::Unclear { what: format!("{what}: {}", quoted(cell)), remedy };
        }
        let text = String::from_utf8_lossy(cell);
        let digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
        let signs = cell.iter().filter(|b| matches!(b, b'.' | b',')).count();
        let grouped = signs > 1 || text.contains(['\'', ' ', '\u{a0}', '\u{2009}', '\u{202f}']);
        let other = if self.point == b'.' { ',' } else { '.' };
        let dash = ['\u{2010}', '\u{2011}', '\u{2012}', '\u{2013}', '\u{2014}'];
        let quotes_commas = self.separator == Separator::Byte(b',') && text.contains(',');
        let remedy = match class(cell, self.point) {
            Class::Missing => "fill the cell, delete the row, or name other columns by --columns",
            Class::Word => "mend the cell, or name other columns by --columns",
            _ if text.starts_with(dash) => "write the minus sign as -",
            _ if quotes_commas => "export with decimal points and without thousands separators",
            _ if grouped && digit(text.chars().next_back()) => "export without thousands separators",
            _ if text.contains(other) => "write all numbers with the same decimal sign",
            _ if text.ends_with(char::is_alphabetic) => {
                "write the number alone; a unit belongs in the header"
            }
            _ => "mend the cell or export the file again",
        };
        let sign = if self.point == b',' { "comma" } else { "point" };
        let expected = match class(cell, self.point) {
            Class::Missing if !cell.is_empty() => "a finite number".into(),
            Class::Missing => "a number".into(),
            _ => format!("a number with a decimal {sign}"),
        };
        let name = ["x", "y", "z"].get(usize::from(axis)).copied().unwrap_or_default().into();
        Fault::Cell { column: column + 1, name, expected: expected.into(), found: quoted(cell), remedy }
    }
}
