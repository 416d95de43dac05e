use super::weld::WeldError;
use super::*;
use crate::mesh::Mesh;
use crate::num::predicates;
use crate::num::random::Random;
use crate::samples::{block, on_threads};
use crate::simd::Level;
use crate::space::Point;
use std::collections::BTreeMap;

pub(crate) fn levels() -> impl Iterator<Item = Level> {
    [Level::Plain, Level::Avx2, Level::Avx512].into_iter().filter(|l| *l <= Level::detect())
}

/// Random facets among `vertices` places of a coarse grid: every kind of mess.
fn soup(random: &mut Random, facets: usize, vertices: u64) -> Mesh {
    let place = |v: u64| [v % 4, v / 4 % 4, v / 16].map(|x| x as f64 * 0.1);
    let facets: Vec<[Point; 3]> =
        (0..facets).map(|_| std::array::from_fn(|_| place(random.below(vertices)))).collect();
    weld::corners(facets.len(), |f, k| facets[f][k]).unwrap()
}

/// An edge as a facet runs along it, and the facet.
type Side = ([u32; 2], u32);

/// The least member that each one hangs together with: painted until nothing changes.
fn paint(members: &[u32], joined: &dyn Fn(u32, u32) -> bool) -> Vec<u32> {
    let mut color: Vec<u32> = members.to_vec();
    loop {
        let before = color.clone();
        for i in 0..members.len() {
            for j in 0..i {
                if color[i] != color[j] && joined(members[i], members[j]) {
                    (color[i], color[j]) = (color[i].min(color[j]), color[i].min(color[j]));
                }
            }
        }
        if color == before {
            return color;
        }
    }
}

/// Everything in [`Topology`] by maps and exhaustive search.
fn compare_with_plain_twin(mesh: &Mesh, name: &str) {
    let repeated = |f: &[u32; 3]| f[0] == f[1] || f[1] == f[2] || f[0] == f[2];
    let counting: Vec<u32> =
        (0..mesh.faces.len() as u32).filter(|&f| !repeated(&mesh.faces[f as usize])).collect();
    let corners = |f: u32| mesh.faces[f as usize];
    let flat = |f: u32| predicates::axis(&corners(f).map(|v| mesh.positions[v as usize])).is_none();
    let mut edges: BTreeMap<[u32; 2], Vec<Side>> = BTreeMap::new();
    for &f in &counting {
        for k in 0..3 {
            let (a, b) = (corners(f)[k], corners(f)[(k + 1) % 3]);
            edges.entry([a.min(b), a.max(b)]).or_default().push(([a, b], f));
        }
    }
    let list = |keep: &dyn Fn(&[Side]) -> bool| -> Vec<EdgeAt> {
        edges.values().filter(|e| keep(e)).map(|e| EdgeAt { vertices: e[0].0, facet: e[0].1 }).collect()
    };
    let mut seen = BTreeMap::new();
    let mut duplicates = vec![];
    for &f in counting.iter().filter(|&&f| !flat(f)) {
        let mut key = corners(f);
        key.sort_unstable();
        let first = *seen.entry(key).or_insert(f);
        if first != f {
            duplicates.push([first, f]);
        }
    }
    let common = |a: u32, b: u32| corners(a).iter().filter(|v| corners(b).contains(v)).count();
    // Shells and fans.
    let color = paint(&counting, &|a, b| common(a, b) >= 2);
    let mut first: Vec<u32> = color.clone();
    first.sort_unstable();
    first.dedup();
    let mut shell_of = vec![u32::MAX; mesh.faces.len()];
    for (f, c) in counting.iter().zip(&color) {
        shell_of[*f as usize] = first.binary_search(c).unwrap() as u32;
    }
    let broken = (0..mesh.positions.len() as u32).filter(|&v| {
        let around: Vec<u32> = counting.iter().copied().filter(|&f| corners(f).contains(&v)).collect();
        paint(&around, &|a, b| common(a, b) >= 2).windows(2).any(|c| c[0] != c[1])
    });
    let broken: Vec<u32> = broken.collect();
    for (level, threads) in levels().flat_map(|l| [(l, 1), (l, 3)]) {
        let t = on_threads(threads, || Topology::with(mesh, level, &crate::progress::Silent)).unwrap();
        let what = format!("{name} {level:?} {threads}");
        assert_eq!((t.edges, t.counting_facets), (edges.len(), counting.len()), "{what}");
        assert_eq!(t.boundary_edges, list(&|e| e.len() == 1), "{what}");
        assert_eq!(t.non_manifold_edges, list(&|e| e.len() > 2), "{what}");
        assert_eq!(t.inconsistent_edges, list(&|e| e.len() == 2 && e[0].0 == e[1].0), "{what}");
        assert_eq!(t.non_manifold_vertices, broken, "{what}");
        assert_eq!(t.duplicate_facets, duplicates, "{what}");
        assert_eq!(t.collinear, counting.iter().copied().filter(|&f| flat(f)).collect::<Vec<_>>(), "{what}");
        assert_eq!(t.repeated_vertex.len(), mesh.faces.len() - counting.len(), "{what}");
        assert_eq!((t.shells, &t.shell_of), (first.len(), &shell_of), "{what}");
        let some: Vec<_> = edges.iter().step_by(7).collect();
        for (edge, facets) in some {
            let facets: Vec<u32> = facets.iter().map(|f| f.1).collect();
            assert_eq!(t.facets_at_edge(mesh, *edge), facets, "{what}");
            assert!(t.has_edge(mesh, *edge) && t.has_edge(mesh, [edge[1], edge[0]]), "{what}");
        }
        let few = mesh.positions.len().min(20) as u32;
        for [a, b] in (0..few).flat_map(|a| (0..few).map(move |b| [a, b])) {
            assert_eq!(t.has_edge(mesh, [a, b]), !t.facets_at_edge(mesh, [a, b]).is_empty(), "{what}");
        }
    }
}

