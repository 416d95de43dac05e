//! PCD: clouds of the Point Cloud Library.
//!
//! Format: "The PCD file format", version 0.7, of its documentation. Packed data are compressed by LZF.

mod header;
mod lzf;
mod packed;
mod text;

#[cfg(test)]
mod tests;

use super::strided::{Rows, StridedPoints};
use crate::{
    ScanWarning, Warning,
    error::{Located, Result},
    format::{Format, Head, Holds, Parsed, ReadOptions},
    lines::{Lines, without_mark, words},
    scalar::Order,
    scan_warning::remark,
    source::Source,
};
use header::{Header, Storage};
use packed::PackedPoints;
use text::AsciiPoints;
use trueness_geom::{cloud::PointStream, space::Point};

/// Point Cloud Data.
pub(crate) const PCD: Format = Format {
    name: "pcd",
    known_as: &["PCD"],
    extensions: &["pcd"],
    written_as: &[],
    manual: include_str!("pcd.md"),
    holds: &[Holds::Points],
    columns: false,
    sniff: |head: &Head| is_pcd(head.bytes),
    read: Some(read),
    model: None,
    points: None,
    mesh: None,
};

/// A header is read up to this length.
const MAX_PCD_HEADER_BYTES: usize = 1 << 16;

/// Whether the first line that is no comment gives the version, or a comment names the format.
fn is_pcd(bytes: &[u8]) -> bool {
    if without_mark(bytes).starts_with(b"# .PCD") {
        return true;
    }
    let mut lines =
        Lines::new(bytes).map(<[u8]>::trim_ascii).filter(|l| !l.is_empty() && !l.starts_with(b"#"));
    let version = lines.next().is_some_and(|l| words(l).next() == Some(b"VERSION"));
    version && lines.next().is_some_and(|l| matches!(words(l).next(), Some(b"FIELDS" | b"COLUMNS")))
}

fn read(mut source: Source, options: &ReadOptions) -> Result<Parsed> {
    let bytes = source.feed.ahead(MAX_PCD_HEADER_BYTES)?;
    let header = Header::parse(&bytes[..bytes.len().min(MAX_PCD_HEADER_BYTES)])?;
    source.feed.step(header.length);
    let places = header.coordinates()?;
    let parsed = match header.storage {
        Storage::Ascii => {
            Parsed::points("pcd-ascii", AsciiPoints::new(source.feed, &header, places, options.block)?)
        }
        Storage::Binary => {
            let place = |axis: usize| (places[axis].byte, places[axis].scalar);
            let rows = Rows {
                order: Order::Little,
                stride: header.stride,
                x: place(0),
                y: place(1),
                z: Some(place(2)),
                count: header.points,
                what: ("point", "points"),
            };
            let points = StridedPoints::new(source.feed, rows, options.block)?.finite_alone();
            Parsed::points("pcd-binary", BinaryPoints(points))
        }
        Storage::Packed => Parsed::points(
            "pcd-binary-compressed",
            PackedPoints::new(source.feed, &header, places, options.block)?,
        ),
    };
    Ok(Parsed { warnings: warnings(&header), ..parsed })
}

fn warnings(header: &Header) -> Vec<Warning> {
    let mut warnings = vec![];
    if header.points == 0 {
        warnings.push(Warning::Nothing);
    }
    let names: Vec<String> = header.other_fields().map(str::to_string).collect();
    if !names.is_empty() {
        warnings.push(Warning::Scan(ScanWarning::ColumnsUnread { names }));
    }
    if let Some(viewpoint) = header.viewpoint.clone() {
        warnings.push(Warning::Scan(ScanWarning::ViewpointUnused { viewpoint }));
    }
    warnings
}

/// Points of rows of bytes.
struct BinaryPoints(StridedPoints);

impl PointStream for BinaryPoints {
    type Error = Located;
    fn expected(&self) -> Option<u64> {
        self.0.expected()
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<()> {
        self.0.next_block(block)
    }
    fn remarks(&self) -> Vec<String> {
        remark(self.0.left_out(), |count| ScanWarning::NotFinite { count }).into_iter().collect()
    }
}
