//! Limits of the input that the search accepts, and how it refuses the rest.

use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::progress::Cancelled;
use crate::space::Point;

pub use crate::space::MIN_COORDINATE;

/// Largest coordinate of a point accepted, millimeters.
pub const MAX_COORDINATE: f64 = 1e60;
/// Largest coordinate of a vertex accepted, millimeters. The distance to a plane needs the product of its fourth power and the
/// square of a point's coordinate. That product is still in the range of numbers.
pub const MAX_VERTEX: f64 = 1e45;
/// Least extent accepted of a mesh that is more than one place, millimeters. With smaller ones those powers lose digits at the
/// lower end of the numbers.
pub const MIN_EXTENT: f64 = 1e-45;
/// Most faces accepted: three corners of each must be countable in 32 bits.
pub const MAX_FACES: usize = 1 << 28;

/// Why no search tree can be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// There is nothing to measure against.
    #[error("the mesh has no faces")]
    NoFaces,
    /// More than [`MAX_FACES`].
    #[error("{0} faces are more than {MAX_FACES}: cut the mesh in parts")]
    TooManyFaces(usize),
    /// A face names a vertex that does not exist.
    #[error("face {face} names vertex {vertex}, but the vertices end at {vertices}")]
    BadIndex {
        /// The face.
        face: usize,
        /// The vertex number it names.
        vertex: u32,
        /// Number of vertices there are.
        vertices: usize,
    },
    /// A coordinate of a vertex that a face uses is NaN, infinite, beyond [`MAX_VERTEX`], or below [`MIN_COORDINATE`] but
    /// not zero.
    #[error(
        "vertex {0} has a coordinate that is not 0 or from {MIN_COORDINATE:e} to {MAX_VERTEX:e} mm: repair the mesh first"
    )]
    BadVertex(usize),
    /// The box of the faces is smaller than [`MIN_EXTENT`], but not a single place.
    #[error("the faces extend over less than {MIN_EXTENT:e} mm: scale the mesh up")]
    TooSmall,
    /// The work was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Why a question was not answered.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum QueryError {
    /// A coordinate of this point is NaN, infinite, beyond [`MAX_COORDINATE`], or below [`MIN_COORDINATE`] but not zero.
    #[error(
        "point {0} has a coordinate that is not 0 or from {MIN_COORDINATE:e} to {MAX_COORDINATE:e} mm: leave it out"
    )]
    BadPoint(usize),
    /// The greatest distance asked for is NaN or negative.
    #[error("the greatest distance must be a number from 0 to infinity, not {0}")]
    BadMaxDistance(f64),
    /// The computation was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// True if every coordinate is 0 or from [`MIN_COORDINATE`] to [`MAX_COORDINATE`] in magnitude. (A NaN fails every
/// comparison.)
///
/// ```
/// use trueness_geom::closest::sane;
/// assert!(sane(&[0.0, -1e-50, 1e60]));
/// assert!(!sane(&[0.0, 1e-51, 1.0]) && !sane(&[1.1e60, 0.0, 0.0]) && !sane(&[f64::NAN, 0.0, 0.0]));
/// ```
#[inline]
pub fn sane(p: &Point) -> bool {
    // Without branches, as clouds of many millions go through it.
    p.iter().fold(true, |good, x| {
        let size = x.abs();
        good & (size <= MAX_COORDINATE) & ((size >= MIN_COORDINATE) | (size == 0.0))
    })
}

/// True if every coordinate is 0 or from [`MIN_COORDINATE`] to [`MAX_VERTEX`] in magnitude.
pub fn sane_vertex(p: &Point) -> bool {
    sane(p) && p.iter().all(|x| x.abs() <= MAX_VERTEX)
}

/// The number of the first point that is not [`sane`], as an error.
pub fn check_points(points: &[Point]) -> Result<(), QueryError> {
    match points.par_iter().position_first(|p| !sane(p)) {
        Some(i) => Err(QueryError::BadPoint(i)),
        None => Ok(()),
    }
}

/// Checks what the tree relies on. Only vertices that a face uses are looked at.
pub fn check_mesh(mesh: &Mesh) -> Result<(), MeshError> {
    let count = mesh.faces.len();
    if count == 0 {
        return Err(MeshError::NoFaces);
    }
    if count > MAX_FACES {
        return Err(MeshError::TooManyFaces(count));
    }
    let fault = |face: usize, f: &[u32; 3]| {
        f.iter().find_map(|&vertex| match mesh.positions.get(vertex as usize) {
            None => Some(MeshError::BadIndex { face, vertex, vertices: mesh.positions.len() }),
            Some(v) if !sane_vertex(v) => Some(MeshError::BadVertex(vertex as usize)),
            Some(_) => None,
        })
    };
    if let Some(e) = mesh.faces.par_iter().enumerate().find_map_first(|(i, f)| fault(i, f)) {
        return Err(e);
    }
    let first = mesh.positions[mesh.faces[0][0] as usize];
    let far = |f: &[u32; 3]| {
        f.iter().any(|v| (0..3).any(|k| (mesh.positions[*v as usize][k] - first[k]).abs() >= MIN_EXTENT))
    };
    // The first face of nearly every mesh will do.
    if mesh.faces.iter().any(far) {
        return Ok(());
    }
    let one_place = mesh.faces.iter().flatten().all(|v| mesh.positions[*v as usize] == first);
    if one_place { Ok(()) } else { Err(MeshError::TooSmall) }
}