#[test]
fn equals_the_plain_twin() {
    let random = &mut Random::new(3);
    for (facets, vertices) in [(0, 4), (1, 4), (6, 4), (30, 8), (60, 24), (120, 60), (200, 64)] {
        compare_with_plain_twin(&soup(random, facets, vertices), &format!("soup {facets} {vertices}"));
    }
    let mut mesh = block(4, 1.0);
    compare_with_plain_twin(&mesh, "block");
    for face in mesh.faces.iter_mut().step_by(11) {
        face.swap(0, 1);
    }
    compare_with_plain_twin(&mesh, "block with turned facets");
    mesh.faces.retain(|f| f[0] % 5 != 0);
    let again = mesh.faces[3];
    mesh.faces.push([again[1], again[2], again[0]]);
    compare_with_plain_twin(&weld::mesh(&mesh).unwrap().mesh, "block with holes and a double facet");
}

#[test]
fn a_block_is_sound_and_has_its_volume() {
    let mesh = block(7, 3.0);
    let topology = Topology::of(&mesh).unwrap();
    let p = Properties::of(&mesh, &topology);
    let near = |a: f64, b: f64| (a - b).abs() < 1e-14 * b;
    assert!(near(p.area, 54.0) && near(p.signed_volume, 27.0), "{p:?}");
    assert!(
        p.center_of_mass.unwrap().iter().chain(&p.center_of_area.unwrap()).all(|x| near(*x, 1.5)),
        "{p:?}"
    );
    assert_eq!((p.bounds.min, p.bounds.max), ([0.0; 3], [3.0; 3]));
    assert_eq!(topology.euler_characteristic(), 2);
    let s = Soundness::from_parts(&topology, &p);
    assert!(s.sound && s.closed && s.outward && s.consistently_oriented && s.shells == 1, "{s:?}");
}

#[test]
fn a_far_block_keeps_its_volume() {
    let mut mesh = block(3, 2.0);
    mesh.positions.iter_mut().for_each(|p| *p = p.map(|x| x + 2f64.powi(40)));
    let p = Properties::of(&mesh, &Topology::of(&mesh).unwrap());
    let placed =
        block(3, 2.0).positions.iter().map(|p| p.map(|x| (x + 2f64.powi(40)) - 2f64.powi(40))).collect();
    let near = Mesh { positions: placed, faces: mesh.faces.clone() };
    let q = Properties::of(&near, &Topology::of(&near).unwrap());
    assert!((p.signed_volume - q.signed_volume).abs() < 1e-14 * q.signed_volume, "{p:?} {q:?}");
}

#[test]
fn shells_have_their_own_volume_and_bits_do_not_hang_on_threads() {
    let random = &mut Random::new(9);
    let mut mesh = block(20, 1.0);
    mesh.positions.iter_mut().flatten().for_each(|x| *x += 0.01 * random.unit());
    let mut other = block(2, 0.5);
    other.faces.iter_mut().for_each(|f| f.swap(0, 1));
    let shift = mesh.positions.len() as u32;
    mesh.positions.extend(other.positions);
    mesh.faces.extend(other.faces.iter().map(|f| f.map(|v| v + shift)));
    let of = |threads| on_threads(threads, || Properties::of(&mesh, &Topology::of(&mesh).unwrap()));
    let p = of(1);
    assert_eq!(p, of(3));
    assert_eq!(p.shell_volumes.len(), 2);
    assert!((p.shell_volumes[1] + 0.125).abs() < 1e-15 && (p.shell_areas[1] - 1.5).abs() < 1e-14, "{p:?}");
    assert!((p.shell_volumes[0] + p.shell_volumes[1] - p.signed_volume).abs() < 1e-15);
}

