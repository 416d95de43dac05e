//! Parts with known faces, whole and in part, with noise and without.

mod cones;
pub(super) mod parts;

use super::grow::Context;
use super::pieces::Band;
use super::{KINDS, Options, SegmentError, Segmentation, cloud, facets, mesh};
use crate::mesh::Mesh;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::shape::{Kind, Parameter, Shape};
use crate::space::{Aabb, Point, Vector, dot, minus, norm, times};
use parts::{Part, bar, bored, elliptic, pebble, round, sleeve, turned};

/// A plane, sphere, cylinder, cone and torus about one place, radius 5 there; of the torus' tube 2.
pub(super) fn one_of_each(center: Point, direction: Vector, half_angle: f64) -> [Shape; 5] {
    let apex = minus(center, times(5.0 / half_angle.tan(), direction));
    [
        Shape::Plane { point: center, normal: direction },
        Shape::Sphere { center, radius: 5.0 },
        Shape::Cylinder { point: center, direction, radius: 5.0 },
        Shape::Cone { apex, direction, half_angle, point: center, radius: 5.0 },
        Shape::Torus { center, direction, major_radius: 5.0, minor_radius: 2.0 },
    ]
}

/// Calls `with` with the context of a mesh with noise of 0.01 mm.
pub(super) fn context<T>(mesh: &Mesh, with: impl FnOnce(&Context) -> T) -> T {
    let surface = facets::surface(mesh);
    with(&Context {
        surface: &surface,
        kinds: &KINDS,
        band: Band { distance: 0.08, cosine: 30f64.to_radians().cos() },
        noise: 0.01,
        crease: Options::default().crease.cos(),
        size: Aabb::of(&mesh.positions).diagonal(),
    })
}

/// For each face the region that holds most of its facets. Every region must belong to one face and have its kind, and hold at
/// least `share` of it.
fn matched(part: &Part, found: &Segmentation, share: f64) -> Vec<usize> {
    assert_eq!(found.regions.len(), part.faces.len(), "{:#?}", kinds(found));
    assert!(found.regions.is_sorted_by(|a, b| a.share >= b.share), "{:#?}", kinds(found));
    let mut taken = vec![false; found.regions.len()];
    (0..part.faces.len())
        .map(|face| {
            let own: Vec<usize> = (0..part.labels.len()).filter(|&i| part.labels[i] == face).collect();
            let count = |r: usize| own.iter().filter(|&&i| found.labels[i] == r as u32).count();
            let best = (0..found.regions.len()).max_by_key(|&r| count(r)).unwrap();
            let kind = part.faces[face].kind();
            assert_eq!(found.regions[best].fit.shape.kind(), kind, "face {face}: {:#?}", kinds(found));
            assert!(
                count(best) as f64 >= share * own.len() as f64,
                "face {face}: {} of {}",
                count(best),
                own.len()
            );
            assert!(!std::mem::replace(&mut taken[best], true), "face {face} shares its region");
            best
        })
        .collect()
}

fn kinds(found: &Segmentation) -> Vec<(Kind, usize, f64)> {
    found.regions.iter().map(|r| (r.fit.shape.kind(), r.pieces, r.share)).collect()
}

/// Greatest difference of the radii, angles and directions in standard uncertainties, and of the places in those of
/// the place that the region gives.
fn errors(part: &Part, found: &Segmentation, regions: &[usize]) -> f64 {
    let mut worst = 0.0f64;
    for (truth, &r) in part.faces.iter().zip(regions) {
        let fit = &found.regions[r].fit;
        let uncertainties = fit.covariance.as_ref().unwrap().uncertainties(&fit.shape);
        for ((name, told), ((_, u), (_, true_one))) in
            fit.shape.parameters().into_iter().zip(uncertainties.into_iter().zip(truth.parameters()))
        {
            let error = match (name, told, u, true_one) {
                ("radius", Parameter::Number(_), ..) if fit.shape.kind() == Kind::Cone => 0.0,
                (_, Parameter::Number(x), Parameter::Number(u), Parameter::Number(t)) => (x - t).abs() / u,
                (
                    "direction" | "normal",
                    Parameter::Vector(x),
                    Parameter::Vector(u),
                    Parameter::Vector(t),
                ) => {
                    let t = times(dot(x, t).signum(), t);
                    norm(minus(x, t)) / norm(u)
                }
                ("point", Parameter::Vector(x), Parameter::Vector(u), _) => axis_distance(truth, x) / norm(u),
                (_, Parameter::Vector(x), Parameter::Vector(u), Parameter::Vector(t)) => {
                    norm(minus(x, t)) / norm(u)
                }
                _ => f64::INFINITY,
            };
            worst = worst.max(error);
        }
    }
    worst
}

