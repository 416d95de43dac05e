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
mod found;
mod nominal;
mod rules;
mod search;
mod surface;

pub use beside::{Piece, pieces_beside};
pub use covered::{covered, farthest_covered};
pub use found::Found;
pub use nominal::{FeatureError, Nearness, Nominal};
pub use search::FeatureSearch;
pub use surface::NominalSurface;

use crate::space::Point;
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
