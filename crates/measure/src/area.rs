//! Areas of facets.

use trueness_geom::mesh::Mesh;
use trueness_geom::space::{cross, minus, norm};

/// The area of some facets of a mesh, mm².
pub(crate) fn mesh_area(mesh: &Mesh, facets: &[u32]) -> f64 {
    let area = |f: &u32| {
        let [a, b, c] = mesh.corners(*f);
        0.5 * norm(cross(minus(b, a), minus(c, a)))
    };
    facets.iter().map(area).sum()
}
