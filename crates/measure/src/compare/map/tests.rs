//! The map against brute force over every displayed place.

use super::super::coverage::Coverage;
use super::*;
use trueness_document::tolerance::Tolerance;
use trueness_geom::closest::Tree;
use trueness_geom::mesh::Mesh;
use trueness_geom::num::random::Random;
use trueness_geom::space::{Point, cross, dot, minus, norm};

/// A cube from the origin, in 12 facets.
pub fn cube(side: f64) -> Mesh {
    let positions = (0..8u32).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|b| side * f64::from(b))).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]];
    let faces = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    Mesh { positions, faces }
}

/// Points on the faces of the cube with 0.01 mm of noise, a dent of 0.5 mm in the top; nothing measured where `skip` says so.
fn measured(n: usize, side: f64, skip: impl Fn(&Point) -> bool) -> Vec<Point> {
    let mut random = Random::new(7);
    let mut points = vec![];
    while points.len() < n {
        let axis = random.below(3) as usize;
        let mut p = [0.0; 3].map(|_: f64| side * random.unit());
        p[axis] = if random.below(2) == 0 { 0.0 } else { side } + 0.02 * (random.unit() - 0.5);
        let out = axis == 2 && p[2] > 0.5 * side;
        if out {
            let away = (p[0] - 0.5 * side).powi(2) + (p[1] - 0.5 * side).powi(2);
            p[2] -= 0.5 * (-away / 4.0).exp();
        }
        if !skip(&p) {
            points.push(p);
        }
    }
    points
}

/// What brute force knows of a point: its nearest place, deviation, and the outward normal of the facet there.
struct Known {
    foot: Point,
    deviation: f64,
    normal: Point,
}

fn compare(mesh: &Mesh, points: &[Point]) -> (Vec<Known>, Vec<(u32, [f64; 3])>) {
    let tree = Tree::build(mesh).unwrap();
    let mut known = vec![];
    let mut places = vec![];
    for p in points {
        let c = tree.closest(p, f64::INFINITY).unwrap().unwrap();
        let [a, b, d] = mesh.faces[c.face as usize].map(|v| mesh.positions[v as usize]);
        let n = cross(minus(b, a), minus(d, a));
        let normal = n.map(|x| x / norm(n));
        let deviation = c.distance.copysign(dot(minus(*p, c.point), normal));
        known.push(Known { foot: c.point, deviation, normal });
        places.push((c.face, c.barycentric));
    }
    (known, places)
}

fn drawn(
    mesh: &Mesh,
    points: &[Point],
    tolerance: Option<Tolerance>,
) -> (Vec<Known>, MapSurface, Vec<usize>) {
    let (known, places) = compare(mesh, points);
    let mut map = PointMap::new(mesh, tolerance, false);
    for (k, (face, weights)) in known.iter().zip(&places) {
        map.add(map.foot(mesh, *face, *weights), k.deviation);
    }
    let mut order: Vec<usize> = (0..known.len()).collect();
    order.sort_by(|a, b| known[*a].deviation.total_cmp(&known[*b].deviation));
    let flags = vec![order[0], order[1], order[order.len() - 1]];
    let flagged: Vec<Flagged> = flags
        .iter()
        .map(|i| Flagged { face: places[*i].0, weights: places[*i].1, deviation: known[*i].deviation })
        .collect();
    let surface = MapSurface::of(mesh, &map, &flagged, Coverage::Auto);
    (known, surface, flags)
}

/// Vertices with the normals of the faces they belong to.
fn vertex_normals(mesh: &Mesh) -> Vec<Vec<Point>> {
    let mut normals = vec![vec![]; mesh.positions.len()];
    for f in &mesh.faces {
        let [a, b, c] = f.map(|v| mesh.positions[v as usize]);
        let n = cross(minus(b, a), minus(c, a));
        if norm(n) > 1e-12 {
            f.iter().for_each(|v| normals[*v as usize].push(n.map(|x| x / norm(n))));
        }
    }
    normals
}

