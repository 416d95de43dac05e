//! Parts that are joined and parts that are parted, and that neither undoes the other.

use super::*;
use trueness_geom::num::random::Random;
use trueness_geom::space::{cross, dot, minus, norm, plus};
use trueness_geom::topology::weld;

/// Two blocks, the second with its lowest corner at `offset`.
fn two(offset: Point) -> Mesh {
    let mut mesh = block(4, 4.0);
    add(&mut mesh, &block(4, 4.0), offset);
    mesh
}

#[test]
fn the_larger_fan_keeps_the_vertex() {
    let mut mesh = block(1, 0.5);
    add(&mut mesh, &block(4, 4.0), [0.5; 3]);
    let repaired = mend(&mesh);
    assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
    // The new vertex lies inside the small block.
    let new = repaired.mesh.positions.last().unwrap();
    assert!(new.iter().all(|x| *x > 0.49 && *x < 0.5), "{new:?}");
}

/// Each needle keeps its place: its tip goes back within it, and no other is touched.
#[test]
fn needles_at_one_vertex_are_parted_within_themselves() {
    let random = &mut Random::new(5);
    let mut mesh = Mesh { positions: vec![[0.0; 3]], faces: vec![] };
    for i in 0..150u32 {
        // Spread over a sphere, so far apart that no two meet.
        let (z, turn) = (1.0 - (2.0 * f64::from(i) + 1.0) / 150.0, 2.399_963 * f64::from(i));
        let (sin, cos) = libm::sincos(turn);
        let far = [cos, sin, z].map(|x| x * 10.0);
        let radius = libm::sqrt(1.0 - z * z);
        let far = [far[0] * radius, far[1] * radius, far[2]];
        let mut corner = || plus(far, std::array::from_fn(|_| random.unit() - 0.5));
        let mut corners = [corner(), corner(), corner()];
        if dot(cross(corners[0], corners[1]), corners[2]) < 0.0 {
            corners.swap(0, 1);
        }
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(corners);
        let [a, b, c] = [first, first + 1, first + 2];
        mesh.faces.extend([[0, b, a], [0, c, b], [0, a, c], [a, b, c]]);
    }
    let repaired = mend(&mesh);
    assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
    assert_eq!(repaired.effect.bodies, [150, 150]);
    assert_eq!(repaired.mesh.faces.len(), 600);
    let tips = repaired.mesh.positions.iter().filter(|p| norm(**p) < 0.1);
    assert_eq!(tips.count(), 150);
}

/// Far from the origin the gap is large. A parted vertex goes no farther than a twentieth of the way to its next
/// corner, and else it stays.
#[test]
fn parts_are_moved_by_little_of_their_size() {
    for far in [0.0, 1e3, 1e4, 1e5] {
        let mut mesh = Mesh { positions: vec![[far; 3]], faces: vec![] };
        for i in 0..12u32 {
            let (sin, cos) = libm::sincos(f64::from(i) * 0.5);
            let [out, up] = [[10.0 * cos, 10.0 * sin, 0.0], [0.0, 0.0, 1.0]];
            let across = cross(up, out.map(|x| 0.2 * x));
            let place = |p: Point| plus([far; 3], plus(out, p));
            let first = mesh.positions.len() as u32;
            mesh.positions.extend([place(across), place(up), place(across.map(|x| -x))]);
            let [a, b, c] = [first, first + 1, first + 2];
            mesh.faces.extend([[0, a, b], [0, b, c], [0, c, a], [a, c, b]]);
        }
        let repaired = mend(&mesh);
        let tips = repaired.mesh.positions[mesh.positions.len()..].iter();
        assert!(tips.clone().all(|p| norm(minus(*p, [far; 3])) < 0.55), "{far}: {tips:?}");
        let shells = [&repaired.before, &repaired.after].map(|report| report.soundness.shells);
        assert!(shells[1] == 12 || shells[0] == shells[1], "{far}: {shells:?}");
    }
}

/// So small a gap that single precision rounds the first offsets to nothing.
#[test]
fn parts_go_farther_from_each_other_until_they_do_not_touch() {
    let options = Options { gap: Some(1e-9), ..only(&["non_manifold_edges"]) };
    let repaired = mend_with(&two([4.0, 4.0, 0.0]), &options);
    assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
    assert_eq!(repaired.after.soundness.shells, 2);
}

