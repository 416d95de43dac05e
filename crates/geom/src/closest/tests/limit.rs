//! The greatest distance that counts.

use super::*;
use crate::closest::brute;

fn answer_within(mesh: &Mesh, points: &[Point], max_distance: f64) -> usize {
    let tree = Tree::build(mesh).unwrap();
    let mut beyond = 0;
    for instructions in LEVELS {
        let got = hits(&tree, points, &Query { max_distance, instructions });
        for (p, h) in points.iter().zip(got) {
            let (d, face) = brute::closest(mesh, p);
            let want = (d.sqrt() <= max_distance).then_some((d.to_bits(), face));
            beyond += want.is_none() as usize;
            assert_eq!(h.map(|h| (h.distance_squared.to_bits(), h.face)), want, "{instructions:?} at {p:?}");
        }
    }
    beyond / LEVELS.len()
}

#[test]
fn points_within_are_exact_and_points_beyond_have_no_answer() {
    let d = &mut TestRandom(11);
    for mesh in [sphere(30, 100.0, [0.0; 3]), sphere(8, 100.0, [1e6; 3]), cube(150.0)] {
        let middle = mesh.positions[0];
        let mut points: Vec<Point> = (0..400).map(|_| plus(middle, d.point(300.0))).collect();
        // Dense points take another path through the search.
        points.extend((0..400).map(|_| plus(middle, d.point(3.0))));
        for max_distance in [0.0, 1e-3, 1.0, 2.5, 30.0, 120.0, 1e9] {
            let beyond = answer_within(&mesh, &points, max_distance);
            assert_eq!(beyond == 0, max_distance == 1e9, "{beyond} beyond {max_distance}");
        }
    }
}

#[test]
fn the_limit_itself_counts() {
    let tree = Tree::build(&cube(1.0)).unwrap();
    for d in [0.1, 0.7, 1e-300, 3e7, 1e-9] {
        let p = [0.5, 0.25, 1.0 + d];
        let true_distance = p[2] - 1.0;
        let query = Query { max_distance: true_distance, ..Query::default() };
        assert_eq!(tree.distances(&[p], &query, &Silent), Ok(vec![true_distance]), "{d}");
        assert!(tree.closest(&p, true_distance).unwrap().is_some(), "{d}");
        assert!(
            true_distance == 0.0 || tree.closest(&p, true_distance.next_down()).unwrap().is_none(),
            "{d}"
        );
    }
    assert!(tree.closest(&[0.5, 0.5, 1.0], 0.0).unwrap().is_some());
}

#[test]
fn points_beyond_are_nan_in_lists() {
    let tree = Tree::build(&cube(1.0)).unwrap();
    let query = Query { max_distance: 1.0, ..Query::default() };
    let d = tree.distances(&[[0.5, 0.5, 1.5], [0.5, 0.5, 2.5]], &query, &Silent).unwrap();
    assert_eq!(d[0], 0.5);
    assert!(d[1].is_nan());
}
