//! Why a mesh could not be welded.

/// Why a mesh could not be welded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum WeldError {
    /// Corners are numbered in 32 bits.
    #[error("{facets} facets are more than the {MAX_FACETS} that one mesh can hold: split the model")]
    TooManyFacets {
        /// Number of facets asked for.
        facets: usize,
    },
    /// A face names a vertex that is not there.
    #[error("facet {facet} names vertex {vertex}, but there are only {vertices} vertices")]
    NoSuchVertex {
        /// Index of the face.
        facet: usize,
        /// The number it names.
        vertex: u32,
        /// Number of positions.
        vertices: usize,
    },
}

/// Most facets whose corners can be numbered by a `u32`; one number and one more are kept free.
pub const MAX_FACETS: usize = (u32::MAX as usize - 1) / 3;
