//! Turned parts whose points have known faces.

mod rounding;

use super::*;
use crate::mesh::Mesh;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::space::dot;
use crate::space::{Vector, minus};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// A profile (distance from the axis, height) that is turned about the z axis: closed, material to the left of each side.
type Profile = Vec<[f64; 2]>;

/// A bushing with a flange, a counterbore and two chamfers.
fn bushing() -> Profile {
    vec![
        [6.0, 0.0],
        [19.0, 0.0],
        [20.0, 1.0],
        [20.0, 6.0],
        [12.0, 6.0],
        [12.0, 25.0],
        [11.0, 26.0],
        [8.0, 26.0],
        [8.0, 20.0],
        [6.0, 20.0],
    ]
}

fn turned(profile: &Profile, sides: usize) -> Mesh {
    let n = profile.len();
    let at = |k: usize, i: usize| {
        let (s, c) = libm::sincos(TAU * i as f64 / sides as f64);
        [profile[k][0] * c, profile[k][0] * s, profile[k][1]]
    };
    let positions = (0..n).flat_map(|k| (0..sides).map(move |i| at(k, i))).collect();
    let number = |k: usize, i: usize| ((k % n) * sides + i % sides) as u32;
    let two = |k: usize, i: usize| {
        let [a, b, c, d] = [number(k, i), number(k, i + 1), number(k + 1, i + 1), number(k + 1, i)];
        [[a, b, c], [a, c, d]]
    };
    Mesh { positions, faces: (0..n).flat_map(|k| (0..sides).flat_map(move |i| two(k, i))).collect() }
}

/// A scan: places about `step` apart along the profile and around, none on an edge; the side of each.
fn scan(profile: &Profile, step: f64, noise: f64, as_mesh: bool, seed: u64) -> (Mesh, Vec<usize>) {
    let mut random = Random::new(seed);
    let n = profile.len();
    let side = |k: usize| minus2(profile[(k + 1) % n], profile[k]);
    let length = |k: usize| libm::hypot(side(k)[0], side(k)[1]);
    let around: f64 = (0..n).map(length).sum();
    let (rows, columns) = ((around / step) as usize, (TAU * 12.0 / step) as usize);
    let (mut mesh, mut sides) = (Mesh::default(), vec![]);
    for row in 0..rows {
        for column in 0..columns {
            let jitter = if as_mesh { 0.37 } else { random.unit() };
            let mut along = (row as f64 + jitter) * around / rows as f64;
            let mut k = 0;
            while along > length(k) {
                along -= length(k);
                k += 1;
            }
            let t = along / length(k);
            let [rho, z] = [0, 1].map(|d| profile[k][d] + t * side(k)[d]);
            let turn = column as f64 + if as_mesh { 0.0 } else { random.unit() };
            let (s, c) = libm::sincos(TAU * turn / columns as f64);
            let p = [rho * c, rho * s, z];
            mesh.positions.push(p.map(|x| x + noise * normal(&mut random)));
            sides.push(k);
        }
    }
    if as_mesh {
        let number = |i: usize, j: usize| (i % rows * columns + j % columns) as u32;
        let two = |i: usize, j: usize| {
            let [a, b, c, d] = [number(i, j), number(i, j + 1), number(i + 1, j + 1), number(i + 1, j)];
            [[a, b, c], [a, c, d]]
        };
        mesh.faces = (0..rows).flat_map(|i| (0..columns).flat_map(move |j| two(i, j))).collect();
    }
    (mesh, sides)
}

