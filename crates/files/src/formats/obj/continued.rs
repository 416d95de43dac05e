//! Lines that a backslash continues.
//!
//! It does so in statements made of numbers. Comments and names may end in a backslash of their own (`mtllib C:\parts\`).
//! That one continues nothing, or the statement on the next line would be lost.

use std::borrow::Cow;

/// The first words of statements that are made of numbers and keywords, whose lines may be continued.
const OF_NUMBERS: &[&[u8]] = &[
    b"v", b"vn", b"vt", b"vp", b"f", b"l", b"p", b"fo", b"curv", b"curv2", b"surf", b"parm", b"trim",
    b"hole", b"scrv", b"sp", b"con", b"deg", b"bmat", b"step",
];

/// The text with continued lines put together. As many blank lines follow, so that every statement stays on its line.
pub(super) fn joined(text: &[u8], end: u8) -> Cow<'_, [u8]> {
    let at_line_end = |i: usize| ends_in_backslash(&text[..i + 1], text.get(i + 1..), end);
    if !memchr::memchr_iter(b'\\', text).any(at_line_end) {
        return Cow::Borrowed(text);
    }
    let mut out = Vec::with_capacity(text.len() + 1);
    let mut lines = text.split(|b| *b == end).peekable();
    while let Some(line) = lines.next() {
        let mut line = line;
        let mut continued = 0;
        let numbers = is_of_numbers(line);
        while let Some(start) = numbers.then(|| without_backslash(line)).flatten() {
            out.extend_from_slice(start);
            out.push(b' ');
            match lines.next() {
                Some(next) => (line, continued) = (next, continued + 1),
                None => line = &[],
            }
        }
        out.extend_from_slice(line);
        out.extend(std::iter::repeat_n(end, continued));
        if lines.peek().is_some() {
            out.push(end);
        }
    }
    Cow::Owned(out)
}

/// Whether the backslash that `before` ends with is followed by nothing but blanks on its line.
fn ends_in_backslash(before: &[u8], after: Option<&[u8]>, end: u8) -> bool {
    let rest = after.unwrap_or_default();
    let next = rest.iter().find(|b| **b == end || !b.is_ascii_whitespace());
    before.ends_with(b"\\") && next.is_none_or(|b| *b == end)
}

/// Whether a line begins a statement made of numbers.
fn is_of_numbers(line: &[u8]) -> bool {
    let line = line.trim_ascii_start();
    let word = line.split(|b| b.is_ascii_whitespace() || *b == b'\\').next().unwrap_or_default();
    OF_NUMBERS.contains(&word)
}

/// The text before the backslash that continues a line of numbers; `None` where there is none, or it ends a comment.
fn without_backslash(line: &[u8]) -> Option<&[u8]> {
    let start = line.trim_ascii_end().strip_suffix(b"\\")?;
    (!start.contains(&b'#')).then_some(start)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_go_on_and_names_do_not() {
        let whole = |text: &str| String::from_utf8(joined(text.as_bytes(), b'\n').into_owned()).unwrap();
        for (text, wanted) in [
            ("v 1 2\\\n3\nf 1", "v 1 2 3\n\nf 1"),
            ("f 1 \\\r\n2 \\ \r\n3\r\nx", "f 1  2  3\r\n\n\nx"),
            ("f 1 2 3 \\", "f 1 2 3  "),
            ("f\\\n1 2 3", "f 1 2 3\n"),
        ] {
            assert_eq!(whole(text), wanted);
        }
        for kept in [
            "# C:\\\nv 1 2 3",
            "mtllib C:\\a\\\nv 1 2 3",
            "usemtl a\\\nf 1 2 3",
            "g a\\\nf 1 2 3",
            "o \\\nv 1 2 3",
            "f 1 2 3 # see C:\\\nf 1 2 4",
            "call C:\\x\\\nf 1 2 3",
            "shadow_obj a\\\nf 1 2 3",
            "s \\\nf 1 2 3",
        ] {
            assert_eq!(whole(kept), kept);
        }
    }
}
