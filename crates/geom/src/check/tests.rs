mod places;

use super::*;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::space::{Point, cross, dot, minus, plus, times};
use crate::topology::tests::{block, on_threads};
use crate::topology::weld;

fn of(mesh: &Mesh) -> Report {
    check(mesh, None, &Options::default(), &Silent).unwrap()
}

pub(crate) fn counts(report: &Report) -> Vec<(&'static str, usize)> {
    let found = report.defects.iter().filter_map(|(k, f)| Some((k.name, f.as_ref()?.count)));
    found.filter(|(_, n)| *n > 0).collect()
}

/// A block of 12 × 12 cells a side, its vertices moved a little in the plane of their side: sound.
pub(crate) fn sound() -> Mesh {
    let mut mesh = block(12, 12.0);
    let random = &mut Random::new(11);
    for p in &mut mesh.positions {
        for x in p.iter_mut().filter(|x| **x > 0.5 && **x < 11.5) {
            *x += (0.25 * random.unit()) as f32 as f64;
        }
    }
    mesh
}

/// `k` facets of the sides that have no vertex in common and none on an edge of the block, taken at random.
fn apart(mesh: &Mesh, k: usize) -> Vec<usize> {
    let random = &mut Random::new(k as u64);
    let (mut used, mut chosen) = (vec![false; mesh.positions.len()], vec![]);
    while chosen.len() < k {
        let f = random.below(mesh.faces.len() as u64) as usize;
        let face = &mesh.faces[f];
        let on_edge =
            |v: &u32| mesh.positions[*v as usize].iter().filter(|x| **x == 0.0 || **x == 12.0).count() > 1;
        if !face.iter().any(|v| used[*v as usize] || on_edge(v)) {
            face.iter().for_each(|v| used[*v as usize] = true);
            chosen.push(f);
        }
    }
    chosen.sort_unstable();
    chosen
}

pub(crate) fn add(mesh: &mut Mesh, other: &Mesh, offset: Point) {
    let shift = mesh.positions.len() as u32;
    mesh.positions.extend(other.positions.iter().map(|p| plus(*p, offset)));
    mesh.faces.extend(other.faces.iter().map(|f| f.map(|v| v + shift)));
}

pub(crate) fn inverted(mut mesh: Mesh) -> Mesh {
    mesh.faces.iter_mut().for_each(|f| f.swap(0, 1));
    mesh
}

/// Replaces the facet by the two that a new vertex on its edge from corner 0 to 1 makes; returns that vertex.
fn split(mesh: &mut Mesh, facet: usize, at: Point) -> u32 {
    let ([a, b, c], m) = (mesh.faces[facet], mesh.positions.len() as u32);
    mesh.positions.push(at);
    mesh.faces[facet] = [a, m, c];
    mesh.faces.push([m, b, c]);
    m
}

/// Shells that look the wrong way, beside cavities that are right.
fn plant_shells(mesh: &mut Mesh, k: usize) {
    // Beside them cavities that are right: one in the block, in it a block, in it another cavity.
    add(mesh, &inverted(block(2, 8.0)), [2.0; 3]);
    add(mesh, &block(3, 6.0), [3.0; 3]);
    add(mesh, &inverted(block(1, 1.0)), [5.0; 3]);
    for i in 0..k {
        let wrong = if i % 2 == 0 { inverted(block(1, 1.0)) } else { block(1, 0.5) };
        let place = if i % 2 == 0 { [20.0, 2.0 * i as f64, 0.0] } else { [2.25, 2.25, 2.25 + i as f64] };
        add(mesh, &wrong, place);
        if i % 2 == 1 {
            mesh.faces.iter_mut().rev().take(12).for_each(|f| f.swap(0, 1));
        }
    }
    // Those in the wall of the first cavity look inwards where they should look outwards.
}

/// Pairs of facets that cross.
fn plant_crossings(mesh: &mut Mesh, k: usize) {
    for i in 0..k {
        let x = 20.0 + 3.0 * i as f64;
        let n = mesh.positions.len() as u32;
        mesh.positions.extend([[x, 0.0, 0.0], [x + 2.0, 0.0, 0.0], [x, 2.0, 0.0]]);
        mesh.positions.extend([[x + 0.5, 0.5, -1.0], [x + 0.5, 0.5, 1.0], [x + 2.0, 2.0, 1.0]]);
        mesh.faces.extend([[n, n + 1, n + 2], [n + 3, n + 4, n + 5]]);
    }
}

/// Normals of all facets as a file might store them, turned over for some.
fn plant_normals(mesh: &Mesh, chosen: &[usize]) -> Vec<[f32; 3]> {
    let normal = |f: &[u32; 3]| {
        let [a, b, c] = f.map(|v| mesh.positions[v as usize]);
        cross(minus(b, a), minus(c, a)).map(|x| x as f32)
    };
    let mut stored: Vec<[f32; 3]> = mesh.faces.iter().map(normal).collect();
    stored[0] = [0.0; 3];
    stored[1] = [f32::NAN; 3];
    chosen.iter().for_each(|&f| stored[f] = stored[f].map(|x| -x));
    stored
}

