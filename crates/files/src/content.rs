//! What a file held.

use crate::{ReadError, Unit, Warning};
use trueness_geom::{cloud::PointStream, mesh::Mesh};

/// A file, read or ready to be read.
pub struct Input {
    /// Where it came from and how it was taken.
    pub provenance: Provenance,
    /// The mesh, or the points as a stream.
    pub body: Body,
    /// What was odd, in the order it was found.
    pub warnings: Vec<Warning>,
}

/// Where data came from and how the file was taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Provenance {
    /// The path as it was given, or `-` for standard input.
    pub path: String,
    /// What the content proved to be, for instance `stl-binary`, `ply-ascii` or `xyz`.
    pub format: &'static str,
    /// Size on disk; 0 where it is not known (standard input).
    pub bytes: u64,
    /// True if the file is packed.
    pub gzip: bool,
    /// The unit in which its numbers were taken.
    pub unit_assumed: Unit,
    /// True if the points have two coordinates only; their z is 0.
    pub planar: bool,
}

/// The points of a file, block by block, in the file's order, millimetres.
pub type PointSource = Box<dyn PointStream<Error = ReadError> + Send>;

/// A mesh or points.
pub enum Body {
    /// Vertices and faces.
    Mesh(SourceMesh),
    /// Vertices without faces; not yet read beyond the first few.
    Points(PointSource),
}

/// A mesh as the file holds it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SourceMesh {
    /// Positions in millimetres, and triangles. In the file's order.
    pub mesh: Mesh,
    /// The normal that an STL file stores with each facet, in the order of `mesh.faces`, not normalised and not
    /// trustworthy. `None` for other formats.
    pub stored_normals: Option<Vec<[f32; 3]>>,
    /// How many facets were left out because of a NaN or infinite coordinate.
    pub nonfinite_facets: u64,
}
