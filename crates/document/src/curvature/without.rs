//! Why places have no curvatures.

use crate::word::words;

words! {
    /// Why a place has no curvatures.
    NoCurvature, "reason", {
        /// A coordinate is infinite or not a number.
        NotFinite = "not_finite",
        /// No facet uses the vertex.
        Unused = "unused",
        /// Facets meet there in a way that is no surface.
        NotASurface = "not_a_surface",
        /// The surface ends there.
        Boundary = "boundary",
        /// There are fewer neighbors than unknowns.
        FewNeighbors = "few_neighbors",
        /// The neighbors do not determine the value.
        Undetermined = "undetermined",
        /// The neighborhood folds over.
        Folded = "folded",
    }
}
