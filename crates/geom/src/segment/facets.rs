//! The surface of a mesh: facets, neighbors through edges.

use super::pieces::{PieceGraph, Pieces};
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::space::{Vector, cross, minus, norm, plus, times, unit};
use crate::spatial::lists::lists;

/// The facets of a mesh whose corners exist and are finite.
pub(super) fn surface(mesh: &Mesh) -> PieceGraph<'_> {
    let shapes: Vec<_> = mesh.faces.par_iter().map(|face| middle(mesh, face)).collect();
    let (first, others) = neighbors(mesh);
    PieceGraph {
        points: &mesh.positions,
        pieces: Pieces::Facets(&mesh.faces),
        places: shapes.iter().map(|s| s.0).collect(),
        normals: shapes.iter().map(|s| s.1).collect(),
        weights: shapes.iter().map(|s| s.2).collect(),
        first,
        others,
    }
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
