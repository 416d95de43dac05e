use super::*;
use crate::closest::brute;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::space::{dot, minus};

/// The paper's steps one after the other, over all facets, as the text has them.
fn twin(mesh: &Mesh, m: &Point) -> f64 {
    let place = |v: u32| mesh.positions[v as usize];
    let corners: Vec<[Point; 3]> = mesh.faces.iter().map(|f| f.map(place)).collect();
    let all = || corners.iter().flatten();
    let extent = |k: usize| {
        all().map(|p| p[k]).fold(f64::MIN, f64::max) - all().map(|p| p[k]).fold(f64::MAX, f64::min)
    };
    let mut search = (extent(0) + extent(1) + extent(2)) / 300.0;
    let inside = |p: &Point, search: f64| (0..3).all(|k| m[k] - search <= p[k] && p[k] <= m[k] + search);
    while corners.iter().filter(|f| f.iter().any(|p| inside(p, search))).count() < corners.len().min(10) {
        search *= 2.0;
    }
    let length =
        |p: &Point, q: &Point| ((p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2) + (p[2] - q[2]).powi(2)).sqrt();
    let used =
        (0..mesh.positions.len() as u32).filter(|v| mesh.faces.iter().flatten().any(|u| u == v)).map(place);
    let nearest = used.filter(|p| inside(p, search)).fold(None, |best: Option<Point>, p| match best {
        Some(b) if length(m, &b) <= length(m, &p) => Some(b),
        _ => Some(p),
    });
    let nearest = nearest.unwrap();
    if nearest == *m {
        return 0.0;
    }
    let around = corners.iter().filter(|f| f.contains(&nearest));
    around
        .map(|[a, b, c]| {
            let obtuse = |p: &Point, q: &Point| {
                length(m, p).powi(2) + length(p, q).powi(2) - length(m, q).powi(2) < 0.0
            };
            let [xa, ya, za] = *a;
            let normal = [
                (b[1] - ya) * (c[2] - za) - (c[1] - ya) * (b[2] - za),
                -((b[0] - xa) * (c[2] - za) - (c[0] - xa) * (b[2] - za)),
                (b[0] - xa) * (c[1] - ya) - (c[0] - xa) * (b[1] - ya),
            ];
            let size = (normal[0].powi(2) + normal[1].powi(2) + normal[2].powi(2)).sqrt();
            let ordered = [(a, b), (b, a), (b, c), (c, b), (c, a), (a, c)];
            if size > 0.0 && !ordered.iter().any(|(p, q)| obtuse(p, q)) {
                return (normal[0] * (m[0] - xa) + normal[1] * (m[1] - ya) + normal[2] * (m[2] - za)).abs()
                    / size;
            }
            let segment = |p: &Point, q: &Point| {
                if p == q || obtuse(p, q) {
                    length(m, p)
                } else if obtuse(q, p) {
                    length(m, q)
                } else {
                    // Heron's triangle instead of (15): a height from three lengths.
                    let base = length(p, q);
                    let along = (length(m, p).powi(2) + base.powi(2) - length(m, q).powi(2)) / (2.0 * base);
                    (length(m, p).powi(2) - along.powi(2)).max(0.0).sqrt()
                }
            };
            [(a, b), (b, c), (c, a)].iter().map(|(p, q)| segment(p, q)).fold(f64::INFINITY, f64::min)
        })
        .fold(f64::INFINITY, f64::min)
}

fn grid(side: usize, stretch: f64, random: &mut Random) -> Mesh {
    let mut positions = vec![];
    for i in 0..=side {
        for j in 0..=side {
            positions.push([stretch * i as f64 + 0.3 * random.unit(), j as f64, random.unit()]);
        }
    }
    let at = |i: usize, j: usize| (i * (side + 1) + j) as u32;
    let cells = (0..side).flat_map(|i| (0..side).map(move |j| (i, j)));
    let faces = cells.flat_map(|(i, j)| {
        [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]
    });
    Mesh { faces: faces.collect(), positions }
}

fn some_points(mesh: &Mesh, count: usize, random: &mut Random) -> Vec<Point> {
    let (b, mut points) = (mesh.bounds(), vec![]);
    for _ in 0..count {
        points.push(std::array::from_fn(|k| b.min[k] + (b.max[k] - b.min[k]) * (1.4 * random.unit() - 0.2)));
        let v = mesh.positions[random.below(mesh.positions.len() as u64) as usize];
        points.push(v.map(|x| x + 0.1 * (random.unit() - 0.5)));
        points.push(v);
    }
    points
}

#[test]
fn equals_the_text_word_for_word() {
    let mut random = Random::new(11);
    let mut meshes = vec![
        grid(9, 1.0, &mut random),
        grid(7, 20.0, &mut random),
        grid(2, 1.0, &mut random),
        grid(1, 3.0, &mut random),
    ];
    // Facets without area, a stray position, doubled positions (a facet soup).
    meshes[1].faces.push([3, 3, 8]);
    meshes[1].faces.push([5, 5, 5]);
    meshes[0].positions.push([4.0, 4.0, 9.0]);
    let soup = &meshes[0];
    let positions: Vec<Point> = soup.faces.iter().flatten().map(|v| soup.positions[*v as usize]).collect();
    let faces = (0..soup.faces.len() as u32).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect();
    meshes.push(Mesh { positions, faces });
    for mesh in &meshes {
        let points = some_points(mesh, 150, &mut random);
        let found = distances(mesh, &points, &Silent).unwrap();
        for (p, d) in points.iter().zip(found) {
            let expected = twin(mesh, p);
            // Heights from three lengths lose half the digits near the segment.
            assert!((d - expected).abs() < 1e-6, "{p:?}: {d} is not {expected}");
        }
    }
}

