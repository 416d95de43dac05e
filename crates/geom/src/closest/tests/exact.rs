//! The search against the brute-force twin, bit for bit: least squared distance and lowest face.

use super::*;
use crate::closest::{Feature, MeshError, QueryError, brute};
use crate::progress::Cancelled;
use crate::space::{minus, norm, times};

/// Points of every kind around `mesh`: on its corners, edges and faces, near, and far.
fn around(mesh: &Mesh, d: &mut TestRandom, n: usize) -> Vec<Point> {
    let bounds = mesh.bounds();
    let size = bounds.sides().into_iter().fold(1e-300, f64::max);
    let center: Point = std::array::from_fn(|k| 0.5 * (bounds.min[k] + bounds.max[k]));
    let mut points = vec![center];
    for i in 0..n {
        let c = mesh.faces[d.bits() as usize % mesh.faces.len()].map(|v| mesh.positions[v as usize]);
        let (s, t) = (d.unit().abs(), d.unit().abs());
        let (s, t) = if s + t > 1.0 { (1.0 - s, 1.0 - t) } else { (s, t) };
        let on = plus(c[0], plus(times(s, minus(c[1], c[0])), times(t, minus(c[2], c[0]))));
        let far = match i % 128 {
            7 => 1e6,
            71 => 1e22,
            _ => 20.0,
        };
        points.push(match i % 8 {
            0 => c[i % 3],
            1 => times(0.5, plus(c[0], c[1])),
            2 => on,
            3 => plus(on, d.point(1e-9 * size)),
            4 => plus(on, d.point(1e-4 * size)),
            5 => plus(on, d.point(0.02 * size)),
            6 => plus(center, d.point(0.8 * size)),
            _ => plus(center, d.point(far * size)),
        });
    }
    points
}

fn check(name: &str, mesh: Mesh, d: &mut TestRandom, n: usize) {
    let tree = Tree::build(&mesh).unwrap();
    let points = around(&mesh, d, n);
    let want: Vec<_> = points.iter().map(|p| brute::closest(&mesh, p)).collect();
    for level in LEVELS {
        for (i, (h, w)) in hits(&tree, &points, &with(level)).iter().zip(&want).enumerate() {
            let h = h.unwrap();
            assert_eq!(
                (h.distance_squared.to_bits(), h.face),
                (w.0.to_bits(), w.1),
                "{name}, {level:?}, point {i} {:?}: {} in face {}, brute force {} in face {}",
                points[i],
                h.distance_squared,
                h.face,
                w.0,
                w.1
            );
        }
    }
    for (p, w) in points.iter().zip(&want) {
        place_is_right(&mesh, p, *w, &tree.closest(p, f64::INFINITY).unwrap().unwrap());
    }
}

/// The single query gives the same face, and a place on it at the distance it says.
fn place_is_right(mesh: &Mesh, p: &Point, want: (f64, u32), got: &Closest) {
    assert_eq!((got.distance.to_bits(), got.face), (want.0.sqrt().to_bits(), want.1), "at {p:?}");
    let corners = mesh.corners(got.face);
    let extent = corners.iter().chain([p]).flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
    // Rounding of the foot: a needle's plane is known to 1e-16 / 3e-8 of the distance from it.
    let slack = 1e-14 * extent + 1e-8 * got.distance;
    assert!((norm(minus(*p, got.point)) - got.distance).abs() <= slack, "{got:?} from {p:?}");
    let b = got.barycentric;
    assert!(b.iter().all(|x| (0.0..=1.0).contains(x)) && (b[0] + b[1] + b[2] - 1.0).abs() < 1e-12, "{got:?}");
    // Weights of a needle are known to 1e-16 over the sine of its angle, at least 3e-8.
    let longest = (0..3).map(|k| norm(minus(corners[k], corners[(k + 1) % 3]))).fold(0.0, f64::max);
    let mean = (0..3).fold([0.0; 3], |m, k| plus(m, times(b[k], corners[k])));
    assert!(norm(minus(mean, got.point)) <= slack + 1e-7 * longest, "{got:?}: mean {mean:?}");
    match got.feature {
        Feature::Face => {}
        Feature::Edge(i) => assert_eq!(b[(i as usize + 2) % 3], 0.0),
        Feature::Vertex(i) => assert_eq!((b[i as usize], got.point), (1.0, corners[i as usize])),
    }
}

