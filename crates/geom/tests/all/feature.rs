//! Nominal features as faces of meshes and clouds whose facets are known, with nothing beside them that tells what else is there.

use trueness_geom::feature::{FeatureError, Nearness, Nominal, facets_near, in_cloud};
use trueness_geom::mesh::Mesh;
use trueness_geom::partition::{Class, Faces, Options, partition};
use trueness_geom::progress::Silent;
use trueness_geom::space::Point;

/// Strips of the arc between floor and wall.
const ARC: usize = 8;
/// Strips along y.
const LONG: usize = 10;

/// A floor z = 0 up to x = 0, an arc of radius 2 down to the wall x = 2; 20 mm along y. Strip `s` between two lines of the
/// profile has the facets 2·LONG·s …: floor 0, arc 1 ..= ARC, wall ARC + 1.
fn rounded_step() -> Mesh {
    let arc = (0..=ARC).map(|k| {
        let angle = std::f64::consts::FRAC_PI_2 * k as f64 / ARC as f64;
        [2.0 * angle.sin(), 2.0 * angle.cos() - 2.0]
    });
    let profile: Vec<[f64; 2]> = std::iter::once([-10.0, 0.0]).chain(arc).chain([[2.0, -12.0]]).collect();
    let mut mesh = Mesh::default();
    for [x, z] in &profile {
        mesh.positions.extend((0..=LONG).map(|j| [*x, 2.0 * j as f64, *z]));
    }
    let at = |i: usize, j: usize| (i * (LONG + 1) + j) as u32;
    for i in 0..profile.len() - 1 {
        for j in 0..LONG {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            mesh.faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh
}

/// The facets and the vertices of a nominal feature.
#[derive(Debug, Default, PartialEq)]
struct Found {
    facets: Vec<u32>,
    points: Vec<u32>,
}

fn found(mesh: &Mesh, nominal: &Nominal, near: Nearness) -> Found {
    let mut faces = Faces::none();
    faces.add_nominal(nominal, near.inward == Some(true)).unwrap();
    let options = Options { distance: Some(near.distance), ..Options::default() };
    let found = partition(&mesh.clone().into(), &[&faces.all[0]], &options, &Silent).unwrap();
    let own = |labels: &[u32]| -> Vec<u32> {
        (0u32..).zip(labels).filter(|(_, label)| **label == 0).map(|(number, _)| number).collect()
    };
    let mut points = own(&found.owners);
    points.retain(|p| found.classes[*p as usize] == Class::Face);
    Found { facets: own(&found.facets), points }
}

fn strips(facets: &[u32]) -> Vec<usize> {
    let mut strips: Vec<usize> = facets.iter().map(|f| *f as usize / (2 * LONG)).collect();
    strips.dedup();
    strips
}

const NEAR: Nearness = Nearness { distance: 0.1, angle: 0.2, margin: 0.0, rim: true, inward: None };

fn floor() -> Nominal {
    let boundary = vec![[-10.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 20.0, 0.0], [-10.0, 20.0, 0.0]];
    Nominal::Plane { point: [-5.0, 9.0, 0.0], normal: [0.0, 0.0, 3.0], boundary }
}

#[test]
fn a_plane_ends_at_its_boundary() {
    let mesh = rounded_step();
    let whole = found(&mesh, &floor(), NEAR);
    assert_eq!(
        (strips(&whole.facets), whole.facets.len(), whole.points.len()),
        (vec![0], 2 * LONG, 2 * (LONG + 1))
    );
    assert!((floor().area().unwrap() - 200.0).abs() < 1e-9);
    let all: Vec<u32> = (0..mesh.faces.len() as u32).collect();
    assert_eq!(facets_near(&mesh, &all, &floor(), &NEAR).unwrap(), whole.facets);
    // No facet keeps to the margin: none of their corners is inside.
    let clear = Nearness { margin: 0.5, ..NEAR };
    assert!(facets_near(&mesh, &all, &floor(), &clear).unwrap().is_empty());
    // From below nothing faces up.
    let below = Nominal::Plane {
        point: [0.0; 3],
        normal: [0.0, 0.0, -1.0],
        boundary: vec![[-10.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 20.0, 0.0]],
    };
    assert_eq!(found(&mesh, &below, NEAR), Found::default());
}

/// A fine floor has a spike, a dent and a step at the rim of the measured area, all steeper than the angle. Nothing tells that
/// they belong to anything else.
#[test]
fn what_is_steep_within_a_plane_belongs_to_it() {
    const N: usize = 20;
    let at = |i: usize, j: usize| (i * (N + 1) + j) as u32;
    let mut mesh = Mesh::default();
    for i in 0..=N {
        mesh.positions.extend((0..=N).map(|j| [i as f64 * 0.1, j as f64 * 0.1, 0.0]));
    }
    for (i, j) in (0..N).flat_map(|i| (0..N).map(move |j| (i, j))) {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        mesh.faces.extend([[a, b, c], [a, c, d]]);
    }
    mesh.positions[at(5, 5) as usize][2] = 0.08;
    // Two vertices beside each other: some facets of the dent have no flat one beside them.
    mesh.positions[at(12, 7) as usize][2] = -0.07;
    mesh.positions[at(13, 7) as usize][2] = -0.07;
    (0..=N).for_each(|i| mesh.positions[at(i, N) as usize][2] = -0.09);
    let boundary = vec![[-1.0, -1.0, 0.0], [3.0, -1.0, 0.0], [3.0, 3.0, 0.0], [-1.0, 3.0, 0.0]];
    let floor = Nominal::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0], boundary };
    let all = found(&mesh, &floor, NEAR);
    assert_eq!((all.facets.len(), all.points.len()), (2 * N * N, (N + 1) * (N + 1)));
    // Deeper than the distance it is no part of the floor.
    mesh.positions[at(5, 5) as usize][2] = 0.2;
    assert!(!found(&mesh, &floor, NEAR).points.contains(&at(5, 5)));
}

