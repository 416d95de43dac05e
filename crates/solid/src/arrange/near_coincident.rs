//! Facets that lie upon each other but for rounding.

use trueness_geom::mesh::Mesh;
use trueness_geom::num::predicates::height;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{Aabb, dot, minus, times};
use trueness_geom::topology::Topology;
use trueness_geom::topology::weld::WeldError;

/// Limit of the distance between facets that lie upon each other, mm, in numbers of this spacing.
#[derive(Clone, Copy)]
pub(super) struct Closeness {
    pub step: f64,
    most: f64,
}

/// Facets lie upon each other where so many times the spacing of numbers, or less, is between them.
const MAX_STEPS_BETWEEN: f64 = 64.0;
/// Where a mesh in single precision is cut in double, only so many: facets that are farther apart can be cut as they are.
const MAX_STEPS_BETWEEN_ROUNDED: f64 = 4.0;

impl Closeness {
    /// In numbers of single precision if the result is rounded to it or the mesh has it, else of double.
    pub fn of(mesh: &Mesh, single: bool) -> Closeness {
        let rounded = !single && mesh.is_single();
        let step = step(mesh, single || rounded);
        Closeness { step, most: step * if rounded { MAX_STEPS_BETWEEN_ROUNDED } else { MAX_STEPS_BETWEEN } }
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

/// How far two facets are apart: of the corners of one from the plane of the other, whichever is less.
fn apart(mesh: &Mesh, [f, g]: [u32; 2]) -> f64 {
    let above = |f: u32, g: u32| {
        let [a, b, c] = mesh.corners(g);
        mesh.corners(f).iter().map(|p| height([&a, &b, &c], p).abs()).fold(0.0, f64::max)
    };
    above(f, g).min(above(g, f))
}

/// How far those of these pairs of facets are apart at most that lie upon each other; 0 where none do, or all do exactly.
fn widest(mesh: &Mesh, pairs: &[[u32; 2]], close: Closeness) -> f64 {
    pairs.par_iter().map(|pair| apart(mesh, *pair)).filter(|h| close.holds(*h)).reduce(|| 0.0, f64::max)
}

/// The pairs of facets at an edge of more than two that lie upon each other, but not exactly. Edges of very many facets are left out.
fn at_edges(mesh: &Mesh, topology: &Topology, close: Closeness) -> Vec<[u32; 2]> {
    /// Facets of one edge whose pairs are compared.
    const MAX_FACETS_PER_EDGE: usize = 64;
    let of_edge = |[a, b]: [u32; 2]| {
        let facets = topology.facets_at_edge(mesh, [a, b]);
        let [p, q] = mesh.places(&[a, b]);
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
        for (i, f) in facets.iter().enumerate().take_while(|_| facets.len() <= MAX_FACETS_PER_EDGE) {
            found.extend(facets[..i].iter().filter(|g| is_upon(**g, *f)).map(|g| [*g, *f]));
        }
        found
    };
    topology.non_manifold_edges.par_iter().flat_map_iter(|e| of_edge(e.vertices)).collect()
}

/// The facets that cross or lie upon each other at an edge they share. Also how far those that lie upon each other are
/// apart at most.
pub(super) fn near_coincident(
    mesh: &Mesh,
    topology: &Topology,
    crossing: &[[u32; 2]],
    close: Closeness,
) -> Result<(Vec<[u32; 2]>, f64), WeldError> {
    let mut all = crossing.to_vec();
    if !topology.non_manifold_edges.is_empty() {
        // With the numbers of these vertices.
        all.extend(at_edges(mesh, &Topology::of(mesh)?, close));
    }
    let widest = widest(mesh, &all, close);
    Ok((all, widest))
}

/// Whether facets lie upon each other, but not exactly, at an edge of more than two; numbers in single precision or double.
pub(crate) fn any_at_edges(mesh: &Mesh, topology: &Topology, single: bool) -> bool {
    !topology.non_manifold_edges.is_empty()
        && !at_edges(mesh, topology, Closeness::of(mesh, single)).is_empty()
}
