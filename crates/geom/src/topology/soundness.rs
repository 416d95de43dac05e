//! Whether a mesh bounds a solid, so that inside and outside have a meaning.
//!
//! The rule: no two facets coincide; two facets meet at every edge. The facets around every vertex form one closed fan, as many
//! facets as edges, at least three. To it belongs, for signs, that neighbors run the same way round and that the facets look
//! outwards. Statistics of deviations from a mesh that breaks the rule are of doubtful worth.

use super::{EdgeAt, Properties, Topology, weld::WeldError};
use crate::mesh::Mesh;
use crate::space::Point;

/// A break of the rule and where it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flaw {
    /// No facet counts.
    Empty,
    /// An edge with one facet.
    BoundaryEdge(EdgeAt),
    /// An edge with more than two facets.
    NonManifoldEdge(EdgeAt),
    /// A vertex where several fans touch.
    NonManifoldVertex(u32),
    /// Two facets with the same corners.
    DuplicateFacets([u32; 2]),
    /// Neighbors that run in different directions.
    InconsistentEdge(EdgeAt),
    /// All facets look inwards: the volume is negative, or zero.
    Inverted,
}

impl Flaw {
    /// A vertex of the flaw, as a place to look at.
    pub fn place(&self, mesh: &Mesh) -> Option<Point> {
        let vertex = match *self {
            Flaw::BoundaryEdge(e) | Flaw::NonManifoldEdge(e) | Flaw::InconsistentEdge(e) => e.vertices[0],
            Flaw::NonManifoldVertex(v) => v,
            Flaw::DuplicateFacets([_, again]) => mesh.faces.get(again as usize)?[0],
            Flaw::Empty | Flaw::Inverted => return None,
        };
        mesh.positions.get(vertex as usize).copied()
    }
}

/// How far a mesh keeps the rule.
#[derive(Clone, Debug, PartialEq)]
pub struct Soundness {
    /// The rule is kept, all facets run the same way round and look outwards.
    pub sound: bool,
    /// There is a facet, and no boundary edge.
    pub closed: bool,
    /// No two neighbors run in different directions.
    pub consistently_oriented: bool,
    /// The signed volume is positive.
    pub outward: bool,
    /// Edges with one facet.
    pub boundary_edges: usize,
    /// Edges with more than two facets.
    pub non_manifold_edges: usize,
    /// Vertices where several fans touch.
    pub non_manifold_vertices: usize,
    /// Facets with the same corners as an earlier one.
    pub duplicate_facets: usize,
    /// Facets with a repeated vertex or with all corners on one line. They break no rule.
    pub degenerate_facets: usize,
    /// Facets with a coordinate that is not finite; they were left out.
    pub not_finite_facets: usize,
    /// Edges at which neighbors run in different directions.
    pub inconsistent_edges: usize,
    /// Parts connected through edges.
    pub shells: usize,
    /// The first flaw of each kind.
    pub first_flaws: Vec<Flaw>,
}

impl Soundness {
    /// Closed, and every edge has two facets that agree about the outside: each shell bounds a solid of its own, though
    /// shells may overlap.
    pub fn oriented(&self) -> bool {
        self.closed
            && self.consistently_oriented
            && self.non_manifold_edges == 0
            && self.duplicate_facets == 0
    }

    /// The soundness of a welded mesh; see [`Topology::of`] for errors and cost.
    ///
    /// # Errors
    /// As [`Topology::of`].
    pub fn of(mesh: &Mesh) -> Result<Soundness, WeldError> {
        let topology = Topology::of(mesh)?;
        let properties = Properties::of(mesh, &topology);
        Ok(Soundness::from_parts(&topology, &properties))
    }

    /// The same from what is known already.
    pub fn from_parts(topology: &Topology, properties: &Properties) -> Soundness {
        let t = topology;
        let not_empty = t.counting_facets > 0;
        let outward = properties.signed_volume > 0.0;
        let first_flaws: Vec<Flaw> = [
            (!not_empty).then_some(Flaw::Empty),
            t.boundary_edges.first().copied().map(Flaw::BoundaryEdge),
            t.non_manifold_edges.first().copied().map(Flaw::NonManifoldEdge),
            t.non_manifold_vertices.first().copied().map(Flaw::NonManifoldVertex),
            t.duplicate_facets.first().copied().map(Flaw::DuplicateFacets),
            t.inconsistent_edges.first().copied().map(Flaw::InconsistentEdge),
            (not_empty && t.boundary_edges.is_empty() && !outward).then_some(Flaw::Inverted),
        ]
        .into_iter()
        .flatten()
        .collect();
        Soundness {
            sound: first_flaws.is_empty(),
            closed: not_empty && t.boundary_edges.is_empty(),
            consistently_oriented: t.inconsistent_edges.is_empty(),
            outward,
            boundary_edges: t.boundary_edges.len(),
            non_manifold_edges: t.non_manifold_edges.len(),
            non_manifold_vertices: t.non_manifold_vertices.len(),
            duplicate_facets: t.duplicate_facets.len(),
            degenerate_facets: t.repeated_vertex.len() + t.collinear.len(),
            not_finite_facets: t.not_finite.len(),
            inconsistent_edges: t.inconsistent_edges.len(),
            shells: t.shells,
            first_flaws,
        }
    }
}
