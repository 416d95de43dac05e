//! The hierarchical winding number against the sum of all solid angles.

use super::*;
use crate::closest::Winding;
use crate::space::{cross, dot, minus, norm};

/// The definition: solid angles by van Oosterom & Strackee, in double precision.
fn by_definition(mesh: &Mesh, p: &Point) -> f64 {
    let angle = |f: &[u32; 3]| {
        let [a, b, c] = f.map(|v| minus(mesh.positions[v as usize], *p));
        let (la, lb, lc) = (norm(a), norm(b), norm(c));
        let re = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
        2.0 * dot(a, cross(b, c)).atan2(re)
    };
    mesh.faces.iter().map(angle).sum::<f64>() / (4.0 * PI)
}

fn numbers(mesh: &Mesh, points: &[Point]) -> Vec<f64> {
    let tree = Tree::build(mesh).unwrap();
    Winding::new(&tree).numbers(points, &Silent).unwrap()
}

#[test]
fn closed_meshes_are_one_inside_and_zero_outside() {
    let d = &mut Dice(12);
    for mesh in [cube(1.0), sphere(50, 1.0, [0.5; 3]), sphere(13, 1.0, [0.5; 3])] {
        let points: Vec<Point> = (0..4000).map(|_| plus([0.5; 3], d.point(1.5))).collect();
        for (p, w) in points.iter().zip(numbers(&mesh, &points)) {
            let want = by_definition(&mesh, p);
            assert!((w - want).abs() < 0.05, "{w} instead of {want} at {p:?}");
        }
    }
}
