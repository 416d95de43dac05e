//! Decimal numbers in text.
//!
//! In the common case, at most 15 digits or so and a small exponent, one exact integer is divided by one exact power of
//! ten. A single operation rounds correctly (W. D. Clinger, How to read floating point numbers accurately, PLDI 1990).
//! Everything else goes to a general parser, also correctly rounded.

/// Powers of ten that a `f64` holds exactly.
pub(crate) const POWERS_OF_TEN: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18,
    1e19, 1e20, 1e21, 1e22,
];

/// The number at the start of `text` and how many bytes it takes. `point` is the decimal point: `.` or `,`.
///
/// Also takes `nan`, `inf` and numbers too large for an `f64` (infinity): the caller checks for finiteness.
#[inline]
pub(crate) fn number(text: &[u8], point: u8) -> Option<(f64, usize)> {
    let negative = text.first() == Some(&b'-');
    let mut at = usize::from(negative || text.first() == Some(&b'+'));
    let (mut digits, mut mantissa) = (0usize, 0u64);
    while let Some(d) = digit(text, at) {
        mantissa = mantissa.wrapping_mul(10).wrapping_add(d);
        digits += 1;
        at += 1;
    }
    let mut fraction = 0;
    if text.get(at) == Some(&point) {
        at += 1;
        let start = at;
        while let Some(d) = digit(text, at) {
            mantissa = mantissa.wrapping_mul(10).wrapping_add(d);
            at += 1;
        }
        fraction = at - start;
        digits += fraction;
    }
    // 19 digits never overflow 64 bits; leading zeros only make the test too careful.
    let simple = digits > 0 && digits <= 19 && mantissa <= 1 << 53 && fraction <= 22;
    if !simple || matches!(text.get(at), Some(b'e' | b'E' | b'd' | b'D')) {
        return general(text, point);
    }
    let value = mantissa as f64 / POWERS_OF_TEN[fraction];
    Some((if negative { -value } else { value }, at))
}

#[inline(always)]
fn digit(text: &[u8], at: usize) -> Option<u64> {
    let d = text.get(at)?.wrapping_sub(b'0');
    (d < 10).then_some(u64::from(d))
}

/// Any number, with an exponent behind `e` or, as Fortran writes it, `d`; its sign may be U+2212, the minus of typesetting.
#[cold]
fn general(text: &[u8], point: u8) -> Option<(f64, usize)> {
    if let Some(rest) = text.strip_prefix("\u{2212}".as_bytes()) {
        let starts = rest.first().is_some_and(|b| b.is_ascii_digit() || *b == point);
        return number(rest, point).filter(|_| starts).map(|(x, n)| (-x, n + text.len() - rest.len()));
    }
    let word = text
        .iter()
        .position(|b| !matches!(b, b'0'..=b'9' | b'+' | b'-' | b'.' | b',' | b'a'..=b'z' | b'A'..=b'Z'));
    let word = &text[..word.unwrap_or(text.len())];
    if point == b'.' && !word.iter().any(|b| matches!(b, b'd' | b'D')) {
        return fast_float2::parse_partial::<f64, _>(word).ok();
    }
    let plain = |b: &u8| match *b {
        b if b == point => b'.',
        // The other one of the two is no part of the number.
        b'.' | b',' => b' ',
        b'd' | b'D' => b'e',
        b => b,
    };
    let plain: Vec<u8> = word.iter().map(plain).collect();
    fast_float2::parse_partial::<f64, _>(&plain).ok()
}

/// `word` as a whole is a number.
pub(crate) fn whole_number(word: &[u8], point: u8) -> Option<f64> {
    number(word, point).filter(|(_, n)| *n == word.len()).map(|(x, _)| x)
}

/// `word` as a whole is an integer without sign.
pub(crate) fn count(word: &[u8]) -> Option<u64> {
    if word.is_empty() {
        return None;
    }
    word.iter().try_fold(0u64, |n, b| {
        let d = b.wrapping_sub(b'0');
        if d > 9 { None } else { n.checked_mul(10)?.checked_add(u64::from(d)) }
    })
}

/// `word` as a whole is an integer.
pub(crate) fn integer(word: &[u8]) -> Option<i64> {
    match word {
        [b'-', rest @ ..] => i64::try_from(count(rest)?).ok().map(|n| -n),
        [b'+', rest @ ..] => i64::try_from(count(rest)?).ok(),
        _ => i64::try_from(count(word)?).ok(),
    }
}

/// The shortest digits that give the same number back.
pub(crate) fn push_number(text: &mut Vec<u8>, x: f64) {
    let mut digits = zmij::Buffer::new();
    let shown = digits.format(x);
    text.extend_from_slice(shown.strip_suffix(".0").unwrap_or(shown).as_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_standard_library_to_the_last_bit() {
        // Numbers of every length and scale, written in several ways. The seed is fixed.
        let mut state = 7u64;
        let mut random = move || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            state >> 11
        };
        let mut tried = 0;
        for _ in 0..200_000 {
            let whole = random() % 10u64.pow(1 + (random() % 15) as u32);
            let digits = (random() % 22) as usize;
            let part: String = (0..digits).map(|_| char::from(b'0' + (random() % 10) as u8)).collect();
            let text = match random() % 4 {
                0 => format!("-{whole}.{part}"),
                1 => format!("{whole}.{part}e{}", random() % 30),
                2 => format!(".{part}"),
                _ => format!("+{whole}.{part}E-{:02}", random() % 330),
            };
            let Ok(expected) = text.parse::<f64>() else { continue };
            let (value, length) = number(text.as_bytes(), b'.').unwrap_or_else(|| panic!("{text}"));
            assert_eq!((value.to_bits(), length), (expected.to_bits(), text.len()), "{text}");
            let comma = text.replace('.', ",");
            assert_eq!(
                number(comma.as_bytes(), b',').map(|n| n.0.to_bits()),
                Some(expected.to_bits()),
                "{comma}"
            );
            tried += 1;
        }
        assert!(tried > 150_000);
    }

    #[test]
    fn stops_where_the_number_stops() {
        assert_eq!(number(b"1.5,2.5", b'.'), Some((1.5, 3)));
        assert_eq!(number(b"1,5;2,5", b','), Some((1.5, 3)));
        assert_eq!(number(b"1.25D+02 ", b'.'), Some((125.0, 8)));
        assert_eq!(number("\u{2212}1,25E1;".as_bytes(), b','), Some((-12.5, 9)));
        assert_eq!(number(b"-0 ", b'.').map(|n| n.0.to_bits()), Some((-0.0f64).to_bits()));
        for bad in ["", "-", ".", "x", "+-1", "-,5", "\u{2212}", "\u{2212}-1", "\u{2212}nan", "\u{2013}1"] {
            assert_eq!(number(bad.as_bytes(), b'.'), None, "{bad}");
        }
        assert!(number(b"nan", b'.').is_some_and(|n| n.0.is_nan()));
        assert!(number(b"1e999", b'.').is_some_and(|n| n.0.is_infinite()));
        assert_eq!(whole_number(b"3.1+e2", b'.'), None);
        assert_eq!(count(b"18446744073709551616"), None);
        assert_eq!(integer(b"-12"), Some(-12));
    }
}