#[test]
fn vertices_that_cannot_be_set_off_become_one_again() {
    let options = Options { gap: Some(1e-15), ..only(&["non_manifold_vertices"]) };
    let repaired = mend_with(&two([4.0; 3]), &options);
    assert_eq!(repaired.after.soundness.non_manifold_vertices, 1);
    let places = weld::mesh(&repaired.mesh).unwrap().mesh.positions.len();
    assert_eq!(places, repaired.mesh.positions.len());
}

/// Two facets that touch at a corner are parted. The new vertex comes to lie within the gap of a vertex of a third
/// facet, or its edge within the stitching distance of one. Joined again, they would be parted again, and so on.
#[test]
fn what_was_parted_is_not_stitched() {
    let near = [[[0.0, 0.005, -0.045], [-10.0, 9.0, -9.0]], [[0.0, 0.004, -0.055], [-10.0, 0.015, -10.0]]];
    for [vertex, end] in near {
        let positions = vec![
            [0.0; 3],
            [20.0, 0.0, 0.0],
            [20.0, 20.0, 0.0],
            [-10.0, 0.0, -10.0],
            [10.0, 0.0, -10.0],
            vertex,
            end,
            [-5.0, 20.0, -5.0],
        ];
        let mesh = Mesh { positions, faces: vec![[0, 1, 2], [0, 3, 4], [5, 6, 7]] };
        let options = Options { gap: Some(0.01), stitch: Some(0.02), ..Options::default() };
        let repaired = unguarded(&mesh, &options);
        let place = repaired.mesh.positions.last();
        assert_eq!(place, Some(&[0.0, 0.0, -0.04]), "{vertex:?}: set off by four gaps");
        assert_eq!((repaired.rounds, repaired.changes.len()), (2, 1), "{vertex:?}: {:?}", repaired.changes);
    }
}

#[test]
fn the_vertex_with_more_facets_stays_whatever_its_number() {
    let mut mesh = block(4, 4.0);
    let first = mesh.positions.len() as u32;
    let loose = mesh.faces[20].map(|v| plus(mesh.positions[v as usize], [3e-5, -2e-5, 1e-5]));
    mesh.positions.extend(loose);
    mesh.faces[20] = [first, first + 1, first + 2];
    // The loose facet has the lowest numbers now.
    mesh.positions.reverse();
    mesh.faces.iter_mut().for_each(|f| *f = f.map(|v| first + 2 - v));
    let repaired = mend(&mesh);
    assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
    assert_eq!(repaired.mesh.positions, mesh.positions[3..]);
}

/// The stitching distance is longer than the edges of a square hole, but it does not fold up.
#[test]
fn a_hole_narrower_than_the_stitching_distance_is_filled_and_not_stitched() {
    let mut mesh = block(4, 4.0);
    let corner = |p: &Point| p[2] == 4.0 && p[0] <= 2.0 && p[1] <= 2.0 && p[0] >= 1.0 && p[1] >= 1.0;
    mesh.faces.retain(|f| !f.iter().all(|v| corner(&mesh.positions[*v as usize])));
    let repaired = mend_with(&mesh, &Options { stitch: Some(2.0), ..Options::default() });
    assert_eq!((repaired.before.soundness.boundary_edges, repaired.counts.facets_added), (4, 2));
    assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
    assert_eq!(repaired.after.properties.signed_volume, 64.0);
}

#[test]
fn of_doubled_facets_that_look_both_ways_the_right_one_stays() {
    let sound = block(4, 4.0);
    for first in [true, false] {
        let mut mesh = sound.clone();
        let [a, b, c] = mesh.faces[20];
        mesh.faces.push([a, c, b]);
        if first {
            mesh.faces.swap_remove(20);
            mesh.faces.push([a, b, c]);
        }
        let repaired = mend_with(&mesh, &only(&["duplicates"]));
        assert!(repaired.after.sound, "{first}: {:?}", counts(&repaired.after));
        assert_eq!(repaired.mesh.faces.len(), sound.faces.len());
    }
}

