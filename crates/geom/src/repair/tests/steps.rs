//! Special cases of single steps.

use super::*;
use crate::check::tests::{add, inverted};
use crate::space::{norm, plus};
use crate::topology::tests::block;

/// Two blocks, the second with its lowest corner at `offset`.
fn two(offset: Point) -> Mesh {
    let mut mesh = block(4, 4.0);
    add(&mut mesh, &block(4, 4.0), offset);
    mesh
}

fn did(repaired: &Repaired, step: &str) -> usize {
    repaired.changes.iter().filter(|c| c.step == step).count()
}

#[test]
fn blocks_that_share_an_edge_are_parted_by_a_hair() {
    let mesh = two([4.0, 4.0, 0.0]);
    let repaired = mend(&mesh);
    assert_eq!(repaired.before.soundness.non_manifold_edges, 4);
    assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
    assert_eq!((repaired.after.soundness.shells, did(&repaired, "non_manifold_edges")), (2, 5));
    let volume = repaired.after.properties.signed_volume;
    assert!(volume < 128.0 && volume > 127.999, "{volume}");
    // It survives single precision.
    assert!(repaired.mesh.positions.iter().flatten().all(|x| f64::from(*x as f32) == *x));
}

/// Blocks that touch along edges and sides, so that the surface runs into itself.
#[test]
fn a_surface_that_runs_into_itself_is_parted() {
    let mut mesh = block(1, 1.0);
    add(&mut mesh, &block(1, 1.0), [1.0, 1.0, 0.0]);
    // Bodies below and above it, so that the surface is connected around both of its ends.
    add(&mut mesh, &block(1, 1.0), [1.0, 0.0, 1.0]);
    add(&mut mesh, &block(1, 1.0), [1.0, 0.0, -1.0]);
    let repaired = mend(&mesh);
    assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
    assert!(repaired.after.soundness.closed);
}

#[test]
fn nested_shells_look_outwards_and_inwards_in_turn() {
    for flip in 0..8 {
        let shell = |size: f64, i: u32| {
            let mut b = block(2, size);
            b.positions.iter_mut().for_each(|p| *p = p.map(|x| x + (8.0 - size) / 2.0));
            if flip >> i & 1 == 1 { inverted(b) } else { b }
        };
        let mut mesh = shell(8.0, 0);
        add(&mut mesh, &shell(6.0, 1), [0.0; 3]);
        add(&mut mesh, &shell(4.0, 2), [0.0; 3]);
        let repaired = mend(&mesh);
        assert!(repaired.after.sound, "{flip}: {:?}", counts(&repaired.after));
        assert!((repaired.after.properties.signed_volume - (512.0 - 216.0 + 64.0)).abs() < 1e-9);
        assert_eq!(repaired.counts.facets_removed, 0);
    }
}

#[test]
fn a_wall_inside_is_removed() {
    let mut mesh = two([4.0, 0.0, 0.0]);
    // The side that the two have in common is there twice, looking both ways: a box with one wall.
    let repaired = mend(&mesh);
    assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
    assert!((repaired.after.properties.signed_volume - 128.0).abs() < 1e-9);
    assert_eq!(repaired.after.soundness.shells, 1);
    // Only once: three facets at each edge of the wall.
    let first_wall = |f: &[u32; 3]| f.iter().all(|v| mesh.positions[*v as usize][0] == 4.0);
    let from = mesh.faces.len() / 2;
    let kept: Vec<[u32; 3]> =
        mesh.faces.iter().enumerate().filter(|(i, f)| *i < from || !first_wall(f)).map(|(_, f)| *f).collect();
    mesh.faces = kept;
    let repaired = mend(&mesh);
    assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
    assert_eq!((did(&repaired, "fins"), repaired.after.soundness.shells), (1, 1));
}

