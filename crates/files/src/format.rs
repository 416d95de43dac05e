//! The list of formats, and what each of them is.
//!
//! A new format is one file in `formats/` and one line in [`FORMATS`]. Its manual is its page in the handbook.

use crate::{
    Unit, Warning,
    content::{SourceMesh, TableReading},
    error::{Located, Result},
    formats,
    open::ReadOptions,
    source::Source,
    write::{MeshWriter, PointsWriter},
};
use trueness_geom::{
    cloud::{PointStream, Whole},
    space::Point,
};

/// A file format.
pub struct Format {
    /// Short name, as it is given on the command line.
    pub name: &'static str,
    /// Extensions of files that are read, lower case, without dot; the first is the usual one.
    pub extensions: &'static [&'static str],
    /// Those under which it is written.
    pub written_as: &'static [&'static str],
    /// The page of the handbook: what is read, what is written, what is lost. Markdown.
    pub manual: &'static str,
    /// Whether the content is beyond doubt of this format.
    pub(crate) sniff: fn(&Head) -> bool,
    pub(crate) read: Option<fn(Source, &ReadOptions) -> Result<Parsed>>,
    pub(crate) points: Option<PointsWriter>,
    pub(crate) mesh: Option<MeshWriter>,
}

/// All formats. Those that show themselves plainly come first.
pub static FORMATS: &[&Format] = &[
    &formats::ply::PLY,
    &formats::npy::NPY,
    &formats::off::OFF,
    &formats::stl::STL,
    &formats::obj::OBJ,
    &formats::table::TABLE,
    &formats::npz::NPZ,
    &formats::vtp::VTP,
    #[cfg(feature = "parquet")]
    &formats::parquet::PARQUET,
];

impl Format {
    /// The format of this name or extension (upper or lower case).
    pub fn named(name: &str) -> Option<&'static Format> {
        let is = |s: &&str| s.eq_ignore_ascii_case(name);
        let by_name = FORMATS.iter().copied().find(|f| is(&f.name));
        by_name.or_else(|| Format::by_extension(name))
    }
    /// The format whose files end in `extension`, given without dot, upper or lower case.
    pub fn by_extension(extension: &str) -> Option<&'static Format> {
        FORMATS.iter().copied().find(|f| f.extensions.iter().any(|e| e.eq_ignore_ascii_case(extension)))
    }
    /// Whether files of this format can be read.
    pub fn reads(&self) -> bool {
        self.read.is_some()
    }
    /// Whether it is a table, whose columns can be chosen.
    pub fn has_columns(&self) -> bool {
        *self == formats::table::TABLE || *self == formats::npy::NPY
    }
    /// Whether points, with deviations or without, can be written.
    pub fn writes_points(&self) -> bool {
        self.points.is_some()
    }
    /// Whether meshes can be written.
    pub fn writes_meshes(&self) -> bool {
        self.mesh.is_some()
    }
}

impl std::fmt::Debug for Format {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

impl PartialEq for Format {
    fn eq(&self, other: &Format) -> bool {
        self.name == other.name
    }
}

/// The start of a file.
pub(crate) struct Head<'a> {
    pub bytes: &'a [u8],
    /// Length of the file, where it is known.
    pub length: Option<u64>,
}

/// What a reader makes of a file, lengths still in the file's unit.
pub(crate) struct Parsed {
    /// The variant found.
    pub variant: &'static str,
    pub content: Parts,
    /// Points in the plane.
    pub planar: bool,
    /// What was taken for what, in a table of text.
    pub table: Option<TableReading>,
    /// The unit that the file gives itself.
    pub unit: Option<Unit>,
    pub warnings: Vec<Warning>,
}

/// A mesh, or a stream of points whose errors do not yet name the file.
pub(crate) enum Parts {
    Mesh(SourceMesh),
    Points(Box<dyn PointStream<Error = Located> + Send>),
}

impl Parsed {
    fn of(variant: &'static str, content: Parts, warnings: Vec<Warning>) -> Parsed {
        Parsed { variant, content, planar: false, table: None, unit: None, warnings }
    }
    pub fn mesh(variant: &'static str, mesh: SourceMesh, mut warnings: Vec<Warning>) -> Parsed {
        if mesh.mesh.faces.is_empty() && mesh.nonfinite_facets == 0 {
            warnings.push(Warning::Nothing);
        }
        Parsed::of(variant, Parts::Mesh(mesh), warnings)
    }
    pub fn points(
        variant: &'static str,
        points: impl PointStream<Error = Located> + Send + 'static,
    ) -> Parsed {
        Parsed::of(variant, Parts::Points(Box::new(points)), vec![])
    }
    /// Points that have been read already.
    pub fn cloud(variant: &'static str, points: Vec<Point>) -> Parsed {
        let warnings = if points.is_empty() { vec![Warning::Nothing] } else { vec![] };
        Parsed { warnings, ..Parsed::points(variant, Whole::new(points)) }
    }
}
