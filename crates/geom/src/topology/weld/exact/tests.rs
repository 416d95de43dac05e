use super::*;
use crate::num::random::Random;
use crate::samples::on_threads;
use std::collections::HashMap;

/// Facets with corners on a grid of `side`³ places, some at −0 and some at NaN.
fn soup(dice: &mut Random, facets: usize, side: u64) -> Vec<[[f32; 3]; 3]> {
    let mut coordinate = || match dice.below(side + 2) {
        0 => -0.0,
        1 if side > 50 => f32::NAN,
        x => x as f32 * 0.1 - 1.0,
    };
    (0..facets).map(|_| std::array::from_fn(|_| std::array::from_fn(|_| coordinate()))).collect()
}

fn bits(mesh: &Mesh) -> Vec<[u64; 3]> {
    mesh.positions.iter().map(|p| p.map(f64::to_bits)).collect()
}

/// The same by a hash map, one corner after the other.
fn plain(soup: &[[[f32; 3]; 3]]) -> Mesh {
    let mut numbers = HashMap::new();
    let mut mesh = Mesh::default();
    for facet in soup {
        mesh.faces.push(facet.map(|p| {
            let p = p.map(|x| f64::from(x) + 0.0);
            *numbers.entry(p.map(f64::to_bits)).or_insert_with(|| {
                mesh.positions.push(p);
                mesh.positions.len() as u32 - 1
            })
        }));
    }
    mesh
}

#[test]
fn equals_a_hash_map_on_any_number_of_threads() {
    let dice = &mut Random::new(1);
    for (facets, side) in [(0, 3), (1, 3), (50, 2), (4_000, 20), (30_000, 60), (40_000, 300)] {
        let soup = soup(dice, facets, side);
        let want = plain(&soup);
        for threads in [1, 2, 5] {
            on_threads(threads, || {
                let got = corners(soup.len(), |f, k| soup[f][k]).unwrap();
                assert!(bits(&got) == bits(&want) && got.faces == want.faces, "{facets} {side} {threads}");
                let wide = corners(soup.len(), |f, k| soup[f][k].map(f64::from)).unwrap();
                assert!(bits(&wide) == bits(&want) && wide.faces == want.faces, "{facets} {side} {threads}");
                let again = mesh(&got).unwrap();
                assert!(bits(&again.mesh) == bits(&want) && again.mesh.faces == want.faces);
                assert!(again.vertex_of.iter().enumerate().all(|(i, &v)| i == v as usize));
            });
        }
    }
}

#[test]
fn vertices_at_one_position_are_joined_and_idle_ones_dropped() {
    let positions = vec![[9.0; 3], [0.0, 0.0, -0.0], [1.0, 0.0, 0.0], [0.0, -0.0, 0.0], [0.0, 1.0, 0.0]];
    let faces = vec![[3, 2, 4], [1, 3, 2]];
    let got = mesh(&Mesh { positions, faces }).unwrap();
    assert_eq!(got.mesh.positions, [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(got.mesh.faces, [[0, 1, 2], [0, 0, 1]]);
    assert_eq!(got.vertex_of, [u32::MAX, 0, 1, 0, 2]);
}

#[test]
fn refuses_what_cannot_be_numbered() {
    let facets = MAX_FACETS + 1;
    assert_eq!(corners(facets, |_, _| [0.0f32; 3]), Err(WeldError::TooManyFacets { facets }));
    let short = Mesh { positions: vec![[0.0; 3]; 3], faces: vec![[0, 1, 2], [0, 3, 9]] };
    assert_eq!(mesh(&short), Err(WeldError::NoSuchVertex { facet: 1, vertex: 3, vertices: 3 }));
}
