//! Models of CAD files; B-spline surfaces for CAD programs, and from them.

pub use crate::content::cad_file::{CadFile, LengthUnit};
pub use crate::content::spline_model::SplineModel;
pub use crate::content::spline_surface::{Bound, SplineSurface, TrimmedFace};
pub use crate::formats::iges::surface as iges;
pub use crate::formats::step::surface as step;

use crate::content::cad_file::CadContent;
use crate::detect;
use crate::error::{Fault, ReadError, Result};
use crate::format::{Holds, ReadOptions};
use crate::source::{FileSources, Source, Sources};
use std::path::Path;
use trueness_geom::progress::Progress;

/// The model of a CAD file, `-` being standard input: parts with exact faces, and where they stand. `.gz` is unpacked on the way.
///
/// Of the options the format counts, and the unit where the file says none. What is damaged, or of a kind that is not read, is left
/// out and stands in [`Model::unread`](trueness_cad::model::Model::unread). Cost: time and memory in proportion to the size of the
/// file. `progress` counts faces.
///
/// # Errors
/// A file of another format; one without faces that can be read; an assembly of more instances than can be held;
/// [`Fault::Cancelled`]; those of reading.
pub fn read(
    path: &Path,
    options: &ReadOptions,
    progress: &dyn Progress,
) -> std::result::Result<CadFile, ReadError> {
    read_from(&FileSources, path, options, progress)
}

/// As [`read`], of what goes by a name in `sources`.
///
/// # Errors
/// Those of [`read`].
pub fn read_from(
    sources: &dyn Sources,
    name: &Path,
    options: &ReadOptions,
    progress: &dyn Progress,
) -> std::result::Result<CadFile, ReadError> {
    let source = sources.bytes(name).map_err(Into::into).and_then(Source::of);
    source
        .and_then(|source| of_source(source, name, options, progress))
        .map_err(|e| e.in_file(&sources.shown(name)))
}

fn of_source(
    mut source: Source,
    name: &Path,
    options: &ReadOptions,
    progress: &dyn Progress,
) -> Result<CadFile> {
    let format = match options.format {
        Some(format) => format,
        None => detect::format(&mut source, name)?,
    };
    let Some(reader) = format.model else {
        let what = format!("this is a file of the format {}, which holds no CAD model", format.name);
        return Err(Fault::Foreign { what, remedy: format!("give {}", Holds::Model.formats()) }.into());
    };
    let (bytes, gzip) = (source.bytes, source.gzip);
    let CadContent { model, unit, warnings, splines } = reader(&mut source, options, progress)?;
    Ok(CadFile { model, format: format.name, bytes, gzip, unit, warnings, splines })
}
