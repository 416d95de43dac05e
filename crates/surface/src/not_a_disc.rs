//! Why a mesh cannot be laid into the plane.

/// Why a mesh cannot be laid into the plane.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NotADisc {
    /// No facet, or a facet that names a vertex that does not exist.
    #[error("the mesh has no facets that count")]
    Empty,
    /// It is no surface.
    #[error(
        "{edges} edges have more than two facets and {vertices} vertices several fans of them: mend the mesh with `trueness repair` first"
    )]
    NotManifold {
        /// Edges with more than two facets.
        edges: usize,
        /// Vertices whose facets do not hang together through edges.
        vertices: usize,
    },
    /// Neighboring facets look to different sides.
    #[error(
        "at {edges} edges the facets look to different sides: mend the mesh with `trueness repair --only orient` first"
    )]
    Turned {
        /// Such edges.
        edges: usize,
    },
    /// Several parts.
    #[error(
        "the mesh has {parts} parts that do not hang together: give them one by one, or remove small ones with `trueness repair --remove-islands`"
    )]
    Parts {
        /// How many.
        parts: usize,
    },
    /// No rim.
    #[error(
        "the mesh is closed, it has no rim to be laid out from: give the part of it that the surface is for"
    )]
    Closed,
    /// Handles, as a cup has.
    #[error(
        "the mesh has handles (tunnels or bridges; {handles} in all): it cannot be laid flat; cut it, or give a part without"
    )]
    Handles {
        /// How many.
        handles: i64,
    },
    /// Vertices without a facet.
    #[error(
        "{count} vertices belong to no facet, the first is {first}: they have no place on the mesh; leave them out, or take another base"
    )]
    Unused {
        /// How many.
        count: usize,
        /// The first one.
        first: usize,
    },
}
