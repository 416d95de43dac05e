//! Dents and bumps of a measured mesh that are deeper than the extract distance of the feature around them: no part of it, which is the
//! better for it. Without a reference its facets alone tell.

use super::reference::ELSEWHERE;
use crate::characteristic::LeftOut;
use trueness_geom::feature::{FeatureError, FeatureSearch, Found, Nearness, Nominal};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;

/// What a feature that was found in a mesh leaves out of them, up to a tenth of the size of the mesh.
pub(super) fn deeper(
    mesh: &Mesh,
    facets: &FeatureSearch,
    found: &Found,
    (nominal, near): (&Nominal, &Nearness),
    progress: &dyn Progress,
) -> Result<Option<LeftOut>, FeatureError> {
    let Some(surface) = nominal.surface() else { return Ok(None) };
    let reach = ELSEWHERE * mesh.bounds().diagonal();
    let deep = facets.deeper(found, nominal, near, reach, progress)?;
    let off = deep.iter().filter_map(|v| surface.distance(*mesh.positions.get(*v as usize)?));
    let off: Vec<f64> = off.map(|(off, _)| off.abs()).collect();
    Ok((!off.is_empty()).then(|| LeftOut::of(&off, near.distance, false)))
}
