//! Points of a PCD file packed by LZF: all numbers of the first field, then all of the second, and so on.

use super::{
    header::{Header, Place},
    lzf,
};
use crate::{
    ScanWarning,
    error::{Fault, Located, Result},
    feed::Feed,
    formats::strided::is_finite,
    scalar::Order,
    scan_warning::remark,
};
use trueness_geom::parallel::prelude::*;
use trueness_geom::{cloud::PointStream, space::Point};

/// Points of fields that are in memory.
pub(super) struct PackedPoints {
    bytes: Vec<u8>,
    places: [Place; 3],
    count: usize,
    found: usize,
    block: usize,
    left_out: u64,
}

/// Bytes of the two lengths before the packed data.
const LENGTHS_BYTES: usize = 8;

impl PackedPoints {
    /// Unpacks all of them. Lengths that cannot be are refused before memory is asked for.
    pub fn new(mut feed: Feed, header: &Header, places: [Place; 3], block: usize) -> Result<PackedPoints> {
        let at = feed.position();
        let head = feed.ahead(LENGTHS_BYTES)?.get(..LENGTHS_BYTES);
        let (packed, whole) = match head {
            Some(&[a, b, c, d, e, f, g, h]) => {
                (u32::from_le_bytes([a, b, c, d]), u32::from_le_bytes([e, f, g, h]))
            }
            _ if header.points == 0 => (0, 0),
            _ => return Err(Fault::Short { what: "bytes of the sizes", declared: 8, present: 0 }.at_byte(at)),
        };
        feed.step(LENGTHS_BYTES);
        let need = header.points.checked_mul(header.stride as u64);
        if need != Some(u64::from(whole)) {
            let what = format!(
                "the compressed data have an unpacked size of {whole} bytes, but {} points of {} bytes each are declared",
                header.points, header.stride
            );
            return Err(Fault::Unclear { what, remedy: "export the file again" }.at_byte(at + 4));
        }
        if u64::from(whole) > u64::from(packed) * lzf::MAX_LZF_RATIO {
            let what = format!("{packed} compressed bytes cannot unpack to {whole} bytes");
            return Err(Fault::Unclear { what, remedy: "export the file again" }.at_byte(at));
        }
        let bytes = feed.ahead(packed as usize)?;
        let Some(packed_bytes) = bytes.get(..packed as usize) else {
            let short = Fault::Short {
                what: "compressed bytes",
                declared: u64::from(packed),
                present: bytes.len() as u64,
            };
            return Err(short.at_byte(at + LENGTHS_BYTES as u64));
        };
        let Some(bytes) = lzf::unpack(packed_bytes, whole as usize) else {
            let what = format!("the compressed data are damaged: they do not unpack to {whole} bytes");
            return Err(Fault::Unclear { what, remedy: "copy or export the file again" }.at_byte(at));
        };
        let count = bytes.len() / header.stride;
        Ok(PackedPoints { bytes, places, count, found: 0, block: block.max(1), left_out: 0 })
    }

    /// Point `i`.
    fn point(&self, i: usize) -> Point {
        self.places.map(|place| {
            let at = place.byte * self.count + i * place.scalar.size();
            place.scalar.get(&self.bytes[at..], Order::Little)
        })
    }
}

impl PointStream for PackedPoints {
    type Error = Located;
    fn expected(&self) -> Option<u64> {
        Some(self.count as u64)
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<()> {
        block.clear();
        while block.is_empty() && self.found < self.count {
            let end = self.count.min(self.found.saturating_add(self.block));
            let of = &*self;
            (of.found..end)
                .into_par_iter()
                .with_min_len(1 << 12)
                .map(|i| of.point(i))
                .collect_into_vec(block);
            block.retain(is_finite);
            self.left_out += (end - self.found - block.len()) as u64;
            self.found = end;
        }
        Ok(())
    }
    fn remarks(&self) -> Vec<String> {
        remark(self.left_out, |count| ScanWarning::NotFinite { count }).into_iter().collect()
    }
}
