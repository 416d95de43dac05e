//! A mesh that can be laid into the plane: one part, with a rim, without handles.

use crate::SurfaceError;
use crate::not_a_disc::NotADisc;
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_geom::space::{minus, norm};
use trueness_geom::topology::{Topology, TopologyError};

/// One part with a rim.
pub(super) struct Disc {
    /// Facets that count.
    pub faces: Vec<[u32; 3]>,
    /// Rims as vertices in the direction of their facets, the longest first; all others are holes.
    pub rims: Vec<Vec<u32>>,
}

impl Disc {
    pub(super) fn of(mesh: &Mesh, progress: &dyn Progress) -> Result<Disc, SurfaceError> {
        let topology = Topology::watched(mesh, progress).map_err(|e| match e {
            TopologyError::Cancelled(e) => SurfaceError::from(e),
            TopologyError::Weld(_) => NotADisc::Empty.into(),
        })?;
        let edges = topology.non_manifold_edges.len();
        let vertices = topology.non_manifold_vertices.len();
        let mut used = vec![false; mesh.positions.len()];
        let counts = |(k, _): &(usize, &[u32; 3])| topology.shell_of[*k] != u32::MAX;
        let faces: Vec<[u32; 3]> =
            mesh.faces.iter().enumerate().filter(counts).map(|(_, face)| *face).collect();
        faces.iter().flatten().for_each(|v| used[*v as usize] = true);
        let fault = if faces.is_empty() {
            Some(NotADisc::Empty)
        } else if edges + vertices > 0 {
            Some(NotADisc::NotManifold { edges, vertices })
        } else if topology.shells > 1 {
            Some(NotADisc::Parts { parts: topology.shells })
        } else if !topology.inconsistent_edges.is_empty() {
            Some(NotADisc::Turned { edges: topology.inconsistent_edges.len() })
        } else if topology.boundary_edges.is_empty() {
            Some(NotADisc::Closed)
        } else {
            let unused = || used.iter().enumerate().filter(|(_, used)| !**used);
            unused().next().map(|(first, _)| NotADisc::Unused { count: unused().count(), first })
        };
        if let Some(fault) = fault {
            return Err(fault.into());
        }
        let rims = rims(mesh, &topology);
        // The characteristic of a sphere with so many holes is 2 less their number; each handle takes 2.
        let handles = (2 - rims.len() as i64 - topology.euler_characteristic()) / 2;
        if handles != 0 {
            return Err(NotADisc::Handles { handles }.into());
        }
        Ok(Disc { faces, rims })
    }
}

/// The rims, the longest first.
fn rims(mesh: &Mesh, topology: &Topology) -> Vec<Vec<u32>> {
    let mut next = std::collections::BTreeMap::new();
    topology.boundary_edges.iter().for_each(|edge| {
        next.insert(edge.vertices[0], edge.vertices[1]);
    });
    let mut rims = vec![];
    while let Some((start, mut at)) = next.pop_first() {
        let mut rim = vec![start];
        while at != start {
            rim.push(at);
            match next.remove(&at) {
                Some(further) => at = further,
                None => break,
            }
        }
        let around = rim.iter().zip(rim.iter().cycle().skip(1));
        let length: f64 =
            around.map(|(a, b)| norm(minus(mesh.positions[*a as usize], mesh.positions[*b as usize]))).sum();
        rims.push((length, rim));
    }
    rims.sort_by(|a, b| b.0.total_cmp(&a.0));
    rims.into_iter().map(|(_, rim)| rim).collect()
}
