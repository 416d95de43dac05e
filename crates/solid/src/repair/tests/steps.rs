//! Special cases of single steps.

use super::*;
use crate::arrange::tests::touching::rotation;
use trueness_geom::samples::{add, block, inverted};
use trueness_geom::space::{norm, plus};
use trueness_geom::topology::weld;

/// Two blocks, the second with its lowest corner at `offset`.
fn two(offset: Point) -> Mesh {
    let mut mesh = block(4, 4.0);
    add(&mut mesh, &block(4, 4.0), offset);
    mesh
}

fn did(repaired: &Repaired, step: &str) -> usize {
    repaired.changes.iter().filter(|c| c.step.name == step).count()
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

/// The surface of unit cubes with their lowest corners at these places.
fn cubes(places: &[[i32; 3]]) -> Mesh {
    let mut mesh = Mesh::default();
    for place in places {
        for (k, side) in (0..3).flat_map(|k| [(k, 0), (k, 1)]) {
            let mut beyond = *place;
            beyond[k] += 2 * side - 1;
            if places.contains(&beyond) {
                continue;
            }
            let corner = |u: i32, v: i32| -> Point {
                let mut p = *place;
                p[k] += side;
                p[(k + 1) % 3] += u;
                p[(k + 2) % 3] += v;
                p.map(f64::from)
            };
            let n = mesh.positions.len() as u32;
            mesh.positions.extend([corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)]);
            let quad = if side == 1 { [n, n + 1, n + 2, n + 3] } else { [n, n + 3, n + 2, n + 1] };
            mesh.faces.extend([[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]]);
        }
    }
    mesh
}

/// Two cubes touch along an edge and are connected at both of its ends, so that neither end has a fan to part.
#[test]
fn an_edge_between_connected_ends_is_parted_in_its_middle() {
    let ends = |z: i32| [[0, 0, z], [1, 0, z], [1, 1, z]];
    let mesh = cubes(&[&ends(0)[..], &[[0, 0, 1], [1, 1, 1]], &ends(2)].concat());
    let repaired = mend(&mesh);
    assert_eq!(repaired.before.soundness.non_manifold_edges, 1);
    assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
    assert!(repaired.changes.iter().any(|c| c.what == "edge parted in its middle"), "{:?}", repaired.changes);
    assert!((repaired.after.properties.signed_volume - 8.0).abs() < 1e-3);
}

#[test]
fn the_smaller_part_is_turned() {
    for turned in [vec![20], vec![3, 40, 60]] {
        let mut mesh = block(4, 4.0);
        turned.iter().for_each(|f: &usize| mesh.faces[*f].swap(0, 1));
        let repaired = mend_with(&mesh, &only(&["orient"]));
        assert_eq!(repaired.after.properties.signed_volume, 64.0);
        assert_eq!(repaired.changes.iter().map(|c| c.facets).sum::<usize>(), turned.len());
    }
}

#[test]
fn a_scrap_is_a_sheet_and_an_open_cup_is_none() {
    let only = only(&["scraps"]);
    for (facets, gone) in [(2, 1), (11, 0)] {
        let mut mesh = block(4, 4.0);
        let mut piece = block(1, 1.0);
        piece.faces.truncate(facets);
        add(&mut mesh, &piece, [9.0; 3]);
        assert_eq!(did(&mend_with(&mesh, &only), "scraps"), gone, "{facets}");
    }
}

/// A sheet beside a block is surface of the part, one inside it is none.
#[test]
fn what_is_lost_is_told_where_no_material_is() {
    for (at, off) in [([9.0; 3], 5.0 * 3f64.sqrt()), ([1.5; 3], 0.0)] {
        let mut mesh = block(4, 4.0);
        let mut sheet = block(1, 1.0);
        sheet.faces.truncate(2);
        add(&mut mesh, &sheet, at);
        let repaired = mend(&mesh);
        assert!(repaired.after.sound && did(&repaired, "scraps") == 1);
        let stated = repaired.effect.surface.unwrap();
        assert!(
            if off > 0.0 { stated >= off && stated < off + 2.0 } else { stated == 0.0 },
            "{stated} {off}"
        );
    }
}

