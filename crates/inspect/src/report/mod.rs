//! The report: one HTML file that needs nothing else.
//!
//! ```text
//! result document ──► page (verdict, tables, figure: readable with scripts off)
//! geometry, deviations ──► picture (PNG of the default view)
//!                      └─► payload (trueness/view/1: manifest and blobs for the script)
//! ```
//! The same input gives the same bytes.

mod documents;
mod html;
mod marks;
mod number;
mod page;
mod payload;
mod picture;
mod text;
mod up;

pub use documents::{Answer, flat};
pub use marks::{Mark, MarkGroup, Marks};
pub use payload::NoValue;
pub(crate) use picture::first_view;
pub use text::Language;
pub use up::Up;

use crate::results::Role;
use crate::scale::Scale;
use crate::scale::palette::Rgb;
use documents::Drawn;
use payload::{Payload, Purpose};
use serde::Serialize;
use std::io::{self, Write};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::Point;

/// What a report is made of.
pub struct ReportInput<'a> {
    /// The answer; every number on the page is from here.
    pub result: Answer<'a>,
    /// What is drawn, the first being what the marks lie on. In a comparison: the measured object, then the references. Of
    /// sections: the points of each contour in its plane, the third coordinate 0 (`flat`).
    pub objects: &'a [ViewObject<'a>],
    /// What is drawn over it, in the order of the numbers that the list's rows lead to.
    pub marks: &'a [Marks],
    /// Words and limits.
    pub options: &'a ReportOptions,
}

/// Header fields, language, size.
#[derive(Clone, Debug)]
pub struct ReportOptions {
    /// Heading; the name of the measured file where absent.
    pub title: Option<String>,
    /// Name or number of the part.
    pub part: Option<String>,
    /// Serial number.
    pub serial: Option<String>,
    /// Who measured.
    pub operator: Option<String>,
    /// Bytes of the whole file that are aimed at.
    pub budget: usize,
    /// Language of the page as it is written; the reader can switch.
    pub language: Language,
    /// Decimal sign; by the language where absent.
    pub decimal: Option<char>,
    /// Which axis of the model points up on the screen.
    pub up: Up,
}

impl Default for ReportOptions {
    fn default() -> ReportOptions {
        ReportOptions {
            title: None,
            part: None,
            serial: None,
            operator: None,
            budget: 10_000_000,
            language: Language::En,
            decimal: None,
            up: Up::Z,
        }
    }
}

/// What an object is to the reader: what it is called, its colour, and what switches it on and off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ViewRole {
    /// Scan, points, the part as it is.
    Measured,
    /// Nominal.
    Reference,
    /// A mesh that is looked at by itself.
    Part,
    /// A mesh that was changed.
    After,
    /// The same before.
    Before,
    /// A surface fitted to points.
    Surface,
    /// Marks: lines of a surface.
    IsoLines,
    /// Marks: the control points of a surface and the lines between them; shown when asked for.
    Net,
    /// A fitted element, drawn translucent.
    Element,
    /// Deviations, on a page that is about something else: shown in place of the part.
    Deviation,
    /// Marks: what is wrong.
    Defects,
    /// Marks: the element's rim and lines.
    Outline,
    /// Marks: points that hold an element.
    Touching,
    /// Marks: lines between regions.
    Edges,
    /// Marks: what was changed.
    Changes,
}

impl From<Role> for ViewRole {
    fn from(role: Role) -> ViewRole {
        match role {
            Role::Measured => ViewRole::Measured,
            Role::Reference => ViewRole::Reference,
            Role::Mesh => ViewRole::Part,
        }
    }
}

impl ViewRole {
    /// Marks that are seen through the part: what is wrong or was changed must never be missed. Edges of the part itself
    /// are hidden by it.
    pub fn shows_through(self) -> bool {
        !matches!(self, ViewRole::Edges | ViewRole::IsoLines)
    }

    /// Colour of what has no map: warm grey for what was measured, blue-grey for what it is compared with.
    pub fn color(self) -> Rgb {
        match self {
            ViewRole::Reference | ViewRole::Before | ViewRole::Surface => [0x8f, 0xa3, 0xbf],
            ViewRole::Element => [0x2f, 0x6f, 0xd6],
            _ => [0xb9, 0xb4, 0xaa],
        }
    }
}

/// A mesh or a cloud with its values.
pub struct ViewObject<'a> {
    /// Measured, reference, …
    pub role: ViewRole,
    /// Shown to the reader; any text at all.
    pub name: &'a str,
    /// Colour of what has no map; the role's own where there is none.
    pub color: Option<Rgb>,
    /// For a reference, its number in the result's `comparisons`.
    pub comparison: Option<usize>,
    /// Places.
    pub geometry: Geometry<'a>,
    /// Deviations at the places. On a measured object: from each reference. On a reference: of the measured points near it.
    pub fields: Vec<ViewField<'a>>,
    /// Places that stay however much is left out, because the result names them; they rise.
    pub keep: &'a [u32],
    /// Set where a place shows the worst of several measured points near it and not a value of its own.
    pub gathered: Option<Gathered>,
}

/// How an object shows points that are not its own places.
#[derive(Clone, Copy, Debug)]
pub struct Gathered {
    /// Farthest that a shown point can be, along the surface, from where it is shown, millimetres.
    pub reach: f64,
    /// Vertices of the surface before it was refined for drawing.
    pub vertices: usize,
}