#[test]
fn a_gap_is_stitched_and_the_vertex_with_more_facets_stays() {
    // One facet of a block is a little off.
    let mut mesh = block(4, 4.0);
    let face = mesh.faces[20];
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(face.map(|v| plus(mesh.positions[v as usize], [3e-5, -2e-5, 1e-5])));
    mesh.faces[20] = [first, first + 1, first + 2];
    let sound = block(4, 4.0);
    let repaired = mend(&mesh);
    assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
    assert_eq!((repaired.counts.vertices_removed, repaired.counts.vertices_added), (3, 0));
    assert_eq!(repaired.mesh.positions, sound.positions);
    let largest = repaired.changes.iter().map(|c| c.size).fold(0.0, f64::max);
    assert!((largest - norm([3e-5, -2e-5, 1e-5])).abs() < 1e-12);
    let back = deviation(&mesh, &repaired.mesh, &Silent).unwrap();
    assert!(back.there.max > 1e-5 && back.there.max <= largest && back.there.mean < 1e-6, "{back:?}");
    // Beyond the distance given nothing is stitched.
    let narrow = Options { stitch: Some(1e-5), holes: Holes::UpTo(0.0), ..Options::default() };
    assert!(mend_with(&mesh, &narrow).changes.iter().all(|c| c.step != "stitch"));
}

#[test]
fn several_vertices_on_one_edge_cut_one_facet() {
    // The facets beyond an edge of a big triangle are finer than it.
    let big = block(1, 4.0);
    let mut mesh = block(4, 4.0);
    // The upper side of the fine block gives way to that of the coarse one.
    mesh.faces.retain(|f| f.iter().any(|v| mesh.positions[*v as usize][2] != 4.0));
    let top: Vec<[u32; 3]> = big
        .faces
        .iter()
        .filter(|f| f.iter().all(|v| big.positions[*v as usize][2] == 4.0))
        .copied()
        .collect();
    add(&mut mesh, &Mesh { positions: big.positions.clone(), faces: top }, [0.0; 3]);
    let repaired = mend(&mesh);
    assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
    assert_eq!(did(&repaired, "t_junctions"), 2);
    assert_eq!(repaired.counts.vertices_added, 0);
    assert_eq!(repaired.after.properties.signed_volume, 64.0);
    let away = deviation(&mesh, &repaired.mesh, &Silent).unwrap();
    assert_eq!((away.there.max, away.back.max), (0.0, 0.0));
}

#[test]
fn crossing_blocks_become_sound() {
    // What is torn out is filled, whatever the limit for holes.
    let no_holes = Options { holes: Holes::UpTo(0.0), ..Options::default() };
    let repaired = mend_with(&two([2.5, 2.5, 2.5]), &no_holes);
    assert!(!repaired.before.sound && repaired.after.sound, "{:?}", counts(&repaired.after));
    assert!(repaired.after.soundness.closed);
}

#[test]
fn what_only_consists_of_crossings_is_left_alone() {
    let mesh = two([0.5, 0.5, 0.5]);
    let repaired = mend(&mesh);
    assert!(repaired.after.properties.area > 0.25 * repaired.before.properties.area);
}

#[test]
fn dust_goes_on_request_only() {
    let (mesh, ..) = planted("islands", 3);
    assert_eq!(mend(&mesh).changes, []);
    let repaired = mend_with(&mesh, &Options { islands: Some(0.01), ..Options::default() });
    assert_eq!((did(&repaired, "islands"), repaired.after.soundness.shells), (3, 1));
}

#[test]
fn a_flat_facet_is_cut_out_of_its_neighbours() {
    // A cap on a side of the block: its middle vertex splits the long edge of the neighbour.
    let mut mesh = block(1, 4.0);
    let n = mesh.positions.len() as u32;
    mesh.positions.push([2.0, 0.0, 0.0]);
    let along = |f: &[u32; 3]| {
        (0..3).position(|k| {
            mesh.positions[f[k] as usize] == [0.0; 3]
                && mesh.positions[f[(k + 1) % 3] as usize] == [4.0, 0.0, 0.0]
        })
    };
    let (i, k) = mesh.faces.iter().enumerate().find_map(|(i, f)| Some((i, along(f)?))).unwrap();
    let [a, b, c] = std::array::from_fn(|j| mesh.faces[i][(k + j) % 3]);
    mesh.faces[i] = [a, n, c];
    mesh.faces.extend([[n, b, c], [a, b, n]]);
    let repaired = mend(&mesh);
    assert_eq!(repaired.before.found("degenerate_facets").map(|f| f.count), Some(1));
    assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
    assert_eq!((repaired.after.properties.signed_volume, did(&repaired, "degenerate")), (64.0, 1));
    assert_eq!(repaired.changes.len(), 1, "nothing else had to be mended: {:?}", repaired.changes);
}
