//! Text in UTF-16, as some exporters and spreadsheets write it, becomes UTF-8.

/// Byte order of UTF-16 text, told by its mark.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Utf16 {
    Little,
    Big,
}

/// Whether the bytes begin with a byte order mark of UTF-16 and go on like text.
pub(crate) fn utf16(head: &[u8]) -> Option<Utf16> {
    match head {
        [0xff, 0xfe, a, 0, ..] if *a != 0 => Some(Utf16::Little),
        [0xfe, 0xff, 0, a, ..] if *a != 0 => Some(Utf16::Big),
        _ => None,
    }
}

/// The text without its mark. What is not a character becomes `U+FFFD`.
pub(crate) fn to_utf8(bytes: &[u8], order: Utf16) -> Vec<u8> {
    let units = bytes.as_chunks::<2>().0.iter().skip(1).map(|b| match order {
        Utf16::Little => u16::from_le_bytes(*b),
        Utf16::Big => u16::from_be_bytes(*b),
    });
    let mut text = String::with_capacity(bytes.len() / 2);
    text.extend(char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)));
    text.into_bytes()
}

/// The bytes after a byte order mark of UTF-8, if there is one.
pub(crate) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}
