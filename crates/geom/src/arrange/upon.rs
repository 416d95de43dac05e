//! Facets that lie upon each other but for rounding.

use crate::mesh::Mesh;
use crate::num::predicates::height;
use crate::space::{Aabb, Point, dot, minus, times};
use crate::topology::Topology;
use rayon::prelude::*;

/// What lies upon each other: facets with so little between them, mm, in numbers of this spacing.
#[derive(Clone, Copy)]
pub(super) struct Closeness {
    pub step: f64,
    most: f64,
}

/// Facets lie upon each other where so many times the spacing of numbers, or less, is between them.
const UPON: f64 = 64.0;
/// Where a mesh in single precision is cut in double, only so many: what is farther apart can be cut as it is.
const ROUNDED: f64 = 4.0;

impl Closeness {
    /// In numbers of the mesh, or of single precision if these are what the result is rounded to.
    pub fn of(mesh: &Mesh, single: bool) -> Closeness {
        let is_single = |p: &Point| p.iter().all(|x| f64::from(*x as f32) == *x || !x.is_finite());
        let rounded = !single && mesh.positions.par_iter().all(is_single);
        let step = step(mesh, single || rounded);
        Closeness { step, most: step * if rounded { ROUNDED } else { UPON } }
    }

    fn holds(&self, apart: f64) -> bool {
        apart > 0.0 && apart <= self.most
    }
}

/// The spacing of numbers at the largest coordinate.
pub(super) fn step(mesh: &Mesh, single: bool) -> f64 {
    let Aabb { min, max } = mesh.finite_bounds();
    let largest = min.iter().chain(&max).fold(0.0f64, |m, x| m.max(x.abs())).min(f64::MAX);
    let digits = if single { 29 } else { 0 };
    (largest.next_up() - largest) * f64::from(1u32 << digits)
}

fn corners(mesh: &Mesh, facet: u32) -> [Point; 3] {
    mesh.faces[facet as usize].map(|v| mesh.positions[v as usize])
}

/// How far two facets are apart: of the corners of one from the plane of the other, whichever is less.
fn apart(mesh: &Mesh, [f, g]: [u32; 2]) -> f64 {
    let above = |f: u32, g: u32| {
        let [a, b, c] = corners(mesh, g);
        corners(mesh, f).iter().map(|p| height([&a, &b, &c], p).abs()).fold(0.0, f64::max)
    };
    above(f, g).min(above(g, f))
}

/// How far those of these pairs of facets are apart at most that lie upon each other; 0 where none do, or all do exactly.
pub(super) fn widest(mesh: &Mesh, pairs: &[[u32; 2]], close: Closeness) -> f64 {
    pairs.par_iter().map(|pair| apart(mesh, *pair)).filter(|h| close.holds(*h)).reduce(|| 0.0, f64::max)
}

/// The pairs of facets at an edge of more than two that lie upon each other, but not exactly. Edges of very many facets are left out.
pub(super) fn at_edges(mesh: &Mesh, topology: &Topology, close: Closeness) -> Vec<[u32; 2]> {
    /// Of one edge.
    const MANY: usize = 64;
    let of_edge = |[a, b]: [u32; 2]| {
        let facets = topology.facets_at_edge(mesh, [a, b]);
        let [p, q] = [a, b].map(|v| mesh.positions[v as usize]);
        let along = minus(q, p);
        // From the edge into the facet.
        let into = |f: u32| {
            let third = mesh.faces[f as usize].into_iter().find(|v| *v != a && *v != b)?;
            let way = minus(mesh.positions[third as usize], p);
            Some(minus(way, times(dot(way, along) / dot(along, along), along)))
        };
        let is_upon = |f: u32, g: u32| {
            let same_side = into(f).zip(into(g)).is_some_and(|(u, v)| dot(u, v) > 0.0);
            same_side && close.holds(apart(mesh, [f, g]))
        };
        let mut found = vec![];
        for (i, f) in facets.iter().enumerate().take_while(|_| facets.len() <= MANY) {
            found.extend(facets[..i].iter().filter(|g| is_upon(**g, *f)).map(|g| [*g, *f]));
        }
        found
    };
    topology.non_manifold_edges.par_iter().flat_map_iter(|e| of_edge(e.vertices)).collect()
}

/// Whether facets lie upon each other, but not exactly, at an edge of more than two; numbers in single precision or double.
pub(crate) fn any_at_edges(mesh: &Mesh, topology: &Topology, single: bool) -> bool {
    !topology.non_manifold_edges.is_empty()
        && !at_edges(mesh, topology, Closeness::of(mesh, single)).is_empty()
}
