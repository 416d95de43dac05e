//! `trueness/check/1`: size and defects of a mesh or a CAD model.

use super::result::ResultDocument;
use super::word::words;
use super::{Bounds, InputRecord, Word};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Name of this document's schema.
pub const SCHEMA: &str = "trueness/check/1";

/// The whole document.
///
/// Vertices are distinct positions (bit for bit, −0 being 0). Facets with a repeated vertex are degenerate and left out
/// of edges and shells. Shells are facets connected through edges.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct CheckDocument {
    /// `trueness/check/1`.
    pub schema: String,
    /// Version of the program.
    pub version: String,
    /// Always `mm`.
    pub units: String,
    /// The file read.
    pub inputs: Vec<InputRecord>,
    /// Facets in the file, those with a coordinate that is not finite among them.
    pub facets: u64,
    /// Vertices that a facet uses.
    pub vertices: u64,
    /// Edges.
    pub edges: u64,
    /// Parts connected through edges.
    pub shells: u64,
    /// Box of the vertices; `null` where there are none.
    pub bounds: Option<Bounds>,
    /// Sides of that box, mm.
    pub dimensions: Option<[f64; 3]>,
    /// Area of the surface, mm².
    pub area: f64,
    /// Volume enclosed, mm³; negative where the facets look inwards. `null` unless the mesh is closed and consistently
    /// oriented.
    pub volume: Option<f64>,
    /// Why there is no volume.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub volume_reason: Option<String>,
    /// What the volume counts otherwise than one might think: where bodies cross or lie in each other, the places they have
    /// in common count as often as there are bodies.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub volume_note: Option<String>,
    /// Center of mass of that volume.
    #[serde(rename = "centre_of_mass")]
    pub center_of_mass: Option<[f64; 3]>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    #[serde(rename = "centre_of_mass_reason")]
    pub center_of_mass_reason: Option<String>,
    /// Vertices − edges + facets.
    pub euler_characteristic: i64,
    /// Handles of all shells together; `null` unless the mesh is a closed, consistently oriented surface.
    pub genus: Option<i64>,
    /// Why there is no genus.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub genus_reason: Option<String>,
    /// Of a CAD model, the keys whose numbers are those of the facets that draw it, within `inputs[].cad.facets_within`. All other
    /// numbers are those of its faces and edges. Absent for a mesh.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub of_drawing: Vec<String>,
    /// No defect of severity `error`.
    pub sound: bool,
    /// The rule on which statistics of deviations rest: two facets at every edge, a closed fan at every vertex, no
    /// coincident facets, all looking outwards. Self-intersections and facets without area do not break it.
    pub precondition: bool,
    /// What only a tolerance decides.
    pub tolerances: Tolerances,
    /// The defects by kind.
    pub defects: BTreeMap<String, Defects>,
}

impl ResultDocument for CheckDocument {
    /// Whether the mesh is sound.
    fn conforms(&self) -> bool {
        self.sound
    }
}

/// From where on something counts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Tolerances {
    /// Distance, mm, up to which two places may have been meant as one; of a CAD model, up to which edges may be off.
    pub gap: f64,
    /// Facets with a smaller angle, radians, are slivers. Absent for a CAD model.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub sliver_angle: Option<f64>,
    /// Shells with a smaller share of the whole diagonal are islands. Absent for a CAD model.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub island_share: Option<f64>,
}

/// All defects of a kind.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Defects {
    /// `error` where the mesh is not sound, `warning` where something may be meant otherwise.
    pub severity: Word<Severity>,
    /// Their number; `null` where they were not looked for.
    pub count: Option<u64>,
    /// There are more than `count`: they were not counted to the end.
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    pub at_least: bool,
    /// Why they were not looked for.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub count_reason: Option<String>,
    /// What the size of an item is.
    pub size: String,
    /// The first ones.
    pub items: Vec<Item>,
    /// Not all are listed.
    pub truncated: bool,
}

/// One defect.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Item {
    /// Facets concerned, numbered from 0 in the order of the file.
    pub facets: Vec<u32>,
    /// Vertices concerned, numbered from 0 by their first use in a facet of the file that is finite.
    pub vertices: Vec<u32>,
    /// A place to look at.
    pub position: [f64; 3],
    /// What to bring into view.
    pub bounds: Option<Bounds>,
    /// How big it is.
    pub size: f64,
    /// Further numbers, by name: of a hole `edges`, `perimeter`, `area`.
    #[serde(flatten)]
    pub measures: BTreeMap<String, f64>,
}

words! {
    /// How bad a defect is.
    Severity, "severity", {
        /// The mesh does not bound a solid, or not a sensible one.
        Error = "error",
        /// The mesh is sound, but something may be meant otherwise.
        Warning = "warning",
    }
}
