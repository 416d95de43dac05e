//! Filling holes: small and large, flat and curved, short and long rings.

use super::*;
use trueness_geom::rigid::Rigid;
use trueness_geom::samples::{add, block, sphere};
use trueness_geom::space::{minus, norm};
use trueness_geom::topology::weld;

/// A sphere without the facets whose corners all lie above `height`.
fn bowl(n: usize, height: f64) -> Mesh {
    let mut mesh = weld::mesh(&sphere(n, 10.0, [0.0; 3])).unwrap().mesh;
    mesh.faces.retain(|f| f.iter().any(|v| mesh.positions[*v as usize][2] <= height));
    weld::mesh(&mesh).unwrap().mesh
}

fn volume(r: &Repaired) -> f64 {
    r.after.properties.signed_volume
}

#[test]
fn a_cap_of_a_sphere_comes_back_round() {
    let mesh = bowl(48, 8.0);
    let repaired = mend(&mesh);
    assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
    assert!(repaired.counts.vertices_added > 20, "{:?}", repaired.counts);
    let new =
        &repaired.mesh.positions[repaired.mesh.positions.len() - repaired.counts.vertices_added as usize..];
    let off = new.iter().map(|p| (norm(minus(*p, [0.0; 3])) - 10.0).abs()).fold(0.0, f64::max);
    // A flat lid would lie more than 2 below the top.
    assert!(off < 0.7, "{off}");
}

#[test]
fn an_open_end_gets_a_flat_lid_without_new_vertices() {
    let mut mesh = block(6, 6.0);
    mesh.faces.retain(|f| f.iter().any(|v| mesh.positions[*v as usize][2] != 6.0));
    let mesh = weld::mesh(&mesh).unwrap().mesh;
    let repaired = mend(&mesh);
    assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
    assert_eq!((repaired.counts.vertices_added, repaired.counts.facets_added), (0, 22));
    assert!((volume(&repaired) - 216.0).abs() < 1e-9);
}

#[test]
fn large_holes_wait_to_be_asked() {
    // Three sides of a block: half of it is missing.
    let mut mesh = block(3, 6.0);
    mesh.faces.retain(|f| (0..3).any(|k| f.iter().all(|v| mesh.positions[*v as usize][k] == 0.0)));
    let mesh = weld::mesh(&mesh).unwrap().mesh;
    assert_eq!(mend(&mesh).changes, []);
    let all = Options { holes: Holes::All, ..Options::default() };
    let repaired = mend_with(&mesh, &all);
    assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
    // A sheet has nothing behind its rim.
    let sheet = Mesh { positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], faces: vec![[0, 1, 2]] };
    assert_eq!(mend(&sheet).changes, []);
}

#[test]
fn the_border_of_a_flat_sheet_stays_even_if_all_holes_are_asked_for() {
    let all = Options { holes: Holes::All, ..Options::default() };
    let random = &mut Random::new(7);
    for _ in 0..20 {
        // A square of 5 x 5 with a hole in its middle, turned anyhow.
        let turn = Rigid::rotation_about([0.0; 3], std::array::from_fn(|_| 6.0 * random.unit() - 3.0));
        let turned = |p: Point| turn.point(p);
        let positions = (0..36).map(|i| turned([f64::from(i % 6), f64::from(i / 6), 0.0])).collect();
        let squares = (0..25u32).filter(|s| *s != 12).map(|s| s / 5 * 6 + s % 5);
        let faces = squares.flat_map(|v| [[v, v + 1, v + 7], [v, v + 7, v + 6]]).collect();
        let repaired = mend_with(&Mesh { positions, faces }, &all);
        assert_eq!((repaired.counts.facets_added, repaired.counts.vertices_added), (2, 0));
        assert!((repaired.after.properties.area - 25.0).abs() < 1e-12 && !repaired.after.soundness.closed);
    }
}

#[test]
fn rings_too_long_to_weigh_all_ways_are_filled() {
    // A prism over a polygon of 400 corners without its lid, and one whose rim goes up and down.
    for wave in [0.0, 0.5] {
        let n = 400u32;
        let place = |i: u32, top: bool| {
            let t = std::f64::consts::TAU * f64::from(i) / f64::from(n);
            let z = if top { 8.0 + wave * (6.0 * t).sin() } else { 0.0 };
            [10.0 * t.cos(), 10.0 * t.sin(), z]
        };
        let mut positions: Vec<Point> =
            (0..n).map(|i| place(i, false)).chain((0..n).map(|i| place(i, true))).collect();
        positions.push([0.0; 3]);
        let wall = |i: u32| {
            let j = (i + 1) % n;
            [[i, j, n + j], [i, n + j, n + i], [j, i, 2 * n]]
        };
        let mesh = Mesh { positions, faces: (0..n).flat_map(wall).collect() };
        let repaired = mend_with(&mesh, &Options { holes: Holes::All, ..Options::default() });
        assert!(repaired.after.sound, "{wave}: {:?}", counts(&repaired.after));
    }
}

#[test]
fn a_hole_across_an_edge_of_a_part_is_closed() {
    for spare in [1.5, 2.5] {
        let mut mesh = block(6, 6.0);
        let near = |v: &u32| {
            let p = mesh.positions[*v as usize];
            norm(minus(p, [3.0, 0.0, 6.0])) < spare
        };
        mesh.faces.retain(|f| !f.iter().any(near));
        let mesh = weld::mesh(&mesh).unwrap().mesh;
        let repaired = mend(&mesh);
        assert!(repaired.after.sound, "{spare}: {:?}", counts(&repaired.after));
    }
}

/// An open box with a pin that stands in its mouth: every patch would cross the pin.
#[test]
fn a_hole_that_something_stands_in_stays_open() {
    let mut mesh = block(4, 4.0);
    mesh.faces.retain(|f| f.iter().any(|v| mesh.positions[*v as usize][2] != 4.0));
    let options = Options { holes: Holes::All, ..only(&["holes"]) };
    assert!(mend_with(&mesh, &options).after.sound);
    add(&mut mesh, &block(1, 1.0), [1.5, 1.5, 3.5]);
    let repaired = mend_with(&mesh, &options);
    assert_eq!(counts(&repaired.after), counts(&repaired.before));
    assert_eq!(repaired.changes, []);
}

/// The patch is one facet, and that crosses a pin.
#[test]
fn a_hole_of_one_facet_that_something_stands_in_stays_open() {
    let mut mesh = block(1, 4.0);
    let top =
        mesh.faces.iter().position(|f| f.iter().all(|v| mesh.positions[*v as usize][2] == 4.0)).unwrap();
    let corners = mesh.faces.remove(top).map(|v| mesh.positions[v as usize]);
    let middle: Point = std::array::from_fn(|k| corners.iter().map(|p| p[k]).sum::<f64>() / 3.0);
    let options = only(&["holes"]);
    assert!(mend_with(&mesh, &options).after.sound);
    add(&mut mesh, &block(1, 0.5), middle.map(|x| x - 0.25));
    assert_eq!(mend_with(&mesh, &options).changes, []);
}
