//! Faces in a box, against a look at every face.

use super::TestRandom;
use crate::closest::Tree;
use crate::mesh::Mesh;
use crate::space::{Aabb, Point, plus, times};

#[test]
fn faces_in_a_box_are_those_that_a_look_at_all_finds() {
    let mut random = TestRandom(5);
    for (count, offset, size) in [(5, 0.0, 1.0), (800, 0.0, 1.0), (800, 1e6, 1e-3), (800, -3e3, 40.0)] {
        let mut positions: Vec<Point> = vec![];
        for _ in 0..count {
            let corner = plus([offset; 3], random.point(10.0 * size));
            let reach = size * random.unit().abs();
            positions.extend([0; 3].map(|_| plus(corner, random.point(reach))));
        }
        let faces = (0..count).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        let mesh = Mesh { positions, faces };
        let tree = Tree::build(&mesh).unwrap();
        let bounds = |f: u32| Aabb::of(mesh.faces[f as usize].map(|v| &mesh.positions[v as usize]));
        let all = Aabb { min: [f64::NEG_INFINITY; 3], max: [f64::INFINITY; 3] };
        assert_eq!(tree.in_box(&all).len(), count as usize);
        assert!(tree.in_box(&Aabb::EMPTY).is_empty());
        let nowhere = Aabb { min: [f64::NAN; 3], max: [f64::NAN; 3] };
        assert!(tree.in_box(&nowhere).is_empty());
        let mut some = 0;
        for k in 0..300 {
            let corner = plus([offset; 3], random.point(11.0 * size));
            let side = [0.0, 1.0, 6.0][k % 3] * size;
            let window = Aabb { min: corner, max: plus(corner, times(side, [1.0, 0.5, 2.0])) };
            let expected: Vec<u32> = (0..count).filter(|f| bounds(*f).meets(&window)).collect();
            assert_eq!(tree.in_box(&window), expected);
            some += expected.len();
            // One that ends where a face begins.
            let of = bounds(k as u32 % count);
            let touching = Aabb { min: plus(of.min, [-size; 3]), max: of.min };
            assert!(tree.in_box(&touching).contains(&(k as u32 % count)));
        }
        assert!(some > 100 || count == 5);
    }
}
