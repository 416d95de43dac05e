//! The value of each curvature at a place.

use trueness_document::curvature::CurvatureKind;
use trueness_geom::spline::surface::Bend;
use trueness_surface::curvature::Curvatures;

/// The value of a curvature at a place.
pub fn value(kind: CurvatureKind, bend: &Bend) -> f64 {
    match kind {
        CurvatureKind::Mean => bend.mean,
        CurvatureKind::Gaussian => bend.gaussian,
        CurvatureKind::K1 => bend.principal[0].curvature,
        CurvatureKind::K2 => bend.principal[1].curvature,
    }
}

/// The values of all places, NaN where there is none.
pub fn values(found: &Curvatures, kind: CurvatureKind) -> Vec<f64> {
    found.places.iter().map(|p| p.as_ref().map_or(f64::NAN, |jet| value(kind, &jet.bend))).collect()
}
