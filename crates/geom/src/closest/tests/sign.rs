//! The side of the surface, and its rim.

use super::*;
use crate::closest::{BoundaryEdges, Feature, Signs, Winding};
use crate::space::norm;

#[test]
fn signs_agree_with_the_winding_number() {
    let d = &mut TestRandom(3);
    for mesh in [cube(1.0), sphere(40, 1.0, [0.2; 3])] {
        let tree = Tree::build(&mesh).unwrap();
        let (signs, winding) = (Signs::new(&tree), Winding::new(&tree));
        assert_eq!(signs.loose_edges(), 0);
        let points: Vec<_> = (0..20_000).map(|_| d.point(2.0)).collect();
        let distances = signs.distances(&points, &Query::default(), &Silent).unwrap();
        let numbers = winding.numbers(&points, &Silent).unwrap();
        for ((p, d), w) in points.iter().zip(distances).zip(numbers) {
            assert_eq!(d < 0.0, w > 0.5, "{p:?}: distance {d}, winding number {w}");
        }
    }
}

#[test]
fn sharp_corners_and_edges_have_the_right_side() {
    // A blade of 3 degrees and a spike: where the normal of the closest face alone goes wrong most often.
    let d = &mut TestRandom(8);
    for width in [0.05, 0.5, 3.0] {
        let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, width, 0.0], [0.7, 0.3 * width, 1.0]];
        let mesh = Mesh { positions, faces: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]] };
        let tree = Tree::build(&mesh).unwrap();
        let signs = Signs::new(&tree);
        let points: Vec<Point> = (0..20_000).map(|_| plus([0.5, 0.5 * width, 0.5], d.point(1.0))).collect();
        let distances = signs.distances(&points, &Query::default(), &Silent).unwrap();
        for (p, got) in points.iter().zip(distances) {
            // A tetrahedron is where all four planes have the point behind them.
            let behind = mesh.faces.iter().all(|f| {
                let [a, b, c] = mesh.places(f);
                let n = crate::space::cross(crate::space::minus(b, a), crate::space::minus(c, a));
                crate::space::dot(crate::space::minus(*p, a), n) < 0.0
            });
            assert!((got < 0.0) == behind || got.abs() < 1e-15, "{p:?}: {got}");
        }
    }
}

/// However far away a point is, it is outside; of a mesh that is inside out, inside.
#[test]
fn far_away_is_outside() {
    let d = &mut TestRandom(12);
    let mut mesh = sphere(20, 7.0, [3.0; 3]);
    for outward in [1.0, -1.0] {
        let tree = Tree::build(&mesh).unwrap();
        let signs = Signs::new(&tree);
        for exponent in (2..=59).step_by(3) {
            let size = 10f64.powi(exponent);
            let mut points: Vec<Point> = (0..200).map(|_| d.point(1.0).map(|x| x * size)).collect();
            points.extend([[size, 1.0, 1.0], [1.0, -size, 1.0], [1.0, size, size], [-size, size, 2.0]]);
            let distances = signs.distances(&points, &Query::default(), &Silent).unwrap();
            for (p, got) in points.iter().zip(distances).filter(|(p, _)| norm(**p) > 20.0) {
                assert_eq!(got.signum(), outward, "{p:?}");
            }
        }
        mesh.faces.iter_mut().for_each(|f| f.swap(0, 1));
    }
}

#[test]
fn size_of_signed_distances_is_that_of_unsigned_ones() {
    let d = &mut TestRandom(9);
    let tree = Tree::build(&sphere(30, 1.0, [0.0; 3])).unwrap();
    let points: Vec<Point> = (0..5000).map(|_| d.point(1.5)).collect();
    let unsigned = tree.distances(&points, &Query::default(), &Silent).unwrap();
    let signed = Signs::new(&tree).distances(&points, &Query::default(), &Silent).unwrap();
    assert!(unsigned.iter().zip(&signed).all(|(u, s)| u.to_bits() == s.abs().to_bits()));
    assert!(
        points
            .iter()
            .zip(&signed)
            .all(|(p, s)| (norm(*p) < 0.97) <= (*s < 0.0) && (norm(*p) > 1.0) <= (*s > 0.0))
    );
}

#[test]
fn boundary_edges_hold_what_is_beside_the_mesh() {
    // The cube without its top: the rim is the square at z = 1.
    let mut mesh = cube(1.0);
    mesh.faces.drain(2..4);
    let tree = Tree::build(&mesh).unwrap();
    let rim = BoundaryEdges::new(&tree);
    assert_eq!(rim.count(), 4);
    let holds = |p: Point| {
        let place = tree.closest(&p, f64::INFINITY).unwrap().unwrap();
        (rim.holds(&place), place.feature)
    };
    assert!(matches!(holds([0.5, -0.1, 1.5]), (true, Feature::Edge(_))), "over an edge of the rim");
    assert!(matches!(holds([-1.0, -1.0, 2.0]), (true, Feature::Vertex(_))), "over a corner of the rim");
    assert!(matches!(holds([0.4, -1.0, 0.5]), (false, Feature::Face)), "before a face");
    assert!(
        matches!(holds([-1.0, -1.0, 0.5]), (false, Feature::Edge(_))),
        "before an inner edge that ends in the rim"
    );
    assert!(matches!(holds([-1.0, -1.0, -1.0]), (false, Feature::Vertex(_))), "before an inner corner");
    assert_eq!(BoundaryEdges::new(&Tree::build(&cube(1.0)).unwrap()).count(), 0);
    // Without shared vertices every edge is free.
    let soup = soup(&mut TestRandom(1), 10, |d| std::array::from_fn(|_| d.point(1.0)));
    assert_eq!(BoundaryEdges::new(&Tree::build(&soup).unwrap()).count(), 30);
}

#[test]
fn an_edge_of_three_faces_is_loose_but_not_free() {
    let positions = vec![[0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, -1.0, 0.0]];
    let mesh = Mesh { positions, faces: vec![[0, 1, 2], [0, 1, 3], [0, 1, 4]] };
    let tree = Tree::build(&mesh).unwrap();
    let rim = BoundaryEdges::new(&tree);
    assert_eq!((rim.count(), Signs::new(&tree).loose_edges()), (6, 9));
    let place = tree.closest(&[-1.0, 0.1, 0.5], f64::INFINITY).unwrap().unwrap();
    assert!(matches!(place.feature, Feature::Edge(_)) && !rim.holds(&place), "{place:?}");
}
