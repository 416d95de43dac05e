//! What was measured of an edge: its rounding or chamfer, told by where it lies and how it faces alone.

use super::parted::OfFeature;
use crate::area::mesh_area;
use crate::characteristic::Others;
use trueness_geom::feature::{FeatureError, Found, Nearness, Nominal, facets_near, in_cloud};
use trueness_geom::mesh::{FacetsAround, Mesh};
use trueness_geom::scan::Scan;

/// The facets near an edge with their vertices, or the points of a cloud.
///
/// # Errors
/// [`FeatureError`]: a nominal feature that makes no sense.
pub(super) fn of(scan: &Scan, nominal: &Nominal, near: &Nearness) -> Result<OfFeature, FeatureError> {
    let found = match scan {
        Scan::Cloud(points) => in_cloud(points, nominal, near)?,
        Scan::Mesh(mesh) => {
            let all: Vec<u32> = (0..mesh.faces.len() as u32).collect();
            of_facets(mesh, facets_near(mesh, &all, nominal, near)?, near.rim)
        }
    };
    Ok(OfFeature { found, covering: None, others: Others::default(), left_out: None })
}

/// Facets with their vertices; without `rim` those that others share are told apart.
fn of_facets(mesh: &Mesh, facets: Vec<u32>, rim: bool) -> Found {
    let mut vertices: Vec<u32> = facets.iter().flat_map(|f| mesh.faces[*f as usize]).collect();
    vertices.sort_unstable();
    vertices.dedup();
    let area = mesh_area(mesh, &facets);
    let around = (!rim).then(|| FacetsAround::new(mesh));
    let is_shared =
        |v: &u32| around.as_ref().is_some_and(|a| a.of(*v).iter().any(|f| facets.binary_search(f).is_err()));
    let (rim, points) = vertices.into_iter().partition(is_shared);
    Found { facets, points, rim, area }
}
