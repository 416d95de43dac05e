//! `trueness/info/1`: what is in a file.

use super::word::words;
use super::{InputRecord, ResultDocument, UNITS, VERSION, Word};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Name of this document's schema.
pub const SCHEMA: &str = "trueness/info/1";

words! {
    /// What a file holds.
    Content, "content of a file", {
        /// Facets.
        Mesh = "mesh",
        /// Points without facets.
        Points = "points",
        /// Faces on exact surfaces.
        Cad = "cad",
        /// B-spline surfaces and curves without bounds.
        Splines = "splines",
        /// Lines, arcs and splines in a plane.
        Drawing = "drawing",
    }
}

words! {
    /// The surface that a face of a CAD model lies on.
    CadSurface, "kind of surface", {
        /// A plane.
        Plane = "plane",
        /// A cylinder.
        Cylinder = "cylinder",
        /// A cone.
        Cone = "cone",
        /// A sphere.
        Sphere = "sphere",
        /// A torus.
        Torus = "torus",
        /// A B-spline, rational or not.
        Spline = "bspline",
        /// An extruded curve.
        Extrusion = "extrusion",
        /// A turned curve.
        Revolution = "revolution",
        /// An offset of another surface.
        Offset = "offset",
    }
}

/// The whole document. Keys that do not belong to the content are absent.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct InfoDocument {
    /// `trueness/info/1`.
    pub schema: String,
    /// Version of the program.
    pub version: String,
    /// Always `mm`: the unit of this document's numbers.
    pub units: String,
    /// The file read.
    pub inputs: Vec<InputRecord>,
    /// What it holds.
    pub content: Word<Content>,
    /// The unit of its own numbers.
    pub unit: String,
    /// Least and greatest coordinates, mm; `null` where there is nothing. Those of a CAD model are exact.
    pub bounds: Option<[[f64; 3]; 2]>,
    /// Points of a cloud, or vertices of a mesh.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub points: Option<u64>,
    /// Facets of a mesh.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub facets: Option<u64>,
    /// Area of the facets or faces, mm².
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub area: Option<f64>,
    /// What a CAD model has.
    #[serde(flatten, skip_serializing_if = "Option::is_none", default)]
    pub cad: Option<CadRecord>,
}

/// What is in a CAD model. Faces, edges and solids count as often as their part stands in the assembly.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
pub struct CadRecord {
    /// Faces by the kind of their surface; kinds that do not occur are absent.
    pub faces: BTreeMap<Word<CadSurface>, u64>,
    /// Edges.
    pub edges: u64,
    /// Vertices of edges.
    pub vertices: u64,
    /// Shells.
    pub shells: u64,
    /// Solids.
    pub solids: u64,
    /// Volume of all solids, mm³; `null` without solids, or where one cannot be told.
    pub volume: Option<f64>,
    /// Why there is no volume.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub volume_reason: Option<String>,
    /// Volume of each solid, mm³.
    pub volumes: Vec<Option<f64>>,
    /// The parts, each once.
    pub parts: Vec<PartRecord>,
    /// Parts where they stand.
    pub instances: u64,
    /// Levels of the assembly; 0 for a single part.
    pub depth: u32,
    /// Where each instance stands.
    pub placements: Vec<PlacementRecord>,
    /// Faces with a color of their own.
    pub coloured_faces: u64,
    /// The uncertainty that the file states for its lengths, mm.
    pub uncertainty: Option<f64>,
    /// The tolerances that the model carries, if it does: `trueness plan init` makes a plan of them.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub tolerances: Option<TolerancesRecord>,
    /// Faces that could not be read: what is not read of a nominal leaves its verdict undecided.
    pub refused: Vec<RefusedRecord>,
    /// Other entities that were not read, by keyword and reason.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub unread: Vec<UnreadRecord>,
}

/// Numbers of tolerances that a CAD model carries.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
pub struct TolerancesRecord {
    /// Datums.
    pub datums: u64,
    /// Sizes, distances and angles.
    pub dimensions: u64,
    /// Tolerances of form, attitude, place and run-out, by their kind.
    pub geometric: BTreeMap<String, u64>,
}

/// A part of a CAD model.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct PartRecord {
    /// The name of its product; may be empty.
    pub name: String,
    /// How often it stands in the assembly.
    pub instances: u64,
    /// Faces of one instance.
    pub faces: u64,
    /// Solids of one instance.
    pub solids: u64,
    /// Curves and points that bound no face.
    pub wires: u64,
}

/// Where a part stands.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct PlacementRecord {
    /// Names from the root of the assembly down to the part, joined by `/`.
    pub path: String,
    /// Its part: the place in `parts`, from 0.
    pub part: u32,
    /// Rows of the matrix from coordinates of the part to those of the assembly, mm.
    pub matrix: [[f64; 4]; 3],
}

/// A face that could not be read.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct RefusedRecord {
    /// The number of its entity in the file.
    pub face: u64,
    /// Its keyword.
    pub keyword: String,
    /// Why.
    pub why: String,
}

/// Entities that were not read and hold no face.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct UnreadRecord {
    /// Their keyword.
    pub keyword: String,
    /// How many.
    pub count: u64,
    /// Why.
    pub why: String,
}

impl InfoDocument {
    /// A document that tells of a file no more than its content.
    pub fn new(input: InputRecord, content: Content) -> InfoDocument {
        InfoDocument {
            schema: SCHEMA.into(),
            version: VERSION.into(),
            units: UNITS.into(),
            unit: input.unit_assumed.clone(),
            inputs: vec![input],
            content: Word(content),
            bounds: None,
            points: None,
            facets: None,
            area: None,
            cad: None,
        }
    }
}

/// What is in a file is told, whatever it is.
impl ResultDocument for InfoDocument {
    fn conforms(&self) -> bool {
        true
    }
}
