//! The hierarchical winding number against the sum of all solid angles.

use super::*;
use crate::closest::{QueryError, Winding};
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

/// Greatest and mean difference from the definition.
fn error(mesh: &Mesh, points: &[Point]) -> (f64, f64) {
    let tree = Tree::build(mesh).unwrap();
    let numbers = Winding::new(&tree).numbers(points, &Silent).unwrap();
    let errors = points.iter().zip(&numbers).map(|(p, w)| (w - by_definition(mesh, p)).abs());
    let (worst, sum) = errors.fold((0.0, 0.0), |(worst, sum): (f64, f64), e| (worst.max(e), sum + e));
    (worst, sum / points.len() as f64)
}

/// Points in and around a mesh, some near its surface.
fn around(mesh: &Mesh, d: &mut TestRandom, n: usize) -> Vec<Point> {
    let bounds = mesh.bounds();
    let size = bounds.sides().into_iter().fold(0.0, f64::max);
    let center: Point = std::array::from_fn(|k| 0.5 * (bounds.min[k] + bounds.max[k]));
    (0..n)
        .map(|i| match i % 3 {
            0 => plus(mesh.positions[d.bits() as usize % mesh.positions.len()], d.point(0.01 * size)),
            1 => plus(center, d.point(0.7 * size)),
            _ => plus(center, d.point(5.0 * size)),
        })
        .collect()
}

/// However far away, and at places that stand for "no data" in files: an answer, and that of all places outside.
#[test]
fn far_away_nothing_winds_around_a_point() {
    let d = &mut TestRandom(41);
    for (mesh, size) in
        [(cube(1.0), 1.0), (cube(2.0), 2.0), (cube(100.0), 100.0), (sphere(20, 3.0, [0.0; 3]), 3.0)]
    {
        let tree = Tree::build(&mesh).unwrap();
        let winding = Winding::new(&tree);
        let mut points: Vec<Point> = vec![];
        for exponent in 7..58 {
            let far = 10f64.powi(exponent);
            points.extend([[far; 3], [size * far; 3], [-far; 3], [far, far, far + 10.0], [far, 0.5, 0.5]]);
            points.push(d.point(far));
            points.push([0.5 * size + far, 0.5 * size + far, 0.5 * size + far]);
        }
        assert!(winding.numbers(&points, &Silent).unwrap().iter().all(|w| w.abs() < 0.05));
        for (limit, expected) in [(0.5, false), (-0.5, true)] {
            let above = winding.above(limit, &points, &Silent).unwrap();
            assert!(above.iter().all(|a| *a == expected), "{size} {limit}");
        }
    }
}

/// Name, mesh, and how often it covers itself.
fn meshes(d: &mut TestRandom) -> Vec<(&'static str, Mesh, f64)> {
    let mut open = sphere(60, 40.0, [1000.0; 3]);
    open.faces.truncate(5000);
    let mut thrice = sphere(30, 1.0, [0.0; 3]);
    thrice.faces = [&thrice.faces[..]; 3].concat();
    let crossing = soup(d, 3000, |d| {
        let c = d.point(10.0);
        std::array::from_fn(|_| plus(c, d.point(0.5)))
    });
    vec![
        ("cube", cube(1.0), 1.0),
        ("sphere", sphere(60, 1.0, [0.5; 3]), 1.0),
        ("sphere at 1e6", sphere(40, 100.0, [1e6; 3]), 1.0),
        ("bowl", open, 1.0),
        ("every face thrice", thrice, 3.0),
        ("soup", crossing, 1.0),
        ("tiny", sphere(30, 1e-12, [0.0; 3]), 1.0),
    ]
}

#[test]
fn differs_little_from_the_sum_of_all_solid_angles() {
    let d = &mut TestRandom(12);
    for (name, mesh, layers) in meshes(d) {
        let (worst, mean) = error(&mesh, &around(&mesh, d, 1500));
        assert!(
            worst < 0.05 * layers && mean < 0.004 * layers,
            "{name}: {worst} at worst, {mean} in the mean"
        );
    }
}

#[test]
fn is_above_a_limit_where_the_definition_is() {
    let d = &mut TestRandom(16);
    let mut narrow = 0;
    for (name, mesh, layers) in meshes(d) {
        let points = around(&mesh, d, 1500);
        let truth: Vec<f64> = points.iter().map(|p| by_definition(&mesh, p)).collect();
        let tree = Tree::build(&mesh).unwrap();
        let winding = Winding::new(&tree);
        for limit in [-0.5, 0.1, 0.5, 0.9, 2.5] {
            let above = winding.above(limit, &points, &Silent).unwrap();
            for (i, (w, above)) in truth.iter().zip(above).enumerate() {
                let clear = (w - limit).abs();
                assert!(clear < 0.01 * layers || above == (*w > limit), "{name}, {limit}: {w}, point {i}");
                narrow += usize::from(clear > 0.01 * layers && clear < 0.05 * layers);
            }
        }
    }
    assert!(narrow > 100, "{narrow} points try what a rough number cannot tell");
}

