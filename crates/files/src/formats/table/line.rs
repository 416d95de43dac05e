//! A line as a way of writing cuts it, and what it looks like.

use super::cell::{Class, Separator, cells, class, filled};

/// A row of the sample.
pub(super) struct Line<'a> {
    /// Its number, from 0.
    pub index: usize,
    pub text: &'a [u8],
    pub cells: Vec<&'a [u8]>,
    pub classes: Vec<Class>,
}

/// Whether a line has nothing on it.
pub(super) fn is_blank_line(line: &[u8]) -> bool {
    line.trim_ascii().is_empty()
}

impl<'a> Line<'a> {
    pub fn of(index: usize, text: &'a [u8], (separator, point): (Separator, u8)) -> Line<'a> {
        // A quote that is not closed: the row will be refused.
        let cells = cells(text, separator).unwrap_or_else(|| vec![text]);
        let classes = cells.iter().map(|c| class(c, point)).collect();
        Line { index, text, cells, classes }
    }
    pub fn numbers(&self) -> usize {
        self.count(&[Class::Number])
    }
    pub fn count(&self, kinds: &[Class]) -> usize {
        self.classes.iter().filter(|c| kinds.contains(c)).count()
    }
    pub fn filled(&self) -> usize {
        filled(&self.cells)
    }
    /// A row of cells like those of other rows, or of nothing but numbers.
    pub fn is_row(&self, width: usize, kinds: &[Class]) -> bool {
        let numbers = self.count(kinds);
        numbers > 0 && (self.cells.len() == width || self.filled() == width)
            || numbers > 1 && numbers == self.filled()
    }
    /// Every cell is a mark for a missing value, or empty, but not all are empty.
    pub fn is_gap(&self, width: usize) -> bool {
        self.filled() > 0 && self.cells.len() == width && self.classes.iter().all(|c| *c == Class::Missing)
    }
    /// Cells that may have been meant as numbers, and hardly a word among them: a row to be refused by its place.
    pub fn is_broken(&self, width: usize) -> bool {
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
    pub fn is_rule(&self) -> bool {
        let drawn =
            |b: &u8| matches!(b, b'-' | b'=' | b'_' | b'+' | b'|' | b'~' | b'*') || self.separates(*b);
        let dashes = self.text.iter().filter(|b| matches!(b, b'-' | b'=' | b'_' | b'~' | b'*')).count();
        dashes > 2 * self.cells.len() && self.text.iter().all(drawn)
    }
    fn separates(&self, byte: u8) -> bool {
        matches!(byte, b' ' | b'\t' | b'\r' | b';' | b',')
    }
}
