//! Laws that hold for any input, tried on inputs that `proptest` makes and, where one fails, makes smaller.
//!
//! Coordinates are small whole numbers. Then faces without area, equal distances, coinciding vertices and points on planes come
//! often, and whole numbers tell the exact answer.

use proptest::prelude::*;
use trueness_geom::closest::{Query, Tree, brute};
use trueness_geom::mesh::Mesh;
use trueness_geom::num::predicates::side_of_plane;
use trueness_geom::progress::Silent;
use trueness_geom::rigid::Rigid;
use trueness_geom::simd::Level;
use trueness_geom::space::{Point, minus, norm};
use trueness_geom::stats::statistics::{Accumulator, Summary};
use trueness_geom::topology::weld;

fn point(most: i32) -> impl Strategy<Value = Point> {
    prop::array::uniform3(-most..=most).prop_map(|p| p.map(f64::from))
}

/// Up to `faces` faces between up to twenty vertices.
fn mesh(faces: usize) -> impl Strategy<Value = Mesh> {
    let corners = prop::collection::vec(prop::array::uniform3(0u32..20), 1..=faces);
    (prop::collection::vec(point(4), 20), corners).prop_map(|(positions, faces)| Mesh { positions, faces })
}

/// Four points: near each other, so that many lie in one plane, or far apart, so that products are large.
fn corners() -> impl Strategy<Value = [Point; 4]> {
    prop_oneof![prop::array::uniform4(point(2)), prop::array::uniform4(point(1 << 20))]
}

/// A motion, from a center, a rotation vector and a translation.
fn motion() -> impl Strategy<Value = Rigid> {
    let vector = || prop::array::uniform3(-3.0..3.0f64);
    (vector(), vector(), vector()).prop_map(|(center, turn, shift)| {
        Rigid::translation_by(shift).after(&Rigid::rotation_about(center, turn))
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(256) })]

    /// The search finds what trying all faces finds, to the last bit and with the same face, on every instruction set.
    #[test]
    fn the_search_is_as_good_as_trying_all_faces(mesh in mesh(60), points in prop::collection::vec(point(9), 1..40)) {
        let tree = Tree::build(&mesh);
        // A mesh that is one place has no extent, which is allowed; else nothing is refused here.
        let tree = tree.unwrap();
        for instructions in [Level::Plain, Level::Avx2, Level::Avx512] {
            let query = Query { max_distance: f64::INFINITY, instructions };
            let found = tree.map_closest(&points, &query, &Silent, |_, hit| hit.map(|h| (h.distance_squared, h.face)));
            for (p, found) in points.iter().zip(found.unwrap()) {
                prop_assert_eq!(found, Some(brute::closest(&mesh, p)));
            }
        }
    }

    /// The side of a plane is the sign of a determinant of whole numbers; it turns with every exchange.
    #[test]
    fn sides_of_planes_are_those_of_whole_numbers(p in corners()) {
        let [a, b, c, d] = p;
        let [u, v, w] = [a, b, c].map(|q| minus(q, d).map(|x| x as i128));
        let determinant = u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
            + u[2] * (v[0] * w[1] - v[1] * w[0]);
        let side = side_of_plane(&a, &b, &c, &d);
        prop_assert_eq!(side, determinant.signum() as i32);
        prop_assert_eq!(side_of_plane(&b, &a, &c, &d), -side);
        prop_assert_eq!(side_of_plane(&a, &b, &d, &c), -side);
    }

    /// Motions keep distances, are undone by their inverse, and may be put together in any grouping.
    #[test]
    fn motions_are_a_group(m in prop::array::uniform3(motion()), p in point(50), q in point(50)) {
        let [a, b, c] = m;
        let off = |x: Point, y: Point| norm(minus(x, y));
        prop_assert!((off(a.point(p), a.point(q)) - off(p, q)).abs() < 1e-12 * (1.0 + off(p, q)));
        prop_assert!(off(a.inverse().point(a.point(p)), p) < 1e-12);
        prop_assert!(off(a.after(&b).point(p), a.point(b.point(p))) < 1e-12);
        prop_assert!(off(a.after(&b).after(&c).point(p), a.after(&b.after(&c)).point(p)) < 1e-12);
    }

    /// Statistics depend neither on the order of the values nor on the blocks in which they come, and negated values have them
    /// negated.
    #[test]
    fn statistics_do_not_depend_on_order_or_blocks(
        values in prop::collection::vec(-1000i32..1000, 2..200),
        cut in 0usize..200,
        turn in 0usize..200,
    ) {
        let values: Vec<f64> = values.into_iter().map(f64::from).collect();
        let whole = Summary::of(&values).all;
        let mut turned = values.clone();
        turned.rotate_left(turn % values.len());
        let other = Summary::of(&turned).all;
        prop_assert_eq!((whole.min, whole.max, whole.median, whole.mad), (other.min, other.max, other.median, other.mad));
        prop_assert_eq!(whole.percentiles, other.percentiles);
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-12 * a.abs().max(1.0);
        prop_assert!(close(whole.mean.unwrap(), other.mean.unwrap()));
        prop_assert!(close(whole.std_dev.unwrap(), other.std_dev.unwrap()));
        let (first, second) = values.split_at(cut.min(values.len()));
        let mut blocks = Accumulator::new();
        blocks.push(first);
        blocks.push(second);
        let streamed = blocks.summary().all;
        prop_assert_eq!((whole.mean, whole.variance), (streamed.mean, streamed.variance));
        let negated = Summary::of(&values.iter().map(|x| -x).collect::<Vec<f64>>()).all;
        prop_assert_eq!(negated.min.unwrap(), -whole.max.unwrap());
        prop_assert!(close(negated.mean.unwrap(), -whole.mean.unwrap()));
    }

    /// After a weld no two vertices are equal, every corner is where it was, and a second weld changes nothing.
    #[test]
    fn a_weld_moves_no_corner_and_is_done_once(mesh in mesh(40)) {
        let welded = weld::mesh(&mesh).unwrap().mesh;
        prop_assert_eq!(welded.faces.len(), mesh.faces.len());
        for (before, after) in mesh.faces.iter().zip(&welded.faces) {
            for (b, a) in before.iter().zip(after) {
                prop_assert_eq!(mesh.positions[*b as usize], welded.positions[*a as usize]);
            }
        }
        for (i, p) in welded.positions.iter().enumerate() {
            prop_assert!(!welded.positions[..i].contains(p));
        }
        prop_assert_eq!(&weld::mesh(&welded).unwrap().mesh, &welded);
    }
}