/// A facet is missing where another body passes: its patch crosses that body until both are united.
#[test]
fn a_hole_within_another_body_is_filled_and_united() {
    for missing in 0..12 {
        let mut mesh = block(1, 10.0);
        add(&mut mesh, &block(1, 10.0), [5.0, 3.0, 2.0]);
        mesh.faces.remove(12 + missing);
        let repaired = mend(&mesh);
        assert!(repaired.after.sound, "{missing}: {:?}", counts(&repaired.after));
        let volume = repaired.after.properties.signed_volume;
        assert!((volume - (2000.0 - 5.0 * 7.0 * 8.0)).abs() < 1e-9, "{missing}: {volume}");
    }
}

/// Three pages at one spine are an open surface: none of them is a fin. On a closed block a page is one.
#[test]
fn pages_of_an_open_surface_stay() {
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.5, 100.0, 0.0], [0.5, -1.0, 0.5], [0.5, -1.0, -0.5]];
    let mesh = Mesh { positions, faces: vec![[0, 1, 2], [1, 0, 3], [1, 0, 4]] };
    let repaired = mend_with(&mesh, &only(&["fins"]));
    assert_eq!((repaired.changes.len(), repaired.mesh.faces.len()), (0, 3));
    let mut mesh = block(4, 4.0);
    let (facets, [a, b, _]) = (mesh.faces.len(), mesh.faces[0]);
    mesh.positions.push([-1.0, -1.0, -1.0]);
    mesh.faces.push([a, b, mesh.positions.len() as u32 - 1]);
    // The same block with a hole: the hole is filled first.
    for open in [false, true] {
        if open {
            mesh.faces.remove(facets / 2);
        }
        let repaired = mend(&mesh);
        assert!(repaired.after.sound, "{open}: {:?}", counts(&repaired.after));
        assert_eq!((repaired.mesh.faces.len(), repaired.after.properties.signed_volume), (facets, 64.0));
    }
}

/// A hood with a window and a slot. The border is larger than the limit, so that these are no holes either; a missing
/// facet is one.
#[test]
fn an_open_sheet_keeps_its_borders() {
    let mut mesh = block(8, 8.0);
    let positions = mesh.positions.clone();
    let all = |f: &[u32; 3], is: &dyn Fn(Point) -> bool| f.iter().all(|v| is(positions[*v as usize]));
    let floor = |p: Point| p[2] == 0.0;
    let window = |p: Point| p[2] == 8.0 && (3.0..=6.0).contains(&p[0]) && (3.0..=6.0).contains(&p[1]);
    let slot = |p: Point| p[2] == 8.0 && (3.0..=5.0).contains(&p[0]) && (1.0..=2.0).contains(&p[1]);
    mesh.faces.retain(|f| !all(f, &floor) && !all(f, &window) && !all(f, &slot));
    mesh.faces.remove(100);
    let facets = mesh.faces.len();
    // The floor is a fifth of the rest, the window 3 %, the slot 0.7 %, the facet 0.2 %.
    for (limit, filled) in [(0.001, 0), (0.1, 1), (0.2, 1), (0.25, 4)] {
        let repaired = mend_with(&mesh, &Options { holes: Holes::UpTo(limit), ..Options::default() });
        assert_eq!(repaired.changes.len(), filled, "{limit}");
        let (added, sound) = (repaired.mesh.faces.len() - facets, repaired.after.sound);
        assert!(if filled == 4 { sound } else { added == filled }, "{limit}: {added}");
    }
    assert!(mend_with(&mesh, &Options { holes: Holes::All, ..Options::default() }).after.sound);
}

#[test]
fn small_sheets_beside_a_large_one_are_no_scraps() {
    let mut mesh = block(4, 4.0);
    mesh.faces.truncate(8);
    let mut piece = block(1, 0.25);
    piece.faces.truncate(1);
    add(&mut mesh, &piece, [9.0; 3]);
    assert_eq!(mend_with(&mesh, &only(&["scraps"])).changes, []);
}

/// A sheet so narrow that its long edges lie within the stitching distance of each other.
#[test]
fn a_narrow_strip_is_not_folded_up() {
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 0.01, 0.0], [0.0, 0.01, 0.0]];
    let mesh = Mesh { positions, faces: vec![[0, 1, 2], [0, 2, 3]] };
    assert_eq!(mend_with(&mesh, &Options { stitch: Some(0.1), ..only(&["stitch"]) }).changes, []);
}

