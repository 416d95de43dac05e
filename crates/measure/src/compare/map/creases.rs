//! Which facets go on into one another, and which meet in a crease.

use trueness_geom::mesh::Mesh;
use trueness_geom::space::{Vector, dot, normal};

/// Cosine of the angle between normals from which facets do not share their values: a point of one face says nothing about
/// the face round the corner.
const CREASE_COSINE: f64 = 0.866;

/// One number for each corner of each facet: equal where facets share a vertex and, around it, go on smoothly into one another.
/// The numbers are those of corners, `3 · facet + corner`.
pub fn corners(mesh: &Mesh) -> Vec<u32> {
    let normals: Vec<Option<Vector>> =
        mesh.faces.iter().map(|f| normal(f.map(|v| mesh.positions[v as usize]))).collect();
    let mut edges: Vec<([u32; 2], u32)> = vec![];
    for (face, corners) in (0u32..).zip(&mesh.faces) {
        for k in 0..3 {
            let [a, b] = [corners[k], corners[(k + 1) % 3]];
            edges.push(([a.min(b), a.max(b)], 3 * face + k as u32));
        }
    }
    edges.sort_unstable();
    let mut sets: Vec<u32> = (0..3 * mesh.faces.len() as u32).collect();
    for group in edges.chunk_by(|a, b| a.0 == b.0) {
        // Where more than two facets meet, or one stands alone, nothing goes on.
        let [(_, one), (_, two)] = group else { continue };
        let (one, two) = (*one, *two);
        let smooth = match (normals[one as usize / 3], normals[two as usize / 3]) {
            (Some(m), Some(n)) => dot(m, n) >= CREASE_COSINE,
            // A facet without area belongs to its neighbors.
            _ => true,
        };
        if !smooth {
            continue;
        }
        for end in [one, next(one)] {
            let vertex = vertex(mesh, end);
            if let Some(other) = [two, next(two)].into_iter().find(|c| self::vertex(mesh, *c) == vertex) {
                join(&mut sets, end, other);
            }
        }
    }
    (0..sets.len() as u32).map(|c| root(&mut sets, c)).collect()
}

/// The corner after this one in its facet.
fn next(corner: u32) -> u32 {
    if corner % 3 == 2 { corner - 2 } else { corner + 1 }
}

fn vertex(mesh: &Mesh, corner: u32) -> u32 {
    mesh.faces[corner as usize / 3][corner as usize % 3]
}

fn root(sets: &mut [u32], mut a: u32) -> u32 {
    while sets[a as usize] != a {
        sets[a as usize] = sets[sets[a as usize] as usize];
        a = sets[a as usize];
    }
    a
}

/// The lower number stands for both.
fn join(sets: &mut [u32], a: u32, b: u32) {
    let (a, b) = (root(sets, a), root(sets, b));
    sets[a.max(b) as usize] = a.min(b);
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn a_cube_has_its_corners_three_times_and_a_flat_sheet_once() {
        let cube = super::super::tests::cube(20.0);
        let numbers: BTreeSet<u32> = corners(&cube).into_iter().collect();
        assert_eq!(numbers.len(), 24);
        let sheet = Mesh {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.1], [0.0, 1.0, 0.0]],
            faces: vec![[0, 1, 2], [0, 2, 3]],
        };
        assert_eq!(corners(&sheet), [0, 1, 2, 0, 2, 5]);
    }
}
