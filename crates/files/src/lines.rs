//! Lines and words of text in memory.

/// Whether bytes are text in some 8-bit code: no control characters but white space.
pub(crate) fn is_text(bytes: &[u8]) -> bool {
    !bytes.iter().any(|b| matches!(b, 0..=8 | 14..=26 | 28..=31 | 127))
}

/// The bytes after a byte order mark of UTF-8, if there is one.
pub(crate) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// The bytes before the Ctrl-Z (and blanks) with which old systems end a text.
pub(crate) fn without_end_mark(bytes: &[u8]) -> &[u8] {
    let end = bytes.iter().rposition(|b| *b != 0x1a && !b.is_ascii_whitespace());
    let text = &bytes[..end.map_or(0, |i| i + 1)];
    if bytes[text.len()..].contains(&0x1a) { text } else { bytes }
}

/// The bytes before the zeros, Ctrl-Z and blanks that fill a text up to the size of a block. Also whether there are zeros
/// among these.
pub(crate) fn without_filling(bytes: &[u8]) -> (&[u8], bool) {
    let end = bytes.iter().rposition(|b| !matches!(b, 0 | 0x1a) && !b.is_ascii_whitespace());
    let (text, filling) = bytes.split_at(end.map_or(0, |i| i + 1));
    (text, filling.contains(&0))
}

/// The byte that ends lines: `\r` in files of old Macintoshes, else `\n` (with `\r` before it counted as blank).
pub(crate) fn line_end(head: &[u8]) -> u8 {
    match memchr::memchr2(b'\n', b'\r', head) {
        Some(i)
            if head[i] == b'\r'
                && head.get(i + 1) != Some(&b'\n')
                && memchr::memchr(b'\n', head).is_none() =>
        {
            b'\r'
        }
        _ => b'\n',
    }
}

/// Number of the line, from 1, in which byte `at` lies.
pub(crate) fn line_of(text: &[u8], at: usize) -> u64 {
    1 + count_lines(&text[..at.min(text.len())], line_end(text))
}

/// Number of line ends in `text`.
pub(crate) fn count_lines(text: &[u8], end: u8) -> u64 {
    memchr::memchr_iter(end, text).count() as u64
}

/// The lines of a text with their numbers from 1, without their ends.
#[derive(Clone)]
pub(crate) struct Lines<'a> {
    rest: &'a [u8],
    end: u8,
    /// Number of the line last delivered.
    pub number: u64,
}

impl<'a> Lines<'a> {
    /// Passes over a byte order mark.
    pub fn new(text: &'a [u8]) -> Lines<'a> {
        Lines { rest: without_mark(text), end: line_end(text), number: 0 }
    }
    /// The text not delivered yet.
    pub fn rest(&self) -> &'a [u8] {
        self.rest
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = &'a [u8];
    fn next(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        let (line, rest) = match memchr::memchr(self.end, self.rest) {
            Some(i) => (&self.rest[..i], &self.rest[i + 1..]),
            None => (self.rest, &[][..]),
        };
        self.rest = rest;
        self.number += 1;
        Some(line)
    }
}

/// The words of a line, separated by ASCII white space.
pub(crate) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> + Clone {
    line.split(|b| b.is_ascii_whitespace()).filter(|w| !w.is_empty())
}

/// Cuts text into parts of about `size` bytes, each ending with a whole line.
pub(crate) fn parts(text: &[u8], size: usize, end: u8) -> Vec<&[u8]> {
    let mut parts = Vec::with_capacity(text.len() / size.max(1) + 1);
    let mut rest = text;
    while rest.len() > size {
        let Some(i) = memchr::memchr(end, &rest[size - 1..]) else { break };
        let (part, later) = rest.split_at(size + i);
        parts.push(part);
        rest = later;
    }
    if !rest.is_empty() {
        parts.push(rest);
    }
    parts
}

/// A line is read up to this length.
const MAX_LINE_BYTES: usize = 1 << 20;

/// The whole lines at the start of `bytes`, about `size` bytes of them. `None` if a line has no end.
pub(crate) fn whole_lines(bytes: &[u8], size: usize, end: u8) -> Option<&[u8]> {
    if bytes.len() < size {
        // The end of the file.
        return Some(bytes);
    }
    match memchr::memrchr(end, &bytes[..size]) {
        Some(i) => Some(&bytes[..=i]),
        None if size > MAX_LINE_BYTES || bytes.len() == size => None,
        None => whole_lines(bytes, size * 2, end),
    }
}

/// At most the first `count` lines of `window`.
pub(crate) fn first_lines(window: &[u8], count: u64, end: u8) -> &[u8] {
    let there = count_lines(window, end);
    if there < count {
        return window;
    }
    let last = usize::try_from(count - 1).ok().and_then(|n| memchr::memchr_iter(end, window).nth(n));
    last.map_or(window, |i| &window[..=i])
}
