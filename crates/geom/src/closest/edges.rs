//! Which triangles meet at each edge, in slot order: what signs and boundary edges are found from.

use crate::closest::tree::{Closest, Tree};
use crate::closest::triangle::Feature;
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress, Silent};

/// Triangles at both ends of an edge from which on the edge is looked up in a sorted list.
const MIN_LISTED_TRIANGLES: usize = 64;
/// Items of a loop after which it is asked whether to go on.
pub(super) const ITEMS_PER_QUESTION: u32 = 1 << 12;

/// The face across an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Across {
    /// Nothing: a boundary edge.
    Free,
    /// The triangle in this slot.
    One(u32),
    /// Several triangles, or an edge of no length.
    Unclear,
}

/// The corners of all triangles, grouped by vertex.
pub(super) struct Fans<'a> {
    slots: &'a [[u32; 3]],
    /// Where the group of each vertex begins.
    start: Vec<u32>,
    /// `3 * slot + corner`.
    corners: Vec<u32>,
}

impl<'a> Fans<'a> {
    /// Linear time.
    pub fn new(tree: &'a Tree) -> Self {
        let (slots, count) = (&tree.slots[..], tree.corners.len());
        let mut start = vec![0u32; count + 1];
        slots.iter().flatten().for_each(|&v| start[v as usize + 1] += 1);
        for v in 0..count {
            start[v + 1] += start[v];
        }
        let mut corners = vec![0u32; 3 * slots.len()];
        let mut next = start.clone();
        for (i, &v) in (0..).zip(slots.iter().flatten()) {
            corners[next[v as usize] as usize] = i;
            next[v as usize] += 1;
        }
        Fans { slots, start, corners }
    }

    /// (slot, corner) of every triangle corner at vertex `v`.
    pub fn around(&self, v: u32) -> impl Iterator<Item = (u32, usize)> {
        let group = self.start[v as usize] as usize..self.start[v as usize + 1] as usize;
        self.corners[group].iter().map(|&i| (i / 3, i as usize % 3))
    }

    /// Number of corners at vertex `v`.
    fn size(&self, v: u32) -> usize {
        (self.start[v as usize + 1] - self.start[v as usize]) as usize
    }

    /// The face across each edge (corner `k` to `k + 1`) of each slot. Worth nothing where `progress` says that it is
    /// cancelled.
    ///
    /// An edge is looked for among the triangles at that end which has fewer. Where both have very many, in a sorted
    /// list: a fan of n triangles takes n steps, several that share their hubs n log n.
    pub fn across(&self, progress: &dyn Progress) -> Vec<[Across; 3]> {
        let crowded = self.crowded();
        let of_edge = |s: u32, a: u32, b: u32| {
            if a == b {
                return Across::Unclear;
            }
            let (a, b) = if self.size(b) < self.size(a) { (b, a) } else { (a, b) };
            if self.size(a) > MIN_LISTED_TRIANGLES {
                let from = crowded.partition_point(|e| (e.0, e.1) < (a.min(b), a.max(b)));
                let at_edge = crowded[from..].iter().take_while(|e| (e.0, e.1) == (a.min(b), a.max(b)));
                return only(at_edge.map(|e| e.2).filter(|o| *o != s));
            }
            only(self.around(a).filter_map(|(o, i)| {
                let t = &self.slots[o as usize];
                (o != s && (t[(i + 1) % 3] == b || t[(i + 2) % 3] == b)).then_some(o)
            }))
        };
        let of_slot = |(s, t): (usize, &[u32; 3])| {
            if (s as u32).is_multiple_of(ITEMS_PER_QUESTION) && progress.cancelled() {
                return [Across::Unclear; 3];
            }
            std::array::from_fn(|k| of_edge(s as u32, t[k], t[(k + 1) % 3]))
        };
        self.slots.par_iter().enumerate().map(of_slot).collect()
    }

    /// Edges between two vertices with very many triangles: the ends, the lower one first, and the triangle; sorted.
    fn crowded(&self) -> Vec<(u32, u32, u32)> {
        let edges = |(s, t): (usize, &[u32; 3])| {
            let t = *t;
            (0..3).map(move |k| (t[k].min(t[(k + 1) % 3]), t[k].max(t[(k + 1) % 3]), s as u32))
        };
        let both = |e: &(u32, u32, u32)| {
            self.size(e.0) > MIN_LISTED_TRIANGLES && self.size(e.1) > MIN_LISTED_TRIANGLES
        };
        let mut all: Vec<(u32, u32, u32)> =
            self.slots.par_iter().enumerate().flat_map_iter(edges).filter(both).collect();
        all.par_sort_unstable();
        // A triangle that names a vertex twice has one edge twice.
        all.dedup();
        all
    }
}

/// The kind of an edge by these triangles.
fn only(mut others: impl Iterator<Item = u32>) -> Across {
    match (others.next(), others.next()) {
        (None, _) => Across::Free,
        (Some(o), None) => Across::One(o),
        _ => Across::Unclear,
    }
}

/// The boundary edges of a mesh, those of one face only: the rim of a scan or of a hole.
///
/// A point whose closest place lies on such an edge is outside the mesh rather than above it. Its distance says more about
/// where the mesh ends than about its shape. Vertices must be shared by index: to faces that only have equal coordinates at
/// their corners, every edge is free. One byte a face.
pub struct BoundaryEdges {
    /// For each face: bit `i` if edge `i` is free, bit `3 + i` if corner `i` lies on a boundary edge.
    flags: Vec<u8>,
    count: usize,
}

impl BoundaryEdges {
    /// Linear time, as [`Signs::new`](super::Signs::new).
    pub fn new(tree: &Tree) -> Self {
        BoundaryEdges::with_progress(tree, &Silent)
    }

    /// As [`BoundaryEdges::new`], asking `progress` whether to go on.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn watched(tree: &Tree, progress: &dyn Progress) -> Result<Self, Cancelled> {
        let edges = BoundaryEdges::with_progress(tree, progress);
        if progress.cancelled() { Err(Cancelled) } else { Ok(edges) }
    }

    fn with_progress(tree: &Tree, progress: &dyn Progress) -> Self {
        let across = Fans::new(tree).across(progress);
        let mut on_rim = vec![false; tree.corners.len()];
        let mut count = 0;
        for (t, edges) in tree.slots.iter().zip(&across) {
            for k in (0..3).filter(|&k| edges[k] == Across::Free) {
                on_rim[t[k] as usize] = true;
                on_rim[t[(k + 1) % 3] as usize] = true;
                count += 1;
            }
        }
        let mut flags = vec![0; tree.face.len()];
        for ((t, edges), &face) in tree.slots.iter().zip(&across).zip(&tree.face) {
            for k in 0..3 {
                flags[face as usize] |= ((edges[k] == Across::Free) as u8) << k;
                flags[face as usize] |= (on_rim[t[k] as usize] as u8) << (3 + k);
            }
        }
        BoundaryEdges { flags, count }
    }

    /// Number of boundary edges.
    pub fn count(&self) -> usize {
        self.count
    }

    /// True if the place lies on a boundary edge or at its end. False for a place on another mesh's faces.
    pub fn holds(&self, place: &Closest) -> bool {
        self.hold(place.face, place.feature)
    }

    /// The same for this part of a face.
    pub(crate) fn hold(&self, face: u32, part: Feature) -> bool {
        let flags = self.flags.get(face as usize).copied().unwrap_or(0);
        match part {
            Feature::Face => false,
            Feature::Edge(i) => flags >> i & 1 != 0,
            Feature::Vertex(i) => flags >> (3 + i) & 1 != 0,
        }
    }
}
