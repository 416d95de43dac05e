//! The brute-force twin: every triangle, in order, in double precision. Slow, and right by definition.

use crate::closest::line::Line;
use crate::closest::triangle;
use crate::mesh::Mesh;
use crate::space::{Point, Vector};

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

/// How far along `direction` (negative behind `p`) the line through `p` meets the nearest of all faces, and the lowest face
/// that it meets there. `None` where it meets none.
///
/// Faces that name a vertex that does not exist are passed over. Cost: proportional to the faces.
pub fn crossing(mesh: &Mesh, p: &Point, direction: Vector) -> Option<(f64, u32)> {
    let line = Line::new(*p, direction)?;
    let mut best: Option<(f64, u32)> = None;
    for (face, corners) in (0..).zip(&mesh.faces) {
        let at = |k: usize| mesh.positions.get(corners[k] as usize);
        let (Some(&a), Some(&b), Some(&c)) = (at(0), at(1), at(2)) else { continue };
        let Some(met) = line.meeting(&[a, b, c]) else { continue };
        if best.is_none_or(|(along, _)| met.along.abs() < along.abs()) {
            best = Some((met.along, face));
        }
    }
    best
}