/// A rim with a step above a straight one. The lower part of the step is joined first. The upper one must not be joined
/// then, or the riser between them would fold up.
#[test]
fn a_step_in_a_rim_is_not_folded_up() {
    let positions = vec![
        [-1.0, 0.0, 0.0],
        [0.0; 3],
        [1.0, 0.0, 0.0],
        [0.0, -5.0, 0.0],
        [-1.0, 0.2, 0.0],
        [0.0, 0.2, 0.0],
        [0.0, 0.01, 0.0],
        [1.0, 0.01, 0.0],
        [0.5, 5.0, 0.0],
    ];
    let faces = vec![[0, 3, 1], [1, 3, 2], [4, 5, 8], [5, 6, 8], [6, 7, 8]];
    let mesh = Mesh { positions, faces };
    let repaired = mend_with(&mesh, &Options { stitch: Some(0.25), ..only(&["stitch"]) });
    assert_eq!((repaired.changes.len(), repaired.counts.vertices_removed), (2, 2), "{:?}", repaired.changes);
    assert_eq!(repaired.after.found(check::DEGENERATE_FACETS).map(|found| found.count), Some(0));
}

/// The vertex lies within the gap of both long edges of a needle.
#[test]
fn a_vertex_cuts_a_facet_once() {
    let positions = vec![
        [0.0; 3],
        [10.0, 0.0, 0.0],
        [10.0, 0.1, 0.0],
        [5.0, 0.02, 0.0],
        [4.0, 0.0, 5.0],
        [6.0, 0.0, 5.0],
    ];
    let mesh = Mesh { positions, faces: vec![[0, 1, 2], [3, 4, 5]] };
    let options = Options { gap: Some(0.05), ..only(&["t_junctions"]) };
    let repaired = unguarded(&mesh, &options);
    assert_eq!(repaired.mesh.faces.len(), 3);
    assert_eq!(repaired.after.found(check::DEGENERATE_FACETS).map(|found| found.count), Some(0));
}

/// Two holes that touch at a corner, where a fin stands as well. The fin is parted, but the surface between the holes
/// stays one by their filling.
#[test]
fn fans_between_holes_wait_until_these_are_filled() {
    let mut mesh = block(4, 4.0);
    let at = |p: Point| mesh.positions.iter().position(|q| *q == p).unwrap() as u32;
    let [v, w, left, behind, right, before] =
        [[2.0, 2.0], [3.0, 3.0], [1.0, 2.0], [2.0, 3.0], [3.0, 2.0], [2.0, 1.0]]
            .map(|[x, y]| at([x, y, 4.0]));
    let holes = [[v, left, behind], [v, right, before]];
    mesh.faces.retain(|f| !holes.iter().any(|hole| hole.iter().all(|v| f.contains(v))));
    mesh.faces.push([v, w, mesh.positions.len() as u32]);
    mesh.positions.push([2.5, 2.5, 90.0]);
    let repaired = mend_with(&mesh, &only(&["non_manifold_edges", "holes"]));
    let steps: Vec<&str> = repaired.changes.iter().map(|c| c.step.name).collect();
    assert_eq!(steps, ["non_manifold_edges", "holes", "holes"]);
    assert_eq!(repaired.after.soundness.boundary_edges, 3);
}

/// Facets that crossed before the parting are no reason to set vertices farther and farther off.
#[test]
fn facets_that_crossed_before_do_not_drive_parts_away() {
    let mut mesh = two([4.0, 4.0, 0.0]);
    let n = mesh.positions.len() as u32;
    mesh.positions.extend([[3.7, 4.3, 0.3], [4.3, 4.4, 0.35], [4.1, 4.3, 0.6]]);
    mesh.faces.push([n, n + 1, n + 2]);
    let repaired = mend_with(&mesh, &only(&["non_manifold_edges"]));
    let new: Vec<&Point> = repaired.mesh.positions.iter().filter(|p| !mesh.positions.contains(p)).collect();
    assert_eq!(new.len(), 5);
    assert!(new.iter().all(|p| p[..2].iter().all(|x| (x - 4.0).abs() < 1e-4)), "{new:?}");
}