/// A prism along z over a regular polygon of radius 10, or over a tube of it. The vertices of its flat ends all lie on its
/// rims. The sides come first, two facets each.
fn prism(sides: u32, height: f64, inner: Option<f64>) -> Mesh {
    let mut mesh = Mesh::default();
    let rings = [Some(10.0), inner].into_iter().flatten();
    for (radius, z) in rings.flat_map(|r| [(r, 0.0), (r, height)]) {
        mesh.positions.extend((0..sides).map(|k| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(sides)).sin_cos();
            [radius * cos, radius * sin, z]
        }));
    }
    let strip = |mesh: &mut Mesh, low: u32, high: u32| {
        for k in 0..sides {
            let next = (k + 1) % sides;
            let [a, b, c, d] = [low + k, low + next, high + next, high + k];
            mesh.faces.extend([[a, b, c], [a, c, d]]);
        }
    };
    strip(&mut mesh, 0, sides);
    match inner {
        Some(_) => {
            strip(&mut mesh, sides, 3 * sides);
            strip(&mut mesh, 3 * sides, 2 * sides);
            strip(&mut mesh, 2 * sides, 0);
        }
        None => {
            (1..sides - 1).for_each(|k| mesh.faces.extend([[0, k + 1, k], [sides, sides + k, sides + k + 1]]))
        }
    }
    mesh
}

/// The inside of the walls of a feature is none of it. Such are the flat ends of a boss, the bore of a thin tube, the other
/// side of a thin plate.
#[test]
fn what_lies_beyond_walls_is_of_something_else() {
    let near = Nearness { distance: 0.5, angle: 0.2, margin: -0.5, rim: true, inward: None };
    let shaft = Nominal::Cylinder { point: [0.0; 3], direction: [0.0, 0.0, 1.0], radius: 10.0, length: 6.0 };
    let sides: Vec<u32> = (0..96).collect();
    assert_eq!(found(&prism(48, 6.0, None), &shaft, near).facets, sides);
    assert_eq!(found(&prism(48, 6.0, Some(9.6)), &shaft, near).facets, sides);
    // A plate of a thickness less than the distance.
    let plate = prism(4, 0.4, None);
    let boundary: Vec<Point> = plate.positions[4..].to_vec();
    let top = Nominal::Plane { point: [0.0, 0.0, 0.4], normal: [0.0, 0.0, 1.0], boundary };
    let own = found(&plate, &top, near).facets;
    assert!(
        own.len() == 2 && own.iter().all(|f| plate.faces[*f as usize].iter().all(|v| *v >= 4)),
        "{own:?}"
    );
}

/// A plate that is off by more than half its thickness: the other side of it is nearer to where the feature is.
#[test]
fn the_nearest_facet_that_faces_right_begins_a_feature() {
    let mut plate = prism(4, 0.4, None);
    let boundary: Vec<Point> = plate.positions[4..].to_vec();
    let near = Nearness { distance: 1.0, angle: 0.2, margin: -1.0, rim: true, inward: None };
    for off in [0.0, 0.3, -0.3] {
        let top =
            Nominal::Plane { point: [0.0, 0.0, 0.4], normal: [0.0, 0.0, 1.0], boundary: boundary.clone() };
        plate.positions.iter_mut().for_each(|p| p[2] += off);
        let own = found(&plate, &top, near).facets;
        plate.positions.iter_mut().for_each(|p| p[2] -= off);
        let is_top = |f: &u32| plate.faces[*f as usize].iter().all(|v| *v >= 4);
        assert!(own.len() == 2 && own.iter().all(is_top), "{off}: {own:?}");
    }
}