/// An equilateral facet: beside it but within the three slabs the paper measures to the plane.
#[test]
fn passes_the_angles_beside_the_facet() {
    let h = 3f64.sqrt() / 2.0;
    let mesh = Mesh { positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.5, h, 0.0]], faces: vec![[0, 1, 2]] };
    let beside = [0.5, -0.1, 0.2];
    let found = Paper::new(&mesh).unwrap().values(&[beside], &Silent).unwrap();
    assert!((found[0].distance - 0.2).abs() < 1e-15);
    let exact = brute::closest(&mesh, &beside).0.sqrt();
    assert!((exact - 0.05f64.sqrt()).abs() < 1e-15);
    let mut differences = Differences::default();
    differences.push(&found, &[exact]);
    differences.push(&found, &[f64::NAN]);
    assert_eq!((differences.count, differences.differing, differences.too_small), (1, 1, 1));
    assert!((differences.max_difference - (exact - 0.2)).abs() < 1e-15);
    assert!((differences.median_difference().unwrap() / (exact - 0.2) - 1.0).abs() < 1e-4);
}

/// A long facet whose vertices are all farther than that of a small one nearby: the wrong facet is measured.
#[test]
fn misses_long_facets() {
    let mesh = Mesh {
        positions: vec![
            [-50.0, -50.0, 0.0],
            [50.0, -50.0, 0.0],
            [0.0, 90.0, 0.0],
            [0.0, 0.0, 9.0],
            [1.0, 0.0, 9.0],
            [0.0, 1.0, 9.0],
        ],
        faces: vec![[0, 1, 2], [3, 4, 5]],
    };
    let found = distances(&mesh, &[[0.2, 0.2, 1.0]], &Silent).unwrap();
    assert!((found[0] - 8.0).abs() < 1e-14);
}

/// Where the angles decide rightly, rounding is the only difference: it must be covered by the bound.
#[test]
fn the_bound_covers_rounding() {
    let mut random = Random::new(21);
    let (mut compared, mut largest): (u32, f64) = (0, 0.0);
    for _ in 0..20_000 {
        let thin = 10f64.powf(-6.0 * random.unit());
        let mut corner = |size: f64| [0; 3].map(|_| size * random.unit());
        let (a, b, aside) = (corner(100.0), corner(100.0), corner(100.0 * thin));
        let t = [a, b, std::array::from_fn(|k| 0.5 * (a[k] + b[k]) + aside[k])];
        let w = [0.2 + random.unit(), 0.2 + random.unit(), 0.2 + random.unit()].map(|x| x / 3.0);
        let total = w[0] + w[1] + w[2];
        let m = std::array::from_fn(|k| {
            (0..3).map(|i| w[i] / total * t[i][k]).sum::<f64>() + 1e-3 * (random.unit() - 0.5)
        });
        let value = facet::least(&m, [t].into_iter());
        // Another first corner: other roundings.
        let mesh = Mesh { positions: t.to_vec(), faces: vec![[1, 2, 0]] };
        let exact = brute::closest(&mesh, &m).0.sqrt();
        let off = (value.distance - exact).abs();
        // Points that the angles send to the edges differ truly.
        let along = |p: usize, q: usize| dot(minus(m, t[p]), minus(t[q], t[p]));
        if (0..3).all(|k| along(k, (k + 1) % 3) > 0.0 && along((k + 1) % 3, k) > 0.0) {
            assert!(off <= value.rounding, "{off} exceeds {}", value.rounding);
            largest = largest.max(off / value.rounding);
            compared += 1;
        }
    }
    assert!(compared > 1_000 && largest > 1e-2, "{compared} {largest}");
}

#[test]
fn the_same_for_any_number_of_threads_and_refuses_nonsense() {
    let mut random = Random::new(31);
    let mesh = grid(20, 1.0, &mut random);
    let points = some_points(&mesh, 1000, &mut random);
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| distances(&mesh, &points, &Silent)).unwrap()
    };
    assert_eq!(run(1), run(4));
    assert_eq!(distances(&Mesh::default(), &points, &Silent), Err(PaperError::Mesh(MeshError::NoFaces)));
    let bad = [[0.0; 3], [f64::NAN, 0.0, 0.0]];
    assert_eq!(distances(&mesh, &bad, &Silent), Err(PaperError::Query(QueryError::BadPoint(1))));
    let dot = Mesh { positions: vec![[1.0, 2.0, 2.0]], faces: vec![[0, 0, 0]] };
    assert_eq!(distances(&dot, &[[0.0; 3], [1.0, 2.0, 2.0]], &Silent).unwrap(), [3.0, 0.0]);
    struct Stop;
    impl Progress for Stop {
        fn cancelled(&self) -> bool {
            true
        }
    }
    assert_eq!(distances(&mesh, &points, &Stop), Err(PaperError::Query(QueryError::Cancelled(Cancelled))));
}