/// A sound block with `k` defects of a kind, the stored normals, and how many findings of that kind there must be.
pub(crate) fn planted(kind: &str, k: usize) -> (Mesh, Option<Vec<[f32; 3]>>, usize) {
    let mut mesh = sound();
    let chosen = apart(&mesh, k);
    let at = |mesh: &Mesh, v: u32| mesh.positions[v as usize];
    let middle = |mesh: &Mesh, f: usize| {
        let [a, b, _] = mesh.faces[f].map(|v| mesh.positions[v as usize]);
        times(0.5, plus(a, b))
    };
    let (mut normals, mut expected) = (None, k);
    match kind {
        "holes" | "boundary_edges" => {
            for f in chosen.into_iter().rev() {
                mesh.faces.remove(f);
            }
            expected = if kind == "holes" { k } else { 3 * k };
        }
        // A fin has two boundary edges, and is one dangling facet.
        "cracks" | "non_manifold_edges" | "dangling_facets" => {
            for f in chosen {
                let [a, b, _] = mesh.faces[f];
                mesh.positions.push(plus(middle(&mesh, f), [20.0, 30.0, 40.0]));
                mesh.faces.push([a, b, mesh.positions.len() as u32 - 1]);
            }
        }
        "non_manifold_vertices" => {
            for (i, x) in (0..k).map(|i| (i, 12.0 * (i % 2) as f64)) {
                let corner = [x, 12.0 * (i / 2 % 2) as f64, 12.0 * (i / 4) as f64];
                let outwards = corner.map(|x| if x > 0.0 { 0.0 } else { -2.0 });
                add(&mut mesh, &block(1, 2.0), plus(corner, outwards));
            }
        }
        "duplicate_facets" => chosen.iter().for_each(|&f| mesh.faces.push(mesh.faces[f])),
        "degenerate_facets" => {
            for (i, f) in chosen.into_iter().enumerate() {
                let [a, b, _] = mesh.faces[f];
                if i % 2 == 0 {
                    mesh.faces.push([a, b, a]);
                } else {
                    let m = split(&mut mesh, f, middle(&sound(), f));
                    mesh.faces.push([a, b, m]);
                }
            }
        }
        "sliver_facets" => {
            for f in chosen {
                let [a, b, c] = mesh.faces[f];
                let near = plus(middle(&mesh, f), times(1e-4, minus(at(&mesh, c), middle(&mesh, f))));
                let m = split(&mut mesh, f, near);
                mesh.faces.push([a, b, m]);
            }
        }
        "reversed_normals" => normals = Some(plant_normals(&mesh, &chosen)),
        "inconsistent_orientation" => {
            chosen.iter().for_each(|&f| mesh.faces[f].swap(0, 1));
            expected = 3 * k;
        }
        "inside_out_shells" => plant_shells(&mut mesh, k),
        "self_intersections" => plant_crossings(&mut mesh, k),
        "t_junctions" => chosen.into_iter().for_each(|f| {
            let place = middle(&mesh, f);
            split(&mut mesh, f, place);
        }),
        "unshared_vertices" => {
            for f in chosen {
                let v = mesh.faces[f][0];
                mesh.positions.push(at(&mesh, v).map(|x| x + 1e-6));
                mesh.faces[f][0] = mesh.positions.len() as u32 - 1;
            }
        }
        "islands" => (0..k).for_each(|i| add(&mut mesh, &block(1, 0.0625), [13.0, 0.5 * i as f64, 0.0])),
        "not_finite_facets" => {
            mesh.positions.push([1.0, f64::NAN, 0.0]);
            let n = mesh.positions.len() as u32 - 1;
            chosen.iter().for_each(|&f| mesh.faces.push([mesh.faces[f][0], n, mesh.faces[f][1]]));
        }
        other => panic!("nothing is planted for {other}"),
    }
    (weld::mesh(&mesh).unwrap().mesh, normals, expected)
}

#[test]
fn every_kind_keeps_the_contract() {
    let clean = of(&sound());
    assert!(clean.sound && clean.soundness.sound, "{:?}", counts(&clean));
    assert_eq!((counts(&clean), clean.euler_characteristic, clean.genus), (vec![], 2, Some(0)));
    for (i, kind) in KINDS.iter().enumerate() {
        assert!(kind.name.chars().all(|c| c.is_ascii_lowercase() || c == '_'), "{}", kind.name);
        assert!(KINDS[..i].iter().all(|k| k.name != kind.name), "{} is there twice", kind.name);
        assert!(kind.about.ends_with('.') && !kind.size.is_empty(), "{}", kind.name);
        for k in [1, 2, 5, 8] {
            let (mesh, normals, expected) = planted(kind.name, k);
            let limited = Options { limit: 3, ..Options::default() };
            let report = check(&mesh, normals.as_deref(), &limited, &Silent).unwrap();
            let found = report.found(kind).unwrap();
            assert_eq!(found.count, expected, "{} {k}: {:?}", kind.name, counts(&report));
            assert_eq!(found.items.len(), expected.min(3), "{}", kind.name);
            for item in &found.items {
                assert!(item.position.iter().all(|x| x.is_finite()) && item.size >= 0.0, "{item:?}");
                assert!(item.facets.iter().all(|f| (*f as usize) < mesh.faces.len()), "{item:?}");
                assert!(item.vertices.iter().all(|v| (*v as usize) < mesh.positions.len()), "{item:?}");
                assert!(!item.facets.is_empty() || !item.vertices.is_empty(), "{item:?}");
            }
            assert_eq!(report.sound, kind.severity == Severity::Warning, "{}", kind.name);
        }
    }
}

