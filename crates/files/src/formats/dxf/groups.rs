//! Groups of a DXF file: a code on a line, its value on the next.

use crate::error::{Fault, Located, Result};
use crate::lines::Lines;
use crate::number;

/// The first bytes of a binary file.
pub(super) const BINARY_MARK: &[u8] = b"AutoCAD Binary DXF";

/// Differences below this share of a size or of a quarter turn come from the rounding of the numbers in a file.
pub(super) const FILE_ROUNDING: f64 = 1e-6;

/// Whether text begins as a drawing does.
pub(super) fn begins(bytes: &[u8]) -> bool {
    if bytes.starts_with(BINARY_MARK) {
        return true;
    }
    let mut lines = Lines::new(bytes).map(<[u8]>::trim_ascii);
    loop {
        match (lines.next(), lines.next()) {
            (Some(b"999"), Some(_)) => {}
            (Some(b"0"), Some(b"SECTION")) => return true,
            _ => return false,
        }
    }
}

/// A group.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group<'a> {
    pub code: i64,
    pub value: &'a [u8],
    /// Line of its value.
    pub line: u64,
}

impl Group<'_> {
    pub fn is(&self, code: i64, value: &[u8]) -> bool {
        self.code == code && self.value == value
    }

    /// Its value as a number that is finite.
    pub fn number(&self) -> Result<f64> {
        let found = number::whole_number(self.value, b'.').filter(|x| x.is_finite());
        found.ok_or_else(|| self.wrong("a finite number"))
    }

    /// Its value as an integer.
    pub fn integer(&self) -> Result<i64> {
        number::integer(self.value).ok_or_else(|| self.wrong("an integer"))
    }

    pub fn wrong(&self, expected: &'static str) -> Located {
        Fault::unexpected(expected, self.value).at_line(self.line)
    }
}

/// The groups of a text, one after the other; comments are passed over.
#[derive(Clone)]
pub(super) struct Groups<'a> {
    lines: Lines<'a>,
}

impl<'a> Groups<'a> {
    pub fn new(text: &'a [u8]) -> Groups<'a> {
        Groups { lines: Lines::new(text) }
    }

    /// The next group; the end of the file before `EOF` is a fault.
    pub fn next(&mut self) -> Result<Group<'a>> {
        loop {
            let code = self.line()?;
            let found = number::integer(code);
            let at = self.lines.number;
            let code = found.ok_or_else(|| Fault::unexpected("the code of a group", code).at_line(at))?;
            let value = self.line()?;
            if code != 999 {
                return Ok(Group { code, value, line: self.lines.number });
            }
        }
    }

    fn line(&mut self) -> Result<&'a [u8]> {
        match self.lines.next() {
            Some(line) => Ok(line.trim_ascii()),
            None => Err(Fault::unexpected("`EOF` at the end", b"").at_line(self.lines.number)),
        }
    }
}
