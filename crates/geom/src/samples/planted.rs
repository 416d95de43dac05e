//! A sound block, and the same with defects of each kind that the check knows.

use super::bodies::{add, block, inverted};
use crate::check::Report;
use crate::mesh::Mesh;
use crate::num::random::Random;
use crate::space::{Point, cross, minus, plus, times};
use crate::topology::weld;

/// The kinds of defect that a check found, with their numbers.
pub fn counts(report: &Report) -> Vec<(&'static str, usize)> {
    let found = report.defects.iter().filter_map(|(k, f)| Some((k.name, f.as_ref()?.count)));
    found.filter(|(_, n)| *n > 0).collect()
}

/// A block of 12 × 12 cells a side, its vertices moved a little in the plane of their side: sound.
pub fn sound() -> Mesh {
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
    // The facets in the wall of the first cavity look inwards where they should look outwards.
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
        let [a, b, c] = mesh.places(f);
        cross(minus(b, a), minus(c, a)).map(|x| x as f32)
    };
    let mut stored: Vec<[f32; 3]> = mesh.faces.iter().map(normal).collect();
    stored[0] = [0.0; 3];
    stored[1] = [f32::NAN; 3];
    chosen.iter().for_each(|&f| stored[f] = stored[f].map(|x| -x));
    stored
}

/// A sound block with `k` defects of a kind, the stored normals, and how many findings of that kind there must be.
pub fn planted(kind: &str, k: usize) -> (Mesh, Option<Vec<[f32; 3]>>, usize) {
    let mut mesh = sound();
    let chosen = apart(&mesh, k);
    let at = |mesh: &Mesh, v: u32| mesh.positions[v as usize];
    let middle = |mesh: &Mesh, f: usize| {
        let [a, b, _] = mesh.places(&mesh.faces[f]);
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
