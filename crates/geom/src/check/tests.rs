mod places;

use super::*;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::samples::{add, block, counts, inverted, on_threads, planted, sound};
use crate::space::{Point, dot, plus, times};
use crate::topology::weld;

fn of(mesh: &Mesh) -> Report {
    check(mesh, None, &Options::default(), &Silent).unwrap()
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
