//! What a comparison is made with, and all that it found.

use super::reference::Compared;
use super::shown::ShownPoints;
use trueness_geom::mesh::Mesh;
use trueness_geom::space::Aabb;
use trueness_geom::stats::paired::Paired;

/// A mesh that points are compared with.
#[derive(Clone, Debug)]
pub struct Reference<'a> {
    /// For messages and documents: its path.
    pub name: String,
    /// The mesh.
    pub mesh: &'a Mesh,
}

/// All that the comparison found.
pub struct Comparisons {
    /// Number of points.
    pub count: u64,
    /// Their box.
    pub bounds: Aabb,
    /// One entry a reference.
    pub references: Vec<Compared>,
    /// `(first, second, differences)` for every pair of references.
    pub paired: Vec<(usize, usize, Paired)>,
    /// Sample for the report.
    pub shown: ShownPoints,
    /// The worst places of every reference, as far as the sample lacks them.
    pub flagged: ShownPoints,
}
