//! IGES 5.3 files: the common part of written ones, in millimeters; and their reading.
//!
//! Lines have 80 columns: 64 to 72 of content, a letter for the section, a number. The dates are fixed, so that the same model
//! gives the same bytes.

mod curves;
mod entry;
mod global;
mod model;
mod record;
mod surface;
#[cfg(test)]
mod tests;
mod text;
mod words;
#[cfg(test)]
mod written;

pub use curves::write as curves;
pub use surface::write as surface;

use crate::UnitFrom;
use crate::content::cad_file::CadContent;
use crate::error::Result;
use crate::format::{Format, Head, Holds, Parsed, ReadOptions};
use crate::formats::brep::holds_anything;
use crate::source::Source;
use trueness_geom::progress::{Progress, Silent};

/// IGES.
pub(crate) const IGES: Format = Format {
    name: "iges",
    known_as: &["IGES"],
    extensions: &["iges", "igs"],
    written_as: &[],
    manual: include_str!("iges.md"),
    holds: &[Holds::Model],
    columns: false,
    // The first line is of the start section, or of the flag that begins the compressed form; the first of them.
    sniff: |head: &Head| {
        let line = head.bytes.split(|b| *b == b'\n').next().unwrap_or_default();
        matches!(line.get(text::SECTION_COLUMN), Some(b'S' | b'C'))
            && line.get(73..80).is_some_and(|n| n.trim_ascii() == b"1" || n.ends_with(b"0000001"))
    },
    read: Some(parsed),
    model: Some(model),
    points: None,
    mesh: None,
};

/// The model of a file.
pub(crate) fn model(
    source: &mut Source,
    options: &ReadOptions,
    progress: &dyn Progress,
) -> Result<CadContent> {
    let content = model::read(source, options, progress)?;
    holds_anything(&content.model)?;
    Ok(content)
}

/// A model with exact faces; the B-spline curves of a file without faces.
fn parsed(mut source: Source, options: &ReadOptions) -> Result<Parsed> {
    let content = model::read(&mut source, options, &Silent)?;
    if content.model.parts.iter().any(|part| !part.brep.faces.is_empty()) {
        return Ok(Parsed::cad("iges", content));
    }
    let splines = content.splines.unwrap_or_default();
    if !content.model.is_complete() || splines.curves.is_empty() {
        holds_anything(&content.model)?;
    }
    let said = (content.unit.from == UnitFrom::Header).then(|| content.unit.nearest());
    Ok(Parsed::splines("iges", splines, said, content.warnings))
}
