//! The places of a measured cloud.

use std::borrow::Cow;
use trueness_geom::mesh::Mesh;
use trueness_geom::topology::weld::first_at_their_places;

/// A cloud with each place once: copies of a point tell nothing new, and neighbors that are copies tell nothing at all. A mesh as it is.
pub(super) fn distinct(mesh: &Mesh) -> Cow<'_, Mesh> {
    if !mesh.faces.is_empty() {
        return Cow::Borrowed(mesh);
    }
    let numbers = first_at_their_places(&mesh.positions);
    if numbers.len() == mesh.positions.len() {
        return Cow::Borrowed(mesh);
    }
    let positions = numbers.iter().map(|n| mesh.positions[*n as usize]).collect();
    Cow::Owned(Mesh { positions, faces: vec![] })
}