fn check(mesh: &Mesh, points: &[Point], tolerance: Option<Tolerance>) -> MapSurface {
    let (known, surface, flags) = drawn(mesh, points, tolerance);
    let shown = surface.mesh.as_ref().unwrap_or(mesh);
    let normals = vertex_normals(shown);
    let away = |v: usize, k: &Known| norm(minus(shown.positions[v], k.foot));
    let same_face = |v: usize, k: &Known| normals[v].iter().any(|n| dot(*n, k.normal) > 0.8);
    let badness = |d: f64| tolerance.map_or(d.abs(), |t| (d - t.upper).max(t.lower - d));
    for (v, value) in surface.values.iter().enumerate().filter(|(v, _)| !normals[*v].is_empty()) {
        let near = || known.iter().filter(|k| same_face(v, k) && away(v, k) <= surface.reach);
        if value.is_nan() {
            // Gray: no point within what every place looks through at least.
            let least =
                known.iter().filter(|k| same_face(v, k)).map(|k| away(v, k)).fold(f64::INFINITY, f64::min);
            assert!(least > 0.2 * surface.reach, "gray at {:?}, a point {least} away", shown.positions[v]);
        } else {
            let real = near().any(|k| k.deviation.to_bits() == value.to_bits());
            assert!(real, "{value} at {:?} is no point's within {}", shown.positions[v], surface.reach);
        }
    }
    // No point is hidden: near each one is a place at least as bad.
    for k in &known {
        let seen = (0..surface.values.len()).any(|v| {
            same_face(v, k)
                && away(v, k) <= surface.reach
                && badness(surface.values[v]) >= badness(k.deviation)
        });
        assert!(seen, "{} at {:?} is shown nowhere", k.deviation, k.foot);
    }
    assert_eq!(surface.keep.len(), flags.len());
    for i in flags {
        let there = |v: &&u32| {
            surface.values[**v as usize] == known[i].deviation && away(**v as usize, &known[i]) < 1e-6
        };
        assert!(surface.keep.iter().any(|v| there(&v)));
    }
    surface
}

#[test]
fn a_dent_between_the_vertices_of_a_coarse_cube() {
    let mesh = cube(20.0);
    let points = measured(6000, 20.0, |_| false);
    let surface = check(&mesh, &points, Some(Tolerance { lower: -0.1, upper: 0.1 }));
    let shown = surface.mesh.as_ref().unwrap();
    assert!((3000..12_000).contains(&shown.positions.len()), "{}", shown.positions.len());
    // Four times as far as the points are apart.
    assert!(surface.reach < 4.0 * (6.0 * 400.0f64 / 6000.0).sqrt(), "{}", surface.reach);
    // The dent is seen where it is, and the other faces stay within tolerance up to their edges.
    let normals = vertex_normals(shown);
    for (v, value) in surface.values.iter().enumerate().filter(|(v, _)| !normals[*v].is_empty()) {
        let p = shown.positions[v];
        let top = normals[v].iter().any(|n| n[2] > 0.9);
        assert!(!value.is_nan());
        assert!(top || value.abs() <= 0.011, "{value} at {p:?}");
        let center = (p[0] - 10.0).hypot(p[1] - 10.0);
        assert!(!top || center > 1.0 || *value < -0.3, "{value} in the dent at {p:?}");
        assert!(!top || center < 5.0 || value.abs() <= 0.03, "{value} beside the dent at {p:?}");
    }
}

#[test]
fn what_was_not_measured_is_gray() {
    let mesh = cube(20.0);
    let points = measured(4000, 20.0, |p| p[0] < 8.0);
    let surface = check(&mesh, &points, None);
    let shown = surface.mesh.as_ref().unwrap();
    let gray = |v: usize| surface.values[v].is_nan();
    for (v, p) in shown.positions.iter().enumerate() {
        assert!(p[0] > 8.0 - surface.reach || gray(v), "{p:?}");
        assert!(p[0] < 9.0 || !gray(v), "{p:?}");
    }
}

#[test]
fn an_asymmetric_zone_decides_what_is_worst() {
    let mesh = cube(20.0);
    // Everywhere +0.4, which is allowed, and among it -0.2, which is not.
    let mut random = Random::new(3);
    let points: Vec<Point> = (0..3000)
        .map(|i| [20.0 * random.unit(), 20.0 * random.unit(), if i % 2 == 0 { 20.4 } else { 19.8 }])
        .filter(|p| p[0].min(p[1]) > 1.0 && p[0].max(p[1]) < 19.0)
        .collect();
    let surface = check(&mesh, &points, Some(Tolerance { lower: -0.1, upper: 0.5 }));
    let shown = surface.values.iter().filter(|v| !v.is_nan()).count();
    let low = surface.values.iter().filter(|v| **v < -0.1).count();
    assert!(low > shown / 2, "{low} of {shown}");
}

