//! The definition of a format: options and result of its reader, and its writers.

pub(crate) mod columns;
pub(crate) mod corners;
pub(crate) mod loss;
pub(crate) mod sink;
pub(crate) mod spool;
pub(crate) mod values;

use crate::{
    Columns, Unit, Warning,
    content::{SourceMesh, TableReading, cad_file::CadContent, drawing::Drawing, spline_model::SplineModel},
    error::{Located, Result},
    source::Source,
};
use sink::{MeshWriter, PointsWriter};
use trueness_geom::{
    cloud::{PointStream, Whole},
    progress::Progress,
    space::Point,
};

/// A file format.
pub struct Format {
    /// Short name, as it is given on the command line.
    pub name: &'static str,
    /// Extensions of files that are read, lower case, without dot; the first is the usual one.
    pub extensions: &'static [&'static str],
    /// Names under which people know its files, as messages have them.
    pub(crate) known_as: &'static [&'static str],
    /// Extensions under which it is written.
    pub written_as: &'static [&'static str],
    /// Its page, as `trueness formats` prints it: what is read, what is written, what is lost. Markdown.
    pub manual: &'static str,
    /// Whether it is a table, whose columns can be chosen.
    pub(crate) columns: bool,
    /// What its files can hold; nothing where they are only written.
    pub(crate) holds: &'static [Holds],
    /// Whether the content is beyond doubt of this format.
    pub(crate) sniff: fn(&Head) -> bool,
    pub(crate) read: Option<fn(Source, &ReadOptions) -> Result<Parsed>>,
    pub(crate) model: Option<ModelReader>,
    pub(crate) points: Option<PointsWriter>,
    pub(crate) mesh: Option<MeshWriter>,
}

/// Reads the exact faces of a file.
pub(crate) type ModelReader = fn(&mut Source, &ReadOptions, &dyn Progress) -> Result<CadContent>;

/// What a file can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holds {
    /// Facets.
    Mesh,
    /// Points without facets.
    Points,
    /// CAD models and B-spline surfaces.
    Model,
    /// Lines, arcs and splines in a plane.
    Drawing,
}

impl Format {
    /// Names under which people know its files, the usual one first.
    pub fn known_as(&self) -> &'static [&'static str] {
        self.known_as
    }
    /// What files of this format can hold; nothing where they are only written.
    pub fn holds(&self) -> &'static [Holds] {
        self.holds
    }
    /// Whether files of this format can be read.
    pub fn reads(&self) -> bool {
        self.read.is_some()
    }
    /// Whether it is a table, whose columns can be chosen.
    pub fn has_columns(&self) -> bool {
        self.columns
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

/// Facts that a file does not state itself.
#[derive(Clone, Debug)]
pub struct ReadOptions {
    /// The unit of its numbers; else that in the names of a table's columns is used, else millimeters are assumed.
    pub units: Option<Unit>,
    /// The unit where neither `units` nor the file says one; millimeters where this is absent too.
    pub unit_else: Option<Unit>,
    /// Columns of x, y, z in a table; found out otherwise. Wrong for any other format.
    pub columns: Option<Columns>,
    /// The normals of the points instead of the points, see [`open_normals`](crate::open_normals).
    pub normals: bool,
    /// Its format; found out otherwise.
    pub format: Option<&'static Format>,
    /// Which vertices of a mesh become one.
    pub weld: Weld,
    /// About how many points a block of a stream holds.
    pub block: usize,
}

impl ReadOptions {
    /// The unit of a file that states `said`. The unit stated by a CAD file overrules the one asked for.
    pub(crate) fn unit_of(&self, said: Option<Unit>) -> Unit {
        said.or(self.units).or(self.unit_else).unwrap_or_default()
    }
}

/// Which vertices of a mesh become one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Weld {
    /// None. An STL file is then a heap of loose triangles, and other formats are torn open where textures or materials
    /// meet.
    None,
    /// Vertices at the same place.
    #[default]
    Same,
    /// Vertices within this distance of one another, millimeters.
    Within(f64),
}

impl Default for ReadOptions {
    fn default() -> ReadOptions {
        ReadOptions {
            units: None,
            unit_else: None,
            columns: None,
            normals: false,
            format: None,
            weld: Weld::Same,
            block: 1 << 21,
        }
    }
}

/// The start of a file.
pub(crate) struct Head<'a> {
    pub bytes: &'a [u8],
    /// Length of the file, where it is known.
    pub length: Option<u64>,
}

/// The result of a reader, lengths still in the unit of the file.
pub(crate) struct Parsed {
    /// The variant found.
    pub variant: &'static str,
    pub content: Content,
    /// Points in the plane.
    pub planar: bool,
    /// How the columns of a table of text were taken.
    pub table: Option<TableReading>,
    /// The unit that the file gives itself.
    pub unit: Option<Unit>,
    pub warnings: Vec<Warning>,
}

/// A mesh, a stream of points whose errors do not yet name the file, splines or a drawing, which are in millimeters already.
pub(crate) enum Content {
    Mesh(SourceMesh),
    Splines(SplineModel),
    Cad(Box<CadContent>),
    Drawing(Drawing),
    Points(Box<dyn PointStream<Error = Located> + Send>),
}

impl Parsed {
    fn of(variant: &'static str, content: Content, warnings: Vec<Warning>) -> Parsed {
        Parsed { variant, content, planar: false, table: None, unit: None, warnings }
    }
    pub fn mesh(variant: &'static str, mesh: SourceMesh, mut warnings: Vec<Warning>) -> Parsed {
        if mesh.mesh.faces.is_empty() && mesh.nonfinite_facets.is_empty() {
            warnings.push(Warning::Nothing);
        }
        Parsed::of(variant, Content::Mesh(mesh), warnings)
    }
    /// Splines whose unit the file says, if it does.
    pub fn splines(
        variant: &'static str,
        model: SplineModel,
        unit: Option<Unit>,
        mut warnings: Vec<Warning>,
    ) -> Parsed {
        if model.surfaces.is_empty() && model.curves.is_empty() {
            warnings.push(Warning::NoSplines);
        }
        Parsed { unit, ..Parsed::of(variant, Content::Splines(model), warnings) }
    }
    /// A model with exact faces.
    pub fn cad(variant: &'static str, content: CadContent) -> Parsed {
        let warnings = content.warnings.clone();
        Parsed::of(variant, Content::Cad(Box::new(content)), warnings)
    }
    /// A drawing whose unit the file says, if it does.
    pub fn drawing(
        variant: &'static str,
        drawing: Drawing,
        unit: Option<Unit>,
        warnings: Vec<Warning>,
    ) -> Parsed {
        Parsed { unit, ..Parsed::of(variant, Content::Drawing(drawing), warnings) }
    }
    pub fn points(
        variant: &'static str,
        points: impl PointStream<Error = Located> + Send + 'static,
    ) -> Parsed {
        Parsed::of(variant, Content::Points(Box::new(points)), vec![])
    }
    /// Points that have been read already.
    pub fn cloud(variant: &'static str, points: Vec<Point>) -> Parsed {
        let warnings = if points.is_empty() { vec![Warning::Nothing] } else { vec![] };
        Parsed { warnings, ..Parsed::points(variant, Whole::new(points)) }
    }
}
