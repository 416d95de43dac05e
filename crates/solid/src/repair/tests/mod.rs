//! Planted defects are mended, sound meshes left alone; then the special cases of each step.

mod holes;
mod joints;
mod nearly;
mod steps;

use super::rounds::MAX_ROUNDS;
use super::*;
use std::collections::BTreeSet;
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::samples::{add, block, counts, on_threads, planted, sound};
use trueness_geom::space::Point;

pub(super) fn mend(mesh: &Mesh) -> Repaired {
    mend_with(mesh, &Options::default())
}

/// These steps alone.
pub(super) fn only(steps: &[&str]) -> Options {
    Options { steps: steps.iter().map(|name| step(name).unwrap()).collect(), ..Options::default() }
}

pub(super) fn mend_with(mesh: &Mesh, options: &Options) -> Repaired {
    let repaired = repair(mesh, options, &Silent).unwrap();
    no_vertex_moves(mesh, &repaired);
    repaired
}

/// Result of the steps, even if it is worse.
pub(super) fn unguarded(mesh: &Mesh, options: &Options) -> Attempt {
    let check_options = check::Options { gap: options.gap, ..check::Options::default() };
    let before = check::check(mesh, None, &check_options, &Silent).unwrap();
    let start = Work::new(mesh.clone(), options, &Silent).unwrap();
    attempt((&start, None), options, (&before, &check_options)).unwrap()
}

/// Vertices said to be kept are places of the mesh as it was, and the counts add up.
fn no_vertex_moves(before: &Mesh, repaired: &Repaired) {
    let bits = |p: &Point| p.map(|x| (x + 0.0).to_bits());
    let old: BTreeSet<_> = before.positions.iter().map(bits).collect();
    let kept = repaired.mesh.positions.iter().filter(|p| old.contains(&bits(p))).count() as u64;
    let c = repaired.counts;
    assert_eq!(c.vertices_kept, kept);
    assert_eq!(c.vertices_kept + c.vertices_added, repaired.mesh.positions.len() as u64);
    assert_eq!(c.facets_kept + c.facets_added, repaired.mesh.faces.len() as u64);
}

#[test]
fn sound_meshes_come_back_bit_for_bit() {
    let mut mesh = sound();
    // The order of a file, not that of first use; and a zero with a sign.
    mesh.positions.reverse();
    let last = mesh.positions.len() as u32 - 1;
    mesh.faces.iter_mut().for_each(|f| *f = f.map(|v| last - v));
    mesh.positions.iter_mut().flatten().filter(|x| **x == 0.0).for_each(|x| *x = -0.0);
    let repaired = mend(&mesh);
    let bits = |m: &Mesh| m.positions.iter().map(|p| p.map(f64::to_bits)).collect::<Vec<_>>();
    assert_eq!((bits(&repaired.mesh), &repaired.mesh.faces), (bits(&mesh), &mesh.faces));
    assert_eq!((repaired.changes.len(), repaired.rounds, repaired.after.sound), (0, 1, true));
    assert_eq!(repaired.deviation(&mesh, &Silent).unwrap().there, Way::default());
}

