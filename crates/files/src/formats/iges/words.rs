//! Parameters between their signs.

use crate::error::Fault;
use std::ops::Range;

/// The signs that end a parameter and an entity: the first two global parameters say them.
pub(super) fn signs(global: &[u8]) -> [u8; 2] {
    match global {
        [b'1', b'H', a, _, b'1', b'H', b, ..] => [*a, *b],
        [b'1', b'H', a, ..] => [*a, b';'],
        [a, b'1', b'H', b, ..] => [*a, *b],
        _ => [b',', b';'],
    }
}

/// Where the parameters stand, up to the sign that ends them all; text without its count.
pub(super) fn words(text: &[u8], [between, last]: [u8; 2]) -> Result<Vec<Range<usize>>, Fault> {
    let (mut all, mut at) = (vec![], 0);
    let skip_blanks = |mut at: usize| {
        while text.get(at) == Some(&b' ') {
            at += 1;
        }
        at
    };
    loop {
        at = skip_blanks(at);
        let rest = text.get(at..).unwrap_or_default();
        let digits = rest.iter().take_while(|b| b.is_ascii_digit()).count();
        if digits > 0 && rest.get(digits) == Some(&b'H') {
            let count = crate::number::count(&rest[..digits]).and_then(|n| usize::try_from(n).ok());
            let from = at + digits + 1;
            let own =
                count.and_then(|n| Some(from..from.checked_add(n)?)).filter(|own| own.end <= text.len());
            let Some(own) = own else { return Err(Fault::unexpected("text as long as it says", rest)) };
            at = own.end;
            all.push(own);
        } else {
            let Some(length) = rest.iter().position(|b| *b == between || *b == last) else {
                return Err(Fault::unexpected("a sign that ends the parameters", rest));
            };
            let word = &rest[..length];
            let end = at + length - word.iter().rev().take_while(|b| b.is_ascii_whitespace()).count();
            all.push(at.min(end)..end.max(at));
            at += length;
        }
        at = skip_blanks(at);
        match text.get(at) {
            Some(b) if *b == last => return Ok(all),
            Some(b) if *b == between => at += 1,
            _ => {
                let rest = text.get(at..).unwrap_or_default();
                return Err(Fault::unexpected("a sign between parameters", rest));
            }
        }
    }
}