/// The mesh with every position and facet moved as told, vertices numbered anew.
fn moved(mesh: &Mesh, order: &[usize], to: impl Fn(&Point) -> Point) -> Mesh {
    let turned = |f: [u32; 3]| [f[1], f[2], f[0]];
    let positions = mesh.positions.iter().map(to).collect();
    let faces = order.iter().map(|&i| turned(mesh.faces[i])).collect();
    weld::mesh(&Mesh { positions, faces }).unwrap().mesh
}

fn run(mesh: &Mesh, normals: Option<&[[f32; 3]]>, threads: usize) -> Report {
    let options = Options { gap: Some(1e-5), ..Options::default() };
    on_threads(threads, || check(mesh, normals, &options, &Silent)).unwrap()
}

#[test]
fn motion_order_precision_and_threads_change_nothing() {
    let random = &mut Random::new(12);
    for kind in KINDS {
        let (mesh, normals, _) = planted(kind.name, 4);
        let want = run(&mesh, normals.as_deref(), 1);
        assert_eq!(want.defects, run(&mesh, normals.as_deref(), 3).defects, "{}", kind.name);
        let mut order: Vec<usize> = (0..mesh.faces.len()).collect();
        (1..order.len()).rev().for_each(|i| order.swap(i, random.below(i as u64 + 1) as usize));
        let normals_in_order = |to: &dyn Fn([f32; 3]) -> [f32; 3]| -> Option<Vec<[f32; 3]>> {
            normals.as_ref().map(|n| order.iter().map(|&i| to(n[i])).collect())
        };
        // A quarter turn and a shift by whole numbers, which single precision holds: everything is as it was.
        let quarter = moved(&mesh, &order, |p| [-p[1] + 3.0, p[0] + 7.0, p[2] - 5.0]);
        let turned = normals_in_order(&|n| [-n[1], n[0], n[2]]);
        assert_eq!(counts(&run(&quarter, turned.as_deref(), 2)), counts(&want), "{}", kind.name);
        // Any turn rounds the vertices: three on a line are so no longer, but what was planted stays.
        let rows = [[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]];
        let turn = |p: Point| rows.map(|r: Point| dot(r, p));
        let tilted = moved(&mesh, &order, |p| plus(turn(*p), [0.1, 77.7, -1e3]));
        let turned = normals_in_order(&|n| turn(n.map(f64::from)).map(|x| x as f32));
        let got = run(&tilted, turned.as_deref(), 2);
        let connected = |r: &Report| (r.edges, r.euler_characteristic, r.soundness.shells);
        assert_eq!(connected(&got), connected(&want), "{}", kind.name);
        if kind.name != "degenerate_facets" {
            let count = |r: &Report| r.found(kind).map(|f| f.count);
            assert_eq!(count(&got), count(&want), "{} turned", kind.name);
        }
    }
}

#[test]
fn a_ring_has_one_handle() {
    // A block with a square tunnel: two sides open in the middle, joined by four walls.
    let mut mesh = block(3, 3.0);
    mesh.faces.retain(|f| {
        let c = f.iter().fold([0.0; 3], |c, v| plus(c, times(1.0 / 3.0, mesh.positions[*v as usize])));
        !(c[2] % 3.0 == 0.0 && c[0] > 1.0 && c[0] < 2.0 && c[1] > 1.0 && c[1] < 2.0)
    });
    let mut tunnel = block(1, 1.0);
    tunnel.faces.retain(|f| {
        let z = f.map(|v| tunnel.positions[v as usize][2]);
        z[0] != z[1] || z[1] != z[2]
    });
    tunnel.positions.iter_mut().for_each(|p| *p = [p[0] + 1.0, p[1] + 1.0, 3.0 * p[2]]);
    add(&mut mesh, &inverted(tunnel), [0.0; 3]);
    let report = of(&weld::mesh(&mesh).unwrap().mesh);
    assert!(report.sound, "{:?}", counts(&report));
    assert_eq!((report.genus, report.euler_characteristic), (Some(1), 0));
    assert!((report.properties.signed_volume - 24.0).abs() < 1e-13);
}
