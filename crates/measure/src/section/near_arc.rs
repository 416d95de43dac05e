//! Curves that are nearly arcs.
//!
//! What a designer drew as an arc is a free curve on a real part: its form deviates by more than neighboring points scatter. The row alone
//! cannot tell that from a curve that was meant. So the arc is told, with how far the curve is from it.

use trueness_document::section::NearArc;
use trueness_geom::fit::{Options, fit};
use trueness_geom::progress::Silent;
use trueness_geom::shape::{Kind, Shape};
use trueness_geom::spline::curve::Curve;

/// Curves farther than this share of their length from their arc are none.
const MAX_ARC_DISTANCE_SHARE: f64 = 1e-3;
/// Angle run through, radians: a flatter curve is near to many arcs.
const MIN_ARC_ANGLE: f64 = 0.5;
/// Places of the curve that are looked at.
const CURVE_SAMPLES: usize = 200;

/// The arc of least squares through places of a curve, where all of the curve is near it.
pub(super) fn near_arc(curve: &Curve<[f64; 2]>, length: f64) -> Option<NearArc> {
    let places: Vec<[f64; 3]> = curve.sample(CURVE_SAMPLES).into_iter().map(|[x, y]| [x, y, 0.0]).collect();
    let found = fit(&places, Kind::Circle2, &Options::default(), &Silent).ok()?;
    let Shape::Circle2 { center: [x, y, _], radius } = found.shape else { return None };
    let off = |p: &[f64; 3]| libm::hypot(p[0] - x, p[1] - y) - radius;
    let max = places.iter().map(|p| off(p).abs()).fold(0.0, f64::max);
    let rms = (places.iter().map(|p| off(p) * off(p)).sum::<f64>() / places.len() as f64).sqrt();
    (max <= MAX_ARC_DISTANCE_SHARE * length && length >= MIN_ARC_ANGLE * radius).then_some(NearArc {
        center: [x, y],
        radius,
        rms,
        max,
    })
}