/// Places, millimetres.
#[derive(Clone, Copy)]
pub enum Geometry<'a> {
    /// A cloud.
    Points(&'a [Point]),
    /// A surface.
    Mesh(&'a Mesh),
}

/// One deviation a point or vertex.
pub struct ViewField<'a> {
    /// Number in the result's `comparisons`.
    pub comparison: usize,
    /// Millimetres, + outside; NaN where there is none.
    pub values: &'a [f64],
    /// Why there is none, place by place; where the list is too short the reason is unknown.
    pub reasons: &'a [NoValue],
}

impl ViewField<'_> {
    /// Deviation and, should it be NaN, the reason.
    fn at(&self, i: usize) -> (f64, NoValue) {
        let value = self.values.get(i).copied().unwrap_or(f64::NAN);
        (value, self.reasons.get(i).copied().unwrap_or(NoValue::Unknown))
    }
}

impl<'a> ViewObject<'a> {
    /// Measured points without name or values.
    pub fn measured(places: &'a [Point]) -> ViewObject<'a> {
        ViewObject {
            role: ViewRole::Measured,
            name: "",
            color: None,
            comparison: None,
            geometry: Geometry::Points(places),
            fields: vec![],
            keep: &[],
            gathered: None,
        }
    }

    fn mesh(&self) -> Option<&'a Mesh> {
        match self.geometry {
            Geometry::Mesh(mesh) => Some(mesh),
            Geometry::Points(_) => None,
        }
    }

    fn points(&self) -> Option<&'a [Point]> {
        match self.geometry {
            Geometry::Mesh(_) => None,
            Geometry::Points(points) => Some(points),
        }
    }

    fn places(&self) -> &'a [Point] {
        match self.geometry {
            Geometry::Mesh(mesh) => &mesh.positions,
            Geometry::Points(points) => points,
        }
    }

    fn color(&self) -> Rgb {
        self.color.unwrap_or(self.role.color())
    }

    fn field(&self, comparison: usize) -> Option<&ViewField<'a>> {
        self.fields.iter().find(|f| f.comparison == comparison)
    }
}

/// What was written.
#[derive(Clone, Copy, Debug)]
pub struct ReportSummary {
    /// Size of the file.
    pub bytes: usize,
    /// Points drawn, of measured clouds.
    pub points_shown: usize,
    /// Points given for drawing.
    pub points_given: usize,
    /// Farthest that what is drawn lies from what was given, millimetres.
    pub display_error: f64,
}

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The output refused bytes.
    #[error("the report could not be written: {0}")]
    Write(#[from] io::Error),
    /// The result could not be made JSON.
    #[error("the result could not be put into the report: {0}")]
    Json(#[from] serde_json::Error),
    /// A field has another number of values than its object has places.
    #[error("object {object}: {values} deviations for {places} places")]
    FieldLength {
        /// Number of the object.
        object: usize,
        /// Deviations given.
        values: usize,
        /// Points or vertices.
        places: usize,
    },
    /// The report is no longer wanted.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The triangle code failed.
    #[error("the triangles could not be packed: {0}")]
    Encoding(String),
}

/// Bytes that an object's entry in the manifest may take, names apart.
const MANIFEST_ENTRY: usize = 4000;

/// Tenths of the budget that objects are packed for at first; the page itself takes the rest.
const FIRST: usize = 9;

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
    let subject = input.result.subject();
    if let Some(drawing) = subject.drawing() {
        return write_drawing(input, drawing, progress, out);
    }
    let zone = subject.scale().and_then(|s| s.tolerance);
    let range = |s: &Scale| s.tolerance.map_or(s.upper - s.lower, |[l, u]| u - l);
    let scales = subject.maps().into_iter().filter_map(|m| m.scale.or(subject.scale()));
    let ranges: Vec<f64> = scales.map(range).collect();
    let purpose = Purpose { ranges: &ranges, zone, progress };
    let draw = || {
        let view = picture::FirstView::of(input, &input.result.subject().picks());
        picture::png(input, &view, progress).map(|png| page::Picture { png: payload::base64(&png), view })
    };
    let (picture, first) =
        rayon::join(draw, || payload::pack(input.objects, &purpose, FIRST * input.options.budget / 10));
    let picture = picture?;
    // What the page takes without its 3D part is left of the budget first.
    let bare = page::page(input, &Payload::default(), &page::Stage::Part(&picture))?.len()
        + MANIFEST_ENTRY * input.objects.len();
    let room = input.options.budget.saturating_sub(bare);
    let payload = first?.within(room, input.objects, input.marks, &purpose)?;
    let html = page::page(input, &payload, &page::Stage::Part(&picture))?;
    finish(&html, &payload, progress, out)
}

/// The report of what draws itself: as many of the measured points as the budget leaves room for.
fn write_drawing(
    input: &ReportInput,
    drawing: &dyn Drawn,
    progress: &dyn Progress,
    out: &mut impl Write,
) -> Result<ReportSummary, ReportError> {
    let bare = page::page(input, &Payload::default(), &page::Stage::Drawing(drawing, 0))?.len();
    let room = input.options.budget.saturating_sub(bare);
    let payload = Payload { points: drawing.shown(input.objects, room), ..Payload::default() };
    progress.advance(work(input.objects));
    let html = page::page(input, &payload, &page::Stage::Drawing(drawing, room))?;
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
