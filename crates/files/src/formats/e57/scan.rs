//! The records of a scan, packet by packet.

use super::{
    column::Column,
    document::{Coordinates, ScanHead},
    pages::Pages,
};
use crate::{
    error::{Fault, Result},
    formats::strided::is_finite,
};
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::Point;

/// Counts of records without a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct LeftOut {
    /// Marked as invalid.
    pub invalid: u64,
    /// With a coordinate that is not finite.
    pub not_finite: u64,
}

/// A scan of which not all records have been read.
pub(super) struct OpenScan {
    /// The content byte at which the next packet begins, and the one behind the last.
    next: u64,
    end: u64,
    declared: u64,
    left: u64,
    /// Columns of a packet.
    streams: usize,
    /// The coordinates, and the state if there is one, with their numbers among the columns.
    columns: Vec<(usize, Column)>,
    coordinates: Coordinates,
    pose: Option<[Point; 4]>,
}

/// Bytes of the head of a scan's records, and of a packet at most.
const SECTION_HEAD_BYTES: u64 = 32;
const MAX_PACKET_BYTES: u64 = 1 << 16;
/// Content bytes that are read at a time.
const WINDOW_BYTES: u64 = 1 << 22;
/// Records that take no bytes at all are read up to this number.
const MAX_RECORDS_WITHOUT_BYTES: u64 = 1 << 16;
/// One task unpacks this many records.
const UNPACKED_PER_TASK: usize = 1 << 12;
/// The first byte of a packet of data; others hold an index or nothing.
const DATA_PACKET: u8 = 1;

impl OpenScan {
    /// The scan before its first record. Refuses more records than the bytes can hold.
    pub fn begin(pages: &mut Pages, scan: &ScanHead) -> Result<OpenScan> {
        let used = scan.places.into_iter().chain(scan.state);
        let mut open = OpenScan {
            next: 0,
            end: 0,
            declared: scan.records,
            left: scan.records,
            streams: scan.columns.len(),
            columns: used.map(|i| (i, Column::new(scan.columns[i]))).collect(),
            coordinates: scan.coordinates,
            pose: scan.pose,
        };
        if scan.records == 0 {
            return Ok(open);
        }
        let outside = |what: &str, offset: u64| {
            Fault::contradiction(format!("{what} of a scan has offset {offset}, beyond the end of the file"))
                .at_byte(scan.offset)
        };
        let start = pages.content_at(scan.offset).filter(|at| at + SECTION_HEAD_BYTES <= pages.length());
        let start = start.ok_or_else(|| outside("the data", scan.offset))?;
        let head = pages.read(start, SECTION_HEAD_BYTES as usize)?;
        let number = |at: usize| head[at..].first_chunk().map_or(0, |b| u64::from_le_bytes(*b));
        let (length, data) = (number(8), number(16));
        if head[0] != 1 {
            return Err(Fault::unexpected("the records of a scan", &head[..1]).at_byte(scan.offset));
        }
        open.next = pages.content_at(data).ok_or_else(|| outside("the first packet", data))?;
        open.end = start.saturating_add(length).min(pages.length()).max(open.next);
        let bits: u64 = scan.columns.iter().map(|c| c.bits as u64).sum();
        let most = (8 * (open.end - open.next)).checked_div(bits).unwrap_or(MAX_RECORDS_WITHOUT_BYTES);
        if scan.records > most {
            let short = Fault::Short { what: "records of a scan", declared: scan.records, present: most };
            return Err(short.at_byte(scan.offset));
        }
        Ok(open)
    }

    /// Records that are left.
    pub fn left(&self) -> u64 {
        self.left
    }