/// Bodies that touch in faces, turned at random, become one: slits that rounding left between them are no surface that
/// was lost. In edges and points they are parted.
#[test]
fn bodies_that_touch_are_united_however_they_are_turned() {
    use crate::arrange::tests::touching::{rotation, touching};
    let random = &mut Random::new(17);
    for _ in 0..12 {
        let turn = rotation(random);
        for (name, mut mesh, _) in touching(random) {
            mesh.positions.iter_mut().for_each(|p| *p = turn.point(*p));
            let repaired = mend(&mesh);
            let (enclosed, surface) =
                (repaired.effect.enclosed.as_ref().unwrap(), repaired.effect.surface.unwrap());
            assert!(repaired.after.sound && repaired.taken_back.is_empty(), "{name}");
            let near = if name.contains("edges") || name.contains("tip") { 0.1 } else { 1e-12 };
            assert!(surface < near, "{name}: {surface}");
            let volume = repaired.after.properties.signed_volume;
            assert!((volume - enclosed.volume).abs() <= near * enclosed.volume, "{name}: {volume}");
            // No wall is left where they touched.
            let areas = [("a slab of four cubes", 16.0), ("two boxes upon a cube", 10.0)];
            if let Some((_, area)) = areas.iter().find(|(of, _)| *of == name) {
                assert!((repaired.after.properties.area - area).abs() < 1e-12 * area, "{name}");
            }
        }
    }
}

/// Boxes that touch, turned: their sides lie a rounding apart, and where these cross cannot be written in double precision. Rounded to
/// single precision they become one; where that would take vertices too far, nothing is rounded.
#[test]
fn what_cannot_be_united_as_it_is_becomes_one_in_single_precision() {
    let mut numbers = include_str!("boxes_a_rounding_apart.off").split_whitespace().skip(1);
    let mut next = || numbers.next().unwrap();
    let [vertices, facets, _] = [(); 3].map(|()| next().parse::<usize>().unwrap());
    let positions = (0..vertices).map(|_| [(); 3].map(|()| next().parse().unwrap())).collect();
    let faces = (0..facets).map(|_| [(); 4].map(|()| next().parse().unwrap())).map(|[_, a, b, c]| [a, b, c]);
    let mut mesh = Mesh { positions, faces: faces.collect() };
    let repaired = super::super::repair(&mesh, &Options::default(), &Silent).unwrap();
    assert!(repaired.after.sound && repaired.taken_back.is_empty() && repaired.not_united.is_none());
    assert!(repaired.rounded.vertices > 0 && repaired.rounded.farthest < 1e-6);
    assert!((repaired.after.properties.signed_volume - 35.0).abs() < 1e-5);
    mesh.positions.iter_mut().for_each(|p| *p = plus(*p, [1024.0; 3]));
    let far = super::super::repair(&mesh, &Options::default(), &Silent).unwrap();
    assert_eq!(far.rounded.vertices, 0);
}

/// Flaps of an open cone: each is moved, and its tip then lies beside the boundary edges of its neighbors.
#[test]
fn flaps_at_one_vertex_are_parted_beyond_the_gap_of_their_neighbors() {
    for (n, height) in [(8, 0.5), (24, 5.0), (100, 5.0), (300, 0.5)] {
        let mut mesh = Mesh { positions: vec![[0.0; 3]], faces: vec![] };
        for i in 0..n {
            let corner = |side: f64| {
                let (sin, cos) = libm::sincos(std::f64::consts::TAU * (f64::from(i) + side) / f64::from(n));
                [10.0 * cos, 10.0 * sin, height]
            };
            let first = mesh.positions.len() as u32;
            mesh.positions.extend([corner(-0.3), corner(0.3)]);
            mesh.faces.push([0, first, first + 1]);
        }
        let repaired = mend(&mesh);
        assert_eq!(repaired.after.soundness.non_manifold_vertices, 0, "{n}");

        assert_eq!(repaired.after.count(check::T_JUNCTIONS), 0, "{n}");
        assert_eq!(repaired.mesh.positions.len(), 3 * n as usize);
    }
}
