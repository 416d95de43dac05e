//! Places on facets, and how large these are.

use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{Point, cross, minus, norm};

/// Area of all facets, square millimeters.
pub(super) fn whole_area(mesh: &Mesh) -> f64 {
    let corners = mesh.faces.par_iter().map(|f| f.map(|v| mesh.positions[v as usize]));
    let areas: Vec<f64> = corners.map(|[a, b, c]| 0.5 * norm(cross(minus(b, a), minus(c, a)))).collect();
    areas.iter().sum()
}

/// The place with these weights of a facet's corners.
pub(super) fn place(mesh: &Mesh, face: u32, weights: [f64; 3]) -> Point {
    let corners = mesh.faces[face as usize].map(|v| mesh.positions[v as usize]);
    [0, 1, 2].map(|k| (0..3).map(|j| weights[j] * corners[j][k]).sum())
}
