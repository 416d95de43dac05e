//! The check and the repair of meshes. A case is a mesh as an OFF file in text, so that a finding can be given to
//! any program; NaN and infinity may stand in it.

use super::{Target, files};
use crate::deform::deformed;
use std::fmt::Write;
use std::path::Path;
use trueness_files::{Body, Format, ReadOptions, open};
use trueness_geom::check::{self, Report, check};
use trueness_geom::mesh::Mesh;
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::topology::weld;
use trueness_solid::repair::{self, Holes, Repaired, repair};

/// The check.
pub const CHECK: Target = Target { name: "check", run: |case, _| checked(&decoded(case)), ..MESHES };

/// The repair.
pub const REPAIR: Target = Target { name: "repair", run: |case, _| repaired(&decoded(case)), ..MESHES };

const MESHES: Target = Target {
    name: "",
    extension: "off",
    seeds: |corpus| seeds(corpus).iter().map(encoded).collect(),
    mutate: |random, case, other| encoded(&deformed(random, decoded(case), &decoded(other))),
    run: |_, _| (),
    // As much as a binary STL file of these facets would have.
    size: |case| 84 + 50 * decoded(case).faces.len(),
};

/// The most facets of a seed.
const FACETS: usize = 300;

fn seeds(corpus: &Path) -> Vec<Mesh> {
    let mut all = vec![];
    for extension in ["stl", "ply", "obj", "off"] {
        for bytes in files(corpus, &[extension]) {
            all.extend(mesh(&bytes, extension).filter(|m| (1..=FACETS).contains(&m.faces.len())));
        }
    }
    all
}

/// The mesh in the bytes of a file, if there is one.
fn mesh(bytes: &[u8], extension: &str) -> Option<Mesh> {
    let path = std::env::temp_dir().join(format!("trueness-fuzz-seed-{}.{extension}", std::process::id()));
    std::fs::write(&path, bytes).ok()?;
    let input = open(&path, &ReadOptions { format: Format::named(extension), ..ReadOptions::default() });
    let _ = std::fs::remove_file(&path);
    match input.ok()?.body {
        Body::Mesh(source) => Some(source.mesh),
        Body::Points(_) | Body::Splines(_) | Body::Cad(_) | Body::Drawing(_) => None,
    }
}