/// Distance of `p` from the axis, or from the plane itself.
fn axis_distance(shape: &Shape, p: Point) -> f64 {
    match *shape {
        Shape::Cylinder { point, direction, .. } | Shape::Cone { point, direction, .. } => {
            Shape::Line { point, direction }.distance(p)
        }
        _ => shape.distance(p).abs(),
    }
}

#[test]
fn faces_without_noise_are_found_to_the_last_facet() {
    for part in [turned(1.0, 72).moved(), bored(64).moved(), turned(0.2, 20).moved()] {
        let found = mesh(&part.mesh, &Options::default(), &Silent).unwrap();
        let regions = matched(&part, &found, 0.99);
        for (truth, r) in part.faces.iter().zip(regions) {
            for &p in &found.regions[r].points {
                assert!(found.regions[r].fit.shape.distance(part.mesh.positions[p as usize]).abs() < 1e-9);
            }
            // The element that was made, not one that passes through its few points.
            let place = found.regions[r].bounds.max;
            let d = (truth.distance(place).abs() - found.regions[r].fit.shape.distance(place).abs()).abs();
            assert!(d < 1e-6, "{truth:?} {:?}", found.regions[r].fit.shape);
        }
    }
}

#[test]
fn noisy_faces_are_found_within_their_uncertainties() {
    for seed in 0..3 {
        for (part, sigma) in [(turned(1.0, 144), 0.01), (bored(128), 0.01), (turned(0.25, 40), 0.01)] {
            let part = part.moved().noisy(sigma, seed);
            let found = mesh(&part.mesh, &Options { seed, ..Options::default() }, &Silent).unwrap();
            assert!((0.5..2.0).contains(&(found.noise / sigma)), "{}", found.noise);
            let regions = matched(&part, &found, 0.8);
            // Some 80 numbers are compared: four standard uncertainties are passed by chance once in 200 parts.
            let worst = errors(&part, &found, &regions);
            assert!(worst < 4.0, "seed {seed}: {worst} uncertainties");
        }
    }
}

/// A quarter of the fillet lies within 0.1 mm of a ball: a small patch does not tell which it is, all of it does.
#[test]
fn short_noisy_fillets_are_tori() {
    for seed in 0..4 {
        let part = turned(0.25, 40).moved().noisy(0.015, seed);
        let found = mesh(&part.mesh, &Options { seed, ..Options::default() }, &Silent).unwrap();
        matched(&part, &found, 0.8);
    }
}

