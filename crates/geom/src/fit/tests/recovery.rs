//! The element that made the points is found again, from parts of it as small as 20°.

use super::{Kind, Made, Method, fitted};
use crate::fit::{Fit, Options, fit};
use crate::num::random::Random;
use crate::progress::Silent;
use crate::shape::Shape;
use crate::space::Point;

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

/// Few points exactly on a short piece of half a tube: the ring's radius is 3, the tube's 1. The ends of the piece are among them.
fn half_tube(count: usize, degrees: f64, seed: u64) -> Vec<Point> {
    let mut random = Random::new(seed);
    let mut share = |k: usize| match k {
        0 => [0.0, 0.0],
        1 => [1.0, 1.0],
        _ => [random.unit(), random.unit()],
    };
    (0..count)
        .map(|k| {
            let [t, a] = share(k);
            let (t, a) = (t * degrees.to_radians(), a * std::f64::consts::PI);
            let rho = 3.0 + a.cos();
            [rho * t.cos(), rho * t.sin(), a.sin()]
        })
        .collect()
}

fn assert_is_the_half_tube(answer: &Fit, what: &str) {
    let Shape::Torus { major_radius, minor_radius, .. } = answer.shape else { panic!("{what}") };
    let right = (major_radius - 3.0).abs() < 3e-6 && (minor_radius - 1.0).abs() < 1e-6;
    assert!(answer.converged && right, "{what}: {major_radius} {minor_radius} {answer:?}");
}

#[test]
fn a_torus_is_found_from_few_points_of_a_short_half_tube() {
    for degrees in [20.0, 22.0, 25.0, 30.0] {
        for seed in 0..20 {
            let points = half_tube(20, degrees, seed);
            // A robust fit tries hundreds of parts of the points.
            let methods = [Method::Gaussian, Method::MinimumZone, Method::Robust];
            for &method in &methods[..if seed < 5 { 3 } else { 2 }] {
                let answer = fitted(&points, Kind::Torus, method).unwrap();
                assert_is_the_half_tube(&answer, &format!("{degrees}° seed {seed} {}", method.name()));
            }
        }
    }
}
