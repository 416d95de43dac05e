//! Pairs of facets of which one lies at a vertex that very many have in common.
//!
//! The boxes of such facets all overlap at that vertex, the *hub*, and the boxes of long thin facets overlap many others: boxes
//! exclude next to nothing. Directions exclude more. Projected from the hub onto a sphere around it, a facet at the hub is an
//! arc of a great circle, from the direction of one corner to that of the other; any other facet is a triangle of the sphere.
//! Two facets that meet outside of the hub have a direction in common there. So two boxes are compared, that of the directions
//! and that of the facet itself, and `meet` decides about the few pairs left. A fan of `n` facets takes O(n log n), and so do
//! two fans that do not lie upon each other.
//!
//! Facets at one edge of very many are a hub of their own, a [`Book`].

use super::book::Book;
use super::seen;
use super::views::{Node, View, overlap};
use crate::mesh::Mesh;
use crate::space::Aabb;
use crate::topology::Topology;
use std::ops::Range;

/// Facets at a vertex with very many, but for flat ones, as arcs around it.
pub(super) struct Hub {
    center: u32,
    /// Where all facets have an edge in common.
    book: Option<Book>,
    /// Neighbors stand near each other.
    arcs: Vec<View>,
    root: Node,
}

/// From so many facets on, an edge at a hub is a book.
const BOOK: usize = 64;

/// The hubs of a mesh, without the facets that `left_out` names. A facet at several of them is at the one with the most
/// facets.
pub(super) fn hubs(mesh: &Mesh, topology: &Topology, left_out: impl Fn(u32) -> bool) -> Vec<Hub> {
    let at = |v: &u32| (*v, topology.facets_at_vertex(*v));
    let mut all: Vec<(u32, Vec<u32>)> = topology.hubs.iter().map(at).collect();
    all.sort_by(|a, b| b.1.len().cmp(&a.1.len()).then(a.0.cmp(&b.0)));
    let mut taken = vec![false; if all.is_empty() { 0 } else { mesh.faces.len() }];
    let mut hubs = vec![];
    for (vertex, mut facets) in all {
        facets.retain(|f| {
            let free = topology.collinear.binary_search(f).is_err() && !left_out(*f);
            free && !std::mem::replace(&mut taken[*f as usize], true)
        });
        let others = |f: &u32| mesh.faces[*f as usize].into_iter().filter(|v| *v != vertex);
        let mut ends: Vec<(u32, u32)> = facets.iter().flat_map(|f| others(f).map(|v| (v, *f))).collect();
        ends.sort_unstable();
        let mut paged = std::collections::BTreeSet::new();
        for edge in ends.chunk_by(|a, b| a.0 == b.0).filter(|edge| edge.len() > BOOK) {
            let pages: Vec<u32> = edge.iter().map(|e| e.1).filter(|f| paged.insert(*f)).collect();
            hubs.push(Hub::new(mesh, vertex, Some(edge[0].0), &pages));
        }
        facets.retain(|f| !paged.contains(f));
        hubs.push(Hub::new(mesh, vertex, None, &facets));
    }
    hubs.retain(|hub| !hub.arcs.is_empty());
    hubs
}

impl Hub {
    fn new(mesh: &Mesh, center: u32, spine: Option<u32>, facets: &[u32]) -> Hub {
        let arc = |&facet: &u32| View {
            number: facet,
            seen: seen_from(mesh, center, facet),
            bounds: Aabb::of(&mesh.corners(facet)),
        };
        let mut arcs: Vec<View> = facets.iter().map(arc).collect();
        let root = Node::of(&mut arcs);
        let book = spine.map(|spine| Book::new(mesh, [center, spine], facets));
        Hub { center, book, arcs, root }
    }

    /// Its facets.
    pub fn facets(&self) -> impl Iterator<Item = u32> {
        self.arcs.iter().map(|a| a.number)
    }

    /// Box of its facets.
    pub fn bounds(&self) -> &Aabb {
        &self.root.bounds
    }

