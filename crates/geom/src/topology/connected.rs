//! How facets hang together: edges, shells, and the places where a mesh is not a surface.

use super::connect;
use super::edge::EdgeAt;
use super::fans::{self, Fans};
use super::union::Sets;
use super::weld::{self, WeldError};
use crate::mesh::Mesh;
use crate::num::predicates;
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress, Silent};
use crate::simd::Level;

/// How the facets of a welded mesh hang together.
///
/// Facets that *count* are those with three different vertices at finite places; the others are listed apart and left
/// out of everything else. Lists of edges are sorted by the lower, then the higher vertex; other lists ascend.
#[derive(Debug)]
pub struct Topology {
    /// Number of edges.
    pub edges: usize,
    /// Number of facets that count.
    pub counting_facets: usize,
    /// Edges with one facet.
    pub boundary_edges: Vec<EdgeAt>,
    /// Edges with more than two facets.
    pub non_manifold_edges: Vec<EdgeAt>,
    /// Edges of two facets that run along them in the same direction.
    pub inconsistent_edges: Vec<EdgeAt>,
    /// Vertices whose facets are not all connected through edges at that vertex.
    pub non_manifold_vertices: Vec<u32>,
    /// Facets with the same three vertices as an earlier one, in either orientation: the first such facet, this one.
    pub duplicate_facets: Vec<[u32; 2]>,
    /// Facets that name a vertex twice.
    pub repeated_vertex: Vec<u32>,
    /// Facets with three different vertices on one line, decided exactly. They count: they are part of the surface.
    pub collinear: Vec<u32>,
    /// Facets with a coordinate that is NaN or infinite.
    pub not_finite: Vec<u32>,
    /// Number of parts connected through edges, numbered by their lowest facet.
    pub shells: usize,
    /// For each facet the number of its shell, [`u32::MAX`] where it does not count.
    pub shell_of: Vec<u32>,
    /// Vertices with more facets than [`connect::MIN_CROWDED_FACETS`].
    pub(crate) hubs: Vec<u32>,
    pub(super) fans: Fans,
}

