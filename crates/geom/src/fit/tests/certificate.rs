//! Zones are certified by their touching points, and nothing random beats them.

use super::{Kind, Made, Method, fitted, methods};
use crate::fit::Options;
use crate::fit::fit;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::space::Point;

#[test]
fn touching_points_touch_and_their_multipliers_sum_to_one() {
    for kind in Kind::ALL {
        for method in methods(kind).filter(|&m| !matches!(m, Method::Gaussian | Method::Robust)) {
            let points = Made { kind, count: 3000, share: 0.9, noise: 0.02, seed: 6 }.points();
            let fit = fitted(&points, kind, method).unwrap();
            assert!(fit.converged && !fit.touching.is_empty());
            let sum: f64 = fit.touching.iter().map(|t| t.multiplier).sum();
            assert!((sum - 1.0).abs() < 1e-9, "{kind:?} {method:?} {sum}");
            let middle = match method {
                Method::MinimumZone if fit.residuals.min.0 < 0.0 => 0.5 * fit.residuals.form_error,
                Method::MinimumZone => fit.residuals.max.0,
                _ => 0.0,
            };
            for t in &fit.touching {
                assert!(t.multiplier > 0.0);
                let d = fit.shape.distance(points[t.point]);
                assert!((d - f64::from(t.side) * middle).abs() < 1e-12, "{kind:?} {method:?} {d} {middle}");
            }
            let beyond = match method {
                Method::MinimumCircumscribed => fit.residuals.max.0,
                Method::MaximumInscribed => -fit.residuals.min.0,
                _ => 0.0,
            };
            assert!(beyond < 1e-12, "{kind:?} {method:?} {beyond}");
        }
    }
}

/// The narrowest strip of a planar set is parallel to an edge of its hull: here, to some pair of points.
#[test]
fn straightness_is_that_of_all_pairs() {
    for seed in 0..20 {
        let points = Made { kind: Kind::Line2, count: 25, share: 1.0, noise: 3.0, seed }.points();
        let fit = fitted(&points, Kind::Line2, Method::MinimumZone).unwrap();
        let mut least = f64::INFINITY;
        for (i, a) in points.iter().enumerate() {
            for b in &points[..i] {
                let length = (b[0] - a[0]).hypot(b[1] - a[1]);
                let height =
                    |p: &Point| ((p[1] - a[1]) * (b[0] - a[0]) - (p[0] - a[0]) * (b[1] - a[1])) / length;
                let (low, high) =
                    points.iter().map(height).fold((0.0f64, 0.0f64), |m, h| (m.0.min(h), m.1.max(h)));
                least = least.min(high - low);
            }
        }
        assert!(
            (fit.residuals.form_error - least).abs() < 1e-12,
            "{seed} {least} {}",
            fit.residuals.form_error
        );
    }
}

#[test]
fn the_smallest_circle_is_that_of_all_pairs_and_triples() {
    for seed in 0..20 {
        let points = Made { kind: Kind::Circle2, count: 14, share: 1.0, noise: 3.0, seed }.points();
        let fit = fitted(&points, Kind::Circle2, Method::MinimumCircumscribed).unwrap();
        let crate::shape::Shape::Circle2 { radius, .. } = fit.shape else { panic!() };
        let holds = |c: [f64; 2]| points.iter().map(|p| (p[0] - c[0]).hypot(p[1] - c[1])).fold(0.0, f64::max);
        let mut least = f64::INFINITY;
        for a in &points {
            for b in &points {
                least = least.min(holds([0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]));
                for c in &points {
                    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
                    let det = 2.0 * (u[0] * v[1] - u[1] * v[0]);
                    let (uu, vv) = (u[0] * u[0] + u[1] * u[1], v[0] * v[0] + v[1] * v[1]);
                    let center = [a[0] + (v[1] * uu - u[1] * vv) / det, a[1] + (u[0] * vv - v[0] * uu) / det];
                    if det.abs() > 1e-9 {
                        least = least.min(holds(center));
                    }
                }
            }
        }
        assert!((radius - least).abs() < 1e-11, "{seed} {radius} {least}");
    }
}

#[test]
fn no_other_start_finds_a_narrower_zone() {
    for kind in [Kind::Plane, Kind::Circle2, Kind::Sphere, Kind::Cylinder, Kind::Cone] {
        for seed in 0..6 {
            let points = Made { kind, count: 50, share: 1.0, noise: 0.05, seed }.points();
            let best = fitted(&points, kind, Method::MinimumZone).unwrap();
            let mut random = Random::new(seed);
            for _ in 0..4 {
                // Points nudged by noise lead to another least-squares element to start from.
                let nudged: Vec<Point> =
                    points.iter().map(|p| p.map(|x| x + 0.2 * (random.unit() - 0.5))).collect();
                let start = fitted(&nudged, kind, Method::Gaussian).unwrap().shape;
                let options = Options { method: Method::MinimumZone, start: Some(start), seed: 0 };
                let other = fit(&points, kind, &options, &Silent).unwrap();
                assert!(other.residuals.form_error > best.residuals.form_error - 1e-9, "{kind:?} {seed}");
            }
        }
    }
}