/// Sheets that would be removed to close the rest stay where the rest stays open all the same.
#[test]
fn no_sheet_is_removed_in_vain() {
    let mut mesh = block(4, 4.0);
    let mut sheet = block(1, 1.0);
    sheet.faces.truncate(2);
    add(&mut mesh, &sheet, [9.0; 3]);
    assert_eq!(did(&mend(&mesh), "scraps"), 1);
    // Three sides of a block: a sheet that was meant to be open.
    let mut open = block(1, 8.0);
    open.faces.retain(|f| (0..3).any(|k| f.iter().all(|v| open.positions[*v as usize][k] == 0.0)));
    add(&mut mesh, &open, [20.0; 3]);
    let repaired = mend(&mesh);
    assert_eq!((did(&repaired, "scraps"), &repaired.taken_back[..]), (0, &[&scraps::STEP][..]));
}

/// A facet that is not finite is no surface: it goes even where without it a hole is left that nothing fits.
#[test]
fn facets_that_are_not_finite_always_go() {
    let mut mesh = block(3, 6.0);
    mesh.faces.retain(|f| (0..3).any(|k| f.iter().all(|v| mesh.positions[*v as usize][k] == 0.0)));
    let mut mesh = weld::mesh(&mesh).unwrap().mesh;
    // A vertex in the middle of a side.
    let middle = mesh.positions.iter().position(|p| *p == [2.0, 2.0, 0.0]).unwrap();
    mesh.positions[middle][2] = f64::NAN;
    for holes in [Holes::UpTo(0.0), Holes::UpTo(0.25)] {
        let repaired = mend_with(&mesh, &Options { holes, ..Options::default() });
        assert!(repaired.mesh.positions.iter().flatten().all(|x| x.is_finite()), "{holes:?}");
        assert_eq!(did(&repaired, "not_finite"), 1, "{holes:?}");
    }
}