/// Every measured point of every piece of a region lies within the tolerance, and the greatest distance is that told. Noise is
/// little and much, tolerances are found and given, on meshes and clouds.
#[test]
fn members_tolerance_and_greatest_distance_agree() {
    let made = |which: usize| match which {
        0 => turned(1.0, 72).moved(),
        1 => turned(1.0, 72).moved().noisy(0.005, 5),
        2 => turned(0.25, 40).moved().noisy(0.05, 5),
        _ => bored(64).moved().noisy(0.02, 5),
    };
    for (which, tolerance) in (0..4).flat_map(|which| [None, Some(0.03)].map(|t| (which, t))) {
        let part = made(which);
        let options = Options { tolerance, ..Options::default() };
        let of_mesh = mesh(&part.mesh, &options, &Silent).unwrap();
        let of_cloud = cloud(&part.mesh.positions, &options, &Silent).unwrap();
        for (found, is_mesh) in [(of_mesh, true), (of_cloud, false)] {
            for (label, region) in (0u32..).zip(&found.regions) {
                let members = (0..found.labels.len()).filter(|&i| found.labels[i] == label);
                let corners = |i: usize| if is_mesh { part.mesh.faces[i].to_vec() } else { vec![i as u32] };
                let points: Vec<u32> = members.clone().flat_map(corners).collect();
                let distance = |&p: &u32| region.fit.shape.distance(part.mesh.positions[p as usize]).abs();
                let farthest = points.iter().map(distance).fold(0.0, f64::max);
                assert_eq!(members.count(), region.pieces);
                assert!(farthest == region.farthest && farthest <= found.tolerance, "{farthest} {region:?}");
                assert!(region.points.iter().all(|p| points.contains(p)));
            }
        }
    }
}

/// At an edge a vertex is of both faces, and with noise of neither.
#[test]
fn elements_rest_on_points_inside_their_faces() {
    let part = turned(1.0, 72).moved().noisy(0.005, 2);
    let found = mesh(&part.mesh, &Options::default(), &Silent).unwrap();
    for (label, region) in found.regions.iter().enumerate() {
        assert!(!region.points.is_empty());
        for (face, &other) in part.mesh.faces.iter().zip(&found.labels) {
            let shared = || face.iter().any(|v| region.points.binary_search(v).is_ok());
            assert!(other == label as u32 || !shared(), "region {label}");
        }
    }
}

/// Two circles of corners lie on a sphere too: the facets between them tell that it is a cylinder.
#[test]
fn faces_of_two_circles_are_found_beside_fillets_too() {
    for seed in 0..40 {
        let mut random = Random::new(seed);
        let mut between = |a: f64, b: f64| a + (b - a) * random.unit();
        let bore = between(3.0, 20.0);
        let sizes = [bore, bore * between(1.2, 3.0), bore * between(0.4, 4.0)];
        let steps = between(24.0, 200.0) as usize;
        let radius = 0.1 * sizes[2].min(bore);
        let corners = [4, 8, 16][seed as usize % 3];
        for fillet in [None, Some((radius, corners))] {
            for part in [sleeve(sizes, fillet, steps), sleeve(sizes, fillet, steps).moved().single()] {
                let found = mesh(&part.mesh, &Options::default(), &Silent).unwrap();
                let at = format!("{seed} {sizes:?} {steps} {fillet:?}");
                for (face, truth) in part.faces.iter().enumerate() {
                    let own = (part.labels.iter().zip(&found.labels)).filter(|l| *l.0 == face).map(|l| *l.1);
                    let label = own.clone().next().unwrap();
                    let fit = found.regions.get(label as usize).map(|r| r.fit.shape);
                    let fit = fit.unwrap_or_else(|| panic!("{at}: {truth:?} is not found"));
                    assert!(own.clone().all(|l| l == label), "{at}: {truth:?} is in pieces");
                    assert_eq!(fit.kind(), truth.kind(), "{at}");
                    let off = radius_of(&fit) - radius_of(truth);
                    assert!(off.abs() < 1e-4, "{at}: {fit:?} for {truth:?}");
                }
            }
        }
    }
}

