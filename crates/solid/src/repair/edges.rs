//! All edges of a mesh with the facets at them, as one sorted table; the sheets between the edges where more than two meet.

use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::topology::Topology;
use trueness_geom::topology::union::Sets;

/// A facet at an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Side {
    /// The ends, the lower vertex first.
    pub ends: [u32; 2],
    pub facet: u32,
    /// Whether the facet runs from the lower to the higher vertex.
    pub up: bool,
}

/// Sides sorted by edge, then by facet.
pub(super) struct Edges(Vec<Side>);

impl Edges {
    /// The sides of the facets that count. n log n, 16 bytes a side.
    pub(super) fn of(mesh: &Mesh, topology: &Topology) -> Edges {
        let side = |f: u32, a: u32, b: u32| Side { ends: [a.min(b), a.max(b)], facet: f, up: a < b };
        let counting = mesh.faces.par_iter().enumerate().filter(|(f, _)| topology.shell_of[*f] != u32::MAX);
        let mut sides: Vec<Side> = counting
            .flat_map_iter(|(f, &[a, b, c])| [(a, b), (b, c), (c, a)].map(|(a, b)| side(f as u32, a, b)))
            .collect();
        sides.par_sort_unstable();
        Edges(sides)
    }

    /// The facets at each edge.
    pub(super) fn iter(&self) -> impl Iterator<Item = &[Side]> {
        self.0.chunk_by(|a, b| a.ends == b.ends)
    }

    /// The facets at an edge.
    pub(super) fn at(&self, a: u32, b: u32) -> &[Side] {
        let ends = [a.min(b), a.max(b)];
        let first = self.0.partition_point(|s| s.ends < ends);
        let count = self.0[first..].partition_point(|s| s.ends == ends);
        &self.0[first..first + count]
    }

    /// For each facet the lowest facet that it is connected with through edges of two facets.
    pub(super) fn sheets(&self, facets: usize) -> Vec<u32> {
        let sets = Sets::new(facets);
        self.iter().filter(|e| e.len() == 2).for_each(|e| sets.join(e[0].facet, e[1].facet));
        (0..facets as u32).map(|f| sets.root(f)).collect()
    }
}
