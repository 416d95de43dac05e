//! The head of a LAS file: a block of numbers, and records of variable length before and behind the points.

use super::coordinate_system::{Lengths, geo_keys, well_known_text};
use crate::{
    error::{Fault, Result},
    feed::Feed,
};
use trueness_geom::space::Point;

/// What the file says of its points.
pub(super) struct Header {
    /// Number of the layout of a record.
    pub format: u8,
    /// Bytes of a record.
    pub length: usize,
    pub points: u64,
    pub scale: Point,
    pub offset: Point,
    /// How the points are packed, in the words of LASzip.
    pub zip: Option<Vec<u8>>,
    /// Whether it has the index of COPC.
    pub is_indexed: bool,
    /// Names of the fields that a record has beside those of its layout.
    pub extra_fields: Vec<String>,
    system: System,
}

/// The records that name the coordinate system.
#[derive(Default)]
struct System {
    /// GeoTIFF: keys, numbers and texts.
    keys: Vec<u8>,
    numbers: Vec<u8>,
    texts: Vec<u8>,
    /// Well-known text.
    text: Option<Vec<u8>>,
}

/// Bytes of the block of numbers: of version 1.0, and of 1.4.
const HEADER_BYTES: usize = 227;
const HEADER_BYTES_1_4: usize = 375;
/// Bytes before the content of a record before the points, and of one behind them.
const RECORD_HEAD_BYTES: usize = 54;
const LATE_RECORD_HEAD_BYTES: u64 = 60;
/// A text of a coordinate system is read up to this length.
const MAX_TEXT_BYTES: u64 = 1 << 20;
/// So many records behind the points are looked at.
const MAX_LATE_RECORDS: u32 = 1 << 12;

/// The number at a place of a block that is long enough.
macro_rules! number {
    ($bytes:expr, $at:expr, $kind:ty) => {
        <$kind>::from_le_bytes($bytes.get($at..).and_then(|b| b.first_chunk().copied()).unwrap_or_default())
    };
}

impl Header {
    /// Reads all that stands before the points, and steps to these.
    pub fn read(feed: &mut Feed) -> Result<Header> {
        let bytes = feed.ahead(HEADER_BYTES_1_4)?;
        let block = &bytes[..bytes.len().min(HEADER_BYTES_1_4)];
        let size = usize::from(number!(block, 94, u16));
        let start = u64::from(number!(block, 96, u32));
        let records = number!(block, 100, u32);
        let minor = block.get(25).copied().unwrap_or_default();
        if block.len() < HEADER_BYTES || size < HEADER_BYTES || start < size as u64 {
            let present = block.len().min(size) as u64;
            return Err(Fault::Short { what: "bytes of the header", declared: HEADER_BYTES as u64, present }
                .at_byte(94));
        }
        let kind = number!(block, 104, u8);
        let late = minor >= 4 && size >= HEADER_BYTES_1_4 && block.len() == HEADER_BYTES_1_4;
        let old = u64::from(number!(block, 107, u32));
        let mut header = Header {
            format: kind & 0x3f,
            length: usize::from(number!(block, 105, u16)),
            points: if late { number!(block, 247, u64) } else { old },
            scale: std::array::from_fn(|i| number!(block, 131 + 8 * i, f64)),
            offset: std::array::from_fn(|i| number!(block, 155 + 8 * i, f64)),
            zip: None,
            is_indexed: false,
            extra_fields: vec![],
            system: System::default(),
        };
        let (late_start, late_records) =
            if late { (number!(block, 235, u64), number!(block, 243, u32)) } else { (0, 0) };
        header.check_numbers()?;
        feed.step(size);
        header.early_records(feed, records, start)?;
        skip_to(feed, start)?;
        header.late_records(feed, late_start, late_records)?;
        if kind & 0xc0 != 0 && header.zip.is_none() {
            return Err(
                Fault::contradiction("the points are compressed, but no VLR of LASzip says how").at_byte(104)
            );
        }
        if kind & 0xc0 == 0 {
            header.zip = None;
        }
        Ok(header)
    }

    fn check_numbers(&self) -> Result<()> {
        for (i, axis) in ["x", "y", "z"].into_iter().enumerate() {
            let (scale, offset) = (self.scale[i], self.offset[i]);
            if !scale.is_normal() || !offset.is_finite() {
                let what = format!("the scale of {axis} is {scale} and its offset {offset}");
                return Err(Fault::contradiction(what).at_byte(131 + 8 * i as u64));
            }
        }
        Ok(())
    }

