//! Binary STL: records of 50 bytes, read where they lie.

use super::facet::Facet;
use crate::{
    Warning,
    error::{Fault, Result},
};

/// Bytes of header and count.
pub(super) const HEADER: usize = 84;
/// Bytes of a facet: normal, three corners, attribute word.
pub(super) const RECORD: usize = 50;

/// The number of facets that the header declares.
pub(super) fn declared(bytes: &[u8]) -> Option<u64> {
    let b = bytes.get(HEADER - 4..)?.first_chunk()?;
    Some(u64::from(u32::from_le_bytes(*b)))
}

/// How many facets a file of `length` bytes that begins with `head` holds: as many as it declares.
pub(super) fn facets(head: &[u8], length: u64) -> Result<(usize, Vec<Warning>)> {
    let Some(declared) = declared(head) else {
        let expected = "the 84 bytes with which a binary STL file begins";
        return Err(Fault::unexpected(expected, head).at_byte(length));
    };
    let body = length - HEADER as u64;
    let present = body / RECORD as u64;
    let facets = usize::try_from(declared).ok().filter(|_| declared <= present);
    let Some(facets) = facets else {
        if head.starts_with(b"solid") && memchr::memmem::find(head, b"facet").is_some() {
            // Text, and its words taken for a count.
            return Err(Fault::Zeros.into());
        }
        return Err(Fault::Short { what: "facets", declared, present }.at_byte(length));
    };
    if declared == 0 && present > 0 {
        let found = format!("0, and then {body} bytes");
        return Err(Fault::unexpected("the number of facets", found.as_bytes()).at_byte(HEADER as u64 - 4));
    }
    let trailing = body - declared * RECORD as u64;
    let warnings = if trailing > 0 { vec![Warning::TrailingBytes { count: trailing }] } else { vec![] };
    Ok((facets, warnings))
}

/// Whether a file of `length` bytes that declares so many facets can have bytes behind each, as many as a word can say.
pub(super) fn may_have_attributes(facets: usize, length: u64) -> bool {
    let most = (RECORD + usize::from(u16::MAX)) as u64;
    length <= HEADER as u64 + (facets as u64).saturating_mul(most)
}

/// Facets whose attribute words are lengths: so many bytes follow each, which are passed over. That is so where the file
/// has exactly the length which that makes, and not the one without them. `bytes` are the whole file.
pub(super) fn with_attributes(bytes: &[u8]) -> Option<Vec<[u8; RECORD]>> {
    let count = usize::try_from(declared(bytes)?).ok()?;
    let mut rest = bytes.get(HEADER..)?;
    if rest.len() / RECORD < count || rest.len() == count * RECORD {
        return None;
    }
    let mut records = Vec::with_capacity(count);
    for _ in 0..count {
        let (record, more) = rest.split_first_chunk::<RECORD>()?;
        let attribute = u16::from_le_bytes([record[RECORD - 2], record[RECORD - 1]]);
        rest = more.get(usize::from(attribute)..)?;
        records.push(*record);
    }
    rest.is_empty().then_some(records)
}

/// Whether the first bytes could be a header and a facet: finite numbers, a normal not longer than 1.
pub(super) fn plausible(head: &[u8]) -> bool {
    let Some(first) = head.get(HEADER..).and_then(|b| b.first_chunk()) else { return false };
    let length = first.normal().iter().map(|x| x * x).sum::<f32>();
    length < 1.1 && (0..3).all(|k| first.corner(k).iter().all(|x| x.abs() < 1e12))
}

#[inline(always)]
fn triple(record: &[u8; RECORD], at: usize) -> [f32; 3] {
    let word = |i: usize| f32::from_le_bytes([record[i], record[i + 1], record[i + 2], record[i + 3]]);
    [word(at), word(at + 4), word(at + 8)]
}

impl Facet for [u8; RECORD] {
    type Position = [f32; 3];
    #[inline(always)]
    fn corner(&self, k: usize) -> [f32; 3] {
        triple(self, 12 + 12 * k)
    }
    fn normal(&self) -> [f32; 3] {
        triple(self, 0)
    }
    fn finite(&self) -> bool {
        // Zero times a number is zero unless the number is not finite.
        (0..3).flat_map(|k| self.corner(k)).map(|x| x * 0.0).sum::<f32>() == 0.0
    }
}

/// A record of a normal and three corners.
pub(super) fn record(normal: [f32; 3], corners: [[f32; 3]; 3]) -> [u8; RECORD] {
    let mut record = [0; RECORD];
    let numbers = normal.iter().chain(corners.as_flattened());
    for (bytes, x) in record.chunks_exact_mut(4).zip(numbers) {
        bytes.copy_from_slice(&x.to_le_bytes());
    }
    record
}
