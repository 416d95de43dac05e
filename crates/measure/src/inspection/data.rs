//! What an inspection is given.

use crate::cad_faces::CadFaces;
use std::collections::BTreeMap;
use std::sync::Arc;
use trueness_geom::mesh::Mesh;
use trueness_geom::scan::Scan;
use trueness_geom::space::{Point, Vector};

/// What was measured, in measured coordinates, millimeters.
#[derive(Clone, Debug, Default)]
pub struct Data {
    /// The measured mesh or cloud.
    pub measured: Option<Scan>,
    /// The normals of a measured cloud, where the plan asks which way its points face; empty otherwise.
    pub normals: Vec<Vector>,
    /// The nominal mesh, where the plan names one and has a use for it: alignment, deviations, features sought by nominals or seeds.
    pub reference: Option<Mesh>,
    /// Its faces, where it is a CAD model, which the mesh only draws.
    pub faces: Option<Arc<CadFaces>>,
    /// Facets of its file that are not in the mesh, as a coordinate is not finite: their numbers, ascending.
    pub reference_left_out: Vec<u32>,
    /// Points that a report can show; 0 without a report.
    pub shown: usize,
    /// Whether deviations are kept at places that are the same for every part.
    pub places: bool,
    /// The points of features that have files of their own, by the number of the feature.
    pub points: BTreeMap<usize, OwnPoints>,
    /// Seed of the random choices of the alignment.
    pub seed: u64,
}

/// Points of a feature's own.
#[derive(Clone, Debug, Default)]
pub struct OwnPoints {
    /// The points.
    pub points: Vec<Point>,
    /// Whether they have two coordinates only.
    pub planar: bool,
}
