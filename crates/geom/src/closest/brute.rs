//! The brute-force twin: every triangle, in order, in double precision. Slow, and right by definition.

use crate::closest::triangle;
use crate::mesh::Mesh;
use crate::space::Point;

/// Least squared distance over all faces, and the lowest face that attains it.
///
/// Infinite and `u32::MAX` for a mesh without faces; faces that name a vertex that does not exist are passed over.
/// Cost: proportional to the faces.
pub fn closest(mesh: &Mesh, p: &Point) -> (f64, u32) {
    let mut best = (f64::INFINITY, u32::MAX);
    for (face, corners) in mesh.faces.iter().enumerate() {
        let at = |k: usize| mesh.positions.get(corners[k] as usize);
        let (Some(&a), Some(&b), Some(&c)) = (at(0), at(1), at(2)) else { continue };
        let (d, _) = triangle::squared_distance(p, &[a, b, c]);
        if d < best.0 {
            best = (d, face as u32);
        }
    }
    best
}
