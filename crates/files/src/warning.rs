//! Oddities of a file that could still be read.

use crate::{ScanWarning, Unit};
use std::fmt;

/// An oddity that did not keep a file from being read. Its text says how it was handled.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Warning {
    /// The file is well-formed and holds nothing.
    Nothing,
    /// Facets with a NaN or infinite coordinate were left out.
    NonFiniteFacets {
        /// How many.
        count: u64,
        /// The first of them, counted from 0.
        first: u64,
    },
    /// Bytes follow what the header declares; they were not read.
    TrailingBytes {
        /// How many.
        count: u64,
    },
    /// A row has more or fewer numbers behind its coordinates or corners than other rows, or numbers that are no color. They were
    /// passed over.
    UnevenRow {
        /// The first such line, from 1.
        line: u64,
    },
    /// Lines of text behind the last solid of an STL file were passed over.
    TextBehind {
        /// The first of them, from 1.
        line: u64,
        /// Its text, shortened.
        text: String,
    },
    /// The last solid of an STL file is not closed by `endsolid`.
    NoEndsolid,
    /// Several solids became one mesh.
    Solids {
        /// How many.
        count: u64,
    },
    /// Faces of more than three vertices were cut into triangles.
    Polygons {
        /// How many.
        count: u64,
    },
    /// Faces that have no area, cross themselves or are far from plane were cut into triangles that do not make up the face.
    CutSomehow {
        /// How many.
        count: u64,
    },
    /// Faces of fewer than three vertices were left out.
    Slight {
        /// How many.
        count: u64,
    },
    /// Vertices at the same place became one.
    Joined {
        /// Vertices in the file.
        before: u64,
        /// Vertices in the mesh.
        after: u64,
    },
    /// Vertices nearer than the distance asked for became one.
    Welded {
        /// The distance, mm.
        distance: f64,
        /// Vertices before.
        before: u64,
        /// Vertices after.
        after: u64,
    },
    /// The first column counts the rows and was not taken for a coordinate.
    RunningNumber,
    /// The rows are an airfoil in the form of a collection. Its title and its counts were taken out, and its two sides put in one row.
    Airfoil {
        /// Whose form.
        form: &'static str,
        /// Its title.
        title: Option<String>,
    },
    /// The header names neither x nor y nor z; the columns of numbers were taken in their order.
    NamesUnknown {
        /// Their names.
        names: Vec<String>,
    },
    /// The text in brackets behind a name is no unit.
    NoUnit {
        /// The name.
        name: String,
    },
    /// The header gives a unit, and the user another one, which was taken.
    UnitOverruled {
        /// That of the header.
        header: Unit,
        /// That which was taken.
        asked: Unit,
    },
    /// A CAD file states its unit, and the user another one, which was not used.
    UnitKept {
        /// That of the file, which was taken.
        said: Unit,
        /// That which was asked for.
        asked: Unit,
    },
    /// Shapes of a CAD file whose representation says no unit of lengths.
    UnitMissing {
        /// How many representations.
        count: u64,
        /// Millimeters in the unit that was taken.
        millimeters: f64,
    },
    /// Faces of a CAD file bound no solid: the file does not say where material is, and their normals were made to agree.
    Sheets {
        /// Faces in no solid.
        faces: u64,
        /// Sheets among them that have no border.
        closed: u64,
        /// Faces that were turned.
        turned: u64,
    },
    /// There are neither B-spline surfaces nor curves in a CAD file.
    NoSplines,
    /// Faces that are less than their surface; it was taken whole.
    Trimmed {
        /// How many.
        count: u64,
    },
    /// Faces on surfaces that are no B-splines were left out.
    FacesLeftOut {
        /// How many.
        count: u64,
        /// Faces of the file.
        of: u64,
    },
    /// Entities of a drawing that have no course in its plane were passed over.
    PassedOver {
        /// How many of which kinds.
        what: String,
    },
    /// Entities of a drawing that are not seen were left out.
    Unseen {
        /// How many are marked as invisible.
        marked: u64,
        /// How many lie on layers that are frozen or switched off.
        on_layers: u64,
        /// The names of these layers.
        layers: String,
    },
    /// The entities of a drawing lie on several layers.
    SeveralLayers {
        /// Their names, with how many entities each holds.
        layers: String,
    },
    /// Splines of a drawing are given by the points alone that they pass through; they are drawn as cubics.
    ThroughPoints {
        /// How many.
        count: u64,
    },
    /// There is neither line nor arc nor spline in a drawing.
    NothingDrawn,
    /// Lines of a header that say nothing known were passed over.
    HeaderLines {
        /// How many.
        count: u64,
        /// The number of the first, counted from 1.
        line: u64,
        /// Its text, shortened.
        text: String,
    },
    /// Of the file of a scanner.
    Scan(ScanWarning),
    /// What a stream of points told at its end.
    Remark(String),
}

