//! The rim of a hole.

use super::super::work::Work;
use trueness_geom::check::Known;
use trueness_geom::space::{Point, plus, times};

/// A closed ring of boundary edges.
#[derive(Clone, Debug)]
pub(super) struct Ring {
    /// Its vertices, in the direction in which the facets of a patch must run.
    pub vertices: Vec<u32>,
    /// The facet at the edge from vertex `i` to the next one.
    pub facets: Vec<u32>,
    /// The shell it belongs to; `u32::MAX` where there is none.
    pub shell: u32,
    /// Area, mm², of that shell.
    pub shell_area: f64,
}

impl Ring {
    /// All rings of a mesh.
    pub(super) fn all(known: &Known) -> Vec<Ring> {
        let edges = &known.topology.boundary_edges;
        let mut sides: Vec<([u32; 2], u32)> = edges.iter().map(|e| (e.vertices, e.facet)).collect();
        sides.sort_unstable();
        let find = |a: u32, b: u32| sides.binary_search_by_key(&[a, b], |s| s.0).ok().map(|i| sides[i].1);
        let ring = |ring: &Vec<u32>| {
            let n = ring.len();
            let along = (0..n).filter(|&i| find(ring[i], ring[(i + 1) % n]).is_some()).count();
            let mut vertices = ring.clone();
            // Most of the facets run along the ring, so the patch must run against it.
            if 2 * along > n {
                vertices.reverse();
            }
            let facet = |i: usize| {
                let (a, b) = (vertices[i], vertices[(i + 1) % n]);
                find(b, a).or(find(a, b)).unwrap_or(u32::MAX)
            };
            let facets: Vec<u32> = (0..n).map(facet).collect();
            let shell = known.topology.shell_of.get(facets[0] as usize).copied().unwrap_or(u32::MAX);
            let shell_area = known.properties.shell_areas.get(shell as usize).copied().unwrap_or(0.0);
            Ring { vertices, facets, shell, shell_area }
        };
        known.boundary.rings.iter().map(ring).collect()
    }

    /// Mean of its vertices.
    pub(super) fn middle(&self, work: &Work) -> Point {
        let sum = self.vertices.iter().fold([0.0; 3], |s, v| plus(s, work.at(*v)));
        times(1.0 / self.vertices.len() as f64, sum)
    }
}
