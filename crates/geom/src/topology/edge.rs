//! An edge by its ends.

/// An edge, and the lowest of the facets at it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct EdgeAt {
    /// The two ends, in the direction in which `facet` runs along the edge.
    pub vertices: [u32; 2],
    /// The lowest facet at the edge.
    pub facet: u32,
}
