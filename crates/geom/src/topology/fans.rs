//! Which facets meet at each vertex, without a list for each: the corners are chained.
//!
//! Corner `k` of facet `f` has the number `3 f + k`. For each vertex the number of one of its corners is kept, for each
//! corner the number of the next one at the same vertex. Building it takes one atomic exchange a corner.

use crate::memory::{atomics, large_pages};
use crate::parallel::prelude::*;
use crate::progress::Progress;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// Facets or vertices of one task.
pub(super) const TOPOLOGY_ITEMS_PER_TASK: usize = 1 << 13;

/// A facet at a vertex: the corner after the vertex, the corner before it, the facet.
pub(super) type Spoke = [u32; 3];

/// The chained corners of a mesh.
#[derive(Debug)]
pub(super) struct Fans {
    /// For each vertex one more than the number of its first corner; zero if it has none.
    head: Vec<AtomicU32>,
    /// For each corner one more than the number of the next one at its vertex; zero ends the chain.
    next: Vec<u32>,
}

impl Fans {
    /// Chains the corners of those faces of so many vertices for which `counts` says yes. All their vertices must exist.
    pub(super) fn new(
        vertices: usize,
        faces: &[[u32; 3]],
        counts: impl Fn(&[u32; 3]) -> bool + Sync,
        progress: &dyn Progress,
    ) -> Fans {
        let head = atomics(vertices);
        let mut next = large_pages(vec![0u32; 3 * faces.len()]);
        next.par_chunks_mut(3 * TOPOLOGY_ITEMS_PER_TASK)
            .zip(faces.par_chunks(TOPOLOGY_ITEMS_PER_TASK))
            .enumerate()
            .for_each(|(i, (next, faces))| {
                if progress.cancelled() {
                    return;
                }
                for (j, face) in faces.iter().enumerate().filter(|(_, f)| counts(f)) {
                    for k in 0..3 {
                        let number = 3 * (i * TOPOLOGY_ITEMS_PER_TASK + j) + k;
                        next[3 * j + k] = head[face[k] as usize].swap(number as u32 + 1, Relaxed);
                    }
                }
            });
        Fans { head, next }
    }

    /// Number of vertices.
    pub(super) fn len(&self) -> usize {
        self.head.len()
    }

    /// Without the vertices that have no corner, and for each vertex its new number.
    pub(super) fn compacted(&self) -> (Fans, Vec<u32>) {
        let (mut head, mut number) = (vec![], vec![u32::MAX; self.len()]);
        for (first, number) in self.head.iter().map(|h| h.load(Relaxed)).zip(&mut number) {
            if first != 0 {
                *number = head.len() as u32;
                head.push(AtomicU32::new(first));
            }
        }
        (Fans { head, next: self.next.clone() }, number)
    }

    /// Number of vertices that have a corner.
    pub(super) fn used(&self) -> usize {
        self.head.par_iter().filter(|h| h.load(Relaxed) != 0).count()
    }

    /// Replaces `spokes` by the facets at `vertex`, in an order that depends on the threads.
    #[inline(always)]
    pub(super) fn spokes(&self, faces: &[[u32; 3]], vertex: u32, spokes: &mut Vec<Spoke>) {
        spokes.clear();
        let mut corner = self.head[vertex as usize].load(Relaxed);
        while corner != 0 {
            let (facet, k) = ((corner - 1) / 3, (corner - 1) as usize % 3);
            let face = faces[facet as usize];
            spokes.push([face[(k + 1) % 3], face[(k + 2) % 3], facet]);
            corner = self.next[corner as usize - 1];
        }
    }

    /// The facets at `vertex`, ascending.
    pub(super) fn facets(&self, vertex: u32) -> Vec<u32> {
        let mut facets = vec![];
        let mut corner = self.head.get(vertex as usize).map_or(0, |c| c.load(Relaxed));
        while corner != 0 {
            facets.push((corner - 1) / 3);
            corner = self.next[corner as usize - 1];
        }
        facets.sort_unstable();
        facets
    }

    /// Whether a facet has the edge between two different vertices. Costs at most as much as the shorter of their chains.
    pub(super) fn has_edge(&self, faces: &[[u32; 3]], edge: [u32; 2]) -> bool {
        let mut corners = edge.map(|v| self.head.get(v as usize).map_or(0, |c| c.load(Relaxed)));
        while corners[0] != 0 && corners[1] != 0 {
            for end in 0..2 {
                if faces[(corners[end] - 1) as usize / 3].contains(&edge[1 - end]) {
                    return true;
                }
                corners[end] = self.next[corners[end] as usize - 1];
            }
        }
        false
    }

    /// The facets at the edge between two different vertices, ascending. Costs as much as the shorter of their chains.
    pub(super) fn at_edge(&self, faces: &[[u32; 3]], edge: [u32; 2]) -> Vec<u32> {
        let mut corners = edge.map(|v| self.head.get(v as usize).map_or(0, |c| c.load(Relaxed)));
        let mut found: [Vec<u32>; 2] = Default::default();
        while corners[0] != 0 && corners[1] != 0 {
            for end in 0..2 {
                let facet = (corners[end] - 1) / 3;
                found[end].extend(faces[facet as usize].contains(&edge[1 - end]).then_some(facet));
                corners[end] = self.next[corners[end] as usize - 1];
            }
        }
        let [of_first, of_second] = found;
        let mut facets = if corners[0] == 0 { of_first } else { of_second };
        facets.sort_unstable();
        facets
    }
}