#[test]
fn a_fine_reference_keeps_its_facets_and_few_points_leave_most_gray() {
    let mut mesh = cube(20.0);
    let refined = {
        let points = measured(6000, 20.0, |_| false);
        drawn(&mesh, &points, None).1.mesh.unwrap()
    };
    mesh = refined;
    let surface = check(&mesh, &measured(3000, 20.0, |_| false), None);
    assert!(surface.keep.len() == 3 && surface.values.iter().filter(|v| v.is_nan()).count() < 200);
    let few = drawn(&cube(20.0), &measured(40, 20.0, |_| false), None).1;
    let gray = few.values.iter().filter(|v| v.is_nan()).count();
    assert!(2 * gray > few.values.len(), "{gray} of {}", few.values.len());
}

/// The means at shared places against the points, one by one: each counts at the nearest corner of the piece that it lies over.
#[test]
fn means_at_places_are_those_of_the_points_over_them() {
    let mesh = cube(20.0);
    let points = measured(30_000, 20.0, |p| p[0] > 15.0 && p[2] > 19.0);
    let (known, feet) = compare(&mesh, &points);
    let mut map = PointMap::new(&mesh, None, true);
    for (k, (face, weights)) in known.iter().zip(&feet) {
        map.add(map.foot(&mesh, *face, *weights), k.deviation);
    }
    let reach = 0.5;
    let found = map.take_places().unwrap().means(reach);
    let pieces = &found.mesh;
    assert!(pieces.positions.len() > 10_000, "{}", pieces.positions.len());
    let sides = pieces.faces.iter().flat_map(|f| [[f[0], f[1]], [f[1], f[2]], [f[2], f[0]]]);
    let length = |[a, b]: [u32; 2]| norm(minus(pieces.positions[a as usize], pieces.positions[b as usize]));
    let longest = sides.map(length).fold(0.0, f64::max);
    let normals = vertex_normals(pieces);
    // Brute force: the facet of the pieces that the foot lies on, among those that face as the facet of the reference does.
    let tree = Tree::build(pieces).unwrap();
    let mut own: Vec<Vec<f64>> = vec![vec![]; pieces.positions.len()];
    for k in &known {
        let inward = [0, 1, 2].map(|i| k.foot[i] + 1e-7 * k.normal[i]);
        let hit = tree.closest(&inward, f64::INFINITY).unwrap().unwrap();
        let away = |v: u32| norm(minus(pieces.positions[v as usize], k.foot));
        let mut corners = pieces.faces[hit.face as usize];
        corners.sort_by(|a, b| away(*a).total_cmp(&away(*b)));
        assert!(dot(normals[corners[0] as usize][0], k.normal) > 0.99 && away(corners[0]) <= longest);
        own[corners[0] as usize].push(k.deviation);
    }
    let (mut astray, mut filled) = (0, 0);
    for (v, list) in own.iter().enumerate() {
        let mean = list.iter().sum::<f64>() / list.len() as f64;
        // A foot within rounding of a side may have gone to either.
        let same = found.counts[v] == list.len() as u64
            && (list.is_empty() || (found.means[v] - mean).abs() < 1e-12);
        astray += usize::from(!same);
        filled += usize::from(list.is_empty() && !found.means[v].is_nan());
        // Means go over to empty places near by, and no farther.
        if list.is_empty() && found.counts[v] == 0 && !normals[v].is_empty() {
            let near = |(w, o): (usize, &Vec<f64>)| {
                let same_side = dot(normals[w][0], normals[v][0]) > 0.99;
                if o.is_empty() || !same_side {
                    f64::INFINITY
                } else {
                    norm(minus(pieces.positions[w], pieces.positions[v]))
                }
            };
            let nearest = own.iter().enumerate().map(near).fold(f64::INFINITY, f64::min);
            assert!(nearest <= reach || found.means[v].is_nan(), "{nearest}");
        }
    }
    assert!(astray <= 4 && filled > 100, "{astray} {filled}");
    assert_eq!(found.counts.iter().sum::<u64>(), points.len() as u64);
    assert!(found.means.iter().any(|m| m.is_nan()));
    // Other points, the same places.
    let other = PointMap::new(&mesh, None, true).take_places().unwrap().means(0.1);
    assert_eq!((&other.mesh, other.means.iter().all(|m| m.is_nan())), (&found.mesh, true));
}