#[test]
fn soups_equal_brute_force() {
    let d = &mut TestRandom(1);
    let large = |d: &mut TestRandom| std::array::from_fn(|_| d.point(1.0));
    for (name, faces, points) in
        [("one", 1, 400), ("eight", 8, 400), ("nine", 9, 400), ("crossing", 700, 1500)]
    {
        check(name, soup(d, faces, large), d, points);
    }
    let small = |d: &mut TestRandom| {
        let c = d.point(10.0);
        std::array::from_fn(|_| plus(c, d.point(0.2)))
    };
    check("small triangles", soup(d, 3000, small), d, 1500);
}

/// Few points make one wide block, whose outer points have other winners than its center.
#[test]
fn wide_blocks_equal_brute_force() {
    let d = &mut TestRandom(7);
    for round in 0..3000 {
        let small = |d: &mut TestRandom| {
            let c = d.point([0.5, 2.0, 3.0][round % 3]);
            std::array::from_fn(|_| plus(c, d.point(0.02)))
        };
        let mesh = soup(d, 2 + round % 30, small);
        let points: Vec<Point> = (0..2 + round % 15).map(|_| d.point(1.0)).collect();
        let tree = Tree::build(&mesh).unwrap();
        for (p, h) in points.iter().zip(hits(&tree, &points, &Query::default())) {
            let h = h.unwrap();
            assert_eq!((h.distance_squared, h.face), brute::closest(&mesh, p), "round {round} at {p:?}");
        }
    }
}

#[test]
fn degenerate_triangles_equal_brute_force() {
    let d = &mut TestRandom(4);
    let thin = |d: &mut TestRandom, width: f64| {
        let (c, e) = (d.point(10.0), d.point(3.0));
        [c, plus(c, e), plus(plus(c, times(0.4, e)), d.point(width))]
    };
    check("needles", soup(d, 1000, |d| thin(d, 1e-7)), d, 700);
    let any_width = |d: &mut TestRandom| {
        let width = 10f64.powf(-4.0 + 8.0 * d.unit()).min(1.0);
        thin(d, width)
    };
    check("slivers at the limit of the plane", soup(d, 1000, any_width), d, 1500);
    let segment = |d: &mut TestRandom| {
        let (c, e) = (d.point(10.0), d.point(1.0));
        [c, plus(c, e), if d.unit() > 0.0 { c } else { plus(c, times(0.5, e)) }]
    };
    check("segments", soup(d, 1000, segment), d, 700);
    // As in drawings: what is left of a side after taking its part along another is rounding that points along it.
    let on_a_line = |d: &mut TestRandom| {
        let whole = |p: Point| p.map(f64::round);
        let (c, e) = (whole(d.point(20.0)), whole(d.point(3.0)));
        [c, plus(c, times(2.0, e)), plus(c, e)]
    };
    check("corners on a line of a grid", soup(d, 1000, on_a_line), d, 700);
    check("points", soup(d, 500, |d| [d.point(10.0); 3]), d, 500);
    check("all in one place", soup(d, 100, |_| [[1.0, 2.0, 3.0]; 3]), d, 200);
}

#[test]
fn closed_meshes_equal_brute_force() {
    let d = &mut TestRandom(5);
    let mut tripled = sphere(12, 5.0, [0.0; 3]);
    tripled.faces = [&tripled.faces[..]; 3].concat();
    check("each face three times", tripled, d, 1000);
    let mut mixed = sphere(40, 1.0, [0.0; 3]);
    let n = mixed.positions.len() as u32;
    mixed.positions.extend([[-1e4, -1e4, -2.0], [1e4, -1e4, -2.0], [0.0, 1e4, -2.0]]);
    mixed.faces.push([n, n + 1, n + 2]);
    check("mixed sizes", mixed, d, 1500);
    check("sphere", sphere(60, 100.0, [0.0; 3]), d, 3000);
    let mut flat = cube(1.0);
    flat.faces.truncate(2);
    check("flat", flat, d, 500);
}

