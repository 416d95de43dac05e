//! Lines before the first row that would be rows but for a cell: one that is missing, or one too many.

use super::{
    cell::{Class, Separator},
    line::Line,
};
use crate::number::count;

/// The kinds of cells in the columns of a table.
pub(super) struct Kinds<'a> {
    /// For each column, whether there are numbers in it, and whether there are words.
    columns: Vec<[bool; 2]>,
    /// For each column, whether a cell of it is missing.
    gaps: Vec<bool>,
    /// The cells of the first row.
    first: &'a [&'a [u8]],
    /// Columns up to the last one with numbers.
    pub fixed: usize,
    separator: Separator,
}

fn is_number(class: Class) -> bool {
    matches!(class, Class::Number | Class::Unreadable)
}

/// A cell with its digits left out: `P17` is like `P3`.
fn shape(cell: &[u8]) -> Vec<u8> {
    let mut shape: Vec<u8> = cell.iter().map(|b| if b.is_ascii_digit() { b'0' } else { *b }).collect();
    shape.dedup_by(|a, b| *a == b'0' && *b == b'0');
    shape
}

impl<'a> Kinds<'a> {
    /// The kinds in the rows of `width` cells. Where text follows the numbers, only rows count whose last number is in the column `ending`.
    pub fn of(rows: &'a [Line], width: usize, separator: Separator, ending: Option<usize>) -> Kinds<'a> {
        let (mut columns, mut gaps) = (vec![[false; 2]; width], vec![false; width]);
        let last = |l: &Line| l.classes.iter().rposition(|c| is_number(*c));
        let ends = |l: &Line| ending.is_none_or(|column| last(l) == Some(column));
        let complete = || rows.iter().filter(|l| l.cells.len() == width && ends(l));
        for (column, class) in complete().flat_map(|l| l.classes.iter().enumerate()) {
            columns[column][0] |= is_number(*class);
            columns[column][1] |= *class == Class::Word;
            gaps[column] |= *class == Class::Missing;
        }
        let fixed = columns.iter().rposition(|[numbers, _]| *numbers).map_or(0, |last| last + 1);
        let first = complete().next().map_or(&[][..], |l| &l.cells);
        Kinds { columns, gaps, first, fixed, separator }
    }

    /// Whether the fixed part ends in a number in every row.
    pub fn ends_in_number(&self) -> bool {
        self.fixed > 0 && !self.gaps[self.fixed - 1] && !self.columns[self.fixed - 1][1]
    }

    fn takes(&self, column: usize, class: Class) -> bool {
        match self.columns.get(column) {
            Some([numbers, words]) => {
                class == Class::Missing || if is_number(class) { *numbers } else { *words }
            }
            // Further words of a text between blanks.
            None => {
                self.separator == Separator::Blanks && self.fixed < self.columns.len() && !is_number(class)
            }
        }
    }

    /// Whether cells fit the columns in their order, with the column `without` left out.
    fn fits(&self, cells: impl ExactSizeIterator<Item = Class>, without: Option<usize>) -> bool {
        let shift = |i: usize| i + usize::from(without.is_some_and(|w| i >= w));
        let enough = shift(cells.len()) >= self.fixed;
        enough && cells.enumerate().all(|(i, class)| self.takes(shift(i), class))
    }

    /// Whether a line is a row with one cell missing or one too many, or one that is cut short.
    pub fn nearly_fits(&self, line: &Line) -> bool {
        let n = line.filled();
        let classes = &line.classes[..n];
        if line.is_rule() || self.fixed == 0 {
            return false;
        }
        let numbers = n > 1 && classes.iter().any(|c| is_number(*c));
        let all = || classes.iter().copied();
        let with_all = || {
            self.fits(all(), None)
                || (0..self.fixed).any(|column| self.fits(all(), Some(column)))
                || (0..n).any(|extra| {
                    let mut kept = classes.to_vec();
                    kept.remove(extra);
                    self.fits(kept.into_iter(), None)
                })
        };
        numbers && with_all() || self.begins_with(line)
    }

    /// Whether a line is the first cells of a row: numbers, and words like those of the first row.
    fn begins_with(&self, line: &Line) -> bool {
        let n = line.filled();
        // One whole number may be the number of points.
        if n == 0 || n >= self.fixed || n == 1 && count(line.cells[0]).is_some() {
            return false;
        }
        let alike = |i: usize| self.first.get(i).is_some_and(|cell| shape(cell) == shape(line.cells[i]));
        (0..n).all(|i| match line.classes[i] {
            Class::Word => alike(i),
            Class::Missing => line.cells[i].is_empty() && i + 1 < n,
            _ => self.columns[i][0],
        })
    }
}