/// A tube whose outside is nearer to where its bore should be than its bore is.
#[test]
fn a_bore_is_not_taken_from_the_outside_of_its_tube() {
    const SIDES: u32 = 48;
    let ring = |radius: f64, z: f64| {
        (0..SIDES).map(move |k| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(SIDES)).sin_cos();
            [radius * cos, radius * sin, z]
        })
    };
    let (bore, outside) = (9.7, 10.04);
    let positions: Vec<Point> = [(bore, 0.0), (bore, 20.0), (outside, 0.0), (outside, 20.0)]
        .into_iter()
        .flat_map(|(r, z)| ring(r, z))
        .collect();
    let mut mesh = Mesh { positions, faces: vec![] };
    for k in 0..SIDES {
        let n = (k + 1) % SIDES;
        let [a, b, c, d] = [k, n, SIDES + n, SIDES + k];
        mesh.faces.extend([[a, c, b], [a, d, c]]);
        let [a, b, c, d] = [a, b, c, d].map(|v| v + 2 * SIDES);
        mesh.faces.extend([[a, b, c], [a, c, d]]);
    }
    let nominal =
        Nominal::Cylinder { point: [0.0; 3], direction: [0.0, 0.0, 1.0], radius: 10.0, length: 20.0 };
    let near = Nearness { distance: 0.5, angle: 0.2, margin: -0.5, rim: true, inward: None };
    let is_bore = |inward| {
        let own = found(&mesh, &nominal, Nearness { inward, ..near });
        let bore = own.facets.iter().filter(|f| *f % 4 < 2).count();
        (own.facets.len(), bore)
    };
    assert_eq!(is_bore(Some(true)), (96, 96));
    assert_eq!(is_bore(Some(false)), (96, 0));
}

#[test]
fn a_rounding_is_found_as_cylinder_and_as_edge() {
    let mesh = rounded_step();
    let all: Vec<u32> = (0..mesh.faces.len() as u32).collect();
    let near = |nominal: &Nominal, near: Nearness| facets_near(&mesh, &all, nominal, &near).unwrap();
    let cylinder =
        Nominal::Cylinder { point: [0.0, 0.0, -2.0], direction: [0.0, 1.0, 0.0], radius: 2.0, length: 20.0 };
    assert_eq!(strips(&found(&mesh, &cylinder, NEAR).facets), (1..=ARC).collect::<Vec<_>>());
    // Only the middle of it: the margin takes 3 mm at both ends, the facets there are 2 mm long.
    let middle = near(&cylinder, Nearness { margin: 3.0, ..NEAR });
    assert_eq!(middle.len(), ARC * 2 * (LONG - 4));
    let edge = Nominal::Edge {
        point: [2.0, 0.0, 0.0],
        direction: [0.0, 1.0, 0.0],
        length: 20.0,
        normals: [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
    };
    let found = near(&edge, Nearness { distance: 3.0, angle: 0.05, ..NEAR });
    assert_eq!(strips(&found), (1..=ARC).collect::<Vec<_>>());
    assert_eq!(Faces::none().add_nominal(&edge, false), Err(FeatureError::NoFace));
}

#[test]
fn a_cloud_gives_what_is_near() {
    let points: Vec<Point> = vec![[-5.0, 5.0, 0.05], [-5.0, 5.0, 0.2], [5.0, 5.0, 0.0], [-0.05, 5.0, 0.0]];
    let all = in_cloud(&points, &floor(), &NEAR).unwrap();
    assert_eq!((all.points, all.facets.len()), (vec![0, 3], 0));
    let inner = in_cloud(&points, &floor(), &Nearness { margin: 0.1, ..NEAR }).unwrap();
    assert_eq!(inner.points, vec![0]);
}

#[test]
fn nominal_features_without_sense_are_refused() {
    let refused = |nominal: Nominal| in_cloud(&[], &nominal, &NEAR).unwrap_err();
    let boundary = vec![[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
    let plane = Nominal::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0], boundary };
    assert_eq!(refused(plane), FeatureError::Boundary);
    let sphere = Nominal::Sphere { center: [0.0; 3], radius: -1.0 };
    assert_eq!(refused(sphere), FeatureError::Size { what: "radius", value: -1.0 });
    let none = Nominal::Cylinder { point: [0.0; 3], direction: [0.0; 3], radius: 1.0, length: 1.0 };
    assert_eq!(refused(none), FeatureError::NoDirection { what: "direction" });
    let lost = Nominal::Sphere { center: [f64::NAN, 0.0, 0.0], radius: 1.0 };
    assert_eq!(refused(lost), FeatureError::NotFinite);
}
