//! The report: one HTML file that needs nothing else.
//!
//! ```text
//! result document ──► page (verdict, tables, figure: readable with scripts off)
//! geometry, deviations ──► picture (PNG of the default view)
//!                      └─► payload (trueness/view/1: manifest and blobs for the script)
//! ```
//! The same input gives the same bytes.
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "a test does not hang on the last digit"))]

mod error;
mod headline;
mod input;
mod marks;
mod no_value;
mod number;
mod object;
mod page;
mod pages;
mod payload;
mod picture;
mod shown;
mod subject;
mod text;
mod up;
mod values;
pub mod views;

pub use error::ReportError;
pub use input::{ReportInput, ReportOptions};
pub use marks::{Mark, MarkGroup, Marks};
pub use no_value::NoValue;
pub use object::{Gathered, Geometry, ObjectFaces, ViewField, ViewObject, ViewRole, flat};
pub use pages::MapPage;
pub use subject::Subject;
pub use text::Language;
pub use up::Up;

use payload::{Payload, Purpose};
use std::io::Write;
use subject::Drawn;
use trueness_document::scale::Scale;
use trueness_geom::progress::{Cancelled, Progress};

/// What was written.
#[derive(Clone, Copy, Debug)]
pub struct ReportSummary {
    /// Size of the file.
    pub bytes: usize,
    /// Points drawn, of measured clouds.
    pub points_shown: usize,
    /// Points given for drawing.
    pub points_given: usize,
    /// Farthest that what is drawn lies from what was given, millimeters.
    pub display_error: f64,
}

/// Bytes that an object's entry in the manifest may take, names apart.
const MANIFEST_ENTRY: usize = 4000;

/// What [`write()`] tells its progress in all: each object's places twice, once drawn and once packed.
pub fn work(objects: &[ViewObject]) -> u64 {
    2 * objects.iter().map(|o| o.places().len() as u64).sum::<u64>()
}

/// Writes the report of a document as one HTML file.
///
/// Objects may be empty, fields may be NaN throughout, names may hold any text. Deterministic for any number of threads.
/// `progress` hears of places, [`work`] in all. Cost: a few passes over the geometry, dominated by collapsing edges.
///
/// # Errors
/// See [`ReportError`].
pub fn write(
    input: &ReportInput,
    progress: &dyn Progress,
    out: &mut impl Write,
) -> Result<ReportSummary, ReportError> {
    for (object, o) in input.objects.iter().enumerate() {
        let places = o.places().len();
        if let Some(f) = o.fields.iter().find(|f| f.values.len() != places) {
            return Err(ReportError::FieldLength { object, values: f.values.len(), places });
        }
    }
    let subject = input.result;
    if let Some(drawing) = subject.drawing() {
        return write_drawing(input, drawing, progress, out);
    }
    let zone = subject.scale().and_then(|s| s.tolerance);
    let range = |s: &Scale| s.tolerance.map_or(s.upper - s.lower, |[l, u]| u - l);
    let scales = subject.maps().into_iter().filter_map(|m| m.scale.or(subject.scale()));
    let ranges: Vec<f64> = scales.map(range).collect();
    let purpose = Purpose { ranges: &ranges, zone, progress };
    let draw = || {
        let view = picture::FirstView::of(input, &input.result.picks());
        picture::png(input, &view, progress).map(|png| page::Picture { png: payload::base64(&png), view })
    };
    let (picture, maps) = rayon::join(draw, || page::maps(input));
    let picture = picture?;
    // What the page takes without its 3D part is left of the budget first.
    let bare = page::page(input, &Payload::default(), &page::Stage::Part(&picture), &maps)?.len()
        + MANIFEST_ENTRY * input.objects.len();
    let room = input.options.budget.saturating_sub(bare);
    let payload = payload::pack(input.objects, input.marks, &purpose, room)?;
    let html = page::page(input, &payload, &page::Stage::Part(&picture), &maps)?;
    finish(&html, &payload, progress, out)
}

/// The report of what draws itself: as many of the measured points as the budget leaves room for.
fn write_drawing(
    input: &ReportInput,
    drawing: &dyn Drawn,
    progress: &dyn Progress,
    out: &mut impl Write,
) -> Result<ReportSummary, ReportError> {
    let maps = page::maps(input);
    let bare = page::page(input, &Payload::default(), &page::Stage::Drawing(drawing, 0), &maps)?.len();
    let room = input.options.budget.saturating_sub(bare);
    let payload =
        Payload { points: drawing.shown(input.objects, input.options.up, room), ..Payload::default() };
    progress.advance(work(input.objects));
    let html = page::page(input, &payload, &page::Stage::Drawing(drawing, room), &maps)?;
    finish(&html, &payload, progress, out)
}

fn finish(
    html: &str,
    payload: &Payload,
    progress: &dyn Progress,
    out: &mut impl Write,
) -> Result<ReportSummary, ReportError> {
    if progress.cancelled() {
        return Err(Cancelled.into());
    }
    out.write_all(html.as_bytes())?;
    out.flush()?;
    Ok(ReportSummary {
        bytes: html.len(),
        points_shown: payload.points.0,
        points_given: payload.points.1,
        display_error: payload.display_error,
    })
}
