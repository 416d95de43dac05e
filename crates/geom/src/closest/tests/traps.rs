//! Inputs on which other programs went wrong, from their public issue threads, and the right answers.

use super::*;
use crate::closest::{Signs, Winding};
use crate::space::{minus, norm, times};

fn one_triangle(a: Point, b: Point, c: Point) -> Mesh {
    Mesh { positions: vec![a, b, c], faces: vec![[0, 1, 2]] }
}

fn closest(mesh: &Mesh, p: Point) -> Closest {
    Tree::build(mesh).unwrap().closest(&p, f64::INFINITY).unwrap().unwrap()
}

fn signed(mesh: &Mesh, points: &[Point]) -> Vec<f64> {
    let tree = Tree::build(mesh).unwrap();
    Signs::new(&tree).distances(points, &Query::default(), &Silent).unwrap()
}

/// Open3D 5105: wrong sign at edges and corners.
#[test]
fn sign_before_an_edge_and_a_corner() {
    let d = signed(&cube(1.0), &[[-1.0, -1.0, 0.0], [-1.0, -1.0, -1.0], [0.5; 3]]);
    assert_eq!(d, [2f64.sqrt(), 3f64.sqrt(), -0.5]);
}

/// trimesh 73: several faces equally near.
#[test]
fn sign_where_faces_tie() {
    assert_eq!(signed(&cube(2.0), &[[3.0, 2.0, 2.0]]), [1.0]);
}

/// parry 76: a triangle with two equal corners.
#[test]
fn degenerate_triangle() {
    let b = [-0.569999993, -8.10000038, 16.6070004];
    let mesh = one_triangle([2.27699995, -7.9000001, 16.3180008], b, b);
    let d = closest(&mesh, [1.10000002, -7.9000001, 16.5879993]).distance;
    assert!((d - 0.1714783).abs() < 5e-8, "{d}");
}

/// CloudCompare 2247: not-a-number now and then.
#[test]
fn a_thousand_runs_give_the_same_numbers() {
    let mesh = one_triangle([0.0; 3], [0.0, 0.5, 0.0], [0.5, 0.0, 0.0]);
    let points = [[0.0, 0.0, 8e-6], [0.0, 0.5, 0.0], [0.5, 0.0, 0.0]];
    for _ in 0..1000 {
        let tree = Tree::build(&mesh).unwrap();
        assert_eq!(tree.distances(&points, &Query::default(), &Silent).unwrap(), [8e-6, 0.0, 0.0]);
        let d = Signs::new(&tree).distances(&points, &Query::default(), &Silent).unwrap();
        // The face looks down: the point above is inside.
        assert_eq!(d, [-8e-6, 0.0, 0.0]);
    }
}

/// CloudCompare 1976: wrong side near the planes of the faces.
#[test]
fn everything_outside_a_box_is_positive() {
    let d = &mut TestRandom(76);
    let mut points = vec![];
    while points.len() < 30_000 {
        let mut p = d.point(3.0);
        if points.len() % 2 == 0 {
            // Near the plane of a face, on either side of it and in it.
            let k = d.bits() as usize % 3;
            p[k] = if d.bits() & 1 == 0 { 0.0 } else { 1.0 };
            p[k] += [0.0, 1e-16, -1e-16, 1e-12, -1e-12, 1e-6, -1e-6][d.bits() as usize % 7];
        }
        if p.iter().any(|x| !(0.0..=1.0).contains(x)) {
            points.push(p);
        }
    }
    for (p, d) in points.iter().zip(signed(&cube(1.0), &points)) {
        assert!(d > 0.0 || p.iter().all(|x| (-2e-16..=1.0 + 3e-16).contains(x)), "{d} at {p:?}");
    }
}