/// Three circles of corners lie on a torus: an end face and the chamfer beside it are none, as they are none of one face.
#[test]
fn a_chamfer_and_the_face_beside_it_are_no_torus() {
    for (bore, outside, length, chamfer, steps) in [
        (5.0, 8.0, 20.0, 1.25, 32),
        (5.0, 10.0, 30.0, 1.25, 64),
        (10.0, 14.0, 25.0, 2.5, 128),
        // At the outside.
        (10.0, 5.0, 30.0, 2.0, 32),
        (10.0, 5.0, 30.0, 2.0, 64),
        (10.0, 5.0, 30.0, 2.0, 128),
    ] {
        let part = sleeve([bore, outside, length], Some((chamfer, 1)), steps);
        let found = mesh(&part.mesh, &Options::default(), &Silent).unwrap();
        let kind = |face: usize| {
            let facet = part.labels.iter().position(|l| *l == face).unwrap();
            found.regions.get(found.labels[facet] as usize).map(|r| r.fit.shape.kind())
        };
        let kinds: Vec<Option<Kind>> = (0..5).map(kind).collect();
        let expected = [Kind::Cylinder, Kind::Plane, Kind::Cylinder, Kind::Plane, Kind::Cone].map(Some);
        assert_eq!(kinds, expected, "{bore} {outside} {steps}");
        assert_eq!(found.regions.len(), 5);
    }
}

/// A bar as programs draw it: sides of two facets each run as tangents into corners of as few as three chords.
#[test]
fn sides_of_two_facets_and_the_fillets_between_them_are_found() {
    for (size, radius, chords) in [
        ([60.0, 12.0], 3.0, 3),
        ([60.0, 12.0], 3.0, 4),
        ([60.0, 12.0], 3.0, 8),
        ([60.0, 12.0], 3.0, 32),
        ([60.0, 30.0], 8.0, 3),
        ([60.0, 30.0], 8.0, 8),
        ([30.0, 30.0], 12.0, 5),
        ([6.0, 5.0], 2.0, 6),
    ] {
        for part in [bar(size, radius, chords), bar(size, radius, chords).moved().single()] {
            let found = mesh(&part.mesh, &Options::default(), &Silent).unwrap();
            let regions = matched(&part, &found, 1.0);
            for (truth, r) in part.faces.iter().zip(regions) {
                let off = radius_of(truth) - radius_of(&found.regions[r].fit.shape);
                assert!(off.abs() < 1e-3, "{size:?} {radius} {chords}: {off}");
            }
        }
    }
}

/// Patches of a part without any edge, of few facets, are all of several faces: no patch tells how exact it is.
#[test]
fn a_drawn_part_without_an_edge_is_exact() {
    for (half, radius, chords) in
        [([20.0, 12.0, 8.0], 4.0, 5), ([20.0, 12.0, 8.0], 4.0, 8), ([9.0, 7.0, 8.0], 6.0, 6)]
    {
        for part in [pebble(half, radius, chords), pebble(half, radius, chords).moved().single()] {
            let found = mesh(&part.mesh, &Options::default(), &Silent).unwrap();
            assert!(found.noise < 1e-5, "{half:?} {radius} {chords}: {}", found.noise);
            let regions = matched(&part, &found, 1.0);
            for (truth, r) in part.faces.iter().zip(regions) {
                let off = radius_of(truth) - radius_of(&found.regions[r].fit.shape);
                assert!(off.abs() < 1e-3, "{half:?} {radius} {chords}: {off}");
            }
        }
    }
}

/// Each chord of an ellipse is a plane of two facets, and none that was drawn.
#[test]
fn chords_of_a_free_curve_are_no_planes() {
    let part = elliptic(48);
    for part in [part.clone(), part.moved().single()] {
        let found = mesh(&part.mesh, &Options::default(), &Silent).unwrap();
        let planes = found.regions.iter().filter(|r| r.fit.shape.kind() == Kind::Plane).count();
        assert_eq!(planes, 2, "{:?}", kinds(&found));
    }
}

/// A bore of a part in four thousand of the surface: what is drawn is certain however small it is.
#[test]
fn a_small_bore_of_a_drawn_plate_is_found() {
    let part = sleeve([0.5, 200.0, 20.0], None, 48);
    for part in [part.clone(), part.moved().single()] {
        let found = mesh(&part.mesh, &Options::default(), &Silent).unwrap();
        matched(&part, &found, 1.0);
        assert!(found.regions[3].share < 0.001 && found.min_share == 1e-4);
    }
}

