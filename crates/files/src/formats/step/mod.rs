//! STEP files (ISO 10303-21): the common part of written ones, of application protocol 214 and in millimeters; and their
//! reading.
//!
//! The header's time stamp is fixed, so that the same model gives the same bytes.

mod curves;
mod instances;
mod model;
mod part21;
mod read;
mod spline;
mod surface;
#[cfg(test)]
mod tests;

pub use curves::write as curves;
pub(super) use instances::real;
pub(crate) use model::read as model;
pub use surface::write as surface;

use crate::content::spline_model::SplineModel;
use crate::error::Result;
use crate::format::{Content, Format, Head, Parsed, ReadOptions};
use crate::source::Source;
use trueness_geom::progress::Silent;

/// STEP.
pub(crate) const STEP: Format = Format {
    name: "step",
    extensions: &["step", "stp", "p21"],
    written_as: &[],
    manual: include_str!("step.md"),
    columns: false,
    sniff: |head: &Head| head.bytes.trim_ascii_start().starts_with(b"ISO-10303-21"),
    read: Some(parsed),
    points: None,
    mesh: None,
};

/// A model with exact faces; surfaces and curves of a file without faces.
fn parsed(mut source: Source, options: &ReadOptions) -> Result<Parsed> {
    match model(&mut source, options, &Silent) {
        Ok(mut content) if content.model.parts.iter().any(|part| !part.brep.faces.is_empty()) => {
            content.splines = whole_splines(&mut source, options);
            Ok(Parsed::cad("step", content))
        }
        Ok(_) => read::read(&mut source, options),
        Err(error) => {
            let splines = read::read(&mut source, options).ok();
            splines.filter(|parsed| parsed.warnings.is_empty()).ok_or(error)
        }
    }
}

/// The surfaces of a file whose faces are all whole B-spline surfaces that stand where they are.
fn whole_splines(source: &mut Source, options: &ReadOptions) -> Option<SplineModel> {
    let parsed = read::read(source, options).ok().filter(|parsed| parsed.warnings.is_empty())?;
    match parsed.content {
        Content::Splines(model) if !model.surfaces.is_empty() => Some(model),
        _ => None,
    }
}
