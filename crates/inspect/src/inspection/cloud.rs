//! The places of a measured cloud.

use std::borrow::Cow;
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;

/// A cloud with each place once: copies of a point tell nothing new, and neighbors that are copies tell nothing at all. A mesh as it is.
pub(super) fn distinct(mesh: &Mesh) -> Cow<'_, Mesh> {
    if !mesh.faces.is_empty() {
        return Cow::Borrowed(mesh);
    }
    // Minus zero is zero.
    let key = |n: &u32| mesh.positions[*n as usize].map(|x| (x + 0.0).to_bits());
    let mut numbers: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    numbers.par_sort_unstable_by_key(|n| (key(n), *n));
    numbers.dedup_by_key(|n| key(n));
    if numbers.len() == mesh.positions.len() {
        return Cow::Borrowed(mesh);
    }
    numbers.sort_unstable();
    let positions = numbers.iter().map(|n| mesh.positions[*n as usize]).collect();
    Cow::Owned(Mesh { positions, faces: vec![] })
}