/// Bytes of a facet of binary STL, the smallest facet of all formats. Fewer trailing bytes hold no facet.
const FACET_BYTES: u64 = 50;

/// The part of a file that was not read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unread {
    /// Faces, and how many the file has, where that is known.
    Faces {
        /// How many were not read.
        count: u64,
        /// All of them.
        of: Option<u64>,
    },
    /// Nobody can tell how much.
    Unknown,
}

impl Warning {
    /// The part of the file that was not read, if this warning says so. Facets that were joined, cut or taken in another unit were read.
    pub fn unread(&self) -> Option<Unread> {
        match self {
            Warning::FacesLeftOut { count, of } => Some(Unread::Faces { count: *count, of: Some(*of) }),
            Warning::NonFiniteFacets { count, .. } => Some(Unread::Faces { count: *count, of: None }),
            Warning::TrailingBytes { count } if *count >= FACET_BYTES => Some(Unread::Unknown),
            Warning::NoEndsolid => Some(Unread::Unknown),
            _ => None,
        }
    }
}

impl Warning {
    /// Writes the text of a warning about a table; nothing for other warnings.
    fn of_tables(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Warning::RunningNumber => {
                write!(f, "the first column counts the rows; the three after it were taken as x, y, z")
            }
            Warning::Airfoil { form, title } => {
                let title = title.as_ref().map_or(String::new(), |t| format!(" with the title \"{t}\""));
                write!(
                    f,
                    "an airfoil in {form}'s form{title}; its title and counts were left out, and both sides are one row around it"
                )
            }
            Warning::NamesUnknown { names } => {
                write!(
                    f,
                    "the header names no coordinate; {} were taken as x, y, z in this order",
                    names.join(", ")
                )
            }
            Warning::NoUnit { name } => {
                write!(f, "the name \"{name}\" gives no known unit")
            }
            Warning::UnitOverruled { header, asked } => {
                write!(f, "the header gives the unit {header}, but {asked} was asked for and taken")
            }
            _ => Ok(()),
        }
    }

    /// Writes the text of a warning about a CAD file or a drawing; nothing for other warnings.
    fn of_cad(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Warning::UnitMissing { count, millimeters } => write!(
                f,
                "{count} representation(s) of shapes say no unit of lengths; one of {millimeters} mm was taken"
            ),
            Warning::Sheets { faces, closed, turned } => write!(
                f,
                "{faces} face(s) are surfaces of no solid, in sheets of which {closed} close; {turned} of them were turned so that \
                 neighbors look to one side, and closed sheets outward"
            ),
            Warning::NoSplines => write!(f, "the file holds neither B-spline surfaces nor B-spline curves"),
            Warning::Trimmed { count } => write!(
                f,
                "{count} face(s) with holes or edges within their surface; each surface was taken whole"
            ),
            Warning::FacesLeftOut { count, of } => {
                write!(
                    f,
                    "{} of {of} faces read; the others lie on surfaces that are no B-splines",
                    of - count
                )
            }
            Warning::PassedOver { what } => {
                write!(f, "entities of the drawing that are not read were passed over: {what}")
            }
            Warning::Unseen { marked, on_layers, layers } => {
                let on = match layers.is_empty() {
                    true => String::new(),
                    false => format!(" ({layers})"),
                };
                write!(
                    f,
                    "{} entities that are not seen in the drawing were left out: {marked} marked as invisible, {on_layers} on layers that are frozen \
                     or switched off{on}",
                    marked + on_layers
                )
            }
            Warning::SeveralLayers { layers } => write!(
                f,
                "the drawing has entities on several layers: {layers}; lines that are no outline cannot be told from others: switch off or \
                 delete layers of center and construction lines"
            ),
            Warning::ThroughPoints { count } => write!(
                f,
                "{count} spline(s) given only by the points on them, drawn as cubics; other programs may draw them otherwise between \
                 the points: export them with their control points"
            ),
            Warning::NothingDrawn => write!(f, "the drawing holds neither lines nor arcs nor splines"),
            _ => Ok(()),
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Warning::Nothing => write!(f, "the file holds neither faces nor points"),
            Warning::NonFiniteFacets { count, first } => {
                write!(
                    f,
                    "{count} facet(s) with a coordinate that is not finite left out, first: facet {first}"
                )
            }
            Warning::TrailingBytes { count } => {
                write!(f, "{count} bytes after the declared content were not read")
            }
            Warning::UnevenRow { line } => write!(
                f,
                "line {line}: the numbers behind the coordinates or corners are unlike those of other rows, or no color, and were \
                 passed over; check that no number is missing"
            ),
            Warning::TextBehind { line, text } => {
                write!(
                    f,
                    "line {line}: text behind the last solid is no part of the mesh and was passed over: {text}"
                )
            }
            Warning::NoEndsolid => write!(f, "the last solid is not closed; the file may be cut short"),
            Warning::Solids { count } => write!(f, "{count} solids read as one mesh"),
            Warning::Polygons { count } => {
                write!(f, "{count} face(s) of more than three vertices cut into triangles")
            }
            Warning::CutSomehow { count } => write!(
                f,
                "{count} face(s) among them that cross themselves, are far from plane or have no area: their triangles may lie \
                 outside of them or upon each other"
            ),
            Warning::Slight { count } => write!(f, "{count} face(s) of fewer than three vertices left out"),
            Warning::Joined { before, after } => {
                write!(
                    f,
                    "{before} vertices become {after}: those at the same place were joined, unused ones left out"
                )
            }
            Warning::Welded { distance, before, after } => {
                write!(f, "{before} vertices became {after}: those within {distance} mm were joined")
            }
            Warning::RunningNumber
            | Warning::Airfoil { .. }
            | Warning::NamesUnknown { .. }
            | Warning::NoUnit { .. }
            | Warning::UnitOverruled { .. } => self.of_tables(f),
            Warning::UnitKept { said, asked } => {
                write!(
                    f,
                    "the file states its unit, {said}, which was used; {asked} is for files that do not state theirs"
                )
            }
            Warning::UnitMissing { .. }
            | Warning::Sheets { .. }
            | Warning::NoSplines
            | Warning::Trimmed { .. }
            | Warning::FacesLeftOut { .. }
            | Warning::PassedOver { .. }
            | Warning::Unseen { .. }
            | Warning::SeveralLayers { .. }
            | Warning::ThroughPoints { .. }
            | Warning::NothingDrawn => self.of_cad(f),
            Warning::Scan(warning) => warning.fmt(f),
            Warning::Remark(text) => f.write_str(text),
            Warning::HeaderLines { count, line, text } => {
                let more = if *count > 1 { format!(" and {} more", count - 1) } else { String::new() };
                write!(f, "line {line} of the header has no known word and was passed over: {text}{more}")
            }
        }
    }
}
