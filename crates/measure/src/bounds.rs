//! Boxes, as all documents have them.

use trueness_document::Bounds;
use trueness_geom::space::Aabb;

/// The box of points; none of no points.
pub fn bounds(points: &Aabb) -> Option<Bounds> {
    (!points.is_empty()).then_some(Bounds { min: points.min, max: points.max })
}
