//! The site of a patch: the mesh around the holes.

use super::super::work::Work;
use std::collections::BTreeSet;
use trueness_geom::check::Known;

/// The mesh around the holes.
pub(super) struct Site<'a, 'w> {
    pub work: &'a Work<'w>,
    pub known: &'a Known,
}

impl Site<'_, '_> {
    /// Whether a facet has this edge.
    pub(super) fn has_edge(&self, a: u32, b: u32) -> bool {
        self.known.topology.has_edge(self.work.mesh(), [a, b])
    }
    /// The vertices of the mesh that share an edge with `v`, ascending.
    pub(super) fn neighbors(&self, v: u32) -> BTreeSet<u32> {
        let facets = self.known.topology.facets_at_vertex(v);
        let all = facets.into_iter().flat_map(|f| self.work.mesh().faces[f as usize]);
        all.filter(|w| *w != v).collect()
    }
}
