//! The element that made the points is found again, from parts of it as small as 20°.

use super::{Kind, Made, Method, fitted};
use crate::fit::{Options, fit};
use crate::progress::Silent;

const KINDS: [Kind; 7] =
    [Kind::Circle2, Kind::Circle, Kind::Ellipse2, Kind::Sphere, Kind::Cylinder, Kind::Cone, Kind::Torus];

/// Share of the turn; a sphere's cap of the same half angle.
fn share(kind: Kind, degrees: f64) -> f64 {
    match kind {
        Kind::Sphere => (1.0 - (0.5 * degrees).to_radians().cos()) / 2.0,
        // Less than a quarter of an ellipse hardly differs from other ellipses.
        Kind::Ellipse2 => degrees.max(90.0) / 360.0,
        _ => degrees / 360.0,
    }
}

#[test]
fn exact_points_of_small_parts_give_the_element_back() {
    for kind in KINDS {
        for degrees in [360.0, 180.0, 90.0, 40.0, 20.0] {
            for count in [30, 2000] {
                let made = Made { kind, count, share: share(kind, degrees), noise: 0.0, seed: 77 };
                let answer = fitted(&made.points(), kind, Method::Gaussian).unwrap();
                let truth = made.shape();
                // The whole element is found, not only the part that was seen.
                let whole = Made { kind, count: 50, share: 1.0, noise: 0.0, seed: 1 }.points();
                for p in whole {
                    let d = answer.shape.distance(p);
                    assert!(d.abs() < 1e-8, "{kind:?} {degrees}° {count}: {d} {truth:?} {answer:?}");
                }
            }
        }
    }
}

#[test]
fn no_start_near_the_truth_beats_the_starts_found() {
    for kind in KINDS {
        for degrees in [360.0, 120.0, 60.0, 30.0, 20.0] {
            for seed in 0..5 {
                let made = Made { kind, count: 60, share: share(kind, degrees), noise: 0.01, seed };
                let points = made.points();
                let global = fitted(&points, kind, Method::Gaussian).unwrap();
                let near = Options { start: Some(made.shape()), ..Options::default() };
                let near = fit(&points, kind, &near, &Silent).unwrap();
                assert!(
                    global.residuals.rms <= near.residuals.rms * (1.0 + 1e-9),
                    "{kind:?} {degrees}° seed {seed}: {} {}",
                    global.residuals.rms,
                    near.residuals.rms
                );
            }
        }
    }
}
