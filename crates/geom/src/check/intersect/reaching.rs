//! Facets whose boxes meet given boxes.

use super::tree::Tree;
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress};
use crate::space::Aabb;
use crate::topology::Topology;
use std::sync::atomic::AtomicUsize;
use std::sync::atomic::Ordering::Relaxed;

/// For each of some boxes the facets with area whose own box meets it, ascending. `None` if there are more than `most` in all.
///
/// # Errors
/// [`Cancelled`].
pub fn reaching(
    mesh: &Mesh,
    topology: &Topology,
    boxes: &[Aabb],
    most: usize,
    progress: &dyn Progress,
) -> Result<Option<Vec<Vec<u32>>>, Cancelled> {
    let in_tree: Vec<bool> = topology.shell_of.iter().map(|shell| *shell != u32::MAX).collect();
    let tree = Tree::build(mesh, topology, &in_tree, None, progress);
    let found = AtomicUsize::new(0);
    let of_box = |b: &Aabb| {
        if found.load(Relaxed) > most || progress.cancelled() {
            return vec![];
        }
        let mut facets = tree.reaching(b);
        facets.sort_unstable();
        found.fetch_add(facets.len(), Relaxed);
        facets
    };
    let all = boxes.par_iter().map(of_box).collect();
    if progress.cancelled() {
        return Err(Cancelled);
    }
    Ok((found.into_inner() <= most).then_some(all))
}

/// The facets with area whose box meets one of these boxes, ascending: those that [`reaching`] lists for any of them. Cost: n log n,
/// however many boxes a facet meets.
///
/// # Errors
/// [`Cancelled`].
pub fn reaching_any(
    mesh: &Mesh,
    topology: &Topology,
    boxes: &[Aabb],
    progress: &dyn Progress,
) -> Result<Vec<u32>, Cancelled> {
    let in_tree: Vec<bool> = topology.shell_of.iter().map(|shell| *shell != u32::MAX).collect();
    let mut facets = Tree::build(mesh, topology, &in_tree, None, progress).reaching_any(boxes, progress);
    if progress.cancelled() {
        return Err(Cancelled);
    }
    facets.sort_unstable();
    Ok(facets)
}
