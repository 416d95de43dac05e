//! Meshes cut where their facets meet, and the boundary of the material that closed shells enclose.
//!
//! [`arrange`] cuts the facets of a mesh along all that they have in common with others. [`outer_boundary`] keeps the
//! pieces with material on one side and none on the other. Both decide exactly:
//!
//! 1. Facets that meet are found by the exact search of the check.
//! 2. The common part of two facets ends at corners, and where edges pass through facets (see
//!    `meetings`). Facets of one plane that overlap are cut together (`cluster`); where cuts cross there are further
//!    points. A point is no triple of rounded numbers but a fraction of whole ones (`points`).
//! 3. Each facet is triangulated along its cuts (`triangulate`, `cut`).
//! 4. The pieces around each edge are sorted (`around`), which gives the cells of space, and each cell has a winding
//!    number (`cells`, `ray`).
//! 5. Only then are points rounded to numbers a file can hold. Where that makes facets cross or flat, the rounded mesh
//!    is cut again (`outer`). New points are first put upon others a few steps of the numbers away (`snap`).
//! 6. If facets still cross after the last cut, surfaces coincide but for rounding. They are given the same vertices and edges,
//!    and the whole is done again from step 1 (`imprint`, `retile`).
//!
//! After Zhou, Grinspun, Zorin, Jacobson, Mesh Arrangements for Solid Geometry, 2016. Filters before exact numbers as
//! in Cherchi, Livesu, Scateni, Attene, Fast and Robust Mesh Arrangements using Floating-point Arithmetic, 2020.

mod cells;
mod cluster;
mod cut;
mod cutting;
mod edge_order;
mod error;
mod imprint;
mod meetings;
mod near_coincident;
mod outer;
mod pairs;
mod passing;
mod points;
mod ray;
mod retile;
mod snap;
#[cfg(test)]
pub(crate) mod tests;
mod triangulate;

pub use error::ArrangeError;
pub(crate) use near_coincident::any_at_edges;
pub use outer::{Boundary, Options, outer_boundary};
pub(crate) use outer::{Input, boundary_of};

use cutting::cutting;
use pairs::{in_range, pairs};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_geom::topology::Topology;
use trueness_geom::topology::weld::as_it_is;

/// A mesh cut where its facets meet.
#[derive(Clone, Debug, PartialEq)]
pub struct Arranged {
    /// Its vertices first, then those at the ends of cuts, rounded to the nearest `f64`.
    pub mesh: Mesh,
    /// For each face the facet that it is a piece of. Where facets coincide, each has a piece of its own with the same
    /// vertices.
    pub source: Vec<u32>,
}

/// Cuts the facets of a mesh along all that they have in common with other facets.
///
/// Any mesh whose coordinates are 0 or from 1e-50 to 1e45 mm will do: open, in any orientation, coincident. Facets
/// without area and those with a coordinate that is not finite have no pieces. Facets that nothing cuts keep their
/// vertices and come first, in their order. The pieces, and the vertices that they share, are decided exactly. Their
/// places are rounded afterwards, each once. So pieces of different facets share the vertices of a cut bit for bit, but
/// thin pieces may cross or become flat by rounding. Where vertices are at the same place or unused, the mesh is welded
/// first. Cost: that of the search for crossings, and about `k` log `k` for each facet with `k` cuts. Each place where
/// cuts meet takes some microseconds. The same result for any number of threads.
///
/// ```
/// use trueness_geom::{mesh::Mesh, progress::Silent};
/// use trueness_solid::arrange::arrange;
/// let positions = vec![
///     [0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0],
///     [1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [9.0, 9.0, 0.0],
/// ];
/// let mesh = Mesh { positions, faces: vec![[0, 1, 2], [3, 4, 5]] };
/// let cut = arrange(&mesh, &Silent).unwrap();
/// // The cut runs from (1, 1, 0) to (2, 2, 0).
/// assert!(cut.mesh.positions[6..].contains(&[2.0, 2.0, 0.0]));
/// assert!(cut.source.iter().filter(|f| **f == 0).count() > 1);
/// ```
///
/// # Errors
/// [`ArrangeError`], but never [`ArrangeError::Open`].
pub fn arrange(mesh: &Mesh, progress: &dyn Progress) -> Result<Arranged, ArrangeError> {
    let mesh = &as_it_is(mesh)?;
    let topology = Topology::of(mesh)?;
    in_range(mesh, &topology)?;
    let pairs = pairs(mesh, &topology, &vec![true; mesh.faces.len()], progress)?;
    let cutting = cutting(mesh, &topology, &pairs, progress)?;
    let positions = (0..cutting.points.len() as u32).map(|p| cutting.points.at(p).nearest()).collect();
    let mut out = Arranged { mesh: Mesh { positions, faces: vec![] }, source: vec![] };
    let further = cutting.further.iter().map(|(p, facet, same)| {
        let [a, b, c] = cutting.pieces[*p].corners;
        (if *same { [a, b, c] } else { [a, c, b] }, *facet)
    });
    for (corners, facet) in cutting.pieces.iter().map(|p| (p.corners, p.facet)).chain(further) {
        out.mesh.faces.push(corners);
        out.source.push(facet);
    }
    Ok(out)
}
