//! The nearest crossing of a line, against all faces tried one by one and against closed forms.

use super::*;
use crate::closest::brute;
use crate::space::{Vector, cross, dot, minus, norm, times};

fn same_as_brute(mesh: &Mesh, points: &[Point], direction: impl Fn(usize) -> Vector + Sync) -> usize {
    let tree = Tree::build(mesh).unwrap();
    let of = |i| Some(direction(i));
    let found = tree.map_crossings(points, of, f64::INFINITY, &Silent, |_, c| c).unwrap();
    let mut met = 0;
    for (i, (p, c)) in points.iter().zip(&found).enumerate() {
        let want = brute::crossing(mesh, p, direction(i));
        let bits = |x: Option<(f64, u32)>| x.map(|(t, f)| (t.to_bits(), f));
        assert_eq!(bits(c.map(|c| (c.along, c.face))), bits(want), "line {i} through {p:?}");
        assert_eq!(*c, tree.crossing(p, direction(i), f64::INFINITY).unwrap());
        met += usize::from(want.is_some());
    }
    met
}

#[test]
fn lines_meet_what_trying_all_faces_meets() {
    let d = &mut TestRandom(1);
    let lumps = soup(d, 400, |d| {
        let (at, size) = (d.point(10.0), 10f64.powf(d.unit() * 3.0));
        std::array::from_fn(|_| plus(at, d.point(size)))
    });
    for mesh in [&sphere(24, 5.0, [1.0, 2.0, 3.0]), &cube(3.0), &lumps] {
        for far in [4.0, 40.0, 4e6] {
            let points: Vec<Point> = (0..300).map(|_| d.point(far)).collect();
            // Towards the middle of the mesh, so that lines from afar meet it too.
            let directions: Vec<Vector> =
                points.iter().map(|p| minus(plus([1.0, 1.0, 1.0], d.point(2.0)), *p)).collect();
            assert!(same_as_brute(mesh, &points, |i| directions[i]) > 150);
            same_as_brute(mesh, &points, |i| [[0.0, 0.0, -2.0], [1e-40, 3.0, 0.0]][i % 2]);
        }
    }
}

#[test]
fn no_line_slips_through_at_edges_and_corners() {
    // Lines to places of a closed mesh: they meet it, whatever the rounding; at corners, in edges, within faces.
    let d = &mut TestRandom(2);
    for turn in 0..40 {
        // The first two lie so that nothing is rounded, and lines go through edges and corners exactly.
        let exact = turn < 2;
        let axis = times(if exact { 0.0 } else { 3.0 }, d.direction());
        let mut mesh = if turn % 2 == 0 { cube(1.0) } else { sphere(12, 1.0, [0.3; 3]) };
        let shift = d.point(if exact { 0.0 } else { 1000.0 });
        let rotation = crate::closest::tests::turned(axis);
        for p in &mut mesh.positions {
            *p = plus(rotation(*p), shift);
        }
        let tree = Tree::build(&mesh).unwrap();
        for face in &mesh.faces {
            let [a, b, _] = mesh.places(face);
            for s in [0.0, 0.5, 0.25, 0.25 + 0.2 * d.unit()] {
                let to = plus(times(1.0 - s, a), times(s, b));
                let inside = plus(shift, rotation(if exact { [0.5; 3] } else { [0.4, 0.45, 0.5] }));
                let met = tree.crossing(&inside, minus(to, inside), f64::INFINITY).unwrap();
                assert!(met.is_some(), "turn {turn}: to {to:?}");
            }
        }
    }
}

#[test]
fn a_sphere_and_a_plane_in_closed_form() {
    // A square in the plane z = 0.3 x + 2: along z the deviation is the height above it.
    let z = |x: f64| 0.3 * x + 2.0;
    let positions = [[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]].map(|[x, y]| [x, y, z(x)]).to_vec();
    let tree = Tree::build(&Mesh { positions, faces: vec![[0, 1, 2], [0, 2, 3]] }).unwrap();
    let d = &mut TestRandom(3);
    for _ in 0..200 {
        let p = d.point(8.0);
        let found = tree.crossing(&p, [0.0, 0.0, -7.0], f64::INFINITY).unwrap().unwrap();
        assert!((found.along - (p[2] - z(p[0]))).abs() < 1e-14 * 20.0);
        assert!(norm(minus(found.point, [p[0], p[1], z(p[0])])) < 1e-13);
    }
    // A fine sphere, from within: a line leaves it at the root of a square equation, to the sag of its facets.
    let (center, r) = ([1.0, 2.0, 3.0], 5.0);
    let tree = Tree::build(&sphere(200, r, center)).unwrap();
    let sag = r * (1.0 - (PI / 200.0).cos());
    for _ in 0..200 {
        let (p, direction) = (plus(center, d.point(2.0)), d.direction());
        let from = minus(p, center);
        let b = dot(from, direction);
        let root = (b * b + r * r - dot(from, from)).sqrt();
        let want = if b > 0.0 { root - b } else { -root - b };
        let found = tree.crossing(&p, direction, f64::INFINITY).unwrap().unwrap();
        let slope = root / r;
        assert!((found.along.abs() - want.abs()).abs() < 2.0 * sag / slope, "{found:?} {want}");
    }
}

#[test]
fn what_is_too_far_or_has_no_direction_is_not_met() {
    let tree = Tree::build(&cube(1.0)).unwrap();
    let above = [0.3, 0.4, 3.0];
    let at = |far: f64| tree.crossing(&above, [0.0, 0.0, 1.0], far).unwrap().map(|c| c.along);
    assert_eq!([at(1.9), at(2.0), at(f64::INFINITY)], [None, Some(-2.0), Some(-2.0)]);
    for none in [[0.0; 3], [f64::NAN, 0.0, 1.0], [f64::INFINITY, 0.0, 0.0]] {
        assert_eq!(tree.crossing(&above, none, f64::INFINITY).unwrap(), None);
    }
    assert!(tree.crossing(&[f64::NAN; 3], [1.0, 0.0, 0.0], 1.0).is_err());
    assert!(tree.crossing(&above, [1.0, 0.0, 0.0], -1.0).is_err());
    // Along a side of the cube: the side itself is not met, those at its ends are.
    let along = tree.crossing(&[-2.0, 0.5, 1.0], [1.0, 0.0, 0.0], f64::INFINITY).unwrap();
    assert_eq!(along.map(|c| c.along), Some(2.0));
}

#[test]
fn any_number_of_threads_gives_the_same() {
    let d = &mut TestRandom(4);
    let mesh = sphere(40, 3.0, [0.0; 3]);
    let tree = Tree::build(&mesh).unwrap();
    let points: Vec<Point> = (0..20_000).map(|_| d.point(4.0)).collect();
    let of = |i: usize| Some(cross(points[i], [0.2, 0.3, 1.0]));
    let run = || tree.map_crossings(&points, of, 2.0, &Silent, |_, c| c).unwrap();
    assert_eq!(in_pool(1, run), in_pool(3, run));
    assert!(tree.map_crossings(&points, of, 2.0, &Stop, |_, c| c).is_err());
}
