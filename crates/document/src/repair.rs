//! `trueness/repair/1`: what was mended in a mesh, and what that cost.

use super::result::ResultDocument;
use super::word::words;
use super::{InputRecord, Word};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Name of this document's schema.
pub const SCHEMA: &str = "trueness/repair/1";

/// The whole document.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct RepairDocument {
    /// `trueness/repair/1`.
    pub schema: String,
    /// Version of the program.
    pub version: String,
    /// Always `mm`.
    pub units: String,
    /// The file read.
    pub inputs: Vec<InputRecord>,
    /// The file written.
    pub output: OutputRecord,
    /// The mesh is sound now, still is when the file written is read again, the part was not changed, and all faces of a CAD model were read.
    pub sound: bool,
    /// Size and defects before.
    pub before: State,
    /// Size and defects after, in memory.
    pub after: State,
    /// Vertices that stayed, came and went.
    pub vertices: VertexCounts,
    /// Facets that stayed, came and went.
    pub facets: FacetCounts,
    /// What became of the part.
    pub effect: Effect,
    /// How far the surface went; `null` where nothing can be measured.
    pub deviation: Option<Deviation>,
    /// Why nothing was measured.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub deviation_reason: Option<String>,
    /// Names of the steps that were allowed, in their order.
    pub steps: Vec<Word<RepairStep>>,
    /// Steps that were not done, because with them some defect would have become more frequent, or surface would have been removed
    /// and the mesh still not been sound.
    pub taken_back: Vec<Word<RepairStep>>,
    /// Why closed shells that meet were not united, where they were not.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub not_united: Option<String>,
    /// Holes were filled up to this share of the area of their shell; `null`: all.
    pub hole_limit: Option<f64>,
    /// How often the steps were gone through.
    pub rounds: u64,
    /// Number of changes.
    pub change_count: u64,
    /// The first changes, in the order in which they were made.
    pub changes: Vec<Change>,
    /// Not all changes are listed.
    pub truncated: bool,
}

impl ResultDocument for RepairDocument {
    /// Whether the mesh is sound now and the part was not changed.
    fn conforms(&self) -> bool {
        self.sound
    }
}

/// The file written.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct OutputRecord {
    /// As given on the command line.
    pub path: String,
    /// Vertices that the format could not hold exactly, or that were rounded because shells could not be united otherwise.
    pub rounded_vertices: u64,
    /// Greatest change of a coordinate by that, mm.
    pub rounding: f64,
    /// The file written, read again, is sound. `null` where it could not be read again.
    pub sound: Option<bool>,
    /// Why it was not read again.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub sound_reason: Option<String>,
    /// Defects found in the file when it was read again, by kind; kinds without a finding are left out.
    pub defects: BTreeMap<String, u64>,
    /// Kinds of which there are more than `defects` says: they were not counted to the end.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub at_least: Vec<String>,
}

/// A mesh in numbers.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct State {
    /// Facets.
    pub facets: u64,
    /// Vertices that a facet uses.
    pub vertices: u64,
    /// Parts connected through edges.
    pub shells: u64,
    /// No edge has one facet only.
    pub closed: bool,
    /// No defect of severity `error`.
    pub sound: bool,
    /// Area of the surface, mm².
    pub area: f64,
    /// Volume enclosed, mm³: before, that of the places with winding number 1 or more, after neighbors were turned to run
    /// the same way round; after, the signed volume. `null` unless the mesh is closed and consistently oriented.
    pub volume: Option<f64>,
    /// Why there is no volume.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub volume_reason: Option<String>,
    /// Defects by kind; kinds without a finding are left out.
    pub defects: BTreeMap<String, u64>,
    /// Kinds of which there are more than `defects` says: they were not counted to the end.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub at_least: Vec<String>,
}

/// Vertices that stayed, came and went.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct VertexCounts {
    /// At their old place, bit for bit; where vertices were rounded to single precision first, at the rounded one.
    pub kept: u64,
    /// Rounded although the format could have held them, because shells could not be united otherwise. No other vertex moves.
    pub moved: u64,
    /// New.
    pub added: u64,
    /// No longer used by a facet.
    pub removed: u64,
}

/// Facets that stayed, came and went.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct FacetCounts {
    /// With the same three vertices as before, in whichever direction.
    pub kept: u64,
    /// New.
    pub added: u64,
    /// Gone.
    pub removed: u64,
}

/// What became of the part. What is changed beyond a limit is no mended part but another one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Effect {
    /// Volume or surface went beyond a limit.
    pub changed: bool,
    /// Closed shells that look outwards, before.
    pub bodies_before: u64,
    /// And after.
    pub bodies_after: u64,
    /// What the volume before may be off by, mm³; `null` where there is none.
    pub volume_error: Option<f64>,
    /// Volume of the places with winding number −1 or less before, mm³: bodies that looked inwards.
    pub volume_inverted: Option<f64>,
    /// Volume after less volume before, mm³, bodies that looked inwards being counted if that makes the change smaller;
    /// `null` where either is not known, and where the mesh is still not sound.
    pub volume_change: Option<f64>,
    /// Largest distance that counts, mm: from the surface that bounded the volume to the new one, and from the new surface
    /// to the old one. Where no volume was enclosed, of what was torn out, and of more than a trifle of fins and loose sheets, to the new
    /// surface; `null` where nothing was.
    pub surface: Option<f64>,
    /// The limits as a share of the diagonal and of the volume.
    pub limit: f64,
    /// That of the surface, mm.
    pub surface_limit: f64,
    /// That of the volume, mm³; `null` where there is no volume.
    pub volume_limit: Option<f64>,
}

/// How far the surface went.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Deviation {
    /// From the old surface to the new one: what is missing. Facets of which a part lay inside a body count in the greatest, not in
    /// the mean.
    pub removed: Distances,
    /// From the new surface to the old one: what was added.
    pub added: Distances,
}

/// Distances of one surface from another, mm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Distances {
    /// The greatest.
    pub max: f64,
    /// Mean over the area.
    pub mean: f64,
}

/// Something that was changed.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Change {
    /// The step that did it.
    pub step: Word<RepairStep>,
    /// What was done.
    pub what: String,
    /// Where, mm.
    pub position: [f64; 3],
    /// Facets concerned.
    pub facets: u64,
    /// How big: mm for vertices and edges, mm² for facets, mm³ for shells.
    pub size: f64,
}

words! {
    /// A step of a repair.
    RepairStep, "step of a repair", {
        /// Facets with coordinates that are no numbers go.
        NotFinite = "not_finite",
        /// Edges of a boundary that lie on each other are joined.
        Stitch = "stitch",
        /// Facets without area go.
        Degenerate = "degenerate",
        /// Bodies that overlap become one.
        Union = "union",
        /// Facets that are there twice go.
        Duplicates = "duplicates",
        /// Edges are parted where vertices lie on them.
        TJunctions = "t_junctions",
        /// Facets that stick out of the surface go.
        Fins = "fins",
        /// Neighbors are made to look the same way.
        Orient = "orient",
        /// Edges of more than two facets are parted.
        NonManifoldEdges = "non_manifold_edges",
        /// Facets that cross each other are cut and rid of what is inside.
        SelfIntersections = "self_intersections",
        /// Holes are filled.
        Holes = "holes",
        /// Pieces of a few facets go.
        Scraps = "scraps",
        /// Vertices where surfaces only touch are parted.
        NonManifoldVertices = "non_manifold_vertices",
        /// Shells are made to look outward.
        Outward = "outward",
        /// Small shells go.
        Islands = "islands",
    }
}
