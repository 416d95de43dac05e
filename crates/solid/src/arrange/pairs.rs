//! The pairs of facets that meet, as long as they are not too many; and which numbers can be dealt with.

use super::error::ArrangeError;
use trueness_geom::check::intersect;
use trueness_geom::closest::sane_vertex;
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_geom::topology::Topology;

/// The most pairs of facets that meet, for a mesh of so many: beyond, time and memory would grow with their square.
fn most_pairs(facets: usize) -> usize {
    10_000 + 16 * facets
}

/// All pairs of facets that meet where they should not, if they are not too many.
pub(super) fn pairs(
    mesh: &Mesh,
    topology: &Topology,
    is_chosen: &[bool],
    progress: &dyn Progress,
) -> Result<Vec<[u32; 2]>, ArrangeError> {
    let most = most_pairs(mesh.faces.len());
    let found = intersect::selected_self_intersections(mesh, topology, is_chosen, most, progress)?;
    found.ok_or(ArrangeError::Tangle { most })
}

/// These pairs of facets of a mesh, if they are not too many.
pub(super) fn not_too_many(pairs: Vec<[u32; 2]>, mesh: &Mesh) -> Result<Vec<[u32; 2]>, ArrangeError> {
    let most = most_pairs(mesh.faces.len());
    if pairs.len() <= most { Ok(pairs) } else { Err(ArrangeError::Tangle { most }) }
}

/// An error where a corner of a facet is so large or so small that products of coordinates leave the range of numbers. Facets that belong
/// to no shell are not considered.
pub(super) fn in_range(mesh: &Mesh, topology: &Topology) -> Result<(), ArrangeError> {
    let facets = mesh.faces.iter().zip(&topology.shell_of).filter(|(_, shell)| **shell != u32::MAX);
    let mut corners = facets.flat_map(|(face, _)| mesh.places(face));
    corners.find(|p| !sane_vertex(p)).map_or(Ok(()), |position| Err(ArrangeError::Range { position }))
}