#[test]
fn any_size_and_place_equals_brute_force() {
    let d = &mut TestRandom(6);
    check("at 1e6", sphere(40, 100.0, [1e6, -1e6, 1e6]), d, 2000);
    check("tiny", sphere(30, 1e-12, [0.0; 3]), d, 1000);
    check("minute", sphere(30, 1e-30, [0.0; 3]), d, 1000);
    check("huge", sphere(30, 1e30, [0.0; 3]), d, 1000);
    check("of few numbers", sphere(12, 1.0, [1e14, 0.0, 0.0]), d, 1000);
    // Points are nearer to the sphere than a place on it can be told, for the length of the whole.
    let mut long = sphere(12, 5.0, [0.0, 0.0, 2e12 - 8e8]);
    let first = long.positions.len() as u32;
    long.positions.extend([[0.0, 0.0, 2e12], [6.0, 0.0, 2e12], [0.0, 6.0, 2e12]]);
    long.faces.push([first, first + 1, first + 2]);
    for _ in 0..20 {
        check("long and far", long.clone(), d, 500);
    }
}

#[test]
fn same_bytes_whatever_the_threads_and_the_order() {
    let d = &mut TestRandom(2);
    let mesh = sphere(100, 50.0, [3.0; 3]);
    let near = |d: &mut TestRandom| plus([3.0; 3], times(50.05, d.direction()));
    let points: Vec<Point> = (0..60_000).map(|i| if i % 2 == 0 { d.point(80.0) } else { near(d) }).collect();
    let ask = |threads: usize, points: &[Point]| {
        in_pool(threads, || hits(&Tree::build(&mesh).unwrap(), points, &Query::default()))
    };
    let one = ask(1, &points);
    assert_eq!(one, ask(2, &points));
    assert_eq!(one, ask(5, &points));
    // Another cloud: other blocks, other places to begin at.
    let backwards: Vec<Point> = points.iter().rev().copied().collect();
    let mut other = ask(3, &backwards[..40_000]);
    other.extend(ask(2, &backwards[40_000..]));
    other.reverse();
    assert_eq!(one, other);
}

#[test]
fn refuses_what_cannot_be_measured() {
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, f64::NAN]];
    let build = |faces: Vec<[u32; 3]>| Tree::build(&Mesh { positions: positions.clone(), faces });
    assert_eq!(build(vec![]).err(), Some(MeshError::NoFaces));
    let bad = MeshError::BadIndex { face: 1, vertex: 3, vertices: 3 };
    assert_eq!(build(vec![[0, 1, 1], [0, 1, 3]]).err(), Some(bad));
    assert_eq!(build(vec![[0, 1, 2]]).err(), Some(MeshError::BadVertex(2)));
    let scaled = |by: f64| {
        let positions = vec![[0.0; 3], [by, 0.0, 0.0], [0.0, by, 0.0], [7.0; 3]];
        Tree::build(&Mesh { positions, faces: vec![[0, 1, 2]] }).err()
    };
    assert_eq!(
        [1e-300, 1e-46, 1e-44].map(scaled),
        [Some(MeshError::BadVertex(1)), Some(MeshError::TooSmall), None]
    );
    assert_eq!([0.0, 1e45, 1e46].map(scaled), [None, None, Some(MeshError::BadVertex(1))]);
    let tree = build(vec![[0, 1, 1]]).unwrap();
    let ask = |points: &[Point], max_distance: f64| {
        tree.distances(points, &Query { max_distance, ..Query::default() }, &Silent)
    };
    let far = f64::INFINITY;
    assert_eq!(ask(&[[0.0; 3], [far, 0.0, 0.0]], far), Err(QueryError::BadPoint(1)));
    assert_eq!(ask(&[[0.0, 1.1e60, 0.0]], far), Err(QueryError::BadPoint(0)));
    assert_eq!(ask(&[[0.0, 1.0, 1e-50], [0.0, 1.0, -0.9e-50]], far), Err(QueryError::BadPoint(1)));
    let tiny = Mesh { positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 1e-51]], faces: vec![[0, 1, 2]] };
    assert_eq!(Tree::build(&tiny).err(), Some(MeshError::BadVertex(2)));
    assert_eq!(ask(&[], far), Ok(vec![]));
    assert!(matches!(ask(&[], f64::NAN), Err(QueryError::BadMaxDistance(_))));
    assert_eq!(ask(&[], -1.0), Err(QueryError::BadMaxDistance(-1.0)));
    assert_eq!(tree.closest(&[f64::NAN; 3], far), Err(QueryError::BadPoint(0)));
}

