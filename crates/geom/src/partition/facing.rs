//! How the vertices of a mesh face.

use crate::mesh::{FacetsAround, Mesh};
use crate::parallel::prelude::*;
use crate::space::{Vector, cross, dot, minus, norm, normal, plus, times, unit};

/// Cosine of the angle (85°) up to which a facet may be steep in its face, such as the side of a dent. Walls that were drawn
/// stand at right angles.
const STEEP_FACET_COSINE: f64 = 0.087;

/// How the vertices of a mesh face.
pub(super) struct Facing {
    /// Unit normals of the facets, zero of those without area.
    pub facets: Vec<Vector>,
    /// Unit normals of the vertices, by the areas of their facets; zero where there is none.
    pub vertices: Vec<Vector>,
    around: FacetsAround,
}

impl Facing {
    pub(super) fn new(scan: &Mesh) -> Facing {
        let around = FacetsAround::new(scan);
        let corners = |f: &[u32; 3]| scan.places(f);
        let facets: Vec<Vector> =
            scan.faces.par_iter().map(|f| normal(corners(f)).unwrap_or_default()).collect();
        let area = |f: u32| {
            let [a, b, c] = corners(&scan.faces[f as usize]);
            norm(cross(minus(b, a), minus(c, a)))
        };
        let vertex = |v: u32| {
            let sum =
                around.of(v).iter().fold([0.0; 3], |sum, f| plus(sum, times(area(*f), facets[*f as usize])));
            unit(sum).map_or([0.0; 3], |n| n.0)
        };
        let vertices = (0..scan.positions.len() as u32).into_par_iter().map(vertex).collect();
        Facing { facets, vertices, around }
    }

    /// The facets about a vertex.
    pub(super) fn about(&self, vertex: u32) -> &[u32] {
        self.around.of(vertex)
    }

    /// Whether a facet is no wall of a face with this normal.
    pub(super) fn is_along(&self, facet: u32, normal: Vector) -> bool {
        dot(self.facets[facet as usize], normal) > STEEP_FACET_COSINE
    }

    /// Whether a vertex may be of a face with this normal: one of its facets is no wall of it. At an edge its own normal is that of neither face.
    pub(super) fn may_be_of(&self, vertex: u32, normal: Vector) -> bool {
        self.around.of(vertex).iter().any(|facet| self.is_along(*facet, normal))
    }
}
