//! The content of a file.

pub(crate) mod cad_file;
pub(crate) mod drawing;
pub(crate) mod spline_model;
pub(crate) mod spline_surface;
mod unit_from;

use crate::{ReadError, Unit, Warning};
pub use unit_from::UnitFrom;

use cad_file::CadFile;
use drawing::Drawing;
use spline_model::SplineModel;
use trueness_geom::{cloud::PointStream, mesh::Mesh};

/// A file, read or ready to be read.
pub struct Input {
    /// Where it came from and how it was taken.
    pub provenance: Provenance,
    /// The mesh, the points as a stream, the splines, or the drawing.
    pub body: Body,
    /// The warnings, in the order of the file.
    pub warnings: Vec<Warning>,
}

/// Where data came from and how the file was taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Provenance {
    /// The path as it was given, or `-` for standard input.
    pub path: String,
    /// The format by the content, for instance `stl-binary`, `ply-ascii` or `xyz`.
    pub format: &'static str,
    /// Size on disk; 0 where it is not known (standard input).
    pub bytes: u64,
    /// True if the file is packed.
    pub gzip: bool,
    /// The unit in which its numbers were taken.
    pub unit_assumed: Unit,
    /// Where the unit comes from.
    pub unit_from: UnitFrom,
    /// True if the points have two coordinates only; their z is 0.
    pub planar: bool,
    /// How the columns of a table of text were taken; `None` for other files.
    pub table: Option<TableReading>,
}

/// How the columns of a table of text were taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TableReading {
    /// The separator of the columns: `semicolons`, `tabs`, `commas` or `blanks`.
    pub separator: &'static str,
    /// `.` or `,`.
    pub decimal_sign: char,
    /// The columns of x, y and, except for points in the plane, z.
    pub columns: Vec<ColumnTaken>,
    /// How many columns there are.
    pub of: usize,
    /// The line whose names were used, counted from 1.
    pub header_line: Option<u64>,
    /// Lines before the first row, the header among them.
    pub lines_skipped: u64,
}

/// A column that was taken for a coordinate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ColumnTaken {
    /// `x`, `y` or `z`.
    pub axis: char,
    /// Its number, counted from 1.
    pub number: usize,
    /// Its name in the header.
    pub name: Option<String>,
}

/// The points of a file, block by block, in the file's order, millimeters.
pub type PointSource = Box<dyn PointStream<Error = ReadError> + Send>;

/// A mesh, points, splines, a CAD model, or a drawing.
pub enum Body {
    /// Vertices and faces.
    Mesh(SourceMesh),
    /// Vertices without faces; not yet read beyond the first few.
    Points(PointSource),
    /// B-spline surfaces and curves of a CAD file.
    Splines(SplineModel),
    /// A CAD model with exact faces.
    Cad(Box<CadFile>),
    /// Lines, arcs and splines in a plane.
    Drawing(Drawing),
}

/// Parts of a mesh to which a file gives names.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FacetRegions {
    /// Their names, in the order of the file; a name may be empty, and may come more than once.
    pub names: Vec<String>,
    /// For each facet the number of its part in `names`.
    pub of_facet: Vec<u32>,
}

/// A mesh as the file holds it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SourceMesh {
    /// Positions in millimeters, and triangles. In the file's order.
    pub mesh: Mesh,
    /// The normal that an STL file stores with each facet, in the order of `mesh.faces`, not normalized and not
    /// trustworthy. `None` for other formats.
    pub stored_normals: Option<Vec<[f32; 3]>>,
    /// Numbers in the file, from 0 and ascending, of the facets that were left out because of a NaN or infinite coordinate.
    pub nonfinite_facets: Vec<u32>,
    /// Which solid of an STL file in words each facet is of, where there are several. `None` for other formats.
    pub regions: Option<FacetRegions>,
    /// Names of the properties that a PLY file has beside places and corners, such as colors, in the order of
    /// the header. They were not read. Empty for other formats.
    pub unread: Vec<String>,
}
