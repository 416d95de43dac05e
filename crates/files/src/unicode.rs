//! Text in UTF-16, as some exporters and spreadsheets write it, becomes UTF-8.

use crate::error::{Fault, Result};
use crate::lines::line_of;

/// Byte order of UTF-16 text, and whether a mark tells it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Utf16 {
    big: bool,
    marked: bool,
}

/// At most this many pairs of bytes decide whether text is in UTF-16.
const MAX_PAIRS_SNIFFED: usize = 512;

/// Whether bytes are text in UTF-16. A byte order mark tells. Without one, every second of the first bytes must be zero
/// and the others printable, which neither text in 8 bits nor numbers are.
pub(crate) fn utf16(head: &[u8]) -> Option<Utf16> {
    let pairs = head.as_chunks::<2>().0;
    let pairs = &pairs[..pairs.len().min(MAX_PAIRS_SNIFFED)];
    let (big, marked) = match pairs {
        [[0xff, 0xfe], ..] => (false, true),
        [[0xfe, 0xff], ..] => (true, true),
        [[0, b], ..] if *b != 0 => (true, false),
        [[b, 0], ..] if *b != 0 => (false, false),
        _ => return None,
    };
    let code = Utf16 { big, marked };
    let text = |unit: u16| match unit {
        0..=8 | 14..=26 | 28..=31 | 127 | 0xfffe | 0xffff => false,
        // Without a mark only what 7 bits hold is taken for proof.
        128.. => marked,
        _ => true,
    };
    let mut units = pairs[usize::from(marked)..].iter().map(|b| code.unit(b)).peekable();
    (units.peek().is_some() && pairs.len() > 2 && units.all(text)).then_some(code)
}

impl Utf16 {
    fn unit(self, b: &[u8; 2]) -> u16 {
        if self.big { u16::from_be_bytes(*b) } else { u16::from_le_bytes(*b) }
    }
}

/// The text without its mark. A unit that is no character becomes `U+FFFD`; half a unit at the end is refused.
pub(crate) fn to_utf8(bytes: &[u8], code: Utf16) -> Result<Vec<u8>> {
    let (pairs, half) = bytes.as_chunks::<2>();
    if !half.is_empty() {
        let found = format!("{} bytes", bytes.len());
        return Err(Fault::unexpected("UTF-16 text of an even number of bytes", found.as_bytes())
            .at_byte(bytes.len() as u64 - 1));
    }
    let units = pairs[usize::from(code.marked)..].iter().map(|b| code.unit(b));
    let mut text = String::with_capacity(bytes.len() / 2);
    text.extend(char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)));
    Ok(text.into_bytes())
}

/// Refuses text with zero bytes: the file was not written to its end, or it is no text.
pub(crate) fn no_zeros(text: &[u8]) -> Result<()> {
    match memchr::memchr(0, text) {
        Some(at) => Err(Fault::Zeros.at_line(line_of(text, at))),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn encoded(text: &str, big: bool, mark: bool) -> Vec<u8> {
        let mark = if mark { "\u{feff}" } else { "" };
        let units = mark.encode_utf16().chain(text.encode_utf16());
        units.flat_map(|u| if big { u.to_be_bytes() } else { u.to_le_bytes() }).collect()
    }

    #[test]
    fn text_is_recognized_with_and_without_a_mark() {
        for (big, mark) in [(false, false), (false, true), (true, false), (true, true)] {
            let bytes = encoded("x;y;z\r\n1,5;2;3\r\n", big, mark);
            let code = utf16(&bytes).unwrap();
            assert_eq!((code.big, code.marked), (big, mark));
            assert_eq!(to_utf8(&bytes, code).unwrap(), b"x;y;z\r\n1,5;2;3\r\n");
            assert!(to_utf8(&bytes[..bytes.len() - 1], code).is_err());
        }
        // A name that 7 bits cannot hold needs the mark.
        assert!(utf16(&encoded("\u{5750}\u{6807};y", false, true)).is_some());
        assert!(utf16(&encoded("\u{5750}\u{6807};y", false, false)).is_none());
    }

    #[test]
    fn nothing_else_is_taken_for_it() {
        let stl = [&[0; 80][..], &4u32.to_le_bytes(), &[0; 200]].concat();
        for bytes in [&b"1 2 3\n4 5 6\n"[..], b"", b"ab", b"\xff\xfe\0\0a\0\0\0", &stl, b"a\0b\0\x01\0c\0"] {
            assert_eq!(utf16(bytes), None, "{bytes:?}");
        }
    }
}
