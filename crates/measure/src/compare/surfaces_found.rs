//! What is to be said of a comparison with exact surfaces.

use super::against::Exact;

/// What is to be said of a comparison with exact surfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacesFound {
    /// Number of surfaces.
    pub surfaces: usize,
    /// Points whose nearest place is not beyond doubt.
    pub uncertain: u64,
    /// How far the facets that draw them may be from the surfaces, millimeters.
    pub drawn_within: f64,
}

impl SurfacesFound {
    pub fn of(exact: Exact) -> SurfacesFound {
        let (surfaces, drawn_within) = match exact {
            Exact::Splines(search) => (search.surfaces(), search.mesh_distance()),
            Exact::Cad(faces) => (faces.faces.len(), faces.drawn_within),
        };
        SurfacesFound { surfaces, uncertain: 0, drawn_within }
    }
}
