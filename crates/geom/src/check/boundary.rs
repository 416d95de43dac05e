//! The graph of the boundary edges, taken apart into closed rings and open chains.
//!
//! Where an odd number of boundary edges meet at a vertex, a chain must end; the walks that start there are the chains. The
//! rest has an even number of edges at every vertex and falls into rings. A walk that comes back to a vertex it has passed
//! leaves a ring behind and goes on. So rings and chains pass no vertex twice. Orientation plays no part: it may be
//! inconsistent. Each walk takes the lowest edge and, at a vertex, the edge to the lowest neighbor first.

use super::near::Near;
use crate::mesh::Mesh;
use crate::topology::Topology;

/// Rings and chains as the vertices they pass, in the order of their lowest edge.
#[derive(Debug, Default, PartialEq)]
pub struct Boundary {
    /// Closed ones; the last vertex joins the first.
    pub rings: Vec<Vec<u32>>,
    /// Open ones, from end to end.
    pub chains: Vec<Vec<u32>>,
}

/// The graph: for each edge end (vertex, other vertex, edge), sorted; and which edges a walk has used.
struct Graph {
    ends: Vec<(u32, u32, u32)>,
    used: Vec<bool>,
    /// First of the ends of a vertex that may still be unused, by the place of the vertex's first end.
    next: Vec<u32>,
}

impl Boundary {
    /// Chains of the boundary edges of `topology`; n log n.
    pub(crate) fn of(topology: &Topology) -> Boundary {
        let edges = topology.boundary_edges.iter().map(|e| e.vertices);
        Boundary::of_edges(&edges.collect::<Vec<_>>())
    }

    /// The vertices on the boundary, ascending.
    pub(crate) fn vertices(&self) -> Vec<u32> {
        let mut all: Vec<u32> = self.rings.iter().chain(&self.chains).flatten().copied().collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// The same with their places, for searching.
    pub(crate) fn near(&self, mesh: &Mesh) -> Near {
        Near::new(self.vertices().into_iter().map(|v| (mesh.positions[v as usize], v)).collect())
    }

    fn of_edges(edges: &[[u32; 2]]) -> Boundary {
        let both = (0..).zip(edges).flat_map(|(i, &[a, b])| [(a, b, i), (b, a, i)]);
        let mut ends: Vec<_> = both.collect();
        ends.sort_unstable();
        let mut graph =
            Graph { used: vec![false; edges.len()], next: (0..ends.len() as u32).collect(), ends };
        let mut found = Boundary::default();
        let odd: Vec<u32> =
            graph.ends.chunk_by(|a, b| a.0 == b.0).filter(|e| e.len() % 2 == 1).map(|e| e[0].0).collect();
        for start in odd {
            graph.walk(start, &mut found);
        }
        for i in 0..graph.ends.len() {
            let (vertex, _, edge) = graph.ends[i];
            if !graph.used[edge as usize] {
                graph.walk(vertex, &mut found);
            }
        }
        found
    }
}

impl Graph {
    /// Takes an unused edge at `vertex`; returns the other end.
    fn step(&mut self, vertex: u32) -> Option<u32> {
        let first = self.ends.partition_point(|e| e.0 < vertex);
        if first == self.ends.len() {
            return None;
        }
        let mut i = self.next[first] as usize;
        while i < self.ends.len() && self.ends[i].0 == vertex && self.used[self.ends[i].2 as usize] {
            i += 1;
        }
        self.next[first] = i as u32;
        let &(v, other, edge) = self.ends.get(i)?;
        if v != vertex {
            return None;
        }
        self.used[edge as usize] = true;
        Some(other)
    }

    /// Walks from `start` until it can go no farther.
    fn walk(&mut self, start: u32, found: &mut Boundary) {
        let mut path = vec![start];
        let mut on_path = std::collections::BTreeMap::from([(start, 0)]);
        let mut here = start;
        while let Some(next) = self.step(here) {
            match on_path.get(&next) {
                Some(&seen) => {
                    for passed in &path[seen + 1..] {
                        on_path.remove(passed);
                    }
                    found.rings.push(path[seen..].to_vec());
                    path.truncate(seen + 1);
                }
                None => {
                    on_path.insert(next, path.len());
                    path.push(next);
                }
            }
            here = next;
        }
        if path.len() > 1 {
            found.chains.push(path);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rings_that_touch_are_taken_apart() {
        // Two triangles with the common vertex 2, and a square apart from them.
        let edges = [[0, 1], [1, 2], [2, 0], [2, 3], [3, 4], [4, 2], [9, 6], [6, 7], [7, 8], [8, 9]];
        let found = Boundary::of_edges(&edges);
        let mut sizes: Vec<usize> = found.rings.iter().map(Vec::len).collect();
        sizes.sort_unstable();
        assert_eq!((sizes, found.chains.len()), (vec![3, 3, 4], 0));
    }

    #[test]
    fn chains_end_where_the_number_of_edges_is_odd() {
        // A chain with a ring on its way, then a star of three.
        let edges = [[0, 1], [1, 2], [2, 3], [3, 1], [1, 4], [10, 11], [10, 12], [10, 13]];
        let found = Boundary::of_edges(&edges);
        assert_eq!(found.rings, [[1, 2, 3]]);
        assert_eq!(found.chains, [vec![0, 1, 4], vec![10, 11], vec![12, 10, 13]]);
        assert_eq!(Boundary::of_edges(&[]), Boundary::default());
    }
}