fn encoded(mesh: &Mesh) -> Vec<u8> {
    let mut text = format!("OFF\n{} {} 0\n", mesh.positions.len(), mesh.faces.len());
    for [x, y, z] in &mesh.positions {
        let _ = writeln!(text, "{x:?} {y:?} {z:?}");
    }
    for [a, b, c] in &mesh.faces {
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    text.into_bytes()
}

/// The reverse of [`encoded`]; what cannot be read is left out.
fn decoded(case: &[u8]) -> Mesh {
    let text = String::from_utf8_lossy(case);
    let mut lines = text.lines().skip(1).map(|line| line.split_ascii_whitespace());
    let count = lines.next().and_then(|mut words| words.next()?.parse().ok()).unwrap_or(0);
    let three = |words: std::str::SplitAsciiWhitespace| -> Vec<String> { words.map(String::from).collect() };
    let mut mesh = Mesh::default();
    for words in lines.map(three) {
        match &words[..] {
            [x, y, z] if mesh.positions.len() < count => {
                mesh.positions.push([x, y, z].map(|w| w.parse().unwrap_or(0.0)));
            }
            [_, a, b, c] => mesh.faces.push([a, b, c].map(|w| w.parse().unwrap_or(0))),
            _ => (),
        }
    }
    mesh
}

/// Whether all coordinates are of a magnitude for which numbers are promised, not only an answer.
fn in_range(mesh: &Mesh) -> bool {
    let promised = |x: &f64| !x.is_finite() || *x == 0.0 || (1e-80..1e60).contains(&x.abs());
    mesh.positions.iter().flatten().all(promised)
}

/// Kinds whose count is decided exactly and hangs on the surface alone.
const EXACT: [&check::DefectKind; 8] = [
    check::BOUNDARY_EDGES,
    check::NON_MANIFOLD_EDGES,
    check::NON_MANIFOLD_VERTICES,
    check::DUPLICATE_FACETS,
    check::DEGENERATE_FACETS,
    check::INCONSISTENT_ORIENTATION,
    check::SELF_INTERSECTIONS,
    check::NOT_FINITE_FACETS,
];

fn checked(mesh: &Mesh) {
    let Ok(welded) = weld::mesh(mesh) else { return };
    let report = of(&welded.mesh);
    for (kind, found) in &report.defects {
        for item in found.iter().flat_map(|f| &f.items) {
            let inside = |of: &[u32], count: usize| of.iter().all(|i| (*i as usize) < count);
            assert!(inside(&item.facets, welded.mesh.faces.len()), "{}: no such facet", kind.name);
            assert!(inside(&item.vertices, welded.mesh.positions.len()), "{}: no such vertex", kind.name);
            assert!(item.size >= 0.0 || !in_range(mesh), "{}: size {}", kind.name, item.size);
        }
    }
    if !in_range(mesh) {
        return;
    }
    let other = of(&weld::mesh(&turned_over(mesh)).expect("as many facets as before").mesh);
    for kind in EXACT {
        let count = |r: &Report| r.found(kind).map(|f| f.count);
        assert_eq!(count(&report), count(&other), "{} in another order", kind.name);
    }
    assert_eq!(report.euler_characteristic, other.euler_characteristic, "characteristic in another order");
    assert_eq!(report.soundness.shells, other.soundness.shells, "shells in another order");
}

fn of(mesh: &Mesh) -> Report {
    check(mesh, None, &check::Options::default(), &Silent).expect("a small mesh can be checked")
}

/// The same surface: facets in another order, each begun at another corner, vertices numbered anew.
fn turned_over(mesh: &Mesh) -> Mesh {
    let random = &mut Random::new(mesh.faces.len() as u64);
    let mut order: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    let mut faces = mesh.faces.clone();
    shuffle(random, &mut order);
    shuffle(random, &mut faces);
    let mut positions = mesh.positions.clone();
    for (new, p) in order.iter().zip(&mesh.positions) {
        positions[*new as usize] = *p;
    }
    let faces = faces.into_iter().map(|[a, b, c]| [b, c, a].map(|v| order[v as usize])).collect();
    Mesh { positions, faces }
}

fn shuffle<T>(random: &mut Random, list: &mut [T]) {
    for i in (1..list.len()).rev() {
        list.swap(i, random.below(i as u64 + 1) as usize);
    }
}

fn repaired(mesh: &Mesh) {
    for (holes, islands) in [(Holes::UpTo(0.25), None), (Holes::All, Some(0.1))] {
        let options = repair::Options { holes, islands, ..repair::Options::default() };
        let Ok(result) = repair(mesh, &options, &Silent) else { return };
        as_reported(mesh, &result);
        if result.after.sound {
            stays(&result.mesh);
        }
    }
}

/// The mesh is what the report of its repair says.
fn as_reported(before: &Mesh, result: &Repaired) {
    let (mesh, after) = (&result.mesh, of(&result.mesh));
    assert!(mesh.positions.iter().flatten().all(|x| x.is_finite()), "a vertex that is not finite");
    for ((kind, told), (_, found)) in result.after.defects.iter().zip(&after.defects) {
        // As text, in which NaN is NaN.
        assert_eq!(format!("{told:?}"), format!("{found:?}"), "{} as told", kind.name);
    }
    let place = |p: &[f64; 3]| p.map(|x| (x + 0.0).to_bits());
    let mut old: Vec<_> = before.positions.iter().map(place).collect();
    old.sort_unstable();
    let kept = mesh.positions.iter().filter(|p| old.binary_search(&place(p)).is_ok()).count() as u64;
    let c = result.counts;
    assert!(c.vertices_kept <= kept, "{} vertices kept, {kept} at their place", c.vertices_kept);
    assert_eq!(c.vertices_kept + c.vertices_added, mesh.positions.len() as u64, "vertices kept and added");
    assert_eq!(c.facets_kept + c.facets_added, mesh.faces.len() as u64, "facets kept and added");
    if let Ok(deviation) = result.deviation(before, &Silent) {
        let sensible = |w: repair::Way| (0.0..f64::INFINITY).contains(&w.mean) && w.max.is_finite();
        let both = sensible(deviation.there) && sensible(deviation.back);
        assert!(both || !in_range(before), "{deviation:?}");
    }
}

/// A sound mesh comes back as it is.
fn stays(mesh: &Mesh) {
    let again = repair(mesh, &repair::Options::default(), &Silent).expect("it was repaired before");
    assert!(again.changes.is_empty(), "a sound mesh is changed: {:?}", again.changes[0]);
    assert!(again.mesh == *mesh, "a sound mesh is numbered anew");
}
