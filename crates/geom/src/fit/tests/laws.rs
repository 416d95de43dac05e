//! Changes that must not change the answer do not; changes that must are refused by name.

use super::{Fit, FitError, Kind, Made, Method, fitted, methods, placement};
use crate::frame::Pose;
use crate::num::random::Random;
use crate::space::{Point, plus, times};

/// Distances of some places from both elements, where `image` maps the first element's world to the second's.
fn same(kind: Kind, one: &Fit, other: &Fit, scale: f64, image: impl Fn(Point) -> Point, what: &str) {
    let mut random = Random::new(3);
    for _ in 0..20 {
        let mut p: Point = std::array::from_fn(|k| placement(kind).origin[k] + 60.0 * (random.unit() - 0.5));
        if kind.is_flat() {
            p[2] = 0.0;
        }
        let (a, b) = (one.shape.distance(p).abs() * scale, other.shape.distance(image(p)).abs());
        // A zone hardly notices small motions of its element where fewer points touch than it has unknowns.
        let limit = if one.touching.is_empty() { 2e-10 } else { 1e-7 };
        assert!((a - b).abs() < limit * scale * 60.0, "{kind:?} {:?} {what}: {a} {b}", one.method);
    }
    let (a, b) = (one.residuals.form_error * scale, other.residuals.form_error);
    assert!((a - b).abs() < 1e-11 * scale * 60.0, "{kind:?} {:?} {what}: form {a} {b}", one.method);
}

#[test]
fn motion_scale_order_and_repetition_change_nothing() {
    for kind in Kind::ALL {
        let made = Made { kind, count: 90, share: 1.0, noise: 0.01, seed: 11 };
        let points = made.points();
        for method in methods(kind).filter(|&m| m != Method::Robust) {
            let first = fitted(&points, kind, method).unwrap();
            let fit_of = |points: Vec<Point>| fitted(&points, kind, method).unwrap();

            let target = if kind.is_flat() {
                Pose::flat([-400.0, 90.0, 0.0], [-0.28, 0.96, 0.0])
            } else {
                Pose::along([-400.0, 90.0, 1000.0], [-0.7, 0.2, -0.4])
            };
            let moved = |p: Point| (0..3).fold(target.origin, |q, k| plus(q, times(p[k], target.axes[k])));
            same(kind, &first, &fit_of(points.iter().map(|&p| moved(p)).collect()), 1.0, moved, "moved");

            for scale in [1e-3, 1234.5] {
                let scaled = |p: Point| times(scale, p);
                same(
                    kind,
                    &first,
                    &fit_of(points.iter().map(|&p| scaled(p)).collect()),
                    scale,
                    scaled,
                    "scaled",
                );
            }
            let reversed: Vec<Point> = points.iter().rev().copied().collect();
            same(kind, &first, &fit_of(reversed), 1.0, |p| p, "reversed");
            let twice: Vec<Point> = points.iter().chain(&points).copied().collect();
            same(kind, &first, &fit_of(twice), 1.0, |p| p, "twice");
        }
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    for (kind, method) in [
        (Kind::Cylinder, Method::Gaussian),
        (Kind::Plane, Method::MinimumZone),
        (Kind::Cone, Method::Gaussian),
        (Kind::Cylinder, Method::MaximumInscribed),
    ] {
        let points = Made { kind, count: 70_001, share: 0.7, noise: 0.02, seed: 2 }.points();
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| fitted(&points, kind, method).unwrap())
        };
        let one = on(1);
        assert_eq!(one, on(2));
        assert_eq!(one, on(5));
    }
}

#[test]
fn many_points_give_what_all_at_once_would() {
    // Blocks, thinned starts and lanes against the plain sums of a small program's way: all points, one by one.
    let made = Made { kind: Kind::Sphere, count: 40_003, share: 0.3, noise: 0.05, seed: 8 };
    let points = made.points();
    let fit = fitted(&points, Kind::Sphere, Method::Gaussian).unwrap();
    let distances: Vec<f64> = points.iter().map(|&p| fit.shape.distance(p)).collect();
    let rms = (distances.iter().map(|d| d * d).sum::<f64>() / points.len() as f64).sqrt();
    assert!((rms - fit.residuals.rms).abs() < 1e-13);
    let least = distances.iter().copied().enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
    assert_eq!(fit.residuals.min.1, least.0);
    let greatest = distances.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
    assert_eq!(fit.residuals.max.1, greatest.0);
    // At the minimum the distances do not lean any way: their sum is zero, and so are their moments.
    assert!(distances.iter().sum::<f64>().abs() / (points.len() as f64) < 1e-14);
}

#[test]
fn wrong_points_are_refused_by_name() {
    for kind in Kind::ALL {
        for method in methods(kind) {
            let good = Made { kind, count: 40, share: 1.0, noise: 0.01, seed: 4 }.points();
            let needed = kind.fewest_points();
            let few = fitted(&good[..needed - 1], kind, method);
            assert_eq!(few, Err(FitError::TooFewPoints { kind, needed, found: needed - 1 }));
            assert_eq!(fitted(&[good[0]; 20], kind, method), Err(FitError::AllEqual));
            let mut bad = good.clone();
            bad[13][1] = f64::NAN;
            assert_eq!(fitted(&bad, kind, method), Err(FitError::NotFinite { index: 13 }));
        }
        let line: Vec<Point> = (0..30).map(|k| times(0.1 * f64::from(k), [1.0, 2.0, 3.0])).collect();
        for method in [Method::Gaussian, Method::Robust] {
            let answer = fitted(&line, kind, method);
            match kind {
                Kind::Line2 | Kind::Line => assert!(answer.unwrap().residuals.rms < 1e-15),
                _ => assert_eq!(answer, Err(FitError::Collinear { kind }), "{kind:?} {method:?}"),
            }
        }
    }
    let circle = Made { kind: Kind::Circle, count: 40, share: 1.0, noise: 0.0, seed: 4 }.points();
    let kind = Kind::Sphere;
    for method in [Method::Gaussian, Method::Robust] {
        assert_eq!(fitted(&circle, kind, method), Err(FitError::Undetermined { kind }));
        let cone = fitted(&circle, Kind::Cone, method);
        assert_eq!(cone, Err(FitError::Undetermined { kind: Kind::Cone }), "{method:?}");
    }
    for (kind, method) in [(Kind::Plane, Method::MinimumCircumscribed), (Kind::Ellipse2, Method::MinimumZone)]
    {
        assert_eq!(fitted(&circle, kind, method), Err(FitError::NoSuchMethod { kind, method }));
    }
}
