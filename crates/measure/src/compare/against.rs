//! What points are compared with, and why that may not be possible.

use super::region::RegionError;
use crate::drawn_faces::DrawnFaces;
use crate::file_numbers::LeftOut;
use trueness_cad::search::Search;
use trueness_cad::trim::Trim;
use trueness_geom::closest::MeshError;
use trueness_geom::deviation::paper::PaperError;
use trueness_geom::mesh::Mesh;
use trueness_geom::spline::surface::FootSearch;
use trueness_geom::topology::TopologyError;

/// A mesh, or B-spline surfaces, that points are compared with.
#[derive(Clone)]
pub struct Reference<'a> {
    /// For messages and documents: its path.
    pub name: String,
    /// The mesh; of surfaces one that draws them.
    pub mesh: &'a Mesh,
    /// The surfaces that are measured against instead of the mesh.
    pub exact: Option<Exact<'a>>,
    /// Facets of the file that are not in the mesh.
    pub left_out: LeftOut<'a>,
}

/// Exact surfaces, which the mesh only draws.
#[derive(Clone, Copy)]
pub enum Exact<'a> {
    /// B-spline surfaces that are whole.
    Splines(&'a FootSearch),
    /// Faces of a CAD model.
    Cad(&'a CadFaces),
}

/// Faces of a CAD model, ready to be measured against.
pub struct CadFaces {
    /// Where nearest places are looked up.
    pub search: Search<Trim>,
    /// Number of faces.
    pub count: usize,
    /// How far the mesh that draws them is from them at most, mm.
    pub drawn_within: f64,
    /// What pictures show of them.
    pub drawn: DrawnFaces,
}

impl std::fmt::Debug for Reference<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(&self.name)
    }
}

/// Why a reference cannot be measured against.
#[derive(Debug, thiserror::Error)]
pub enum ReferenceError {
    /// Its facets or coordinates do not allow it.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// Its topology cannot be told.
    #[error(transparent)]
    Topology(#[from] TopologyError),
    /// The paper's method refuses it.
    #[error(transparent)]
    Paper(#[from] PaperError),
    /// A region is not there.
    #[error(transparent)]
    Region(#[from] RegionError),
}
