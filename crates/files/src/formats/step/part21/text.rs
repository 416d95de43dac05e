//! The characters of a text (ISO 10303-21, 6.4.3): doubled quotes, code pages, hexadecimal codes. What is no code stays as it is.

use super::pages::page;

/// Characters of a name that are kept.
const MAX_CHARACTERS: usize = 512;

/// The text as it is meant, cut to the length of a name.
pub(super) fn decoded(raw: &[u8]) -> String {
    let mut out = String::new();
    let (mut rest, mut upper) = (raw, page(b'A'));
    let mut count = 0;
    while !rest.is_empty() && count < MAX_CHARACTERS {
        let before = out.len();
        rest = next(rest, &mut upper, &mut out);
        count += out[before..].chars().count();
    }
    out
}

/// Takes the next character or code off the text.
fn next<'a>(raw: &'a [u8], upper: &mut [char; 96], out: &mut String) -> &'a [u8] {
    match raw {
        [b'\'', b'\'', rest @ ..] => push(out, '\'', rest),
        [b'\\', b'\\', rest @ ..] => push(out, '\\', rest),
        [b'\\', b'S', b'\\', c @ 0x20..=0x7f, rest @ ..] => push(out, upper[usize::from(c - 0x20)], rest),
        [b'\\', b'P', c @ b'A'..=b'I', b'\\', rest @ ..] => {
            *upper = page(*c);
            rest
        }
        [b'\\', b'N' | b'F', b'\\', rest @ ..] => rest,
        [b'\\', b'X', b'\\', a, b, rest @ ..] => match hex(&[*a, *b]).and_then(char::from_u32) {
            Some(c) => push(out, c, rest),
            None => push(out, '\\', &raw[1..]),
        },
        [b'\\', b'X', b'2', b'\\', rest @ ..] => codes(rest, 4, out),
        [b'\\', b'X', b'4', b'\\', rest @ ..] => codes(rest, 8, out),
        // Texts are not wrapped within: such breaks come from writers of short lines.
        [b'\r' | b'\n', rest @ ..] => rest,
        [c @ 0..=0x7f, rest @ ..] => {
            push(out, if c.is_ascii_control() { '\u{fffd}' } else { char::from(*c) }, rest)
        }
        _ => above_ascii(raw, out),
    }
}

fn push<'a>(out: &mut String, c: char, rest: &'a [u8]) -> &'a [u8] {
    out.push(c);
    rest
}

/// A character in UTF-8, which the third edition allows; else one of ISO 8859-1, which older programs write.
fn above_ascii<'a>(raw: &'a [u8], out: &mut String) -> &'a [u8] {
    let width = match raw[0] {
        0xc0..=0xdf => 2,
        0xe0..=0xef => 3,
        0xf0.. => 4,
        _ => 1,
    };
    match raw.get(..width).map(std::str::from_utf8) {
        Some(Ok(c)) => {
            out.push_str(c);
            &raw[width..]
        }
        _ => push(out, char::from(raw[0]), &raw[1..]),
    }
}

/// Characters of so many hexadecimal digits each, up to `\X0\`.
fn codes<'a>(mut rest: &'a [u8], digits: usize, out: &mut String) -> &'a [u8] {
    let mut high: Option<u32> = None;
    while let Some(code) = rest.get(..digits).and_then(hex) {
        rest = &rest[digits..];
        // Characters beyond 16 bits stand as two halves where codes have four digits.
        let whole = match (high.take(), code) {
            (Some(high), 0xdc00..0xe000) => 0x1_0000 + ((high - 0xd800) << 10) + (code - 0xdc00),
            (_, 0xd800..0xdc00) => {
                high = Some(code);
                continue;
            }
            _ => code,
        };
        out.push(char::from_u32(whole).unwrap_or('\u{fffd}'));
    }
    rest.strip_prefix(b"\\X0\\").unwrap_or(rest)
}

fn hex(digits: &[u8]) -> Option<u32> {
    digits.iter().try_fold(0u32, |sum, d| Some(sum.checked_mul(16)? + char::from(*d).to_digit(16)?))
}
