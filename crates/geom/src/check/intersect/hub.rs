//! Pairs of facets of which one lies at a vertex that very many have in common.
//!
//! The boxes of such facets all overlap at that vertex, the *hub*. The boxes of long thin facets overlap many others: boxes
//! exclude next to nothing. Directions exclude more. Projected from the hub onto a sphere around it, a facet at the hub is an
//! arc of a great circle. The arc runs from the direction of one corner to that of the other. Any other facet is a triangle of
//! the sphere. Two facets that meet outside of the hub have a direction in common there. So two boxes are compared, that of the
//! directions and that of the facet itself, and `meet` decides about the few pairs left. A fan of `n` facets takes O(n log n),
//! and so do two fans that do not lie upon each other. Fans on both sides of a line in a plane are seen one upon the other.
//! Walls along a facet (`walls`) leave out those on its other side.
//!
//! Facets at one edge of very many are a hub of their own, a [`Book`].

use super::book::Book;
use super::seen;
use super::views::{Node, View, overlap};
use super::walls::Walls;
use crate::mesh::Mesh;
use crate::space::{Aabb, Point};
use crate::topology::Topology;
use std::ops::Range;

/// Facets at a vertex with very many, but for flat ones, as arcs around it; or near a place, as triangles around it.
pub(super) struct Hub {
    /// The vertex that they have in common.
    vertex: Option<u32>,
    center: Point,
    /// Box of the vertex; empty where there is none.
    place: Aabb,
    /// Where all facets have an edge in common.
    book: Option<Book>,
    /// Neighbors stand near each other. Their bounds are those of the corners that are not in common.
    arcs: Vec<View>,
    root: Node,
}

/// Facets from which on an edge at a hub is a book.
const MIN_BOOK_FACETS: usize = 64;

/// The hubs of a mesh, without the facets that `is_excluded` names. A facet at several of them is at the one with the most
/// facets.
pub(super) fn hubs(mesh: &Mesh, topology: &Topology, is_excluded: impl Fn(u32) -> bool) -> Vec<Hub> {
    let at = |v: &u32| (*v, topology.facets_at_vertex(*v));
    let mut all: Vec<(u32, Vec<u32>)> = topology.hubs.iter().map(at).collect();
    all.sort_by(|a, b| b.1.len().cmp(&a.1.len()).then(a.0.cmp(&b.0)));
    let mut claimed = vec![false; if all.is_empty() { 0 } else { mesh.faces.len() }];
    let mut hubs = vec![];
    for (vertex, mut facets) in all {
        facets.retain(|f| {
            let free = topology.collinear.binary_search(f).is_err() && !is_excluded(*f);
            free && !std::mem::replace(&mut claimed[*f as usize], true)
        });
        let others = |f: &u32| mesh.faces[*f as usize].into_iter().filter(|v| *v != vertex);
        let mut ends: Vec<(u32, u32)> = facets.iter().flat_map(|f| others(f).map(|v| (v, *f))).collect();
        ends.sort_unstable();
        let mut paged = std::collections::BTreeSet::new();
        for edge in ends.chunk_by(|a, b| a.0 == b.0).filter(|edge| edge.len() > MIN_BOOK_FACETS) {
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
    fn new(mesh: &Mesh, vertex: u32, spine: Option<u32>, facets: &[u32]) -> Hub {
        let center = mesh.positions[vertex as usize];
        let book = spine.map(|spine| Book::new(mesh, [vertex, spine], facets));
        Hub { book, ..Hub::with_views(mesh, (Some(vertex), center), Aabb::of([&center]), facets) }
    }

    /// Facets with corners near a place, which need not be one of them.
    pub fn crowd(mesh: &Mesh, center: Point, facets: &[u32]) -> Hub {
        Hub::with_views(mesh, (None, center), Aabb::EMPTY, facets)
    }

    fn with_views(mesh: &Mesh, (vertex, center): (Option<u32>, Point), place: Aabb, facets: &[u32]) -> Hub {
        let others = |facet: u32| mesh.faces[facet as usize].into_iter().filter(|v| Some(*v) != vertex);
        let arc = |&facet: &u32| View {
            number: facet,
            seen: seen_from(mesh, vertex, center, facet),
            bounds: Aabb::of(others(facet).map(|v| &mesh.positions[v as usize])),
        };
        let mut arcs: Vec<View> = facets.iter().map(arc).collect();
        let root = Node::of(&mut arcs);
        Hub { vertex, center, place, book: None, arcs, root }
    }

    /// Its facets.
    pub fn facets(&self) -> impl Iterator<Item = u32> {
        self.arcs.iter().map(|a| a.number)
    }

    /// Box of its facets.
    pub fn bounds(&self) -> Aabb {
        self.root.bounds.union(&self.place)
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
        if !overlap(&bounds, &self.bounds()) {
            return true;
        }
        if let Some(mut pages) = self.book.as_ref().and_then(|book| book.near(mesh, facet)) {
            return pages
                .all(|page| !overlap(&bounds, &Aabb::of(&mesh.corners(page))) || decide(facet, page));
        }
        let one = View { number: facet, seen: seen_from(mesh, self.vertex, self.center, facet), bounds };
        let sides = seen::Sides::of(self.center, mesh.corners(facet));
        let walls = Walls::of(mesh.corners(facet), self.center);
        let may_meet = |seen: &Aabb, others: &Aabb| {
            overlap(&one.seen, seen)
                && overlap(&one.bounds, &others.union(&self.place))
                && !sides.miss(seen)
                && !walls.separate(others)
        };
        self.below(&self.root, &may_meet, &mut |other| decide(facet, other))
    }

    /// Calls `decide` with the facets below a node that `may_meet` leaves, by their directions and the box of their other corners.
    fn below(
        &self,
        node: &Node,
        may_meet: &impl Fn(&Aabb, &Aabb) -> bool,
        decide: &mut impl FnMut(u32) -> bool,
    ) -> bool {
        if !may_meet(&node.seen, &node.bounds) {
            return true;
        }
        match &node.halves {
            Some(halves) => halves.iter().all(|half| self.below(half, may_meet, decide)),
            None => {
                let arcs = self.arcs[node.range.clone()].iter();
                arcs.filter(|arc| may_meet(&arc.seen, &arc.bounds)).all(|arc| decide(arc.number))
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
        if !overlap(&a.seen, &b.seen) {
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
        let whole = one.bounds.union(&self.place);
        let near = |o: &&View| overlap(&one.seen, &o.seen) && overlap(&whole, &o.bounds.union(&self.place));
        self.arcs[others].iter().filter(near).all(|other| decide(one.number, other.number))
    }
}

/// Box of a facet as seen from a place: that of an arc where the vertex there is one of its corners.
fn seen_from(mesh: &Mesh, vertex: Option<u32>, from: Point, facet: u32) -> Aabb {
    let place = |v: u32| mesh.positions[v as usize];
    match mesh.faces[facet as usize] {
        [v, a, b] | [b, v, a] | [a, b, v] if Some(v) == vertex => seen::segment(from, place(a), place(b)),
        face => seen::triangle(from, face.map(place)),
    }
}
