//! The size and place of a finding, against plain calculations from the facets and vertices it names.

use crate::check::{Finding, KINDS, Options, check};
use crate::mesh::Mesh;
use crate::progress::Silent;
use crate::samples::{planted, sound};
use crate::space::{Aabb, Point};

fn distance(p: Point, q: Point) -> f64 {
    (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>().sqrt()
}

/// Heron's formula.
fn area([a, b, c]: [Point; 3]) -> f64 {
    let [x, y, z] = [distance(a, b), distance(b, c), distance(c, a)];
    let s = (x + y + z) / 2.0;
    (s * (s - x) * (s - y) * (s - z)).sqrt()
}

fn middle(bounds: &Aabb) -> Point {
    std::array::from_fn(|k| (bounds.min[k] + bounds.max[k]) / 2.0)
}

/// Height of a triangle over its longest edge, by Pythagoras.
fn height(corners: [Point; 3]) -> f64 {
    let turns = [0, 1, 2].map(|k| [corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]]);
    let [a, b, c] =
        turns.into_iter().max_by(|p, q| distance(p[0], p[1]).total_cmp(&distance(q[0], q[1]))).unwrap();
    off_line(c, a, b)
}

/// Distance of `p` from the line of `a` and `b`: that from the nearest of many places on it.
fn off_line(p: Point, a: Point, b: Point) -> f64 {
    let along = |t: f64| distance(p, std::array::from_fn(|k| a[k] + t * (b[k] - a[k])));
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..200 {
        let [s, t] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
        if along(s) < along(t) { high = t } else { low = s }
    }
    along(low)
}

/// Facets with an edge between these vertices.
fn at_edge(mesh: &Mesh, [a, b]: [u32; 2]) -> Vec<u32> {
    let has = |f: &u32| [a, b].iter().all(|v| mesh.faces[*f as usize].contains(v));
    (0..mesh.faces.len() as u32).filter(has).collect()
}

/// Size, position and box of the finding, and the facets it must name.
fn plain(kind: &str, mesh: &Mesh, item: &Finding) -> (f64, Point, Aabb, Vec<u32>) {
    let at = |v: &u32| mesh.positions[*v as usize];
    let corners = |f: &u32| mesh.faces[*f as usize].map(|v| at(&v));
    let places: Vec<Point> = item.vertices.iter().map(at).collect();
    let of_facets = Aabb::of(&item.facets.iter().flat_map(corners).collect::<Vec<Point>>());
    let bounds = if places.is_empty() { of_facets } else { Aabb::of(&places) };
    let same = item.facets.clone();
    let ring = |n: usize| (0..n).map(|i| distance(places[i], places[(i + 1) % places.len()])).sum::<f64>();
    match kind {
        "boundary_edges" | "non_manifold_edges" | "inconsistent_orientation" => {
            let facets = at_edge(mesh, [item.vertices[0], item.vertices[1]]);
            (ring(1), middle(&bounds), bounds, facets)
        }
        "holes" => {
            let mean =
                std::array::from_fn(|k| places.iter().map(|p| p[k]).sum::<f64>() / places.len() as f64);
            (ring(places.len()), mean, bounds, vec![])
        }
        "cracks" => (ring(places.len() - 1), middle(&bounds), bounds, vec![]),
        "dangling_facets" => {
            let [a, b, c] = mesh.faces[item.facets[0] as usize];
            let free = [[a, b], [b, c], [c, a]].iter().filter(|e| at_edge(mesh, **e).len() == 1).count();
            (free as f64, middle(&bounds), bounds, same)
        }
        "non_manifold_vertices" => {
            let v = item.vertices[0];
            let facets: Vec<u32> =
                (0..mesh.faces.len() as u32).filter(|f| mesh.faces[*f as usize].contains(&v)).collect();
            (facets.len() as f64, at(&v), bounds, facets)
        }
        "duplicate_facets" => {
            let alike = |f: &u32| mesh.faces[*f as usize] == mesh.faces[same[0] as usize];
            let facets = (0..mesh.faces.len() as u32).filter(alike).collect();
            (area(corners(&same[0])), middle(&bounds), bounds, facets)
        }
        "reversed_normals" => (area(corners(&same[0])), middle(&bounds), bounds, same),
        "degenerate_facets" => {
            let [a, b, c] = corners(&same[0]);
            (distance(a, b).max(distance(b, c)).max(distance(c, a)), middle(&bounds), bounds, same)
        }
        "sliver_facets" => (height(corners(&same[0])), middle(&bounds), bounds, same),
        "t_junctions" => (
            off_line(places[0], places[1], places[2]),
            places[0],
            bounds,
            at_edge(mesh, [item.vertices[1], item.vertices[2]]),
        ),
        "unshared_vertices" => (distance(bounds.min, bounds.max), middle(&bounds), bounds, vec![]),
        // Their shells are blocks.
        "inside_out_shells" | "islands" => {
            let size = if kind == "islands" {
                0.0625
            } else if item.bounds.min[0] >= 20.0 {
                1.0
            } else {
                0.5
            };
            let max = item.bounds.min.map(|x| x + size);
            let bounds = Aabb { min: item.bounds.min, max };
            let inside =
                (0..3).all(|k| bounds.min[k] <= of_facets.min[k] && of_facets.max[k] <= bounds.max[k]);
            assert!(inside, "{item:?}");
            let size = if kind == "islands" { size * 3f64.sqrt() } else { size.powi(3) };
            (size, middle(&bounds), bounds, same)
        }
        "self_intersections" => {
            let x = of_facets.min[0];
            let bounds = Aabb { min: [x + 0.5, 0.5, 0.0], max: [x + 2.0, 2.0, 0.0] };
            (1.5 * 2f64.sqrt(), [x + 1.25, 1.25, 0.0], bounds, vec![same[0], same[0] + 1])
        }
        "not_finite_facets" => (0.0, middle(&sound().finite_bounds()), Aabb::EMPTY, same),
        other => panic!("no calculation for {other}"),
    }
}

#[test]
fn size_and_place_equal_a_plain_calculation() {
    for kind in KINDS {
        let (mesh, normals, _) = planted(kind.name, 5);
        let report = check(&mesh, normals.as_deref(), &Options::default(), &Silent).unwrap();
        for item in &report.found(kind).unwrap().items {
            let (size, position, bounds, facets) = plain(kind.name, &mesh, item);
            assert!((item.size - size).abs() <= 1e-11, "{}: {size}: {item:?}", kind.name);
            assert!(distance(item.position, position) <= 1e-14, "{}: {position:?}: {item:?}", kind.name);
            assert_eq!(item.bounds, bounds, "{}", kind.name);
            assert_eq!(item.facets, facets, "{}", kind.name);
        }
    }
}
