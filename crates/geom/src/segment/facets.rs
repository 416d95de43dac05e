//! The surface of a mesh: facets, neighbors through edges.

use super::pieces::{PieceGraph, Pieces, step};
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::space::{Vector, cross, dot, minus, norm, plus, times, unit};
use crate::spatial::lists::lists;

/// The facets of a mesh whose corners exist and are finite.
pub(super) fn surface(mesh: &Mesh) -> PieceGraph<'_> {
    let shapes: Vec<_> = mesh.faces.par_iter().map(|face| middle(mesh, face)).collect();
    let (first, others) = neighbors(mesh);
    let weights: Vec<f64> = shapes.iter().map(|s| s.2).collect();
    let is_drawn = is_drawn(mesh, &weights, &first, &others);
    PieceGraph {
        points: &mesh.positions,
        pieces: Pieces::Facets(&mesh.faces),
        places: shapes.iter().map(|s| s.0).collect(),
        normals: shapes.iter().map(|s| s.1).collect(),
        weights,
        first,
        others,
        is_drawn,
    }
}

/// Whether the half of the area is of facets with a neighbor in their plane, or that mirrors them, to the rounding of single precision:
/// what is drawn has two facets where four corners lie in a plane, and equal ones around the tip of a cone; what is measured has none such.
fn is_drawn(mesh: &Mesh, areas: &[f64], first: &[u32], others: &[u32]) -> bool {
    let step = step(&mesh.positions);
    let flat = |facet: usize| {
        let around = &others[first[facet] as usize..first[facet + 1] as usize];
        around.iter().any(|&other| is_ruled(mesh, mesh.faces[facet], mesh.faces[other as usize], step))
    };
    let is_flat: Vec<bool> = (0..mesh.faces.len()).into_par_iter().map(flat).collect();
    let flat: f64 = areas.iter().zip(is_flat).filter(|f| f.1).map(|f| f.0).sum();
    flat >= 0.5 * areas.iter().sum::<f64>()
}

/// Whether the four corners of two facets lie in one plane, where each may be off by `step`: the volume between them is no more than
/// that of `step` over the four sides. Or whether the sides of one are as long as those of the other, at both ends of their edge.
fn is_ruled(mesh: &Mesh, one: [u32; 3], other: [u32; 3], step: f64) -> bool {
    let find = |of: [u32; 3], not: [u32; 3]| of.into_iter().find(|v| !not.contains(v));
    let (Some(near), Some(far)) = (find(one, other), find(other, one)) else { return false };
    let at = |v: u32| mesh.positions[v as usize];
    let [a, b, c, d] = [one[0], one[1], one[2], far].map(at);
    let sides = [[a, b, c], [a, b, d], [a, c, d], [b, c, d]];
    let area: f64 = sides.iter().map(|[p, q, r]| norm(cross(minus(*q, *p), minus(*r, *p)))).sum();
    let is_flat = dot(cross(minus(b, a), minus(c, a)), minus(d, a)).abs() <= step * area;
    let even = |v: u32| (norm(minus(at(near), at(v))) - norm(minus(d, at(v)))).abs() <= 2.0 * step;
    is_flat || one.into_iter().filter(|v| *v != near).all(even)
}

/// Centroid, unit normal and area; the normal of a facet without area is zero.
fn middle(mesh: &Mesh, face: &[u32; 3]) -> ([f64; 3], Vector, f64) {
    let [a, b, c] = face.map(|v| mesh.positions[v as usize]);
    let twice = cross(minus(b, a), minus(c, a));
    let place = times(1.0 / 3.0, plus(a, plus(b, c)));
    (place, unit(twice).map_or([0.0; 3], |(n, _)| n), 0.5 * norm(twice))
}

/// Facets that share an edge. At an edge of more than two facets each is a neighbor of the next one only.
fn neighbors(mesh: &Mesh) -> (Vec<u32>, Vec<u32>) {
    let mut edges: Vec<(u64, u32)> = (mesh.faces.par_iter().enumerate())
        .flat_map_iter(|(i, face)| {
            (0..3).map(move |k| {
                let (a, b) = (face[k], face[(k + 1) % 3]);
                (u64::from(a.min(b)) << 32 | u64::from(a.max(b)), i as u32)
            })
        })
        .collect();
    edges.par_sort_unstable();
    let pairs: Vec<[u32; 2]> = (edges.windows(2))
        .filter(|w| w[0].0 == w[1].0 && w[0].1 != w[1].1)
        .flat_map(|w| [[w[0].1, w[1].1], [w[1].1, w[0].1]])
        .collect();
    lists(mesh.faces.len(), pairs)
}