/// Why there is no topology.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TopologyError {
    /// The faces cannot be connected.
    #[error(transparent)]
    Weld(#[from] WeldError),
    /// The work was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The reasons why a facet counts or not.
#[derive(Clone, Copy, PartialEq, Eq)]
enum FacetState {
    Fine,
    Collinear,
    Repeated,
    NotFinite,
}

impl Topology {
    /// Connects the facets of `mesh` through the vertices they share.
    ///
    /// Two vertices at one place are two vertices here. Weld first where that is not meant (an STL file always, as the readers
    /// of files do). Linear in the number of facets, but for vertices with very many facets. The result is the same for any
    /// number of threads; uses the current rayon pool and about 30 bytes a facet.
    ///
    /// # Errors
    /// [`WeldError::NoSuchVertex`], [`WeldError::TooManyFacets`].
    pub fn of(mesh: &Mesh) -> Result<Topology, WeldError> {
        Topology::with(mesh, Level::detect(), &Silent)
    }

    /// Where `progress` says that it is cancelled, some facets may be missing.
    pub(super) fn with(mesh: &Mesh, level: Level, progress: &dyn Progress) -> Result<Topology, WeldError> {
        weld::check_corners(mesh)?;
        let finite = mesh.positions.par_iter().all(|p| p.iter().all(|x| x.is_finite()));
        let shape = |f: &[u32; 3]| shape(mesh, f, finite);
        let odd: Vec<(u32, FacetState)> = (mesh.faces.par_chunks(fans::TOPOLOGY_ITEMS_PER_TASK).enumerate())
            .filter(|_| !progress.cancelled())
            .flat_map_iter(|(i, part)| {
                let first = (i * fans::TOPOLOGY_ITEMS_PER_TASK) as u32;
                let numbered = (first..).zip(part);
                numbered.map(|(i, f)| (i, shape(f))).filter(|(_, s)| *s != FacetState::Fine)
            })
            .collect();
        let of_shape =
            |wanted: FacetState| odd.iter().filter(|(_, s)| *s == wanted).map(|(i, _)| *i).collect();
        let counts = |f: &[u32; 3]| {
            f[0] != f[1] && f[1] != f[2] && f[2] != f[0] && (finite || shape(f) != FacetState::NotFinite)
        };
        let fans = Fans::new(mesh.positions.len(), &mesh.faces, counts, progress);
        let sets = Sets::new(mesh.faces.len());
        let found = connect::connect(mesh, &fans, &sets, level, progress);
        let (shells, shell_of) = sets.numbered(|i| counts(&mesh.faces[i as usize]));
        let (repeated_vertex, not_finite): (Vec<u32>, Vec<u32>) =
            (of_shape(FacetState::Repeated), of_shape(FacetState::NotFinite));
        Ok(Topology {
            edges: found.edges,
            counting_facets: mesh.faces.len() - repeated_vertex.len() - not_finite.len(),
            boundary_edges: found.boundary,
            non_manifold_edges: found.non_manifold,
            inconsistent_edges: found.inconsistent,
            non_manifold_vertices: found.non_manifold_vertices,
            duplicate_facets: found.duplicates,
            repeated_vertex,
            collinear: of_shape(FacetState::Collinear),
            not_finite,
            shells,
            shell_of,
            hubs: found.hubs,
            fans,
        })
    }

    /// As [`Topology::of`], asking `progress` whether to go on.
    ///
    /// # Errors
    /// [`TopologyError`].
    pub fn watched(mesh: &Mesh, progress: &dyn Progress) -> Result<Topology, TopologyError> {
        let topology = Topology::with(mesh, Level::detect(), progress)?;
        if progress.cancelled() { Err(Cancelled.into()) } else { Ok(topology) }
    }

    /// The topology after the vertices that no facet uses have been removed from the mesh. `None` where some facets do not count: these
    /// might use such vertices.
    pub(crate) fn compacted(&self) -> Option<Topology> {
        if self.counting_facets < self.shell_of.len() {
            return None;
        }
        let (fans, number) = self.fans.compacted();
        let new = |v: &u32| number[*v as usize];
        let edges = |of: &[EdgeAt]| -> Vec<EdgeAt> {
            of.iter().map(|e| EdgeAt { vertices: e.vertices.map(|v| new(&v)), facet: e.facet }).collect()
        };
        Some(Topology {
            edges: self.edges,
            counting_facets: self.counting_facets,
            boundary_edges: edges(&self.boundary_edges),
            non_manifold_edges: edges(&self.non_manifold_edges),
            inconsistent_edges: edges(&self.inconsistent_edges),
            non_manifold_vertices: self.non_manifold_vertices.iter().map(new).collect(),
            duplicate_facets: self.duplicate_facets.clone(),
            repeated_vertex: vec![],
            collinear: self.collinear.clone(),
            not_finite: vec![],
            shells: self.shells,
            shell_of: self.shell_of.clone(),
            hubs: self.hubs.iter().map(new).collect(),
            fans,
        })
    }

    /// The facets at `vertex` that count, ascending; none where there is no such vertex.
    pub fn facets_at_vertex(&self, vertex: u32) -> Vec<u32> {
        self.fans.facets(vertex)
    }

    /// The facets of `mesh` at the edge between two vertices that count, ascending. `mesh` is the one this was made of.
    pub fn facets_at_edge(&self, mesh: &Mesh, [a, b]: [u32; 2]) -> Vec<u32> {
        if a == b { vec![] } else { self.fans.at_edge(&mesh.faces, [a, b]) }
    }

    /// Whether a facet of `mesh` that counts has the edge between two vertices. For an edge with very many facets this is
    /// faster than to list them.
    pub fn has_edge(&self, mesh: &Mesh, [a, b]: [u32; 2]) -> bool {
        a != b && self.fans.has_edge(&mesh.faces, [a, b])
    }

    /// Number of vertices that a counting facet uses.
    pub fn used_vertices(&self) -> usize {
        self.fans.used()
    }

    /// V − E + F, over vertices that a facet uses and facets that count.
    pub fn euler_characteristic(&self) -> i64 {
        self.used_vertices() as i64 - self.edges as i64 + self.counting_facets as i64
    }
}

#[inline(always)]
fn shape(mesh: &Mesh, face: &[u32; 3], finite: bool) -> FacetState {
    let corners = face.map(|v| &mesh.positions[v as usize]);
    if !finite && corners.into_iter().flatten().any(|x| !x.is_finite()) {
        FacetState::NotFinite
    } else if face[0] == face[1] || face[1] == face[2] || face[2] == face[0] {
        FacetState::Repeated
    } else if predicates::is_flat(corners) {
        FacetState::Collinear
    } else {
        FacetState::Fine
    }
}