/// All corners of a cylinder with its ends lie on one sphere, as those of a frustum do.
#[test]
fn a_round_solid_is_no_sphere() {
    for (radii, long) in [([10.0, 10.0], 30.0), ([10.0, 10.0], 50.0), ([10.0, 4.0], 6.0), ([5.0, 2.5], 2.5)] {
        for chords in [24, 64] {
            for part in [round(radii, long, chords), round(radii, long, chords).moved().single()] {
                let found = mesh(&part.mesh, &Options::default(), &Silent).unwrap();
                matched(&part, &found, 1.0);
            }
        }
    }
}

/// Chords of a cylinder that is cut at an angle are as wide and of other lengths.
#[test]
fn chords_of_a_cylinder_cut_askew_are_no_planes() {
    for chords in [24, 48] {
        let mut part = round([8.0, 8.0], 30.0, chords);
        part.mesh.positions.iter_mut().filter(|p| p[2] > 0.0).for_each(|p| p[2] += 1.5 * p[0]);
        let found = mesh(&part.mesh, &Options::default(), &Silent).unwrap();
        let planes = found.regions.iter().filter(|r| r.fit.shape.kind() == Kind::Plane).count();
        assert_eq!(planes, 2, "{:?}", kinds(&found));
    }
}

/// Where something cuts into a cylinder, the facets of its chords meet somewhere within them: no two are equally wide.
#[test]
fn chords_of_a_cylinder_that_is_cut_into_are_no_planes() {
    let mut random = Random::new(3);
    for chords in [24, 48] {
        let Part { mut mesh, .. } = round([8.0, 8.0], 30.0, chords);
        let ends = mesh.faces.split_off(2 * chords);
        let sides: Vec<[u32; 3]> = mesh.faces.drain(..).collect();
        for pair in sides.chunks(2) {
            let [[a, b, c], [_, _, d]] = [pair[0], pair[1]];
            let [s, t] = [0.2 + 0.6 * random.unit(), 0.2 + 0.6 * random.unit()];
            let [p, q] = mesh.places(&[a, b]);
            let middle = mesh.positions.len() as u32;
            mesh.positions.push([p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1]), 30.0 * t]);
            mesh.faces.extend([[a, b, middle], [b, c, middle], [c, d, middle], [d, a, middle]]);
        }
        mesh.faces.extend(ends);
        let found = super::mesh(&mesh, &Options::default(), &Silent).unwrap();
        let planes = found.regions.iter().filter(|r| r.fit.shape.kind() == Kind::Plane).count();
        assert_eq!(planes, 2, "{:?}", kinds(&found));
    }
}

fn radius_of(shape: &Shape) -> f64 {
    match shape {
        Shape::Cylinder { radius, .. } | Shape::Sphere { radius, .. } => *radius,
        Shape::Torus { minor_radius, .. } => *minor_radius,
        _ => 0.0,
    }
}

#[test]
fn a_cloud_has_the_same_faces() {
    let mut random = Random::new(8);
    // The bored block, evenly strewn.
    let part = bored(128).moved();
    let mut points: Vec<Point> = Vec::new();
    let mut labels = Vec::new();
    for (face, &label) in part.mesh.faces.iter().zip(&part.labels) {
        let [a, b, c] = part.mesh.places(face);
        let (ab, ac) = (minus(b, a), minus(c, a));
        let area = 0.5 * norm(crate::space::cross(ab, ac));
        for _ in 0..(3.0 * area + random.unit()) as usize {
            let (mut s, mut t) = (random.unit(), random.unit());
            if s + t > 1.0 {
                (s, t) = (1.0 - s, 1.0 - t);
            }
            points.push(std::array::from_fn(|k| a[k] + s * ab[k] + t * ac[k]));
            labels.push(label);
        }
    }
    let found = cloud(&points, &Options { tolerance: Some(0.05), ..Options::default() }, &Silent).unwrap();
    let part = Part { labels, ..part };
    matched(&part, &found, 0.85);
}

