//! Points of exact features, for tests.

use std::f64::consts::TAU;
use trueness_geom::rigid::Rigid;
use trueness_geom::space::Point;

/// Five by five places, 10 mm apart.
pub fn grid(f: impl Fn(f64, f64) -> Point) -> Vec<Point> {
    (0..25).map(|k| f(f64::from(k % 5) * 10.0, f64::from(k / 5) * 10.0)).collect()
}

/// Circles about an axis along z, their radius as a function of the number of the point around.
pub fn round(center: [f64; 2], levels: &[f64], around: usize, radius: impl Fn(usize) -> f64) -> Vec<Point> {
    let at = |k: usize, z: f64| {
        let angle = TAU * k as f64 / around as f64;
        [center[0] + radius(k) * angle.cos(), center[1] + radius(k) * angle.sin(), z]
    };
    levels.iter().flat_map(|z| (0..around).map(move |k| at(k, *z))).collect()
}

/// A motion far from where it began.
pub fn far() -> Rigid {
    let turned = Rigid::rotation_about([1.0, 2.0, 3.0], [0.7, -1.9, 0.4]);
    Rigid::translation_by([120.0, -340.0, 56.0]).after(&turned)
}
