//! Whether a row has all of its cells.
//!
//! A cell that is missing together with its separator moves the cells behind it to the left. Its own row does not show that, but the other
//! rows do. The columns up to the last one that holds numbers are the fixed part, which each row has as a whole. A row without one of these
//! cells is shorter than the fixed part, or has words of a later column where the fixed part ends. Only text behind the fixed part may be
//! missing and, between blanks, be several words.

use super::cell::{Class, Separator, class, unquoted};
use crate::error::{Fault, quoted};

/// How long the rows of a table are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Length {
    /// Cells of a row, those at the end that are empty in every row not counted.
    pub width: usize,
    /// Cells up to the last column that holds numbers.
    pub fixed: usize,
    /// Cells of a row as most rows have them, empty ones at the end counted too. A row of so many separators lacks none.
    pub full: usize,
    /// Whether the fixed part ends in a number in every row that most are like.
    pub ends_in_number: bool,
}

/// The cells of a row, counted.
pub(super) struct Counted<'a> {
    pub cells: usize,
    /// Without empty ones at the end.
    filled: usize,
    /// The last cell of the fixed part; `None` where it is known to be a number.
    last: Option<&'a [u8]>,
    /// The first cell behind the fixed part.
    behind: Option<&'a [u8]>,
}

impl<'a> Counted<'a> {
    /// A row of which so many cells, the last of them a number, have been read.
    pub fn from(cells: usize) -> Counted<'a> {
        Counted { cells, filled: cells, last: None, behind: None }
    }

    pub fn of(cells: &[&'a [u8]], length: &Length) -> Counted<'a> {
        let mut counted = Counted::from(0);
        cells.iter().for_each(|cell| counted.push(cell, length));
        counted
    }

    pub fn push(&mut self, cell: &'a [u8], length: &Length) {
        let cell = unquoted(cell);
        if self.cells + 1 == length.fixed {
            self.last = Some(cell);
        }
        if self.cells == length.fixed {
            self.behind = Some(cell);
        }
        self.cells += 1;
        if !cell.is_empty() {
            self.filled = self.cells;
        }
    }
}

impl Length {
    /// Whether a row is as long as it should be.
    pub(super) fn fits(&self, row: &Counted, separator: Separator, point: u8) -> bool {
        let last = || row.last.map_or(Class::Number, |cell| class(cell, point));
        let is_number = |class: Class| matches!(class, Class::Number | Class::Unreadable);
        match separator {
            Separator::Byte(_) if row.filled > self.width => false,
            Separator::Byte(_) if row.cells == self.full => true,
            Separator::Byte(_) if row.cells > self.full => {
                self.ends_in_number
                    && is_number(last())
                    && !row.behind.is_some_and(|cell| is_number(class(cell, point)))
            }
            Separator::Byte(_) => row.filled >= self.fixed && is_number(last()),
            Separator::Blanks if self.fixed == self.width => row.cells == self.width,
            Separator::Blanks => {
                let gap = || !self.ends_in_number && row.cells == self.width && last() == Class::Missing;
                let ends = is_number(last()) || gap();
                row.cells >= self.fixed
                    && ends
                    && !row.behind.is_some_and(|cell| is_number(class(cell, point)))
            }
        }
    }

    /// Whether a row has fewer cells than most.
    pub(super) fn is_short(&self, row: &Counted, separator: Separator) -> bool {
        let least = match separator {
            Separator::Blanks if self.fixed < self.width => self.fixed,
            Separator::Blanks => self.width,
            Separator::Byte(_) => self.full,
        };
        row.cells < least
    }

    /// The fault of a row that does not fit.
    pub(super) fn fault(&self, row: &Counted, separator: Separator, text: &[u8]) -> Fault {
        let (shown, blanks) = (quoted(text), separator == Separator::Blanks);
        if blanks && self.fixed < self.width {
            let what = format!("expected a row of {} cells and text behind them, found {shown}", self.fixed);
            let remedy = "put in what is missing, delete what is too much, or export with semicolons between the columns";
            return Fault::Unclear { what, remedy };
        }
        let short = self.is_short(row, separator);
        let found = if blanks || short { row.cells } else { row.filled.max(row.cells) };
        let what =
            format!("expected a row of {} cells as the others are, found {found} in {shown}", self.width);
        let remedy = match short {
            true => "put in the missing cell or separator, or delete the line",
            false => "delete what is too much, or the line",
        };
        Fault::Unclear { what, remedy }
    }
}