/// Material is where the shells wind around a place; all are turned where that is nowhere.
#[test]
fn nested_shells_bound_what_they_wind_around() {
    for flip in 0..8 {
        let sign = |i: u32| if flip >> i & 1 == 1 { -1 } else { 1 };
        let shell = |size: f64, i: u32| {
            let mut b = block(2, size);
            b.positions.iter_mut().for_each(|p| *p = p.map(|x| x + (8.0 - size) / 2.0));
            if sign(i) < 0 { inverted(b) } else { b }
        };
        let mut mesh = shell(8.0, 0);
        add(&mut mesh, &shell(6.0, 1), [0.0; 3]);
        add(&mut mesh, &shell(4.0, 2), [0.0; 3]);
        let mut layers = [(sign(0), 512.0 - 216.0), (sign(0) + sign(1), 216.0 - 64.0), (0, 64.0)];
        layers[2].0 = layers[1].0 + sign(2);
        if layers.iter().all(|layer| layer.0 <= 0) {
            layers.iter_mut().for_each(|layer| layer.0 = -layer.0);
        }
        let mut expected: f64 = layers.iter().filter(|layer| layer.0 > 0).map(|layer| layer.1).sum();
        if flip == 6 {
            // An inverted shell that floats in a cavity is turned over, not removed; the gain of volume is told.
            expected += 64.0;
        }
        let repaired = mend(&mesh);
        assert!(repaired.after.sound, "{flip}: {:?}", counts(&repaired.after));
        assert!(
            (repaired.after.properties.signed_volume - expected).abs() < 1e-9,
            "{flip}: {expected}, not {}",
            repaired.after.properties.signed_volume
        );
        assert_eq!(repaired.counts.facets_added, 0);
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
fn a_small_fin_goes_and_a_large_one_may_be_meant() {
    for (far, gone) in [(3.0, 1), (30.0, 0)] {
        let mut mesh = block(4, 4.0);
        let ([a, b, _], n) = (mesh.faces[20], mesh.positions.len() as u32);
        mesh.positions.push(mesh.positions[a as usize].map(|x| 2.0 + far * (x - 2.0)));
        mesh.faces.push([a, b, n]);
        let repaired = mend_with(&mesh, &only(&["fins"]));
        assert_eq!((did(&repaired, "fins"), repaired.after.sound), (gone, gone == 1), "{far}");
    }
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
    let back = repaired.deviation(&mesh, &Silent).unwrap();
    assert!(back.there.max > 1e-5 && back.there.max <= largest && back.there.mean < 1e-6, "{back:?}");
    // Beyond the distance given nothing is stitched.
    let narrow = Options { stitch: Some(1e-5), holes: Holes::UpTo(0.0), ..Options::default() };
    assert!(mend_with(&mesh, &narrow).changes.iter().all(|c| *c.step != stitch::STEP));
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
    let away = repaired.deviation(&mesh, &Silent).unwrap();
    assert_eq!((away.there.max, away.back.max), (0.0, 0.0));
}

/// All steps but the union.
fn without_union() -> Options {
    let steps = STEPS.into_iter().filter(|step| step.name != "union").collect();
    Options { steps, ..Options::default() }
}

#[test]
fn crossing_blocks_become_sound() {
    // A hole torn out is filled, whatever the limit for holes.
    let no_holes = Options { holes: Holes::UpTo(0.0), ..without_union() };
    let repaired = mend_with(&two([2.5, 2.5, 2.5]), &no_holes);
    assert!(!repaired.before.sound && repaired.after.sound, "{:?}", counts(&repaired.after));
    assert!(repaired.after.soundness.closed);
    assert!(did(&repaired, "self_intersections") > 0);
}

/// The volume before is found in another way, with rounded places: see `enclosed`.
#[test]
fn bodies_that_meet_become_their_union() {
    for (cells, offset) in [([8, 12], [3.3, 2.1, 2.7]), ([24, 22], [2.0, 0.7, 1.3]), ([1, 1], [0.5; 3])] {
        for single in [false, true] {
            let mesh = turned_blocks(cells, offset);
            let repaired = repair(&mesh, &Options { single, ..Options::default() }, &Silent).unwrap();
            assert!(repaired.after.sound && repaired.not_united.is_none(), "{:?}", counts(&repaired.after));
            assert!(did(&repaired, "union") > 0 && did(&repaired, "self_intersections") == 0);
            let expected = repaired.effect.enclosed.unwrap().volume;
            let found = repaired.after.properties.signed_volume;
            let limit = if single { 1e-6 } else { 1e-12 };
            assert!((found - expected).abs() < limit * expected, "{found} {expected}");
            assert_eq!(repaired.rounded.vertices > 0, single);
            let places = repaired.mesh.positions.iter().flatten();
            assert!(!single || places.into_iter().all(|x| f64::from(*x as f32) == *x));
        }
    }
}

/// A sheet through a block: neither loses anything.
#[test]
fn sheets_keep_their_crossings() {
    let mut mesh = block(2, 4.0);
    let first = mesh.positions.len() as u32;
    mesh.positions.extend([[-9.0, -9.0, 1.3], [15.0, -9.0, 1.3], [3.0, 15.0, 1.4]]);
    mesh.faces.push([first, first + 1, first + 2]);
    let repaired = mend(&mesh);
    assert_eq!((repaired.changes.len(), repaired.after.sound), (0, false), "{:?}", repaired.changes);
    assert_eq!(repaired.mesh, mesh);
}

/// Two blocks that cross, the second turned and with its lowest corner at `offset`.
fn turned_blocks(cells: [u32; 2], offset: Point) -> Mesh {
    let (mut mesh, mut other) = (block(cells[0], 4.0), block(cells[1], 3.0));
    other.positions.iter_mut().for_each(|p| *p = [0.8 * p[0] - 0.6 * p[1], 0.6 * p[0] + 0.8 * p[1], p[2]]);
    add(&mut mesh, &other, offset);
    mesh
}

/// Mended without uniting them; how often holes were widened.
fn crossing(cells: [u32; 2], offset: Point) -> (Repaired, usize) {
    let repaired = mend_with(&turned_blocks(cells, offset), &without_union());
    let widened = repaired.changes.iter().filter(|c| c.what == "holes widened that nothing fits").count();
    (repaired, widened)
}

/// Where facets of two fine bodies that cross were torn out, their rims lie so near each other that patches cross again.
#[test]
fn holes_of_cut_out_facets_are_filled() {
    let (repaired, widened) = crossing([8, 12], [3.3, 2.1, 2.7]);
    assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
    assert_eq!(widened, 0);
    let volume = repaired.after.properties.signed_volume;
    assert!(volume > 0.85 * 91.0 && volume < 91.0, "{volume}");
}

#[test]
#[ignore = "known fault: without the union, this pair keeps its crossings"]
fn holes_of_cut_out_facets_are_widened_until_something_fits() {
    let (repaired, widened) = crossing([24, 8], [3.0, -0.5, 3.1]);
    assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
    assert_eq!(widened, 2);
}

/// With half of each body in the other all of them would go. Facets torn out in vain stay.
#[test]
fn holes_are_not_widened_for_nothing() {
    let (repaired, widened) = crossing([24, 22], [2.0, 0.7, 1.3]);
    assert_eq!((repaired.after.sound, widened), (false, 0));
    assert!(repaired.after.properties.area > 0.75 * repaired.before.properties.area);
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

/// Two of the same facet inside a closed surface, at whose edges all others have their partner: neither is needed.
#[test]
fn doubled_walls_that_nobody_needs_go_both() {
    let positions = vec![[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.5, 0.5, 1.0], [0.5, 0.5, -1.0]];
    let shell = [[0, 1, 3], [1, 2, 3], [2, 0, 3], [1, 0, 4], [2, 1, 4], [0, 2, 4]];
    for second in [[0, 1, 2], [0, 2, 1]] {
        let faces = shell.into_iter().chain([[0, 1, 2], second]).collect();
        let only = only(&["duplicates"]);
        let repaired = mend_with(&Mesh { positions: positions.clone(), faces }, &only);
        assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
        assert_eq!(repaired.mesh.faces, shell);
    }
}

/// Puts a flat facet at the edge from `a` to `b`: the facet that runs there is divided at the middle.
fn cap(mesh: &mut Mesh, a: u32, b: u32) {
    let runs = |f: &[u32; 3]| (0..3).position(|k| [f[k], f[(k + 1) % 3]] == [a, b]);
    let (i, k) = mesh.faces.iter().enumerate().find_map(|(i, f)| Some((i, runs(f)?))).unwrap();
    let (c, n) = (mesh.faces[i][(k + 2) % 3], mesh.positions.len() as u32);
    let [p, q] = mesh.places(&[a, b]);
    mesh.positions.push(std::array::from_fn(|k| (p[k] + q[k]) / 2.0));
    mesh.faces[i] = [a, n, c];
    mesh.faces.extend([[n, b, c], [a, b, n]]);
}

#[test]
fn two_flat_facets_at_one_facet_are_cut_out_one_after_the_other() {
    let mut mesh = block(4, 4.0);
    let [a, b, c] = mesh.faces[20];
    cap(&mut mesh, b, a);
    cap(&mut mesh, c, b);
    let repaired = mend_with(&mesh, &only(&["degenerate"]));
    assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
    assert_eq!((repaired.after.properties.signed_volume, did(&repaired, "degenerate")), (64.0, 2));
}

#[test]
fn a_flat_facet_is_cut_out_of_its_neighbors() {
    // A cap on a side of the block: its middle vertex splits the long edge of the neighbor.
    let mut mesh = block(1, 4.0);
    let at = |p: Point| mesh.positions.iter().position(|q| *q == p).unwrap() as u32;
    let [a, b] = [at([0.0; 3]), at([4.0, 0.0, 0.0])];
    cap(&mut mesh, a, b);
    let repaired = mend(&mesh);
    assert_eq!(repaired.before.found(check::DEGENERATE_FACETS).map(|f| f.count), Some(1));
    assert!(repaired.after.sound, "{:?}", counts(&repaired.after));
    assert_eq!((repaired.after.properties.signed_volume, did(&repaired, "degenerate")), (64.0, 1));
    assert_eq!(repaired.changes.len(), 1, "nothing else had to be mended: {:?}", repaired.changes);
}

#[test]
fn flat_facets_back_to_back_just_go() {
    let sound = block(4, 4.0);
    let at = |x: f64| sound.positions.iter().position(|p| *p == [x, 0.0, 0.0]).unwrap() as u32;
    let [a, m, b] = [at(0.0), at(1.0), at(2.0)];
    let mut mesh = sound.clone();
    mesh.faces.extend([[a, b, m], [b, a, m]]);
    let repaired = mend_with(&mesh, &only(&["degenerate"]));
    assert_eq!((repaired.mesh.faces, repaired.changes.len()), (sound.faces, 2));
}

/// Facets anywhere, each by itself: given up at once, and left as it is.
#[test]
fn a_soup_of_facets_is_given_up() {
    let random = &mut Random::new(8);
    let positions: Vec<Point> = (0..18_000).map(|_| std::array::from_fn(|_| random.unit() * 10.0)).collect();
    let faces = (0..6_000).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect();
    let mesh = Mesh { positions, faces };
    let repaired = mend(&mesh);
    assert!(matches!(repaired.not_united, Some(ArrangeError::Tangle { .. })));
    assert!(repaired.changes.is_empty() && repaired.rounds == 0 && !repaired.after.sound);
    assert_eq!(repaired.mesh, mesh);
}

/// Far from the origin single precision cannot write where two bodies cross: they stay, rather than vanish.
#[test]
fn bodies_that_numbers_cannot_hold_stay() {
    for far in [1e6, 3e6, 1e7] {
        let random = &mut Random::new(4);
        let (turn, other) = (rotation(random), rotation(random));
        let mut mesh = block(6, 10.0);
        mesh.positions.iter_mut().for_each(|p| *p = other.point(*p));
        add(&mut mesh, &block(6, 10.0), [0.0; 3]);
        mesh.positions.iter_mut().for_each(|p| *p = plus(turn.point(*p), [far, 0.7 * far, -far]));
        let options = Options { single: true, ..Options::default() };
        let repaired = super::super::repair(&mesh, &options, &Silent).unwrap();
        assert!(repaired.after.properties.area > 500.0, "{far}: {}", repaired.after.properties.area);
    }
}

/// Every other cube of a board of three by three by three: some touch around an empty cell, whose walls are no fins.
#[test]
fn cubes_that_touch_in_edges_keep_the_cells_between() {
    let mut mesh = Mesh::default();
    for i in (0..27u32).filter(|i| (i % 3 + i / 3 % 3 + i / 9) % 2 == 0) {
        add(&mut mesh, &block(1, 1.0), [i % 3, i / 3 % 3, i / 9].map(f64::from));
    }
    let repaired = mend(&mesh);
    let volume = repaired.after.properties.signed_volume;
    assert!(repaired.after.sound && (volume - 14.0).abs() < 1e-2, "{} {volume}", repaired.after.sound);
}

/// However many rounds there are, no more than a tenth of the area goes as fins.
#[test]
fn flaps_at_one_edge_do_not_go_by_rounds() {
    let random = &mut Random::new(3);
    let mut mesh = Mesh { positions: vec![[0.0; 3], [1.0, 0.0, 0.0]], faces: vec![] };
    for i in 0..100 {
        mesh.positions.push([random.unit(), 2.0 * random.unit() * if i % 2 == 0 { 1.0 } else { -1.0 }, 0.0]);
        mesh.faces.push(if i % 2 == 0 { [0, 1, i + 2] } else { [1, 0, i + 2] });
    }
    let repaired = mend(&mesh);
    let [before, after] = [&repaired.before, &repaired.after].map(|report| report.properties.area);
    assert!(after >= 0.89 * before, "{before} {after}");
}
