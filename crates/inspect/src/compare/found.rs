//! What a comparison is made with, and all that it found.

use super::reference::Compared;
use super::shown::ShownPoints;
use trueness_geom::mesh::Mesh;
use trueness_geom::space::Aabb;
use trueness_geom::spline::surface::FootSearch;
use trueness_geom::stats::paired::Paired;

/// A mesh, or B-spline surfaces, that points are compared with.
#[derive(Clone)]
pub struct Reference<'a> {
    /// For messages and documents: its path.
    pub name: String,
    /// The mesh; of surfaces that of [`FootSearch::mesh`], which draws them.
    pub mesh: &'a Mesh,
    /// The surfaces that are measured against instead of the mesh.
    pub splines: Option<&'a FootSearch>,
}

impl std::fmt::Debug for Reference<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(&self.name)
    }
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