    /// Appends the points of about the next `most` records.
    pub fn next(
        &mut self,
        pages: &mut Pages,
        most: usize,
        out: &mut Vec<Point>,
        left_out: &mut LeftOut,
    ) -> Result<()> {
        let most = usize::try_from(self.left).unwrap_or(usize::MAX).min(most);
        while self.available() < most {
            if !self.packets(pages)? {
                break;
            }
        }
        let count = self.available().min(most);
        if count == 0 {
            let present = self.declared - self.left;
            return Err(Fault::Short { what: "records of a scan", declared: self.declared, present }.into());
        }
        let scan = &*self;
        let tasks = (0..count.div_ceil(UNPACKED_PER_TASK)).into_par_iter();
        let parts: Vec<(Vec<Point>, LeftOut)> = tasks
            .map(|task| {
                let from = task * UNPACKED_PER_TASK;
                scan.points(from..count.min(from + UNPACKED_PER_TASK))
            })
            .collect();
        for (points, without) in parts {
            out.extend_from_slice(&points);
            left_out.invalid += without.invalid;
            left_out.not_finite += without.not_finite;
        }
        self.columns.iter_mut().for_each(|(_, column)| column.step(count));
        self.left -= count as u64;
        Ok(())
    }

    /// Records of which all numbers are there.
    fn available(&self) -> usize {
        self.columns.iter().filter_map(|(_, column)| column.available()).min().unwrap_or(usize::MAX)
    }

    /// Takes the packets of the next window; false at the end of the scan.
    fn packets(&mut self, pages: &mut Pages) -> Result<bool> {
        let length = WINDOW_BYTES.min(self.end - self.next) as usize;
        let window = pages.read(self.next, length)?;
        let is_last = self.next + length as u64 == self.end;
        let mut at = 0;
        while window.len() - at >= 4 && (is_last || (window.len() - at) as u64 >= MAX_PACKET_BYTES) {
            let size = usize::from(u16::from_le_bytes([window[at + 2], window[at + 3]])) + 1;
            let Some(packet) = window.get(at..at + size).filter(|_| size >= 4) else { break };
            match packet[0] {
                DATA_PACKET => {
                    self.data(packet).map_err(Fault::contradiction)?;
                }
                0 | 2 => {}
                other => {
                    let what = format!("a packet of a scan has the unknown type {other}");
                    return Err(Fault::contradiction(what).into());
                }
            }
            at += size;
        }
        self.next += at as u64;
        Ok(at > 0)
    }

    /// Takes the bytes of a packet that are of columns in use.
    fn data(&mut self, packet: &[u8]) -> std::result::Result<(), &'static str> {
        const TOO_SHORT: &str = "a packet of a scan is shorter than its columns";
        let count = packet.get(4..6).map_or(0, |b| usize::from(u16::from_le_bytes([b[0], b[1]])));
        if count != self.streams {
            return Err("a packet of a scan has another number of columns than the scan");
        }
        let lengths = packet.get(6..6 + 2 * count).ok_or(TOO_SHORT)?;
        let mut at = 6 + 2 * count;
        for (i, length) in lengths.chunks_exact(2).enumerate() {
            let length = usize::from(u16::from_le_bytes([length[0], length[1]]));
            let bytes = packet.get(at..at + length).ok_or(TOO_SHORT)?;
            self.columns.iter_mut().filter(|(own, _)| *own == i).for_each(|(_, column)| column.push(bytes));
            at += length;
        }
        Ok(())
    }

    /// The points of some records that are there.
    fn points(&self, records: std::ops::Range<usize>) -> (Vec<Point>, LeftOut) {
        let (mut points, mut left_out) = (Vec::with_capacity(records.len()), LeftOut::default());
        let [(_, a), (_, b), (_, c), state @ ..] = &self.columns[..] else { return (points, left_out) };
        for i in records {
            if state.iter().any(|(_, state)| state.get(i) != 0.0) {
                left_out.invalid += 1;
                continue;
            }
            let point = self.placed([a.get(i), b.get(i), c.get(i)]);
            if is_finite(&point) {
                points.push(point);
            } else {
                left_out.not_finite += 1;
            }
        }
        (points, left_out)
    }

    /// A record's place in common axes.
    fn placed(&self, numbers: [f64; 3]) -> Point {
        let own = match self.coordinates {
            Coordinates::Cartesian => numbers,
            Coordinates::Spherical => {
                let [range, azimuth, elevation] = numbers;
                let across = range * libm::cos(elevation);
                [across * libm::cos(azimuth), across * libm::sin(azimuth), range * libm::sin(elevation)]
            }
        };
        match &self.pose {
            None => own,
            Some([a, b, c, d]) => {
                std::array::from_fn(|i| own[0] * a[i] + own[1] * b[i] + own[2] * c[i] + d[i])
            }
        }
    }
}
