//! The words of a text whose line ends mean no more than other blanks.

use crate::lines::{count_lines, line_end};

/// Words and where they are.
#[derive(Clone)]
pub(crate) struct Flow<'a> {
    text: &'a [u8],
    /// Where the next word is looked for.
    pub at: usize,
    /// Whether `#` begins a comment, which reaches to the end of its line.
    comments: bool,
}

impl<'a> Flow<'a> {
    pub fn new(text: &'a [u8], comments: bool) -> Flow<'a> {
        Flow { text, at: 0, comments }
    }

    /// The text not delivered yet.
    pub fn rest(&self) -> &'a [u8] {
        self.text.get(self.at..).unwrap_or_default()
    }

    /// Number of the line, from 1, in which the word last delivered stands.
    pub fn line(&self) -> u64 {
        1 + count_lines(&self.text[..self.at], line_end(self.text))
    }

    /// The next word if it stands on the same line as the one before.
    pub fn next_on_line(&mut self) -> Option<&'a [u8]> {
        let mut ahead = self.clone();
        let word = ahead.next()?;
        let between = &self.text[self.at..ahead.at - word.len()];
        if between.iter().any(|b| matches!(b, b'\n' | b'\r')) {
            return None;
        }
        *self = ahead;
        Some(word)
    }
}

impl<'a> Iterator for Flow<'a> {
    type Item = &'a [u8];
    fn next(&mut self) -> Option<&'a [u8]> {
        loop {
            let rest = self.text.get(self.at..)?;
            let start = self.at + rest.iter().position(|b| !b.is_ascii_whitespace())?;
            let rest = &self.text[start..];
            if self.comments && rest.starts_with(b"#") {
                self.at = start + rest.iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or(rest.len());
                continue;
            }
            let ends = |b: &u8| b.is_ascii_whitespace() || self.comments && *b == b'#';
            let length = rest.iter().position(ends).unwrap_or(rest.len());
            self.at = start + length;
            return Some(&rest[..length]);
        }
    }
}
