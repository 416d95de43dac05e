//! Points of a PCD file in words.

use super::header::{Header, Place};
use crate::{
    ScanWarning,
    error::{Fault, Located, Result},
    feed::Feed,
    formats::strided::is_finite,
    lines::words,
    number::{POWERS_OF_TEN, count, whole_number},
    records::TextRecords,
    scalar::Scalar,
    scan_warning::remark,
};
use trueness_geom::{cloud::PointStream, space::Point};

/// Points of lines of words.
pub(super) struct AsciiPoints {
    records: TextRecords,
    row: Row,
    declared: u64,
    found: u64,
    left_out: u64,
}

/// How a line is made.
struct Row {
    places: [Place; 3],
    words: usize,
}

impl AsciiPoints {
    pub fn new(feed: Feed, header: &Header, places: [Place; 3], block: usize) -> Result<AsciiPoints> {
        // A word and a blank for each number, but for the line end of the last.
        let least = (2 * header.words as u64).checked_mul(header.points);
        if let Some(left) = feed.left()
            && least.is_none_or(|least| least > left + 1)
        {
            let present = left / (2 * header.words as u64);
            return Err(Fault::short("points", header.points, present).at_line(header.lines + 1));
        }
        let records = TextRecords::new(feed, header.end, header.lines, block);
        let row = Row { places, words: header.words };
        Ok(AsciiPoints { records, row, declared: header.points, found: 0, left_out: 0 })
    }
}

impl PointStream for AsciiPoints {
    type Error = Located;
    fn expected(&self) -> Option<u64> {
        Some(self.declared)
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<()> {
        block.clear();
        while block.is_empty() && self.found < self.declared {
            let row = &self.row;
            let records = self.records.points(self.declared - self.found, |line| row.point(line), block)?;
            if records == 0 {
                return Err(Fault::short("points", self.declared, self.found).at_line(self.records.lines + 1));
            }
            self.found += records;
            self.left_out += records - block.len() as u64;
        }
        Ok(())
    }
    fn remarks(&self) -> Vec<String> {
        remark(self.left_out, |count| ScanWarning::NotFinite { count }).into_iter().collect()
    }
}

impl Row {
    /// The point of a line, unless it is not finite.
    fn point(&self, line: &[u8]) -> std::result::Result<Option<Point>, Fault> {
        let mut point = [0.0; 3];
        let mut there = 0;
        for (i, word) in words(line).enumerate() {
            there = i + 1;
            for (x, place) in point.iter_mut().zip(&self.places) {
                if place.word == i {
                    let value = whole_number(word, b'.');
                    let value =
                        value.ok_or_else(|| Fault::unexpected("a number with a decimal point", word))?;
                    *x = if place.scalar == Scalar::F32 { single(value, word) } else { value };
                }
            }
        }
        if there != self.words {
            return Err(Fault::unexpected(format!("{} numbers", self.words), line));
        }
        Ok(is_finite(&point).then_some(point))
    }
}

/// A digit that was rounded from the middle of two may seem to be farther off by the rounding of this very comparison.
const TIE: f64 = 1.0 + 1e-6;

/// The number of a field that is declared to be of single precision. A word to which a single rounds stands for this single. A
/// word with more digits than a single has was never one, and its digits are kept.
fn single(value: f64, word: &[u8]) -> f64 {
    let near = f64::from(value as f32);
    if (near - value).abs() <= TIE * half_unit(word) { near } else { value }
}

/// Half a unit of the last digit of a number in text.
fn half_unit(word: &[u8]) -> f64 {
    let (digits, exponent) = match memchr::memchr2(b'e', b'E', word) {
        Some(at) => (&word[..at], &word[at + 1..]),
        None => (word, &[][..]),
    };
    let decimals = memchr::memchr(b'.', digits).map_or(0, |at| digits.len() - at - 1);
    if let (true, Some(ten)) = (exponent.is_empty(), POWERS_OF_TEN.get(decimals)) {
        return 0.5 / ten;
    }
    let (negative, size) = match exponent {
        [b'-', size @ ..] => (true, size),
        [b'+', size @ ..] | size => (false, size),
    };
    let size = count(size).and_then(|n| i32::try_from(n).ok()).unwrap_or_default();
    let power = f64::from(if negative { -size } else { size }) - decimals as f64;
    0.5 * libm::pow(10.0, power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_singles_are_singles_and_longer_words_keep_their_digits() {
        for bits in (0..u32::MAX).step_by(1_000_003) {
            let x = f32::from_bits(bits);
            if !x.is_finite() {
                continue;
            }
            // Below 2^24 all digits count; above, the usual form fills up with zeros.
            let usual = (x.abs() < 16_777_216.0).then(|| format!("{x}"));
            for word in usual.into_iter().chain([format!("{x:e}"), format!("{x:.8e}")]) {
                let value: f64 = word.parse().unwrap();
                assert_eq!(single(value, word.as_bytes()), f64::from(x), "{word}");
            }
        }
        for word in ["4320978.61", "600000.125001", "1.00000000001", "16777217"] {
            let value: f64 = word.parse().unwrap();
            assert_eq!(single(value, word.as_bytes()), value, "{word}");
        }
    }
}
