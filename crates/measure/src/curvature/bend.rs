//! The curvatures of a place, as documents have them.

use trueness_document::curvature::BendRecord;
use trueness_geom::spline::surface::Bend;

/// The record of a bend.
pub fn bend_record(bend: &Bend) -> BendRecord {
    let [first, second] = bend.principal;
    BendRecord {
        normal: bend.normal,
        k1: first.curvature,
        k2: second.curvature,
        k1_direction: first.direction,
        k2_direction: second.direction,
        mean: bend.mean,
        gaussian: bend.gaussian,
    }
}