/// Rows of a scanner lie fifteen times as far apart as the points of a row. So a point's nearest neighbors are all on its own
/// row.
#[test]
fn rows_of_points_are_one_face() {
    let half_turn = |k: i32, rho: f64, z: f64| {
        let a = 0.004 * f64::from(k);
        [rho * a.cos(), rho * a.sin(), z]
    };
    let shaft = (0..20).flat_map(|row| (0..750).map(move |k| half_turn(k, 50.0, 3.0 * f64::from(row))));
    let foot = (1..10).flat_map(|row| {
        let rho = 50.0 + 3.0 * f64::from(row);
        (0..750).map(move |k| half_turn(k, rho, 0.0))
    });
    let points: Vec<Point> = shaft.chain(foot).collect();
    let found = cloud(&points, &Options::default(), &Silent).unwrap();
    assert_eq!(kinds(&found).iter().map(|k| k.0).collect::<Vec<_>>(), [Kind::Cylinder, Kind::Plane]);
    // The row next to the edge is of neither face for certain.
    assert!(found.regions[0].pieces > 18 * 750 && found.regions[1].pieces > 8 * 740, "{:?}", kinds(&found));
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let part = turned(1.0, 72).moved().noisy(0.01, 5);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let options = Options::default();
            (
                mesh(&part.mesh, &options, &Silent).unwrap(),
                cloud(&part.mesh.positions, &options, &Silent).unwrap(),
            )
        })
    };
    let one = on(1);
    assert!(one == on(2) && one == on(5));
}

#[test]
fn only_the_kinds_asked_for_are_found() {
    let part = turned(1.0, 72);
    let options = Options { kinds: vec![Kind::Plane, Kind::Sphere], ..Options::default() };
    let found = mesh(&part.mesh, &options, &Silent).unwrap();
    assert!(found.regions.iter().all(|r| options.kinds.contains(&r.fit.shape.kind())), "{:?}", kinds(&found));
    let options = Options { min_share: Some(0.2), ..Options::default() };
    let found = mesh(&part.mesh, &options, &Silent).unwrap();
    assert!(!found.regions.is_empty() && found.regions.iter().all(|r| r.share >= 0.2), "{:?}", kinds(&found));
}

#[test]
fn what_is_no_surface_is_refused_or_left_out() {
    let options = Options::default();
    let square = |faces: Vec<[u32; 3]>| Mesh {
        positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.0, 0.0]],
        faces,
    };
    let error = |mesh: &Mesh| super::mesh(mesh, &options, &Silent).unwrap_err();
    assert_eq!(error(&Mesh::default()), SegmentError::Empty("points"));
    assert_eq!(error(&square(vec![])), SegmentError::Empty("facets"));
    assert_eq!(error(&square(vec![[0, 1, 4], [0, 0, 1]])), SegmentError::NoSurface);
    assert!(matches!(error(&square(vec![[0, 1, 9]])), SegmentError::Mesh(_)));
    let mut bad = square(vec![[0, 1, 2]]);
    bad.positions[3][1] = f64::NAN;
    assert_eq!(error(&bad), SegmentError::NotFinite { index: 3 });
    assert_eq!(cloud(&[[1.0, 2.0, 3.0]; 90], &options, &Silent), Err(SegmentError::NoSurface));
    let wrong = Options { crease: 0.0, ..Options::default() };
    let answer = super::mesh(&square(vec![[0, 1, 2]]), &wrong, &Silent);
    assert!(matches!(answer, Err(SegmentError::WrongOption { name: "crease", .. })));
    // Facets without area, doubled ones and three at an edge do not disturb the others.
    let odd = square(vec![[0, 1, 2], [0, 2, 3], [0, 1, 4], [0, 1, 2], [2, 1, 0], [3, 3, 3]]);
    let found = super::mesh(&odd, &options, &Silent).unwrap();
    assert_eq!((found.regions.len(), found.labels[2], found.labels[5]), (1, u32::MAX, u32::MAX));
}