#[test]
fn every_flaw_is_named_with_its_place() {
    let whole = block(2, 1.0);
    let flaws = |mesh: &Mesh| Soundness::of(mesh).unwrap().first_flaws;
    let mut inverted = whole.clone();
    inverted.faces.iter_mut().for_each(|f| f.swap(1, 2));
    assert_eq!(flaws(&inverted), [Flaw::Inverted]);
    assert_eq!(flaws(&Mesh::default()), [Flaw::Empty]);
    let mut open = whole.clone();
    let [a, b, _] = open.faces.remove(5);
    assert!(matches!(flaws(&open)[..], [Flaw::BoundaryEdge(_)]));
    assert!(flaws(&open)[0].place(&open).is_some());
    let mut turned = whole.clone();
    turned.faces[5].swap(0, 1);
    assert!(matches!(flaws(&turned)[..], [Flaw::InconsistentEdge(_)]));
    let mut double = whole.clone();
    double.faces.push(double.faces[5]);
    assert!(matches!(flaws(&double)[..], [Flaw::NonManifoldEdge(_), Flaw::DuplicateFacets([5, 48])]));
    let mut fin = whole.clone();
    fin.positions.push([9.0; 3]);
    fin.faces.push([a, b, fin.positions.len() as u32 - 1]);
    assert!(matches!(flaws(&fin)[..], [Flaw::BoundaryEdge(_), Flaw::NonManifoldEdge(_)]));
    let mut touching = whole.clone();
    let shift = touching.positions.len() as u32;
    touching.positions.extend(whole.positions.iter().map(|p| p.map(|x| x + 1.0)));
    touching.faces.extend(whole.faces.iter().map(|f| f.map(|v| v + shift)));
    let touching = weld::mesh(&touching).unwrap().mesh;
    assert!(matches!(flaws(&touching)[..], [Flaw::NonManifoldVertex(_)]));
    assert_eq!(flaws(&touching)[0].place(&touching), Some([1.0; 3]));
}

#[test]
fn facets_that_are_not_finite_do_not_count() {
    let mut mesh = block(1, 1.0);
    mesh.positions.push([f64::NAN, 0.0, 0.0]);
    mesh.faces.push([0, 1, 8]);
    mesh.faces.push([8, 8, 8]);
    mesh.faces.push([2, 2, 3]);
    let t = Topology::of(&mesh).unwrap();
    assert_eq!((t.not_finite, t.repeated_vertex), (vec![12, 13], vec![14]));
    assert!(Soundness::of(&mesh).unwrap().sound);
    mesh.faces.push([0, 1, 9]);
    assert!(matches!(Topology::of(&mesh), Err(WeldError::NoSuchVertex { facet: 15, vertex: 9, .. })));
}

/// Corners beyond what 28 bits number, records beyond what 32 bits address: a torus of 90 million facets.
#[test]
#[ignore = "takes 5 GB of memory and half a minute"]
fn a_mesh_beyond_four_gigabytes() {
    const SIDE: usize = 6720;
    let corner = |f: usize, k: usize| {
        let (cell, upper) = (f / 2, f % 2 == 1);
        let steps = if upper { [[0, 0], [1, 1], [0, 1]] } else { [[0, 0], [1, 0], [1, 1]] };
        let [i, j] = [(cell / SIDE + steps[k][0]) % SIDE, (cell % SIDE + steps[k][1]) % SIDE];
        [i as f32, j as f32, 0.0f32]
    };
    let facets = 2 * SIDE * SIDE;
    assert!(50 * facets as u64 > u64::from(u32::MAX));
    let mesh = weld::corners(facets, corner).unwrap();
    assert_eq!((mesh.faces.len(), mesh.positions.len()), (facets, SIDE * SIDE));
    let last = mesh.faces[facets - 1].map(|v| mesh.positions[v as usize].map(|x| x as f32));
    assert_eq!(last, std::array::from_fn(|k| corner(facets - 1, k)));
    let t = Topology::of(&mesh).unwrap();
    assert_eq!((t.edges, t.euler_characteristic(), t.shells), (3 * SIDE * SIDE, 0, 1));
    assert!(
        t.boundary_edges.is_empty() && t.non_manifold_edges.is_empty() && t.inconsistent_edges.is_empty()
    );
    assert!(t.non_manifold_vertices.is_empty() && t.duplicate_facets.is_empty() && t.collinear.is_empty());
    let around = t.facets_at_vertex(mesh.faces[facets - 1][0]);
    assert!(around.len() == 6 && around.contains(&(facets as u32 - 1)));
}
