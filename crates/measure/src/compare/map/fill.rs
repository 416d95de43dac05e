//! Values for vertices beside those that have one.

use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{minus, norm};

/// Gives each vertex without a value (NaN) that of the nearest vertex with one along the edges, up to `reach` away. At the same distance,
/// it is the vertex with the lower number. Values never go over where edges are not shared.
///
/// Ways are shortened round by round (R. Bellman, "On a routing problem", 1958): with a reach of a few edges there are few rounds.
pub fn fill(mesh: &Mesh, values: &mut [f64], reach: f64) {
    let empty: Vec<bool> = values.iter().map(|v| v.is_nan()).collect();
    let (starts, neighbors) = around_empty(mesh, &empty);
    let length = |a: u32, b: u32| norm(minus(mesh.positions[a as usize], mesh.positions[b as usize]));
    let list = |v: u32| &neighbors[starts[v as usize] as usize..starts[v as usize + 1] as usize];
    let empty = |v: &u32| empty[*v as usize];
    // The shortest way so far to a vertex with a value, and that vertex.
    let mut nearest: Vec<(f64, u32)> = (0..values.len() as u32)
        .into_par_iter()
        .map(|v| {
            let known = list(v).iter().filter(|n| !empty(n)).map(|&n| (length(n, v), n));
            known.filter(|(way, _)| *way <= reach).fold((f64::INFINITY, u32::MAX), nearer)
        })
        .collect();
    let mut turn: Vec<u32> = (0..).zip(&nearest).filter(|(_, n)| n.1 != u32::MAX).map(|(v, _)| v).collect();
    let mut waits = vec![false; values.len()];
    while !turn.is_empty() {
        let mut next = vec![];
        for &v in &turn {
            waits[v as usize] = false;
            let (way, source) = nearest[v as usize];
            for &n in list(v).iter().filter(|n| empty(n)) {
                let offer = (way + length(v, n), source);
                let best = nearer(nearest[n as usize], offer);
                if offer.0 <= reach && best != nearest[n as usize] {
                    nearest[n as usize] = best;
                    if !std::mem::replace(&mut waits[n as usize], true) {
                        next.push(n);
                    }
                }
            }
        }
        turn = next;
    }
    for (v, (_, source)) in nearest.into_iter().enumerate() {
        if source != u32::MAX {
            values[v] = values[source as usize];
        }
    }
}

/// The shorter way, of equal ones that to the lower number.
fn nearer(a: (f64, u32), b: (f64, u32)) -> (f64, u32) {
    if b.0 < a.0 || b.0 == a.0 && b.1 < a.1 { b } else { a }
}

/// For each vertex without a value the vertices that it shares an edge with: where each list starts, and the lists.
fn around_empty(mesh: &Mesh, empty: &[bool]) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0u32; empty.len() + 1];
    let beside = |f: &&[u32; 3]| f.iter().any(|v| empty[*v as usize]);
    let faces: Vec<&[u32; 3]> = mesh.faces.par_iter().filter(beside).collect();
    let ends = |f: &[u32; 3]| [[f[0], f[1]], [f[1], f[2]], [f[2], f[0]]].map(|[a, b]| [[a, b], [b, a]]);
    let links = || faces.iter().flat_map(|f| ends(f)).flatten().filter(|[v, _]| empty[*v as usize]);
    for [v, _] in links() {
        starts[v as usize + 1] += 1;
    }
    for v in 0..empty.len() {
        starts[v + 1] += starts[v];
    }
    let mut next = starts.clone();
    let mut lists = vec![0; starts[empty.len()] as usize];
    for [v, n] in links() {
        lists[next[v as usize] as usize] = n;
        next[v as usize] += 1;
    }
    (starts, lists)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_along_the_strip_and_no_farther_than_the_reach() {
        // A strip of squares of 1 mm; vertex 2i above 2i + 1.
        let positions = (0..20u32).map(|i| [f64::from(i / 2), f64::from(i % 2), 0.0]).collect();
        let faces =
            (0..9u32).flat_map(|i| [[2 * i, 2 * i + 1, 2 * i + 2], [2 * i + 2, 2 * i + 1, 2 * i + 3]]);
        let mesh = Mesh { positions, faces: faces.collect() };
        let mut values = vec![f64::NAN; 20];
        (values[4], values[12]) = (0.1, -0.7);
        fill(&mesh, &mut values, 3.0);
        for i in [0, 2, 4, 6] {
            assert_eq!(values[i], 0.1);
        }
        for i in [8, 10, 12, 14, 16, 18] {
            assert_eq!(values[i], if i == 8 { 0.1 } else { -0.7 }, "{i}");
        }
        fill(&mesh, &mut values, f64::INFINITY);
        assert!(values.iter().all(|v| !v.is_nan()));
        let mut alone = vec![f64::NAN; 20];
        fill(&mesh, &mut alone, 9.0);
        assert!(alone.iter().all(|v| v.is_nan()));
    }
}
