//! The pages of an E57 file: 1020 bytes of content and their checksum each (CRC-32C). What is in the file is numbered by content
//! bytes here; in the file itself, offsets count the checksums too.

use crate::{
    error::{Fault, Result},
    feed::Feed,
};
use trueness_geom::parallel::prelude::*;

/// Bytes of a page, and of its content.
const E57_PAGE_BYTES: usize = 1024;
const CONTENT_BYTES: usize = E57_PAGE_BYTES - 4;

/// A file as a run of content bytes.
pub(super) struct Pages {
    feed: Feed,
    pages: u64,
}

/// Tables of CRC-32C for eight bytes at a time (Kounavis and Berry 2005), the polynomial with its bits reversed.
const CRC: [[u32; 256]; 8] = {
    const CRC_POLYNOMIAL: u32 = 0x82f6_3b78;
    let mut tables = [[0; 256]; 8];
    let mut i = 0;
    while i < 256 {
        let (mut crc, mut bit) = (i as u32, 0);
        while bit < 8 {
            crc = if crc & 1 == 1 { crc >> 1 ^ CRC_POLYNOMIAL } else { crc >> 1 };
            bit += 1;
        }
        tables[0][i] = crc;
        i += 1;
    }
    let mut i = 0;
    while i < 256 {
        let mut k = 1;
        while k < 8 {
            let before = tables[k - 1][i];
            tables[k][i] = before >> 8 ^ tables[0][(before & 255) as usize];
            k += 1;
        }
        i += 1;
    }
    tables
};

/// CRC-32C of some bytes.
pub(super) fn crc32c(bytes: &[u8]) -> u32 {
    let mut crc = !0u32;
    let (eights, rest) = bytes.as_chunks::<8>();
    for &[a, b, c, d, e, f, g, h] in eights {
        let low = (u32::from_le_bytes([a, b, c, d]) ^ crc).to_le_bytes();
        crc = CRC[7][usize::from(low[0])]
            ^ CRC[6][usize::from(low[1])]
            ^ CRC[5][usize::from(low[2])]
            ^ CRC[4][usize::from(low[3])]
            ^ CRC[3][usize::from(e)]
            ^ CRC[2][usize::from(f)]
            ^ CRC[1][usize::from(g)]
            ^ CRC[0][usize::from(h)];
    }
    for b in rest {
        crc = crc >> 8 ^ CRC[0][usize::from(crc as u8 ^ b)];
    }
    !crc
}

impl Pages {
    /// The pages of a whole file.
    pub fn open(mut feed: Feed) -> Result<Pages> {
        let head = feed.ahead(48)?;
        let number =
            |at: usize| head.get(at..at + 8).and_then(|b| b.first_chunk()).map(|b| u64::from_le_bytes(*b));
        if let Some(size) = number(40)
            && size != E57_PAGE_BYTES as u64
        {
            let what = format!("the pages have {size} bytes");
            return Err(
                Fault::Unsupported { what, remedy: "export the file with pages of 1024 bytes" }.at_byte(40)
            );
        }
        let declared = number(16).unwrap_or(48);
        let present = feed.count_left()?;
        if present < declared || present < E57_PAGE_BYTES as u64 {
            return Err(
                Fault::Short { what: "bytes (the length in the header)", declared, present }.at_byte(present)
            );
        }
        Ok(Pages { feed, pages: present / E57_PAGE_BYTES as u64 })
    }

    /// Content bytes of the file.
    pub fn length(&self) -> u64 {
        self.pages * CONTENT_BYTES as u64
    }

    /// The content byte at an offset of the file; `None` behind its end or in a checksum.
    pub fn content_at(&self, offset: u64) -> Option<u64> {
        let (page, byte) = (offset / E57_PAGE_BYTES as u64, offset % E57_PAGE_BYTES as u64);
        (page < self.pages && byte < CONTENT_BYTES as u64).then_some(page * CONTENT_BYTES as u64 + byte)
    }

    /// So many content bytes, whose pages have the right checksums. There are as many: see [`Pages::length`].
    pub fn read(&mut self, at: u64, length: usize) -> Result<Vec<u8>> {
        let content = CONTENT_BYTES as u64;
        let first = at / content;
        let end = at.saturating_add(length as u64);
        let last = end.div_ceil(content).max(first);
        if last > self.pages {
            return Err(
                Fault::Short { what: "bytes of content", declared: end, present: self.length() }.into()
            );
        }
        let mut bytes = vec![0; (last - first) as usize * E57_PAGE_BYTES];
        self.feed.copy(first * E57_PAGE_BYTES as u64, &mut bytes)?;
        // The standard's byte order is the low byte first, but that of the checksum is the other one in all files.
        let is_wrong =
            |page: &[u8]| !page[CONTENT_BYTES..].iter().eq(&crc32c(&page[..CONTENT_BYTES]).to_be_bytes());
        if let Some(wrong) = bytes.par_chunks(E57_PAGE_BYTES).position_first(is_wrong) {
            let page = first + wrong as u64;
            let what = format!("the checksum (CRC) of page {page} is wrong");
            return Err(Fault::contradiction(what).at_byte(page * E57_PAGE_BYTES as u64));
        }
        for page in 1..(last - first) as usize {
            let from = page * E57_PAGE_BYTES;
            bytes.copy_within(from..from + CONTENT_BYTES, page * CONTENT_BYTES);
        }
        let start = (at - first * content) as usize;
        bytes.copy_within(start..start + length, 0);
        bytes.truncate(length);
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checksums_are_those_of_the_standard() {
        // RFC 3720, appendix B.4.
        assert_eq!(crc32c(&[0; 32]), 0x8a91_36aa);
        assert_eq!(crc32c(&[255; 32]), 0x62a8_ab43);
        assert_eq!(crc32c(&(0..32).collect::<Vec<u8>>()), 0x46dd_794e);
        assert_eq!(crc32c(b"123456789"), 0xe306_9283);
    }
}
