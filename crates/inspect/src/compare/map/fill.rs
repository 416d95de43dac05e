//! Values for vertices beside those that have one.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use trueness_geom::mesh::Mesh;
use trueness_geom::space::{minus, norm};

/// Gives each vertex without a value (NaN) that of the vertex nearest along the edges that has one, if the way is no longer than
/// `reach`; of several at the same distance, the one with the lower number. Values never go over where edges are not shared.
///
/// E. W. Dijkstra, "A note on two problems in connexion with graphs", 1959. Cost: `n log n` in the vertices that get a value.
pub fn fill(mesh: &Mesh, values: &mut [f64], reach: f64) {
    let (starts, neighbours) = around_empty(mesh, values);
    let length = |a: u32, b: u32| norm(minus(mesh.positions[a as usize], mesh.positions[b as usize]));
    let list = |v: u32| &neighbours[starts[v as usize] as usize..starts[v as usize + 1] as usize];
    let mut open = BinaryHeap::new();
    let offer = |open: &mut BinaryHeap<_>, way: f64, from: u32, to: u32| {
        let way = way + length(from, to);
        if way <= reach {
            // Ways are not below zero: their bits have their order.
            open.push(Reverse((way.to_bits(), from, to)));
        }
    };
    for v in (0..values.len() as u32).filter(|v| values[*v as usize].is_nan()) {
        for &n in list(v).iter().filter(|n| !values[**n as usize].is_nan()) {
            offer(&mut open, 0.0, n, v);
        }
    }
    while let Some(Reverse((way, from, to))) = open.pop() {
        if !values[to as usize].is_nan() {
            continue;
        }
        values[to as usize] = values[from as usize];
        for &n in list(to).iter().filter(|n| values[**n as usize].is_nan()) {
            offer(&mut open, f64::from_bits(way), to, n);
        }
    }
}

/// For each vertex without a value the vertices that it shares an edge with: where each list starts, and the lists.
fn around_empty(mesh: &Mesh, values: &[f64]) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0u32; values.len() + 1];
    let ends = |f: &[u32; 3]| [[f[0], f[1]], [f[1], f[2]], [f[2], f[0]]].map(|[a, b]| [[a, b], [b, a]]);
    let wanted = |v: u32| values[v as usize].is_nan();
    for [v, _] in mesh.faces.iter().flat_map(ends).flatten().filter(|[v, _]| wanted(*v)) {
        starts[v as usize + 1] += 1;
    }
    for v in 0..values.len() {
        starts[v + 1] += starts[v];
    }
    let mut next = starts.clone();
    let mut lists = vec![0; starts[values.len()] as usize];
    for [v, n] in mesh.faces.iter().flat_map(ends).flatten().filter(|[v, _]| wanted(*v)) {
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
