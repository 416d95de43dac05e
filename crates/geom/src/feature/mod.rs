//! Features of a measured part, found with the help of the nominal model.
//!
//! The facet nearest to a place of the nominal feature is the start; facets next to those found join them as long as they
//! keep the rules of the feature: near the nominal surface, facing as it does, within its bounds. The points of the feature
//! are the distinct vertices of the facets found. After Xu and Yang, A digital quality characterization technique for 3D
//! printing based on the STL model (in Chinese), section 3. Where they start from one facet, several starts are taken, so
//! that a hole at the middle or a gap in the scan loses nothing; and a distance from the nominal bounds planes too.

mod beside;
mod bounds;
mod covered;
mod extent;
mod found;
mod nominal;
mod rules;
mod search;
mod surface;

pub(crate) use extent::Extent;
pub use beside::{Piece, pieces_beside};
pub use covered::{covered, farthest_covered};
pub use found::Found;
pub use nominal::{FeatureError, Nearness, Nominal};
pub use search::FeatureSearch;
pub use surface::NominalSurface;

use crate::mesh::Mesh;
use crate::space::{Point, normal};
use rules::Rules;

/// The points of a cloud that belong to `nominal`: those near it and within its bounds. A cloud without normals does not
/// tell which way it faces; what lies behind a thin wall is kept apart by the distance alone.
///
/// # Errors
/// [`FeatureError`]: a nominal feature that makes no sense.
pub fn in_cloud(points: &[Point], nominal: &Nominal, near: &Nearness) -> Result<Found, FeatureError> {
    let rules = Rules::new(nominal, near)?;
    let bounds = rules.bounds();
    let is_near = |p: &Point| bounds.holds(p) && rules.point(*p);
    let points = (0..points.len() as u32).filter(|i| is_near(&points[*i as usize])).collect();
    Ok(Found { points, ..Found::default() })
}

/// Those of some facets of a mesh that are near `nominal`: their corners as near to it as that says and within its bounds, facing as it does. Facets
/// without area are none.
///
/// # Errors
/// [`FeatureError`]: a nominal feature that makes no sense.
pub fn facets_near(
    mesh: &Mesh,
    facets: &[u32],
    nominal: &Nominal,
    near: &Nearness,
) -> Result<Vec<u32>, FeatureError> {
    let rules = Rules::new(nominal, near)?;
    let bounds = rules.bounds();
    let is_near = |f: &u32| {
        let corners = mesh.faces.get(*f as usize)?.map(|v| mesh.positions.get(v as usize).copied());
        let [Some(a), Some(b), Some(c)] = corners else { return None };
        let inside = [a, b, c].iter().all(|p| bounds.holds(p));
        Some(inside && rules.facet([a, b, c], normal([a, b, c])?))
    };
    Ok(facets.iter().copied().filter(|f| is_near(f) == Some(true)).collect())
}

/// Places all over a nominal feature: of a plane those of a grid within its boundary, of what is round some on rings.
///
/// # Errors
/// [`FeatureError`]: a nominal feature that makes no sense.
pub fn places_over(nominal: &Nominal) -> Result<Vec<Point>, FeatureError> {
    let near = Nearness { distance: 0.0, angle: 0.0, margin: 0.0, rim: true, inward: None };
    Ok(Rules::new(nominal, &near)?.starts())
}
