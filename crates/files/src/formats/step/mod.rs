//! STEP files (ISO 10303-21): the common part of written ones, of application protocol 214 and in millimeters; and their
//! reading.
//!
//! The header's time stamp is fixed, so that the same model gives the same bytes.

mod context;
mod curves;
mod instances;
mod model;
mod part21;
mod read;
mod spline;
mod surface;
#[cfg(test)]
mod tests;
mod tolerances;

pub use curves::write as curves;
pub(super) use instances::real;
pub use surface::write as surface;

use crate::content::cad_file::CadContent;
use crate::content::spline_model::SplineModel;
use crate::error::Result;
use crate::format::{Content, Format, Head, Holds, Parsed, ReadOptions};
use crate::formats::brep::holds_anything;
use crate::source::Source;
use trueness_geom::progress::{Progress, Silent};

/// STEP.
pub(crate) const STEP: Format = Format {
    name: "step",
    known_as: &["STEP"],
    extensions: &["step", "stp", "p21"],
    written_as: &[],
    manual: include_str!("step.md"),
    holds: &[Holds::Model],
    columns: false,
    sniff: |head: &Head| head.bytes.trim_ascii_start().starts_with(b"ISO-10303-21"),
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

/// A model with exact faces; surfaces and curves of a file without faces.
fn parsed(mut source: Source, options: &ReadOptions) -> Result<Parsed> {
    let mut content = model::read(&mut source, options, &Silent)?;
    let has_faces = content.model.parts.iter().any(|part| !part.brep.faces.is_empty());
    if has_faces {
        content.splines = SplineModel::of(&content.model);
        return Ok(Parsed::cad("step", content));
    }
    if !content.model.is_complete() {
        holds_anything(&content.model)?;
    }
    let splines = read::read(&mut source, options)?;
    if matches!(&splines.content, Content::Splines(found) if found.surfaces.is_empty() && found.curves.is_empty())
    {
        holds_anything(&content.model)?;
    }
    Ok(splines)
}
