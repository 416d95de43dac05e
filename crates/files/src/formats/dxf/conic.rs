//! Parts of ellipses as rational curves.

use super::groups::FILE_ROUNDING;
use crate::content::drawing::Drawn;
use crate::error::Fault;
use crate::formats::spline::{Raw, curve};
use std::f64::consts::FRAC_PI_2;

/// The places `center + cos a · u + sin a · v` over a sweep of the angle `a`. Each quarter is a curve of degree 2, exactly.
pub(super) fn conic(
    center: [f64; 2],
    [u, v]: [[f64; 2]; 2],
    from: f64,
    sweep: f64,
) -> Result<Vec<Drawn>, Fault> {
    let pieces = (sweep.abs() / FRAC_PI_2 - FILE_ROUNDING).ceil().max(1.0);
    let half = 0.5 * sweep / pieces;
    let place = |angle: f64, out: f64| {
        let (sin, cos) = libm::sincos(angle);
        let on = |k: usize| center[k] + out * (cos * u[k] + sin * v[k]);
        [on(0), on(1), 0.0]
    };
    let piece = |i: u32| {
        let middle = from + half * (2.0 * f64::from(i) + 1.0);
        let cos = libm::cos(half);
        let raw = Raw {
            degree: vec![2],
            knots: vec![vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0]],
            counts: vec![3],
            points: vec![place(middle - half, 1.0), place(middle, 1.0 / cos), place(middle + half, 1.0)],
            weights: vec![1.0, cos, 1.0],
        };
        Ok(Drawn::Spline(curve(raw)?))
    };
    (0..pieces as u32).map(piece).collect()
}
