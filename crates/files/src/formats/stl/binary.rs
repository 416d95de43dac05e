//! Binary STL: records of 50 bytes, read where they lie.

use super::facet::Facet;
use crate::{
    Warning,
    error::{Fault, Result},
};

/// Bytes of header and count.
pub(super) const STL_HEADER_BYTES: usize = 84;
/// Bytes of a facet: normal, three corners, attribute word.
pub(super) const STL_RECORD_BYTES: usize = 50;

/// The number of facets that the header declares.
pub(super) fn declared(bytes: &[u8]) -> Option<u64> {
    let b = bytes.get(STL_HEADER_BYTES - 4..)?.first_chunk()?;
    Some(u64::from(u32::from_le_bytes(*b)))
}

/// How many facets a file of `length` bytes that begins with `head` holds: as many as it declares.
pub(super) fn facets(head: &[u8], length: u64) -> Result<(usize, Vec<Warning>)> {
    let Some(declared) = declared(head) else {
        let expected = "the 84 bytes with which a binary STL file begins";
        return Err(Fault::unexpected(expected, head).at_byte(length));
    };
    let body = length - STL_HEADER_BYTES as u64;
    let present = body / STL_RECORD_BYTES as u64;
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
        return Err(
            Fault::unexpected("the number of facets", found.as_bytes()).at_byte(STL_HEADER_BYTES as u64 - 4)
        );
    }
    let trailing = body - declared * STL_RECORD_BYTES as u64;
    let warnings = if trailing > 0 { vec![Warning::TrailingBytes { count: trailing }] } else { vec![] };
    Ok((facets, warnings))
}

/// Whether a file of `length` bytes that declares so many facets can have bytes behind each, as many as a word can say.
pub(super) fn may_have_attributes(facets: usize, length: u64) -> bool {
    let most = (STL_RECORD_BYTES + usize::from(u16::MAX)) as u64;
    length <= STL_HEADER_BYTES as u64 + (facets as u64).saturating_mul(most)
}

/// Facets whose attribute words are lengths of further bytes, which are passed over. That is so where these lengths give exactly the
/// length of the file, and it is longer than its facets alone. `bytes` are the whole file.
pub(super) fn with_attributes(bytes: &[u8]) -> Option<Vec<[u8; STL_RECORD_BYTES]>> {
    let count = usize::try_from(declared(bytes)?).ok()?;
    let mut rest = bytes.get(STL_HEADER_BYTES..)?;
    if rest.len() / STL_RECORD_BYTES < count || rest.len() == count * STL_RECORD_BYTES {
        return None;
    }
    let mut records = Vec::with_capacity(count);
    for _ in 0..count {
        let (record, more) = rest.split_first_chunk::<STL_RECORD_BYTES>()?;
        let attribute = u16::from_le_bytes([record[STL_RECORD_BYTES - 2], record[STL_RECORD_BYTES - 1]]);
        rest = more.get(usize::from(attribute)..)?;
        records.push(*record);
    }
    rest.is_empty().then_some(records)
}

/// Whether the first bytes could be a header and a facet: finite numbers, a normal not longer than 1.
pub(super) fn plausible(head: &[u8]) -> bool {
    let Some(first) = head.get(STL_HEADER_BYTES..).and_then(|b| b.first_chunk()) else { return false };
    let length = first.normal().iter().map(|x| x * x).sum::<f32>();
    length < 1.1 && (0..3).all(|k| first.corner(k).iter().all(|x| x.abs() < 1e12))
}

#[inline(always)]
fn triple(record: &[u8; STL_RECORD_BYTES], at: usize) -> [f32; 3] {
    let word = |i: usize| f32::from_le_bytes([record[i], record[i + 1], record[i + 2], record[i + 3]]);
    [word(at), word(at + 4), word(at + 8)]
}

impl Facet for [u8; STL_RECORD_BYTES] {
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
pub(super) fn record(normal: [f32; 3], corners: [[f32; 3]; 3]) -> [u8; STL_RECORD_BYTES] {
    let mut record = [0; STL_RECORD_BYTES];
    let numbers = normal.iter().chain(corners.as_flattened());
    for (bytes, x) in record.chunks_exact_mut(4).zip(numbers) {
        bytes.copy_from_slice(&x.to_le_bytes());
    }
    record
}