#[test]
fn a_single_leaf_is_summed_to_single_precision() {
    let d = &mut TestRandom(13);
    for _ in 0..100 {
        let mesh = soup(d, 8, |d| std::array::from_fn(|_| d.point(1.0)));
        let points: Vec<Point> = (0..20).map(|_| d.point(1.5)).collect();
        let (worst, _) = error(&mesh, &points);
        assert!(worst < 1e-5, "{worst}");
    }
}

#[test]
fn full_turns_are_counted() {
    // Nested spheres: the number inside all is their count, of either sense.
    let mut mesh = Mesh::default();
    for (i, turns) in [(1, 5), (2, 5)] {
        for _ in 0..turns {
            let s = sphere(12, i as f64, [0.0; 3]);
            let first = mesh.positions.len() as u32;
            mesh.positions.extend(s.positions);
            mesh.faces.extend(s.faces.iter().map(|f| f.map(|v| v + first)));
        }
    }
    let points = [[0.0; 3], [0.1, 0.2, 0.3], [1.4, 0.0, 0.3], [3.0, 0.0, 0.0]];
    for (sense, swap) in [(1.0, false), (-1.0, true)] {
        if swap {
            mesh.faces.iter_mut().for_each(|f| f.swap(1, 2));
        }
        let tree = Tree::build(&mesh).unwrap();
        let numbers = Winding::new(&tree).numbers(&points, &Silent).unwrap();
        for (got, want) in numbers.iter().zip([10.0, 10.0, 5.0, 0.0]) {
            assert!((got - sense * want).abs() < 0.3, "{numbers:?}");
        }
    }
}

#[test]
fn points_on_corners_and_edges_have_a_number() {
    let mesh = cube(1.0);
    let tree = Tree::build(&mesh).unwrap();
    let mut points = mesh.positions.clone();
    points.extend([[0.5, 0.0, 0.0], [0.5, 0.5, 0.0], [0.25, 0.5, 1.0]]);
    let numbers = Winding::new(&tree).numbers(&points, &Silent).unwrap();
    assert!(numbers.iter().all(|w| w.is_finite()), "{numbers:?}");
}

#[test]
fn does_not_depend_on_neighbors_or_threads() {
    let d = &mut TestRandom(14);
    let mesh = sphere(40, 1.0, [0.0; 3]);
    let tree = Tree::build(&mesh).unwrap();
    let winding = Winding::new(&tree);
    let points = around(&mesh, d, 3000);
    let ask = |points: &[Point]| -> Vec<u64> {
        winding.numbers(points, &Silent).unwrap().into_iter().map(f64::to_bits).collect()
    };
    let all = in_pool(1, || ask(&points));
    assert_eq!(all, in_pool(5, || ask(&points)));
    for i in (0..points.len()).step_by(50) {
        assert_eq!(ask(&points[i..=i]), all[i..=i], "point {i} alone");
    }
}

/// To the last bit, also on the surface, where the last bit decides the side.
#[test]
fn instruction_sets_agree() {
    let d = &mut TestRandom(15);
    let mesh = sphere(40, 1.0, [0.0; 3]);
    let tree = Tree::build(&mesh).unwrap();
    let winding = Winding::new(&tree);
    let mut places = around(&mesh, d, 1600);
    places.extend(&mesh.positions[..1600]);
    for part in places.chunks_exact(16) {
        let points: &[Point; 16] = part.try_into().unwrap();
        let ask = |level| winding.block(level, points, 0xffff, 3.0, &mut vec![]).map(f64::to_bits);
        let plain = ask(Level::Plain);
        assert_eq!((plain, plain), (ask(Level::Avx2), ask(Level::Avx512)));
    }
}

#[test]
fn refuses_bad_points_and_stops_when_asked() {
    let tree = Tree::build(&cube(1.0)).unwrap();
    let winding = Winding::new(&tree);
    assert_eq!(winding.numbers(&[[0.0; 3], [f64::NAN; 3]], &Silent), Err(QueryError::BadPoint(1)));
    assert!(matches!(winding.numbers(&[[0.0; 3]], &Stop), Err(QueryError::Cancelled(_))));
    assert_eq!(winding.numbers(&[], &Silent), Ok(vec![]));
}