/// trimesh 310: points around an obtuse triangle.
#[test]
fn obtuse_triangle() {
    let t = [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [12.0, 1.0, 0.0]];
    let mesh = one_triangle(t[0], t[1], t[2]);
    let to_segment = |p: Point, a: Point, b: Point| {
        // By trying many places: no formula to get wrong.
        (0..=20_000)
            .map(|i| norm(minus(p, plus(a, times(i as f64 / 20_000.0, minus(b, a))))))
            .fold(f64::INFINITY, f64::min)
    };
    for i in 0..72 {
        let a = PI * i as f64 / 36.0;
        for (r, height) in [(1.0, 0.0), (8.0, 2.0), (15.0, 0.0)] {
            let p = [6.0 + r * a.cos(), 0.4 + r * a.sin(), height];
            let side = |a: Point, b: Point| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
            let inside = (0..3).all(|k| side(t[k], t[(k + 1) % 3]) >= 0.0);
            let rim = (0..3).map(|k| to_segment(p, t[k], t[(k + 1) % 3])).fold(f64::INFINITY, f64::min);
            let want = if inside { height.abs() } else { rim };
            let got = closest(&mesh, p).distance;
            assert!((got - want).abs() < 1e-6, "{got} instead of {want} at {p:?}");
        }
    }
}

/// libigl 644: a face doubled in opposite orientation spoils the pseudonormals, not the winding number.
#[test]
fn doubled_opposite_face() {
    let mut mesh = cube(1.0);
    let mut twin = mesh.faces[3];
    twin.swap(0, 1);
    mesh.faces.push(twin);
    mesh.faces.push(mesh.faces[3]);
    let tree = Tree::build(&mesh).unwrap();
    assert!(Signs::new(&tree).loose_edges() > 0, "flagged");
    let d = &mut TestRandom(644);
    let points: Vec<Point> = (0..2000).map(|_| plus([0.5; 3], d.point(1.0))).collect();
    let numbers = Winding::new(&tree).numbers(&points, &Silent).unwrap();
    for (p, w) in points.iter().zip(numbers) {
        let inside = p.iter().all(|x| (0.0..1.0).contains(x));
        assert_eq!(w > 0.5, inside, "{w} at {p:?}");
    }
}

/// libigl 1060 and 2348: a fractional winding number must not scale the distance.
#[test]
fn fractional_winding_leaves_the_size_alone() {
    // Half a box: winding numbers between 0 and 1 everywhere.
    let mut mesh = cube(1.0);
    mesh.faces.truncate(6);
    let tree = Tree::build(&mesh).unwrap();
    let (signs, winding) = (Signs::new(&tree), Winding::new(&tree));
    let d = &mut TestRandom(2348);
    let points: Vec<Point> = (0..2000).map(|_| plus([0.5; 3], d.point(1.0))).collect();
    let numbers = winding.numbers(&points, &Silent).unwrap();
    assert!(numbers.iter().any(|w| (0.2..0.8).contains(w)));
    let unsigned = tree.distances(&points, &Query::default(), &Silent).unwrap();
    let signed = signs.distances(&points, &Query::default(), &Silent).unwrap();
    assert!(unsigned.iter().zip(&signed).all(|(u, s)| *u == s.abs()));
}

/// Open3D 5669: single wrong signs in a grid around a sphere.
#[test]
fn no_speckle_around_a_sphere() {
    let mesh = sphere(40, 0.8, [0.0; 3]);
    let step = |i: usize| -1.0 + 2.0 * i as f64 / 63.0;
    let points: Vec<Point> =
        (0..64 * 64 * 64).map(|i| [step(i % 64), step(i / 64 % 64), step(i / 4096)]).collect();
    // The faces lie inside the sphere, by less than this.
    let chord = 0.8 * (1.0 - (PI / 40.0).cos()) * 2.0;
    for (p, d) in points.iter().zip(signed(&mesh, &points)) {
        let want = norm(*p) - 0.8;
        assert!(
            (-chord..=0.0).contains(&want) || (want > 0.0) == (d > 0.0),
            "{d} at {p:?}, {want} from the sphere"
        );
    }
}
