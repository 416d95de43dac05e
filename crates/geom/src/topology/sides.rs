//! The facets at each edge, gone through by the lower end of the edge, many at once: no list of all edges is made.

use super::connected::Topology;
use super::fans::{Fans, Spoke, TOPOLOGY_ITEMS_PER_TASK};
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::progress::Silent;

/// A facet at an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Side {
    /// The ends, the lower vertex first.
    pub ends: [u32; 2],
    /// The facet.
    pub facet: u32,
    /// Whether the facet runs from the lower to the higher vertex.
    pub up: bool,
}

/// Calls `visit` with the sides at each edge of these faces, ascending; the faces name vertices below `vertices`. Where `visit` returns
/// errors, the one of the least edge is returned.
///
/// Linear, but for vertices with very many facets. Faces must not name a vertex twice.
pub fn each_edge<E: Send>(
    vertices: usize,
    faces: &[[u32; 3]],
    visit: impl Fn(&[Side]) -> Result<(), E> + Sync,
) -> Result<(), E> {
    through(&Fans::new(vertices, faces, |_| true, &Silent), faces, visit)
}

impl Topology {
    /// As [`each_edge`], of the facets of `mesh` that count. `mesh` is the one this was made of.
    pub fn each_edge<E: Send>(
        &self,
        mesh: &Mesh,
        visit: impl Fn(&[Side]) -> Result<(), E> + Sync,
    ) -> Result<(), E> {
        through(&self.fans, &mesh.faces, visit)
    }
}

fn through<E: Send>(
    fans: &Fans,
    faces: &[[u32; 3]],
    visit: impl Fn(&[Side]) -> Result<(), E> + Sync,
) -> Result<(), E> {
    let refused = |part: usize| -> Option<E> {
        let (mut spokes, mut sides): (Vec<Spoke>, Vec<Side>) = (vec![], vec![]);
        for v in part * TOPOLOGY_ITEMS_PER_TASK..fans.len().min((part + 1) * TOPOLOGY_ITEMS_PER_TASK) {
            let v = v as u32;
            fans.spokes(faces, v, &mut spokes);
            sides.clear();
            for &[next, before, facet] in &spokes {
                let both = [(next, true), (before, false)].into_iter().filter(|(end, _)| *end > v);
                sides.extend(both.map(|(end, up)| Side { ends: [v, end], facet, up }));
            }
            sides.sort_unstable();
            let refused = sides.chunk_by(|a, b| a.ends == b.ends).find_map(|edge| visit(edge).err());
            if refused.is_some() {
                return refused;
            }
        }
        None
    };
    let parts = (0..fans.len().div_ceil(TOPOLOGY_ITEMS_PER_TASK)).into_par_iter();
    parts.find_map_first(refused).map_or(Ok(()), Err)
}
