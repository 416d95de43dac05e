//! Pairs among the facets at a vertex that very many have in common.
//!
//! The boxes of such facets all overlap at that vertex, the hub, and settle nothing. But seen from the hub a facet is an
//! arc of a great circle, from the direction of one corner to that of the other; and two facets that meet outside the hub
//! meet along a stretch of a ray from it, where their arcs cross or touch. So boxes around the arcs are compared, however
//! long or short the facets are, and `meet` decides about the few pairs left. A fan of `n` facets takes O(n log n).

use super::meet::meet;
use crate::mesh::Mesh;
use crate::progress::Progress;
use crate::space::{Aabb, Point, minus, norm, plus, unit};
use crate::topology::Topology;
use std::ops::Range;

/// The facets at a vertex with very many, but for flat ones, as arcs around it.
pub(super) struct Hub {
    /// Neighbours stand near each other.
    arcs: Vec<Arc>,
    root: Node,
}

struct Arc {
    facet: u32,
    bounds: Aabb,
}

/// Some of the arcs.
struct Node {
    range: Range<usize>,
    bounds: Aabb,
    halves: Option<Box<[Node; 2]>>,
}

/// Arcs of a node that is not halved.
const FEW: usize = 8;

/// The hubs of a mesh. A facet at several of them is at the one with the most facets.
pub(super) fn hubs(mesh: &Mesh, topology: &Topology) -> Vec<Hub> {
    let at = |v: &u32| (*v, topology.facets_at_vertex(*v));
    let mut all: Vec<(u32, Vec<u32>)> = topology.hubs.iter().map(at).collect();
    all.sort_by(|a, b| b.1.len().cmp(&a.1.len()).then(a.0.cmp(&b.0)));
    let mut taken = std::collections::BTreeSet::new();
    let mut hubs = vec![];
    for (vertex, mut facets) in all {
        facets.retain(|f| topology.collinear.binary_search(f).is_err() && taken.insert(*f));
        let mut arcs: Vec<Arc> =
            facets.into_iter().map(|facet| Arc { facet, bounds: around(mesh, vertex, facet) }).collect();
        let root = node(&mut arcs, 0);
        hubs.push(Hub { arcs, root });
    }
    hubs
}

/// Box of the arc of a facet as seen from one of its corners.
fn around(mesh: &Mesh, vertex: u32, facet: u32) -> Aabb {
    /// Of directions: some ten roundings of 2^-53, and much to spare.
    const ROUNDING: f64 = 1e-12;
    let from = mesh.positions[vertex as usize];
    let mut corners = mesh.faces[facet as usize].into_iter().filter(|v| *v != vertex);
    let mut next = || corners.next().and_then(|v| direction(from, mesh.positions[v as usize]));
    let (Some(u), Some(v)) = (next(), next()) else {
        return Aabb { min: [-1.0; 3], max: [1.0; 3] };
    };
    // No place of an arc is farther from its chord than its middle is.
    let rise = 1.0 - 0.5 * norm(plus(u, v)) + ROUNDING;
    Aabb {
        min: std::array::from_fn(|k| u[k].min(v[k]) - rise),
        max: std::array::from_fn(|k| u[k].max(v[k]) + rise),
    }
}

/// Unit vector from one place to another, whatever their distance; `None` where it is beyond numbers.
fn direction(from: Point, to: Point) -> Option<Point> {
    let way = minus(to, from);
    let size = way.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    unit(way.map(|x| x / size)).map(|(direction, _)| direction)
}

/// Halves the arcs, which begin at number `start`, again and again where they spread most.
fn node(arcs: &mut [Arc], start: usize) -> Node {
    let bounds = arcs.iter().fold(Aabb::EMPTY, |all, a| all.union(&a.bounds));
    let range = start..start + arcs.len();
    if arcs.len() <= FEW {
        return Node { range, bounds, halves: None };
    }
    let sides = bounds.sides();
    let axis = (0..3).fold(0, |k, j| if sides[j] > sides[k] { j } else { k });
    let middle = |a: &Arc| a.bounds.min[axis] + a.bounds.max[axis];
    let half = arcs.len() / 2;
    arcs.select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)).then(a.facet.cmp(&b.facet)));
    let (left, right) = arcs.split_at_mut(half);
    Node { range, bounds, halves: Some(Box::new([node(left, start), node(right, start + half)])) }
}

impl Hub {
    /// Its facets, neighbours near each other.
    pub fn facets(&self) -> Vec<u32> {
        self.arcs.iter().map(|a| a.facet).collect()
    }

    /// Calls `found` with all pairs of its facets that are asked for and meet where they should not.
    pub fn pairs(
        &self,
        mesh: &Mesh,
        progress: &dyn Progress,
        asked: &impl Fn([u32; 2]) -> bool,
        found: &mut impl FnMut([u32; 2]),
    ) {
        let triangle = |facet: u32| {
            let face = mesh.faces[facet as usize];
            (face.map(|v| mesh.positions[v as usize]), face)
        };
        let mut decide = |a: u32, b: u32| {
            if asked([a, b]) && meet(&triangle(a), &triangle(b)) {
                found([a.min(b), a.max(b)]);
            }
        };
        self.within(&self.root, progress, &mut decide);
    }

    fn within(&self, node: &Node, progress: &dyn Progress, decide: &mut impl FnMut(u32, u32)) {
        if progress.cancelled() {
            return;
        }
        if let Some(halves) = &node.halves {
            halves.iter().for_each(|half| self.within(half, progress, decide));
            return self.between(&halves[0], &halves[1], decide);
        }
        for i in node.range.clone() {
            self.one_with(i, i + 1..node.range.end, decide);
        }
    }

    fn between(&self, a: &Node, b: &Node, decide: &mut impl FnMut(u32, u32)) {
        if !overlap(&a.bounds, &b.bounds) {
            return;
        }
        let (whole, halves) = match (&a.halves, &b.halves) {
            (None, None) => {
                return a.range.clone().for_each(|i| self.one_with(i, b.range.clone(), decide));
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
        halves.iter().for_each(|half| self.between(half, whole, decide));
    }

    fn one_with(&self, i: usize, others: Range<usize>, decide: &mut impl FnMut(u32, u32)) {
        let arc = &self.arcs[i];
        for other in self.arcs[others].iter().filter(|other| overlap(&arc.bounds, &other.bounds)) {
            decide(arc.facet, other.facet);
        }
    }
}

fn overlap(a: &Aabb, b: &Aabb) -> bool {
    (0..3).all(|k| a.min[k] <= b.max[k] && b.min[k] <= a.max[k])
}