#[test]
fn planted_defects_of_every_kind_are_mended() {
    for kind in check::KINDS {
        for k in [1, 2, 5] {
            let (mesh, _, expected) = planted(kind.name, k);
            let repaired = mend(&mesh);
            let count = |r: &Report| r.found(kind).map_or(0, |f| f.count);
            if kind.severity == check::Severity::Error {
                assert_eq!(count(&repaired.before), expected, "{} {k}", kind.name);
                let facets: usize = repaired.changes.iter().map(|c| c.facets).sum();
                assert!(facets >= k, "{} {k}: {:?}", kind.name, repaired.changes);
            }
            assert!(repaired.after.sound, "{} {k}: {:?}", kind.name, counts(&repaired.after));
            assert!(repaired.rounds < MAX_ROUNDS, "{} {k}: {} rounds", kind.name, repaired.rounds);
            assert_eq!(mend(&repaired.mesh).changes, [], "{} {k}: nothing is left to do", kind.name);
        }
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    for kind in check::KINDS {
        let (mesh, ..) = planted(kind.name, 3);
        let [one, three] = [1, 3].map(|n| on_threads(n, || mend(&mesh)));
        assert_eq!((&one.mesh, &one.changes), (&three.mesh, &three.changes), "{}", kind.name);
    }
}

#[test]
fn steps_keep_the_contract_and_can_be_chosen() {
    for (i, step) in STEPS.into_iter().enumerate() {
        assert!(step.name.chars().all(|c| c.is_ascii_lowercase() || c == '_'), "{}", step.name);
        assert!(STEPS[..i].iter().all(|s| s.name != step.name), "{} is there twice", step.name);
        assert!(step.about.ends_with('.'), "{}", step.name);
        let only = Options { steps: vec![step], ..Options::default() };
        for kind in check::KINDS {
            let repaired = mend_with(&planted(kind.name, 2).0, &only);
            assert!(repaired.changes.iter().all(|c| c.step == step), "{}: {:?}", step.name, repaired.changes);
        }
    }
    let none = Options { steps: vec![], ..Options::default() };
    let (mesh, ..) = planted("holes", 3);
    assert_eq!(mend_with(&mesh, &none).mesh, mesh);
}

/// Random facets among few places: every kind of mess at once. Nothing is promised but an end.
#[test]
fn any_mess_comes_to_an_end() {
    let random = &mut Random::new(8);
    for facets in [0, 1, 2, 5, 20, 60] {
        for _ in 0..8 {
            let vertices = 4 + random.below(20) as u32;
            let places = |_| std::array::from_fn(|_| (random.unit() * 8.0).floor());
            let positions: Vec<Point> = (0..vertices).map(places).collect();
            let face = |_| std::array::from_fn(|_| random.below(u64::from(vertices)) as u32);
            let mesh = Mesh { positions, faces: (0..facets).map(face).collect() };
            for holes in [Holes::UpTo(0.25), Holes::All] {
                let repaired = mend_with(&mesh, &Options { holes, islands: Some(0.1), ..Options::default() });
                assert!(repaired.rounds <= MAX_ROUNDS);
                assert!(repaired.mesh.positions.iter().flatten().all(|x| x.is_finite()));
            }
        }
    }
    let broken = Mesh { positions: vec![[0.0; 3]], faces: vec![[0, 0, 7]] };
    assert!(matches!(repair(&broken, &Options::default(), &Silent), Err(RepairError::Weld(_))));
}

/// At the ends of the range counts and distances are as they should be; beyond, products of coordinates would be 0 or infinite.
#[test]
fn meshes_at_the_ends_of_the_range_are_mended_and_those_beyond_refused() {
    let scales = [(1e-300, false), (1e-52, false), (1e-43, true), (1e-36, true), (1e42, true), (1e46, false)];
    for (kind, (scale, fits)) in check::KINDS.iter().flat_map(|kind| scales.map(|s| (kind, s))) {
        let (mut mesh, ..) = planted(kind.name, 5);
        mesh.positions.iter_mut().flatten().for_each(|x| *x *= scale);
        if !fits {
            let refused = repair(&mesh, &Options::default(), &Silent);
            assert!(matches!(refused, Err(RepairError::Range(_))), "{} {scale:e}", kind.name);
            continue;
        }
        let repaired = mend(&mesh);
        // Nothing can be measured against facets at no place.
        if kind.name == "not_finite_facets" {
            continue;
        }
        let deviation = repaired.deviation(&mesh, &Silent).unwrap();
        for way in [deviation.there, deviation.back] {
            assert!(way.mean >= 0.0 && way.max.is_finite(), "{} {scale:e}: {way:?}", kind.name);
        }
    }
}

#[test]
fn facets_at_no_place_are_not_part_of_the_mean() {
    let (mesh, ..) = planted("not_finite_facets", 1);
    let holed = Mesh { faces: mesh.faces[1..].to_vec(), ..mesh.clone() };
    let mean = |to: &Repaired| to.deviation(&mesh, &Silent).unwrap().there.mean;
    assert_eq!(mean(&mend(&mesh)), 0.0);
    assert!(mean(&mend_with(&holed, &only(&["not_finite"]))) > 0.0);
}

/// Sheets closer together than the gap: each vertex lies on most edges, and cutting there would never end.
#[test]
fn a_heap_of_thin_facets_does_not_grow() {
    let random = &mut Random::new(21);
    let place = |_| [100.0 * random.unit(), 0.5 * random.unit(), 0.5 * random.unit()];
    let positions: Vec<Point> = (0..180).map(place).collect();
    let faces: Vec<[u32; 3]> = (0..60).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect();
    let repaired = mend_with(&Mesh { positions, faces }, &Options { gap: Some(1.0), ..Options::default() });
    assert!(repaired.mesh.faces.len() < 600, "{} facets", repaired.mesh.faces.len());
}

/// Facets lie upon each other in a plane, nearly all against all. Beside them are a box with a pin in its mouth and a
/// box that touches its corner. Patches and parted vertices are searched by themselves, not with the whole heap each
/// time.
#[test]
fn a_flat_heap_does_not_hold_up_what_lies_beside_it() {
    let random = &mut Random::new(22);
    let mut mesh = block(4, 4.0);
    mesh.faces.retain(|f| f.iter().any(|v| mesh.positions[*v as usize][2] != 4.0));
    add(&mut mesh, &block(1, 1.0), [1.5, 1.5, 3.5]);
    add(&mut mesh, &block(1, 1.0), [-1.0; 3]);
    let place = |_| [random.unit(), random.unit(), 9.0];
    let heap = Mesh {
        positions: (0..4500).map(place).collect(),
        faces: (0..1500).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect(),
    };
    add(&mut mesh, &heap, [0.0; 3]);
    let repaired = mend_with(&mesh, &only(&["holes", "non_manifold_vertices"]));
    assert_eq!((repaired.rounds, repaired.changes.len()), (2, 1), "{:?}", repaired.changes);
}

/// Flat facets in a plane with corners on each other's edges: cut there, they would only make ever more that cross.
#[test]
fn facets_that_lie_upon_each_other_are_not_cut() {
    let random = &mut Random::new(8);
    let place = |_| [1000.0, random.below(2) as f64 * 0.25, random.below(64) as f64 / 8.0];
    let positions: Vec<Point> = (0..73).map(place).collect();
    let face = |_| {
        let first = random.below(73) as u32;
        std::array::from_fn(|k| (first + k as u32 * (1 + random.below(3) as u32)) % 73)
    };
    let repaired = mend(&Mesh { positions, faces: (0..111).map(face).collect() });
    assert!(repaired.before.found(check::T_JUNCTIONS).is_some_and(|found| found.count > 300));
    let crossings = |r: &Report| r.found(check::SELF_INTERSECTIONS).map_or(0, |f| f.count);
    assert!(crossings(&repaired.after) <= crossings(&repaired.before));
}

/// Random bodies that cross, touch and contain each other.
fn heap_of_bodies(random: &mut Random) -> Mesh {
    let mut mesh = Mesh::default();
    for _ in 0..2 + random.below(3) {
        let mut body = block(1 + random.below(4) as u32, 2.0);
        let (sin, cos) = if random.below(3) == 0 { (0.0, 1.0) } else { (6.3 * random.unit()).sin_cos() };
        let round = random.below(2) == 0;
        body.positions.iter_mut().for_each(|p| {
            let [mut x, mut y, mut z] = p.map(|x| x - 1.0);
            if round {
                // From a cube to a sphere.
                let long = (x * x + y * y + z * z).sqrt().max(0.1);
                (x, y, z) = (x / long, y / long, z / long);
            }
            *p = [x * cos - y * sin, x * sin + y * cos, z];
        });
        add(&mut mesh, &body, std::array::from_fn(|_| (6.0 * random.unit()).round() / 2.0));
    }
    mesh
}

/// Nothing that makes a mesh unsound is there more often afterwards, and closed surfaces stay closed.
#[test]
fn a_repair_makes_nothing_worse() {
    let random = &mut Random::new(31);
    let mut taken_back = 0;
    for round in 0..40 {
        let mut mesh = heap_of_bodies(random);
        if round % 4 == 3 {
            let kept_facets = mesh.faces.len() / 2 + random.below(mesh.faces.len() as u64 / 2) as usize;
            mesh.faces.truncate(kept_facets);
        }
        // Without the union more goes wrong, and is taken back.
        for (holes, skipped) in [(Holes::UpTo(0.25), ""), (Holes::All, ""), (Holes::UpTo(0.25), "union")] {
            let steps = STEPS.into_iter().filter(|step| step.name != skipped).collect();
            let repaired = mend_with(&mesh, &Options { holes, steps, ..Options::default() });
            let closed = |r: &Report| r.soundness.boundary_edges == 0;
            assert!(
                closed(&repaired.after) || !closed(&repaired.before),
                "{round}: {:?}",
                counts(&repaired.after)
            );
            for kind in check::KINDS.iter().filter(|k| k.severity == check::Severity::Error) {
                let count = |r: &Report| r.found(kind).map_or(0, |f| f.count);
                let (was, is) = (count(&repaired.before), count(&repaired.after));
                assert!(is <= was, "{round}: {was} {}, {is} afterwards", kind.name);
            }
            taken_back += usize::from(!repaired.taken_back.is_empty());
        }
    }
    assert!(taken_back > 0, "nothing was put to the test");
}

/// Without a step that changed something: from the state before it as from the start.
#[test]
fn going_on_from_a_kept_state_comes_to_the_same() {
    let random = &mut Random::new(47);
    let mut tried: BTreeSet<&str> = BTreeSet::new();
    let mut meshes: Vec<Mesh> = check::KINDS.iter().map(|kind| planted(kind.name, 3).0).collect();
    for round in 0..12 {
        let mut mesh = heap_of_bodies(random);
        if round % 2 == 1 {
            let kept_facets = mesh.faces.len() / 2 + random.below(mesh.faces.len() as u64 / 2) as usize;
            mesh.faces.truncate(kept_facets);
        }
        meshes.push(mesh);
    }
    for (number, mesh) in meshes.into_iter().enumerate() {
        let (options, check_options) = (Options::default(), check::Options::default());
        let mesh = as_it_is(&mesh).unwrap();
        let before = check::check(&mesh, None, &check_options, &Silent).unwrap();
        let start = Work::new(mesh, &options, &Silent).unwrap();
        let go = |options: &Options, from: Option<&KeptState>| {
            attempt((&start, from), options, (&before, &check_options)).unwrap()
        };
        let all = go(&options, None);
        for step in all.did(STEPS) {
            let name = step.name;
            let from = KeptState::before(&all.kept, &[step]);
            if ["union", "self_intersections"].contains(&name) || from.is_none() {
                continue;
            }
            let without = Options { steps: all_but(step), ..options.clone() };
            let (kept, whole) = (go(&without, from), go(&without, None));
            // As text: of facets that are not finite, no coordinate equals itself.
            let text = |a: &Attempt| format!("{:?}", (&a.mesh, &a.changes, &a.lost, counts(&a.after)));
            assert!(text(&kept) == text(&whole), "{number} without {name}");
            assert_eq!((kept.rounds, kept.counts), (whole.rounds, whole.counts), "{number} without {name}");
            tried.insert(name);
        }
    }
    assert!(tried.len() >= 8, "{tried:?}");
}

/// Boxes that cross: their union has 1,000 + 1,000 − 125.
#[test]
fn the_effect_tells_what_was_enclosed_and_how_far_its_surface_went() {
    let mut mesh = block(5, 10.0);
    add(&mut mesh, &block(5, 10.0), [5.0; 3]);
    let repaired = mend(&mesh);
    let enclosed = repaired.effect.enclosed.clone().unwrap();
    assert!((enclosed.volume - 1875.0).abs() < 1e-9 && enclosed.error < 1e-9, "{enclosed:?}");
    assert_eq!((enclosed.inverted, repaired.effect.bodies[0]), (0.0, 2));
    // The report states how far the surface that is gone and bounded the bodies is from the rest.
    let apart = repaired.after.properties.signed_volume - 1875.0;
    let surface = repaired.effect.surface.unwrap();
    assert!(apart.abs() < 1e-9 && surface < 1e-9, "{apart} {surface}");
    // A hole has no surface to go away.
    let (open, ..) = planted("holes", 3);
    let repaired = mend(&open);
    assert_eq!(repaired.effect.enclosed, Err(NotEnclosed::Open));
    assert_eq!((repaired.effect.surface, repaired.effect.bodies[1]), (None, 1));
    // Turned shells enclose the same.
    let (turned, ..) = planted("inconsistent_orientation", 2);
    let repaired = mend(&turned);
    let was = repaired.effect.enclosed.unwrap();
    assert!((was.volume - repaired.after.properties.signed_volume).abs() < 1e-9, "{was:?}");
    assert_eq!(repaired.effect.surface, Some(0.0));
    // Nested shells that look the same way are one body; parted into body and cavity they are another.
    let mut nested = block(2, 8.0);
    add(&mut nested, &block(2, 4.0), [2.0; 3]);
    let repaired = mend(&nested);
    assert!((repaired.effect.enclosed.unwrap().volume - 512.0).abs() < 1e-9);
}