fn minus2(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// The sum of twelve even numbers is normal enough.
fn normal(random: &mut Random) -> f64 {
    (0..12).map(|_| random.unit()).sum::<f64>() - 6.0
}

/// The side of the profile that each face is of.
fn sides_of(faces: &Faces, sides: usize) -> Vec<usize> {
    faces.all.iter().map(|f| f.facets[0] as usize / (2 * sides)).collect()
}

fn all_of(faces: &Faces) -> Vec<&Face> {
    faces.all.iter().collect()
}

/// Of a mesh, or without facets of a cloud.
fn partition(
    scan: &Mesh,
    faces: &[&Face],
    options: &Options,
    progress: &dyn Progress,
) -> Result<Partition, PartitionError> {
    super::partition(&scan.clone().into(), faces, options, progress)
}

const SIDES: usize = 96;
const OPTIONS: Options = Options { distance: Some(0.5), reaches: BTreeMap::new(), seed: 0 };

/// Points of a side that have another one, or none, or a class other than that of faces. Also the greatest distance of one of
/// them from its own side.
fn wrong(
    nominal: &Profile,
    found: &Partition,
    faces: &Faces,
    scan: &Mesh,
    truth: &Profile,
    sides: &[usize],
) -> (usize, f64) {
    let of_faces = sides_of(faces, SIDES);
    assert_eq!(faces.all.len(), nominal.len());
    let mut far: (usize, f64) = (0, 0.0);
    for (p, side) in sides.iter().enumerate() {
        let owner = found.owners[p];
        let right = owner != NO_FACE && of_faces[owner as usize] == *side && found.classes[p] == Class::Face;
        if right {
            continue;
        }
        far.0 += 1;
        // How far off the side that it was given to.
        let given = if owner == NO_FACE { *side } else { of_faces[owner as usize] };
        let [a, b] = [truth[given], truth[(given + 1) % truth.len()]];
        let q = scan.positions[p];
        let off = minus2([libm::hypot(q[0], q[1]), q[2]], a);
        let along = minus2(b, a);
        let across = (off[0] * along[1] - off[1] * along[0]).abs() / libm::hypot(along[0], along[1]);
        far.1 = far.1.max(if found.classes[p] == Class::Face { across } else { f64::INFINITY });
    }
    far
}

/// All points have their side, but for those that noise lays on two. The part is as drawn, or has faces off their places, as
/// clouds and as meshes whose vertices lie on no edge.
#[test]
fn points_have_their_own_faces() {
    let nominal = bushing();
    let faces = Faces::of(&turned(&nominal, SIDES), &Silent).unwrap();
    let mut off = nominal.clone();
    // The counterbore wider by 0.2 and deeper by 0.25, the flange thinner by 0.15.
    (off[7][0], off[8][0]) = (8.2, 8.2);
    (off[8][1], off[9][1]) = (19.75, 19.75);
    (off[3][1], off[4][1]) = (5.85, 5.85);
    for (truth, name) in [(&nominal, "as drawn"), (&off, "off")] {
        for noise in [0.0, 0.004] {
            for as_mesh in [false, true] {
                let (scan, sides) = scan(truth, 0.6, noise, as_mesh, 1);
                let found = partition(&scan, &all_of(&faces), &OPTIONS, &Silent).unwrap();
                let (count, far) = wrong(&nominal, &found, &faces, &scan, truth, &sides);
                println!("{name} {noise} {as_mesh}: {count} of {}, {far}", sides.len());
                assert!(
                    count as f64 <= 0.004 * sides.len() as f64 && far <= 6.0 * noise + 1e-9,
                    "{name} {noise} {as_mesh}: {count} {far}"
                );
            }
        }
    }
}

/// Faces are put where they are: one that lies off is moved, one that leans is fitted.
#[test]
fn faces_are_placed() {
    let nominal = bushing();
    let faces = Faces::of(&turned(&nominal, SIDES), &Silent).unwrap();
    let mut off = nominal.clone();
    (off[7][0], off[8][0]) = (8.2, 8.2);
    let (mut scan, sides) = scan(&off, 0.6, 0.0, false, 2);
    // The shaft leans.
    for (p, _) in scan.positions.iter_mut().zip(&sides).filter(|(_, side)| **side == 4) {
        p[0] += 0.02 * (p[2] - 15.0);
    }
    let found = partition(&scan, &all_of(&faces), &OPTIONS, &Silent).unwrap();
    let of_faces = sides_of(&faces, SIDES);
    let placed = |side: usize| found.placed[of_faces.iter().position(|s| *s == side).unwrap()];
    // Out of the material is towards the axis.
    assert!((placed(7).offset + 0.2).abs() < 1e-6 && placed(7).shape.is_none(), "{:?}", placed(7));
    let leans = placed(4).shape.and_then(|s| s.direction()).map(|d| d[0] / d[2]);
    assert!(leans.is_some_and(|x| (x - 0.02).abs() < 1e-4), "{:?}", placed(4));
}

/// Points added to a scan, and the classes that they have to have.
#[test]
fn what_is_of_no_face_is_told_apart() {
    let nominal = bushing();
    let faces = Faces::of(&turned(&nominal, SIDES), &Silent).unwrap();
    let (part, _) = scan(&nominal, 0.6, 0.002, false, 3);
    let grid = |rows: usize, columns: usize, place: &dyn Fn(f64, f64) -> Point| -> Vec<Point> {
        (0..rows * columns).map(|i| place((i / columns) as f64, (i % columns) as f64)).collect()
    };
    // A wall that stands on the flange; a hole in the flange deeper than the reach; a table beside the foot.
    let wall = grid(20, 20, &|i, j| [14.0 + 0.2 * j, 3.0, 6.0 + 0.2 * i]);
    let table = grid(30, 30, &|i, j| [21.0 + 0.5 * i, -7.0 + 0.5 * j, 0.001]);
    let hole = grid(20, 30, &|i, j| {
        let (s, c) = libm::sincos(TAU * j / 30.0);
        [-15.0 + 1.5 * c, 1.5 * s, 5.9 - 0.1 * i]
    });
    let not_in_hole = |p: &&Point| p[2] < 5.5 || libm::hypot(p[0] + 15.0, p[1]) > 1.5;
    let mut positions: Vec<Point> = part.positions.iter().filter(not_in_hole).copied().collect();
    let first = positions.len();
    for more in [&wall, &table, &hole] {
        positions.extend(more);
    }
    let scan = Mesh { positions, faces: vec![] };
    let found = partition(&scan, &all_of(&faces), &OPTIONS, &Silent).unwrap();
    let count = |from: usize, count: usize, class: Class| {
        found.classes[from..from + count].iter().filter(|c| **c == class).count()
    };
    let [of_wall, of_table, of_hole] = [first, first + wall.len(), first + wall.len() + table.len()];
    // Points on the flange within noise belong to it: the first row.
    assert_eq!(count(of_wall, wall.len(), Class::Face), 20);
    assert!(count(of_wall, wall.len(), Class::High) >= 20);
    assert_eq!(count(of_table, table.len(), Class::Face), 0);
    assert!(count(of_hole, hole.len(), Class::Face) == 0 && count(of_hole, hole.len(), Class::Deep) >= 100);
}

/// A dent is form of its face; a groove along an edge is of none for certain.
#[test]
fn dents_are_of_their_face_and_grooves_along_edges_are_not() {
    let nominal = bushing();
    let faces = Faces::of(&turned(&nominal, SIDES), &Silent).unwrap();
    let (mut scan, sides) = scan(&nominal, 0.4, 0.002, false, 4);
    let (mut dent, mut groove) = (vec![], vec![]);
    for (i, p) in scan.positions.iter_mut().enumerate() {
        let rho = libm::hypot(p[0], p[1]);
        // On the shaft, ∅24: a dent of 0.3; at its foot, a groove 0.3 deep and 0.8 wide.
        let away = norm3(minus(*p, [12.0, 0.0, 15.0]));
        let down = match sides[i] {
            4 if away < 2.0 => {
                dent.push(i);
                0.3 * (1.0 - away / 2.0)
            }
            4 if p[2] < 6.6 => {
                groove.push(i);
                0.3
            }
            _ => 0.0,
        };
        (p[0], p[1]) = (p[0] * (1.0 - down / rho), p[1] * (1.0 - down / rho));
    }
    let found = partition(&scan, &all_of(&faces), &OPTIONS, &Silent).unwrap();
    let of_faces = sides_of(&faces, SIDES);
    assert!(
        dent.iter().all(|i| found.classes[*i] == Class::Face && of_faces[found.owners[*i] as usize] == 4)
    );
    let is_edge = |i: usize| matches!(found.classes[i], Class::Edge | Class::Broken);
    let edge = groove.iter().filter(|i| is_edge(**i)).count();
    assert!(10 * edge >= 9 * groove.len(), "{edge} of {}", groove.len());
}

/// A dent deeper than the reach is of its face, as long as it is closed.
#[test]
fn dents_deeper_than_the_reach_are_of_their_face_and_holes_are_not() {
    let nominal = bushing();
    let faces = Faces::of(&turned(&nominal, SIDES), &Silent).unwrap();
    let of_faces = sides_of(&faces, SIDES);
    for as_mesh in [false, true] {
        for is_hole in [false, true] {
            let (mut scan, sides) = scan(&nominal, 0.4, 0.002, as_mesh, 4);
            let mut dent = vec![];
            for (i, p) in scan.positions.iter_mut().enumerate().filter(|(i, _)| sides[*i] == 4) {
                // On the shaft, ∅24, 1.2 deep where the reach is 0.5.
                let (rho, away) = (libm::hypot(p[0], p[1]), norm3(minus(*p, [12.0, 0.0, 15.0])));
                let down = if away < 2.5 { 1.2 * (1.0 - away / 2.5) } else { 0.0 };
                if down > 0.02 {
                    dent.push(i);
                }
                (p[0], p[1]) = (p[0] * (1.0 - down / rho), p[1] * (1.0 - down / rho));
            }
            // Nothing deeper than 0.7 was measured: it may go on.
            let is_open = |p: &Point| is_hole && libm::hypot(p[0], p[1]) < 11.3 && p[0] > 10.0 && p[2] < 20.0;
            let gone: Vec<usize> = (dent.iter().copied()).filter(|i| is_open(&scan.positions[*i])).collect();
            scan.faces.retain(|f| f.iter().all(|v| !gone.contains(&(*v as usize))));
            for i in &gone {
                // Far from everything.
                scan.positions[*i] = [500.0 + *i as f64, 0.0, 0.0];
            }
            dent.retain(|i| !gone.contains(i));
            let found = partition(&scan, &all_of(&faces), &OPTIONS, &Silent).unwrap();
            let class = if is_hole { Class::Deep } else { Class::Dent };
            let is_right = |i: &&usize| {
                found.classes[**i] == class && (is_hole || of_faces[found.owners[**i] as usize] == 4)
            };
            let right = dent.iter().filter(is_right).count();
            assert!(10 * right >= 9 * dent.len(), "{as_mesh} {is_hole}: {right} of {}", dent.len());
        }
    }
}

/// Points out of the material are in no hole of any face, through whatever material its places over that face go.
#[test]
fn what_lies_outside_is_deep_in_no_face() {
    let nominal = bushing();
    let faces = Faces::of(&turned(&nominal, SIDES), &Silent).unwrap();
    let (mut scan, _) = scan(&nominal, 0.6, 0.002, false, 5);
    // The bore was measured in half, and beside the flange, at its height, stands a thing.
    scan.positions.retain(|p| libm::hypot(p[0], p[1]) > 6.5 || p[0] < 0.0);
    let first = scan.positions.len() as u32;
    let thing = |i: usize| {
        [20.6 + 0.4 * (i % 12) as f64, -3.0 + 0.4 * (i / 12 % 15) as f64, 0.5 + 0.4 * (i / 180) as f64]
    };
    scan.positions.extend((0..1800).map(thing));
    let found = partition(&scan, &all_of(&faces), &OPTIONS, &Silent).unwrap();
    let deep = found.beyond.iter().find(|b| b.point >= first && b.off < 0.0);
    assert!(deep.is_none(), "{deep:?}");
}

/// Meshes whose facets straddle edges are scans, without noise too; those with vertices on the edges are not.
#[test]
fn scans_are_told_from_computed_meshes() {
    let nominal = bushing();
    let faces = Faces::of(&turned(&nominal, SIDES), &Silent).unwrap();
    let is_scan = |mesh: &Mesh| partition(mesh, &all_of(&faces), &OPTIONS, &Silent).unwrap().is_scan;
    assert!(!is_scan(&turned(&nominal, SIDES)) && !is_scan(&turned(&nominal, 3 * SIDES)));
    for noise in [0.0, 0.004] {
        assert!(is_scan(&scan(&nominal, 0.6, noise, true, 6).0), "{noise}");
    }
}

fn norm3(v: Vector) -> f64 {
    dot(v, v).sqrt()
}

#[test]
fn wrong_coordinates_are_refused_and_nothing_has_no_faces() {
    let faces = Faces::of(&turned(&bushing(), SIDES), &Silent).unwrap();
    let nan = Mesh { positions: vec![[0.0; 3], [f64::NAN, 0.0, 0.0]], faces: vec![] };
    let found = partition(&nan, &all_of(&faces), &OPTIONS, &Silent);
    assert_eq!(found.err(), Some(PartitionError::NotFinite { index: 1 }));
    let no_vertex = Mesh { positions: vec![[0.0; 3]; 3], faces: vec![[0, 1, 2], [0, 1, 3]] };
    let found = partition(&no_vertex, &all_of(&faces), &OPTIONS, &Silent);
    assert_eq!(found.err(), Some(PartitionError::NoSuchVertex { facet: 1 }));
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let options = Options { distance: Some(value), ..Options::default() };
        let found = partition(&Mesh::default(), &all_of(&faces), &options, &Silent);
        assert!(matches!(found, Err(PartitionError::Reach { face: 0, .. })), "{value}");
    }
    let nothing = partition(&Mesh::default(), &all_of(&faces), &OPTIONS, &Silent).unwrap();
    assert!(nothing.owners.is_empty() && nothing.classes.is_empty());
}
