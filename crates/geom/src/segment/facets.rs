//! The surface of a mesh: facets, neighbors through edges.

use super::pieces::{PieceGraph, Pieces};
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::space::{Vector, cross, dot, minus, norm, plus, single_step, times, unit};
use crate::spatial::lists::lists;

/// Steps of single precision by which the corners of two facets, together, turn one against the other.
const CORNER_ROUNDING_STEPS: f64 = 4.0;

/// The facets of a mesh whose corners exist and are finite.
pub(super) fn surface(mesh: &Mesh) -> PieceGraph<'_> {
    let shapes: Vec<_> = mesh.faces.par_iter().map(|face| middle(mesh, face)).collect();
    let (first, others) = neighbors(mesh);
    let weights: Vec<f64> = shapes.iter().map(|s| s.2).collect();
    let normals: Vec<Vector> = shapes.iter().map(|s| s.1).collect();
    let is_drawn = is_drawn(mesh, &normals, &weights, &first, &others);
    PieceGraph {
        points: &mesh.positions,
        pieces: Pieces::Facets(&mesh.faces),
        places: shapes.iter().map(|s| s.0).collect(),
        normals,
        weights,
        first,
        others,
        is_drawn,
    }
}

/// Whether half of the area belongs to facets with a neighbor in their plane, or with two that mirror them and turn as far. The
/// rounding of single precision is allowed for. A drawn surface has two facets where four corners lie in a plane, and equal
/// ones around the tip of a cone. A measured surface has none such. But noise across an even grid changes the sides of its
/// facets in second order only, so that they mirror each other.
fn is_drawn(mesh: &Mesh, normals: &[Vector], areas: &[f64], first: &[u32], others: &[u32]) -> bool {
    let step = single_step(&mesh.positions);
    let flat = |facet: usize| {
        let around = &others[first[facet] as usize..first[facet + 1] as usize];
        let face = |facet: usize| mesh.faces[facet];
        if around.iter().any(|&other| is_flat(mesh, face(facet), face(other as usize), step)) {
            return true;
        }
        let mirrors =
            around.iter().filter(|&&other| is_mirrored(mesh, face(facet), face(other as usize), step));
        let turns: Vec<f64> =
            mirrors.map(|&other| norm(cross(normals[facet], normals[other as usize]))).collect();
        // The normal of a facet as high as this is off by so much.
        let [a, b, c] = face(facet).map(|v| mesh.positions[v as usize]);
        let longest =
            [[a, b], [b, c], [c, a]].into_iter().fold(0.0, |most: f64, [p, q]| most.max(norm(minus(p, q))));
        let off = CORNER_ROUNDING_STEPS * step * longest / (2.0 * areas[facet]);
        (0..turns.len()).any(|i| turns[..i].iter().any(|turn| (turn - turns[i]).abs() <= off))
    };
    let is_flat: Vec<bool> = (0..mesh.faces.len()).into_par_iter().map(flat).collect();
    let flat: f64 = areas.iter().zip(is_flat).filter(|f| f.1).map(|f| f.0).sum();
    flat >= 0.5 * areas.iter().sum::<f64>()
}

/// Whether the four corners of two facets lie in one plane, where each may be off by `step`. The volume between them is then no
/// more than that of `step` over the four sides.
fn is_flat(mesh: &Mesh, one: [u32; 3], other: [u32; 3], step: f64) -> bool {
    let Some(far) = other_corner(other, one) else { return false };
    let [a, b, c, d] = [one[0], one[1], one[2], far].map(|v| mesh.positions[v as usize]);
    let sides = [[a, b, c], [a, b, d], [a, c, d], [b, c, d]];
    let area: f64 = sides.iter().map(|[p, q, r]| norm(cross(minus(*q, *p), minus(*r, *p)))).sum();
    dot(cross(minus(b, a), minus(c, a)), minus(d, a)).abs() <= step * area
}

/// Whether the sides of one facet are as long as those of the other, at both ends of their edge.
fn is_mirrored(mesh: &Mesh, one: [u32; 3], other: [u32; 3], step: f64) -> bool {
    let (Some(near), Some(far)) = (other_corner(one, other), other_corner(other, one)) else { return false };
    let length = |from: u32, to: u32| norm(minus(mesh.positions[from as usize], mesh.positions[to as usize]));
    one.into_iter().filter(|v| *v != near).all(|v| (length(near, v) - length(far, v)).abs() <= 2.0 * step)
}

/// The corner of one facet that the other does not have.
fn other_corner(of: [u32; 3], not: [u32; 3]) -> Option<u32> {
    of.into_iter().find(|v| !not.contains(v))
}

/// Centroid, unit normal and area; the normal of a facet without area is zero.
fn middle(mesh: &Mesh, face: &[u32; 3]) -> ([f64; 3], Vector, f64) {
    let [a, b, c] = mesh.places(face);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    /// Noise across an even grid changes no side that shows in single precision.
    #[test]
    fn an_even_grid_with_noise_is_measured_and_a_fan_is_drawn() {
        let random = &mut Random::new(8);
        let half = 3f64.sqrt() / 2.0;
        let at = |i: u32, j: u32, z: f64| {
            [0.8 * (f64::from(i) + 0.5 * f64::from(j % 2)), 0.8 * half * f64::from(j), z]
        };
        let positions = (0..1600).map(|k| at(k % 40, k / 40, 0.01 * (random.unit() - 0.5))).collect();
        let faces = (0..39 * 39).flat_map(|k| {
            let (i, j) = (k % 39, k / 39);
            let v = |i: u32, j: u32| i + 40 * j;
            match j % 2 {
                0 => [[v(i, j), v(i + 1, j), v(i, j + 1)], [v(i + 1, j), v(i + 1, j + 1), v(i, j + 1)]],
                _ => [[v(i, j), v(i + 1, j), v(i + 1, j + 1)], [v(i, j), v(i + 1, j + 1), v(i, j + 1)]],
            }
        });
        assert!(!surface(&Mesh { positions, faces: faces.collect() }).is_drawn);
        let ring = (0..24).map(|k| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / 24.0).sin_cos();
            [100.0 + 5.0 * cos, 5.0 * sin, 40.0]
        });
        let positions = ring.chain([[100.0, 0.0, 70.0]]).map(|p| p.map(|x| f64::from(x as f32))).collect();
        let faces = (0..24).map(|k| [k, (k + 1) % 24, 24]).collect();
        assert!(surface(&Mesh { positions, faces }).is_drawn);
    }
}
