//! Robust fits of points of which a third is elsewhere.

use super::{Kind, Made, Method, fitted};
use crate::num::random::Random;
use crate::space::Point;

#[test]
fn a_third_of_outliers_does_not_move_the_element() {
    for kind in Kind::ALL {
        let made = Made { kind, count: 600, share: 0.6, noise: 0.01, seed: 12 };
        let clean = made.points();
        let mut points = clean.clone();
        let mut random = Random::new(40);
        let mut moved = 0;
        for p in points.iter_mut() {
            if random.unit() < 0.33 {
                moved += 1;
                // One-sided, as burrs and neighbors of a feature are.
                for k in 0..if kind.is_flat() { 2 } else { 3 } {
                    p[k] += 1.0 + 12.0 * random.unit();
                }
            }
        }
        let robust = fitted(&points, kind, Method::Robust).unwrap();
        let truth = made.shape();
        let worst = clean.iter().fold(0.0f64, |m, &p: &Point| {
            m.max((robust.shape.distance(p).abs() - truth.distance(p).abs()).abs())
        });
        assert!(worst < 0.02, "{kind:?} {worst} {robust:?}");
        assert!(robust.outliers.abs_diff(moved) <= 25, "{kind:?} {} {moved}", robust.outliers);
        let plain = fitted(&points, kind, Method::Gaussian).unwrap();
        assert!(plain.residuals.rms > 20.0 * robust.residuals.rms, "{kind:?}");
    }
}

#[test]
fn without_outliers_it_is_nearly_least_squares() {
    let points = Made { kind: Kind::Cylinder, count: 500, share: 1.0, noise: 0.01, seed: 3 }.points();
    let robust = fitted(&points, Kind::Cylinder, Method::Robust).unwrap();
    let plain = fitted(&points, Kind::Cylinder, Method::Gaussian).unwrap();
    assert_eq!(robust.outliers, 0);
    assert!(robust.residuals.rms < 1.01 * plain.residuals.rms);
}