    /// The records between the block of numbers and the points.
    fn early_records(&mut self, feed: &mut Feed, declared: u32, start: u64) -> Result<()> {
        for present in 0..u64::from(declared) {
            let at = feed.position();
            let short = || {
                let what = "VLRs before the points";
                Fault::Short { what, declared: u64::from(declared), present }.at_byte(at)
            };
            let head = feed.ahead(RECORD_HEAD_BYTES)?;
            let length = usize::from(number!(head, 20, u16));
            let end = at + (RECORD_HEAD_BYTES + length) as u64;
            if head.len() < RECORD_HEAD_BYTES || end > start {
                return Err(short());
            }
            let record = feed.ahead(RECORD_HEAD_BYTES + length)?;
            let Some(content) = record.get(RECORD_HEAD_BYTES..RECORD_HEAD_BYTES + length) else {
                return Err(short());
            };
            self.take(&record[2..18], number!(record, 18, u16), content);
            feed.step(RECORD_HEAD_BYTES + length);
        }
        Ok(())
    }

    /// The records behind the points, from byte `at` of the file on; only a coordinate system is taken from them.
    fn late_records(&mut self, feed: &mut Feed, mut at: u64, declared: u32) -> Result<()> {
        for present in 0..declared.min(MAX_LATE_RECORDS) {
            let short = || {
                let what = "EVLRs behind the points";
                Fault::Short { what, declared: u64::from(declared), present: u64::from(present) }.at_byte(at)
            };
            let mut head = [0; LATE_RECORD_HEAD_BYTES as usize];
            let from = at.checked_sub(feed.position()).ok_or_else(short)?;
            feed.copy(from, &mut head).map_err(|_| short())?;
            let length = number!(head, 20, u64);
            if &head[2..17] == b"LASF_Projection" && length <= MAX_TEXT_BYTES {
                let mut content = vec![0; length as usize];
                feed.copy(from + LATE_RECORD_HEAD_BYTES, &mut content).map_err(|_| short())?;
                self.take(&head[2..18], number!(head, 18, u16), &content);
            }
            at = length.checked_add(at + LATE_RECORD_HEAD_BYTES).ok_or_else(short)?;
        }
        Ok(())
    }

    /// Keeps a record that says something of the points.
    fn take(&mut self, user: &[u8], id: u16, content: &[u8]) {
        let user = user.split(|b| *b == 0).next().unwrap_or_default();
        match (user, id) {
            (b"laszip encoded", 22204) => self.zip = Some(content.into()),
            (b"copc", 1) => self.is_indexed = true,
            (b"LASF_Projection", 34735) => self.system.keys = content.into(),
            (b"LASF_Projection", 34736) => self.system.numbers = content.into(),
            (b"LASF_Projection", 34737) => self.system.texts = content.into(),
            (b"LASF_Projection", 2112) => self.system.text = Some(content.into()),
            (b"LASF_Spec", 4) => self.extra_fields = content.chunks_exact(192).map(extra_field).collect(),
            _ => {}
        }
    }

    /// The units of the coordinates, `None` where the file does not say them. `is_said` tells that the user did; then why those of the file
    /// are of no use is the second value.
    pub fn lengths(&self, is_said: bool) -> Result<(Option<Lengths>, Option<String>)> {
        let System { keys, numbers, texts, text } = &self.system;
        let found = match text {
            Some(text) => well_known_text(&String::from_utf8_lossy(text)),
            None => geo_keys(keys, numbers, texts),
        };
        match found {
            Ok(lengths) => Ok((lengths, None)),
            Err(Fault::Unsupported { what, .. }) if is_said => Ok((None, Some(what))),
            Err(_) if is_said => Ok((None, None)),
            Err(fault) => Err(fault.into()),
        }
    }
}

/// The name of a further field of a record.
fn extra_field(record: &[u8]) -> String {
    let name = record[4..36].split(|b| *b == 0).next().unwrap_or_default();
    String::from_utf8_lossy(name).into_owned()
}

/// Steps to a byte of the file.
fn skip_to(feed: &mut Feed, to: u64) -> Result<()> {
    while feed.position() < to {
        let want = (to - feed.position()).min(1 << 18) as usize;
        let there = feed.ahead(want)?.len().min(want);
        if there == 0 {
            return Err(Fault::Short {
                what: "bytes before the points",
                declared: to,
                present: feed.position(),
            }
            .into());
        }
        feed.step(there);
    }
    Ok(())
}
