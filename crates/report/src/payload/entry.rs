//! Entries of the manifest: what the script draws, and in which blobs it is.

use super::super::no_value::NoValue;
use super::super::{ViewObject, ViewRole};
use super::field::Codes;
use super::grid::Grid;
use serde::{Serialize, Serializer};
use trueness_document::scale::palette::hex;
use trueness_geom::space::Point;

/// An entry of `objects`.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum Entry {
    /// A mesh or cloud.
    Object(ObjectEntry),
    /// Marks over it.
    Marks(MarksEntry),
}

/// A blob, by its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Blob {
    /// Among those of the part that the entry belongs to, until parts are joined.
    pub blob: usize,
}

/// A mesh or cloud.
#[derive(Debug, Serialize)]
pub struct ObjectEntry {
    pub role: ViewRole,
    pub name: String,
    pub color: String,
    pub kind: &'static str,
    pub comparison: Option<usize>,
    pub vertices: usize,
    pub source_vertices: usize,
    pub origin: Point,
    pub step: f64,
    #[serde(flatten)]
    pub places: PlacesEntry,
    pub fields: Vec<FieldEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub faces: Option<FacesEntry>,
    pub display_error: f64,
    pub id: usize,
    pub shown: bool,
}

/// How the places of an object are stored.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum PlacesEntry {
    /// A surface.
    Mesh {
        triangles: usize,
        source_triangles: usize,
        /// How far gathered points can be from where they are shown.
        reach: Option<f64>,
        corners: Blob,
        positions: Blob,
        /// The coarser ones.
        levels: Vec<LevelEntry>,
    },
    /// A cloud.
    Points {
        positions: Blob,
        /// How many points each level has, with those before it.
        levels: Vec<CountEntry>,
    },
}

/// A coarser level of a mesh.
#[derive(Debug, Serialize)]
pub struct LevelEntry {
    pub triangles: usize,
    pub error: f64,
    #[serde(flatten)]
    pub code: Blob,
}

/// How many points a level has.
#[derive(Debug, Serialize)]
pub struct CountEntry {
    pub points: usize,
}

/// The values of a map at the places of an object.
#[derive(Debug, Serialize)]
pub struct FieldEntry {
    comparison: usize,
    name: &'static str,
    unit: &'static str,
    bits: usize,
    step: f64,
    #[serde(flatten)]
    values: Blob,
    /// Which codes stand for the reasons why there is no value.
    #[serde(serialize_with = "reasons")]
    no_value: Codes,
}

fn reasons<S: Serializer>(codes: &Codes, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(NoValue::ALL.map(|r| (codes.no_value(r).to_string(), r.name())))
}

/// The faces of a CAD model that a surface draws.
#[derive(Debug, Serialize)]
pub struct FacesEntry {
    /// The faces.
    pub list: Vec<FaceEntry>,
    /// Of each vertex the place of its face in the list.
    pub of: Blob,
    /// Along edges.
    pub lines: LinesEntry,
}

/// A face.
#[derive(Debug, Serialize)]
pub struct FaceEntry {
    /// What a user names it by.
    pub number: u64,
    #[serde(skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// What its surface is.
    pub kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color: Option<String>,
}

/// Lines through places on the grid of their object.
#[derive(Debug, Serialize)]
pub struct LinesEntry {
    pub lines: usize,
    pub points: usize,
    pub positions: Blob,
    /// How many places each line has.
    pub counts: Blob,
}

/// Marks over an object.
#[derive(Debug, Serialize)]
pub struct MarksEntry {
    pub role: ViewRole,
    pub kind: &'static str,
    pub vertices: usize,
    pub origin: Point,
    pub step: f64,
    pub shown: bool,
    pub comparison: Option<usize>,
    /// Number of the first mark.
    pub first: usize,
    pub groups: Vec<GroupEntry>,
    pub triangles: usize,
    pub segments: usize,
    pub points: usize,
    pub positions: Blob,
    pub items: Blob,
    pub id: usize,
}

/// Marks of one color.
#[derive(Debug, PartialEq, Serialize)]
pub struct GroupEntry {
    pub key: String,
    pub color: String,
    pub count: usize,
}

impl ObjectEntry {
    /// Of an object on a grid, of whose places so many are shown of so many given.
    pub fn new(
        object: &ViewObject,
        grid: &Grid,
        (shown, given): (usize, usize),
        places: PlacesEntry,
    ) -> ObjectEntry {
        ObjectEntry {
            role: object.role,
            name: object.name.to_string(),
            color: hex(object.color()),
            kind: match places {
                PlacesEntry::Mesh { .. } => "mesh",
                PlacesEntry::Points { .. } => "points",
            },
            comparison: object.comparison,
            vertices: shown,
            source_vertices: given,
            origin: grid.origin,
            step: grid.step,
            places,
            fields: vec![],
            faces: None,
            display_error: 0.0,
            id: 0,
            shown: true,
        }
    }
}

impl FieldEntry {
    /// Of the field of a map.
    pub fn new(comparison: usize, codes: Codes, values: Blob) -> FieldEntry {
        let bits = 8 * codes.bytes;
        FieldEntry {
            comparison,
            name: "deviation",
            unit: "mm",
            bits,
            step: codes.step,
            values,
            no_value: codes,
        }
    }
}

impl Entry {
    /// The same with blobs whose numbers are greater by `shift`.
    pub fn shifted(mut self, shift: usize) -> Entry {
        let add = |blob: &mut Blob| blob.blob += shift;
        match &mut self {
            Entry::Marks(marks) => [&mut marks.positions, &mut marks.items].into_iter().for_each(add),
            Entry::Object(object) => {
                match &mut object.places {
                    PlacesEntry::Mesh { corners, positions, levels, .. } => {
                        [corners, positions].into_iter().for_each(add);
                        levels.iter_mut().map(|level| &mut level.code).for_each(add);
                    }
                    PlacesEntry::Points { positions, .. } => add(positions),
                }
                if let Some(FacesEntry { of, lines, .. }) = &mut object.faces {
                    [of, &mut lines.positions, &mut lines.counts].into_iter().for_each(add);
                }
                object.fields.iter_mut().map(|field| &mut field.values).for_each(add);
            }
        }
        self
    }
}