#[test]
fn tells_of_every_point_and_stops_when_asked() {
    #[derive(Default)]
    struct Count(std::sync::atomic::AtomicU64);
    impl Progress for Count {
        fn advance(&self, items: u64) {
            self.0.fetch_add(items, std::sync::atomic::Ordering::Relaxed);
        }
    }
    let tree = Tree::build(&cube(1.0)).unwrap();
    let points = vec![[2.0; 3]; 30_000];
    let count = Count::default();
    tree.distances(&points, &Query::default(), &count).unwrap();
    assert_eq!(count.0.into_inner(), 30_000);
    assert_eq!(tree.distances(&points, &Query::default(), &Stop), Err(QueryError::Cancelled(Cancelled)));
}

/// A needle in the plane of x and y, with whole coordinates, turned and stretched ninefold by a matrix of whole numbers: all
/// exact. Squared distances in the plane follow from whole numbers too.
#[test]
fn needles_keep_their_digits() {
    type Flat = [i64; 2];
    let cross = |o: Flat, a: Flat, b: Flat| {
        let [u, v] = [a, b].map(|p| [p[0] - o[0], p[1] - o[1]].map(i128::from));
        u[0] * v[1] - u[1] * v[0]
    };
    let dot = |o: Flat, a: Flat, b: Flat| {
        let [u, v] = [a, b].map(|p| [p[0] - o[0], p[1] - o[1]].map(i128::from));
        u[0] * v[0] + u[1] * v[1]
    };
    let edge = |p: Flat, a: Flat, b: Flat| {
        let (along, length) = (dot(a, b, p), dot(a, b, b));
        match along {
            _ if along <= 0 => dot(a, p, p) as f64,
            _ if along >= length => dot(b, p, p) as f64,
            _ => (cross(a, b, p) as f64).powi(2) / length as f64,
        }
    };
    let place = |[x, y]: Flat, z: i64| -> Point {
        [[1, -8, 4], [4, 4, 7], [-8, 1, 4]].map(|row: [i64; 3]| (row[0] * x + row[1] * y + row[2] * z) as f64)
    };
    let d = &mut TestRandom(31);
    let mut inside = 0;
    for case in 0..20_000 {
        let long = 1i64 << 44;
        let wide = 1i64 << (d.bits() % 42);
        let mut below = |n: i64| (d.bits() % n as u64) as i64;
        let flat = [[0, 0], [long, below(3) * wide], [below(long), wide]];
        let t = [0, 1, 2].map(|k| flat[(k + case) % 3]);
        let (x, y) = (below(long), below(2 * wide) - wide / 2);
        // Along the needle, and up with the width, the length, or not at all.
        let up = [0, below(4 * wide), below(wide) / 1024, below(long)][case / 3 % 4];
        let p = [x, y + (i128::from(x) * i128::from(flat[1][1] / 2) / i128::from(long)) as i64];
        let turns = [cross(t[0], t[1], p), cross(t[1], t[2], p), cross(t[2], t[0], p)];
        let within = turns.iter().all(|c| *c >= 0) || turns.iter().all(|c| *c <= 0);
        let edges = [edge(p, t[0], t[1]), edge(p, t[1], t[2]), edge(p, t[2], t[0])];
        let flat2 = if within { 0.0 } else { edges.into_iter().fold(f64::INFINITY, f64::min) };
        let want = 9.0 * (flat2 + (up as f64).powi(2)).sqrt();
        let mesh = Mesh { positions: t.map(|c| place(c, 0)).to_vec(), faces: vec![[0, 1, 2]] };
        let (squared, _) = brute::closest(&mesh, &place(p, up));
        let got = squared.sqrt();
        // Distances to edges are differences of the whole length, after some ten roundings of it.
        let limit = 16.0 * f64::EPSILON * 9.0 * long as f64;
        assert!((got - want).abs() <= limit, "{case}: {got} {want}, width {wide} of {long}");
        let found = Tree::build(&mesh).unwrap().closest(&place(p, up), f64::INFINITY).unwrap().unwrap();
        assert_eq!(found.distance.to_bits(), got.to_bits(), "{case}");
        let off = norm(minus(found.point, place(p, up)));
        assert!((off - want).abs() <= 4.0 * limit, "{case}: {off} {want}");
        inside += u32::from(within);
    }
    assert!(inside > 3000, "{inside}");
}
