//! The record of a point: where its numbers are, and what they mean.

use super::header::Header;
use crate::{
    ScanWarning,
    error::{Fault, Result},
    scan_warning::remark,
};
use trueness_geom::space::Point;

/// How records are made, and how their integers become lengths.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    /// Bytes of a record.
    pub length: usize,
    pub has_wave_packets: bool,
    /// Bytes behind those of the format.
    pub extra_bytes: usize,
    scale: Point,
    offset: Point,
    /// The bit of the flags in byte 15 that withholds a point.
    withheld: u8,
    /// Where the time is.
    time: Option<usize>,
}

/// Counts of records about which something is told.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Tally {
    /// Marked as withheld.
    pub withheld: u64,
    /// With a time that is not finite.
    pub bad_times: u64,
}

impl Tally {
    /// What is told of the records.
    pub fn remarks(&self) -> Vec<String> {
        let withheld = remark(self.withheld, |count| ScanWarning::Withheld { count });
        let times = remark(self.bad_times, |count| ScanWarning::TimeNotFinite { count });
        withheld.into_iter().chain(times).collect()
    }
}

impl std::ops::AddAssign for Tally {
    fn add_assign(&mut self, other: Tally) {
        self.withheld += other.withheld;
        self.bad_times += other.bad_times;
    }
}

/// The byte with the flags of a point.
const FLAGS_BYTE: usize = 15;
/// Bytes of a record of each format, and the byte of its time.
const POINT_FORMATS: [(usize, Option<usize>); 11] = [
    (20, None),
    (28, Some(20)),
    (26, None),
    (34, Some(20)),
    (57, Some(20)),
    (63, Some(20)),
    (30, Some(22)),
    (36, Some(22)),
    (38, Some(22)),
    (59, Some(22)),
    (67, Some(22)),
];
/// The first format with the flags of LAS 1.4.
const FIRST_LATE_FORMAT: u8 = 6;

impl Layout {
    pub fn of(header: &Header) -> Result<Layout> {
        let Some((base, time)) = POINT_FORMATS.get(usize::from(header.format)).copied() else {
            let what = format!("the points have format {}, of formats 0 to 10", header.format);
            return Err(Fault::Unsupported { what, remedy: "export the file as LAS 1.4" }.at_byte(104));
        };
        if header.length < base {
            let what =
                format!("a record of point format {} has {base} bytes, not {}", header.format, header.length);
            return Err(Fault::contradiction(what).at_byte(105));
        }
        Ok(Layout {
            length: header.length,
            has_wave_packets: matches!(header.format, 4 | 5 | 9 | 10),
            extra_bytes: header.length - base,
            scale: header.scale,
            offset: header.offset,
            withheld: if header.format < FIRST_LATE_FORMAT { 1 << 7 } else { 1 << 2 },
            time,
        })
    }

    /// The place of a record, which has all its bytes, in the unit of the file.
    #[inline(always)]
    pub fn point(&self, record: &[u8], tally: &mut Tally) -> Point {
        tally.withheld += u64::from(record[FLAGS_BYTE] & self.withheld != 0);
        if let Some(time) = self.time {
            let time = f64::from_le_bytes(record[time..].first_chunk().copied().unwrap_or_default());
            tally.bad_times += u64::from(!time.is_finite());
        }
        std::array::from_fn(|i| {
            let step = i32::from_le_bytes(record[4 * i..].first_chunk().copied().unwrap_or_default());
            f64::from(step) * self.scale[i] + self.offset[i]
        })
    }
}
