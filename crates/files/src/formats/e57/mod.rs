//! E57: scans of terrestrial scanners.
//!
//! Format: ASTM E2807-11. Pages of 1024 bytes end with a checksum each. A document of XML within them describes the scans; their
//! records are packed column by column in packets.

mod column;
mod document;
mod pages;
mod scan;

#[cfg(test)]
mod tests;

use crate::{
    ScanWarning, Unit, Warning,
    error::{Fault, Located, Result},
    format::{Format, Head, Holds, Parsed, ReadOptions},
    scan_warning::remark,
    source::Source,
};
use document::{Document, ScanHead};
use pages::Pages;
use scan::{LeftOut, OpenScan};
use trueness_geom::{cloud::PointStream, space::Point};

/// ASTM E57.
pub(crate) const E57: Format = Format {
    name: "e57",
    known_as: &["E57"],
    extensions: &["e57"],
    written_as: &[],
    manual: include_str!("e57.md"),
    holds: &[Holds::Points],
    columns: false,
    sniff: |head: &Head| head.bytes.starts_with(b"ASTM-E57"),
    read: Some(read),
    model: None,
    points: None,
    mesh: None,
};

fn read(source: Source, options: &ReadOptions) -> Result<Parsed> {
    let mut pages = Pages::open(source.feed)?;
    let Document { scans, images } = Document::read(&mut pages)?;
    if scans.is_empty() {
        let what = format!("the file holds {images} image(s), but no scan");
        return Err(Fault::Unsupported { what, remedy: "export the points too" }.into());
    }
    let warnings = told(&scans, images);
    for scan in &scans {
        OpenScan::begin(&mut pages, scan)?;
    }
    let scans = Scans {
        pages,
        expected: scans.iter().map(|s| s.records).fold(0, u64::saturating_add),
        scans: scans.into_iter(),
        open: None,
        block: options.block.max(1),
        left_out: LeftOut::default(),
    };
    Ok(Parsed { unit: Some(Unit::Meter), warnings, ..Parsed::points("e57", scans) })
}

/// What there is to tell before the points.
fn told(scans: &[ScanHead], images: u64) -> Vec<Warning> {
    let mut told = vec![];
    let empty = scans.iter().filter(|s| s.records == 0).count() as u64;
    if scans.len() > 1 {
        told.push(ScanWarning::Scans { count: scans.len() as u64, empty });
    }
    let mut names: Vec<String> = vec![];
    for name in scans.iter().flat_map(|s| &s.unread) {
        if !names.contains(name) {
            names.push(name.clone());
        }
    }
    if !names.is_empty() {
        told.push(ScanWarning::ColumnsUnread { names });
    }
    if images > 0 {
        told.push(ScanWarning::Images { count: images });
    }
    let nothing = (empty == scans.len() as u64).then_some(Warning::Nothing);
    nothing.into_iter().chain(told.into_iter().map(Warning::Scan)).collect()
}

/// The points of all scans, one after the other.
struct Scans {
    pages: Pages,
    expected: u64,
    /// Scans that are not begun.
    scans: std::vec::IntoIter<ScanHead>,
    open: Option<OpenScan>,
    block: usize,
    left_out: LeftOut,
}

impl PointStream for Scans {
    type Error = Located;
    fn expected(&self) -> Option<u64> {
        Some(self.expected)
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<()> {
        block.clear();
        while block.is_empty() {
            match &mut self.open {
                Some(open) if open.left() > 0 => {
                    open.next(&mut self.pages, self.block, block, &mut self.left_out)?;
                }
                _ => match self.scans.next() {
                    Some(scan) => self.open = Some(OpenScan::begin(&mut self.pages, &scan)?),
                    None => return Ok(()),
                },
            }
        }
        Ok(())
    }
    fn remarks(&self) -> Vec<String> {
        let LeftOut { invalid, not_finite } = self.left_out;
        let invalid = remark(invalid, |count| ScanWarning::Invalid { count });
        let not_finite = remark(not_finite, |count| ScanWarning::NotFinite { count });
        invalid.into_iter().chain(not_finite).collect()
    }
}