    /// Calls `decide` with all pairs of its facets that may meet where they should not, until that says no.
    pub fn pairs(&self, decide: &mut impl FnMut(u32, u32) -> bool) -> bool {
        match &self.book {
            Some(book) => book.pairs(decide),
            None => self.within(&self.root, decide),
        }
    }

    /// Calls `decide` with those of its facets that may meet another one, until that says no.
    pub fn against(&self, mesh: &Mesh, facet: u32, decide: &mut impl FnMut(u32, u32) -> bool) -> bool {
        let bounds = Aabb::of(&mesh.corners(facet));
        if !overlap(&bounds, &self.root.bounds) {
            return true;
        }
        if let Some(mut pages) = self.book.as_ref().and_then(|book| book.near(mesh, facet)) {
            return pages
                .all(|page| !overlap(&bounds, &Aabb::of(&mesh.corners(page))) || decide(facet, page));
        }
        let other = View { number: facet, seen: seen_from(mesh, self.center, facet), bounds };
        let sides = seen::Sides::of(mesh.positions[self.center as usize], mesh.corners(facet));
        self.one_below((&other, &sides), &self.root, decide)
    }

    fn one_below(
        &self,
        (one, sides): (&View, &seen::Sides),
        node: &Node,
        decide: &mut impl FnMut(u32, u32) -> bool,
    ) -> bool {
        if !overlap(&one.seen, &node.seen) || !overlap(&one.bounds, &node.bounds) || sides.miss(&node.seen) {
            return true;
        }
        match &node.halves {
            Some(halves) => halves.iter().all(|half| self.one_below((one, sides), half, decide)),
            None => {
                let near = |o: &&View| {
                    overlap(&one.seen, &o.seen) && overlap(&one.bounds, &o.bounds) && !sides.miss(&o.seen)
                };
                let arcs = &self.arcs[node.range.clone()];
                arcs.iter().filter(near).all(|other| decide(one.number, other.number))
            }
        }
    }

    fn within(&self, node: &Node, decide: &mut impl FnMut(u32, u32) -> bool) -> bool {
        match &node.halves {
            Some(halves) => {
                halves.iter().all(|half| self.within(half, decide))
                    && self.between(&halves[0], &halves[1], decide)
            }
            None => node.range.clone().all(|i| self.one_with(&self.arcs[i], i + 1..node.range.end, decide)),
        }
    }

    fn between(&self, a: &Node, b: &Node, decide: &mut impl FnMut(u32, u32) -> bool) -> bool {
        if !overlap(&a.seen, &b.seen) || !overlap(&a.bounds, &b.bounds) {
            return true;
        }
        let (whole, halves) = match (&a.halves, &b.halves) {
            (None, None) => {
                return a.range.clone().all(|i| self.one_with(&self.arcs[i], b.range.clone(), decide));
            }
            (Some(halves), None) => (b, halves),
            (None, Some(halves)) => (a, halves),
            (Some(of_a), Some(of_b)) => {
                if a.range.len() >= b.range.len() {
                    (b, of_a)
                } else {
                    (a, of_b)
                }
            }
        };
        halves.iter().all(|half| self.between(half, whole, decide))
    }

    fn one_with(&self, one: &View, others: Range<usize>, decide: &mut impl FnMut(u32, u32) -> bool) -> bool {
        let near = |o: &&View| overlap(&one.seen, &o.seen) && overlap(&one.bounds, &o.bounds);
        self.arcs[others].iter().filter(near).all(|other| decide(one.number, other.number))
    }
}

/// Box of a facet as seen from a vertex: that of an arc where it is one of its corners.
fn seen_from(mesh: &Mesh, center: u32, facet: u32) -> Aabb {
    let from = mesh.positions[center as usize];
    let place = |v: u32| mesh.positions[v as usize];
    match mesh.faces[facet as usize] {
        [v, a, b] | [b, v, a] | [a, b, v] if v == center => seen::segment(from, place(a), place(b)),
        face => seen::triangle(from, face.map(place)),
    }
}
