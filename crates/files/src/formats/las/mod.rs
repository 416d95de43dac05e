//! LAS and LAZ: clouds of airborne and other laser scanners.
//!
//! Format: ASPRS, LAS specification 1.4 R15, and the older ones from 1.0 on. LAZ packs the records of LAS in chunks, which may be
//! unpacked by different threads; COPC is LAZ with an index that is not needed here.

mod coordinate_system;
mod header;
mod plain;
mod record;
mod units;
mod zip;
mod zip_table;

#[cfg(test)]
mod tests;

use crate::{
    ScanWarning, Unit, Warning,
    error::Result,
    format::{Format, Head, Holds, Parsed, ReadOptions},
    source::Source,
};
use coordinate_system::Lengths;
use header::Header;
use plain::PlainPoints;
use record::Layout;
use zip::ZippedPoints;

/// LAS, LAZ and COPC.
pub(crate) const LAS: Format = Format {
    name: "las",
    known_as: &["LAS", "LAZ"],
    extensions: &["las", "laz"],
    written_as: &[],
    manual: include_str!("las.md"),
    holds: &[Holds::Points],
    columns: false,
    sniff: |head: &Head| head.bytes.starts_with(b"LASF"),
    read: Some(read),
    model: None,
    points: None,
    mesh: None,
};

fn read(mut source: Source, options: &ReadOptions) -> Result<Parsed> {
    let header = Header::read(&mut source.feed)?;
    let layout = Layout::of(&header)?;
    let (lengths, unusable) = header.lengths(options.units.is_some())?;
    let (unit, warnings) = told(&header, &layout, lengths, unusable);
    let parsed = match header.zip.clone() {
        None => Parsed::points("las", PlainPoints::new(source.feed, layout, header.points, options.block)?),
        Some(zip) => {
            let points = ZippedPoints::new(source.feed, layout, header.points, &zip, options.block)?;
            Parsed::points(if header.is_indexed { "copc" } else { "laz" }, points)
        }
    };
    Ok(Parsed { unit, warnings, ..parsed })
}

/// The unit, and what there is to tell before the points.
fn told(
    header: &Header,
    layout: &Layout,
    lengths: Option<Lengths>,
    unusable: Option<String>,
) -> (Option<Unit>, Vec<Warning>) {
    let mut told = vec![];
    match lengths {
        None => {
            told.push(unusable.map_or(ScanWarning::UnitUnstated, |why| ScanWarning::UnitUnusable { why }))
        }
        Some(Lengths { unit, height }) => {
            if matches!(unit, Unit::Foot | Unit::SurveyFoot) {
                told.push(ScanWarning::Feet { unit });
            }
            if let Some(height) = height.filter(|height| *height != unit) {
                told.push(ScanWarning::HeightUnit { taken: unit, height });
            }
        }
    }
    if layout.has_wave_packets {
        told.push(ScanWarning::WavePackets);
    }
    if !header.extra_fields.is_empty() {
        told.push(ScanWarning::ColumnsUnread { names: header.extra_fields.clone() });
    } else if layout.extra_bytes > 0 {
        told.push(ScanWarning::ColumnsUnread {
            names: vec![format!("{} bytes without a name", layout.extra_bytes)],
        });
    }
    let nothing = (header.points == 0).then_some(Warning::Nothing);
    let warnings = nothing.into_iter().chain(told.into_iter().map(Warning::Scan)).collect();
    (lengths.map(|l| l.unit), warnings)
}
