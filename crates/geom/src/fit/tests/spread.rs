//! Stated uncertainties against the spread of many fits.

use super::{Kind, Made, Method, fitted, placement};
use crate::shape::Shape;
use crate::space::{Point, dot, minus, plus, times};

/// 600 sets of points with fresh noise: the standard deviation of each parameter over them agrees with what one
/// fit states, within the 3 % that 600 trials leave it and the noise of one fit's own residuals.
#[test]
fn stated_uncertainties_are_the_spread_of_repeated_fits() {
    const TRIALS: u64 = 600;
    for kind in Kind::ALL {
        let share = 0.4;
        let fits: Vec<(Vec<f64>, Vec<f64>)> = (0..TRIALS)
            .map(|seed| {
                // The same places each time: the seed moves the noise only.
                let base = Made { kind, count: 80, share, noise: 0.0, seed: 5 }.points();
                let points = noisy(&base, kind, seed);
                let fit = fitted(&points, kind, Method::Gaussian).unwrap();
                let covariance = fit.covariance.unwrap();
                let stated =
                    (0..covariance.size).map(|k| covariance.values[k * covariance.size + k].max(0.0));
                (
                    {
                        let (numbers, count) = at_foot_of(placement(kind).origin, &fit.shape).flattened();
                        numbers[..count].to_vec()
                    },
                    stated.collect(),
                )
            })
            .collect();
        let count = TRIALS as f64;
        for k in 0..fits[0].0.len() {
            let mean = fits.iter().map(|f| f.0[k]).sum::<f64>() / count;
            let spread = (fits.iter().map(|f| (f.0[k] - mean).powi(2)).sum::<f64>() / (count - 1.0)).sqrt();
            let stated = (fits.iter().map(|f| f.1[k]).sum::<f64>() / count).sqrt();
            assert!(
                (spread - stated).abs() <= 0.12 * stated + 1e-12,
                "{kind:?} parameter {k}: spread {spread} stated {stated}"
            );
        }
    }
}

/// The same element, its point at the foot of one place for all trials: the box of the points, at whose middle
/// it stands, changes with the noise.
fn at_foot_of(place: Point, shape: &Shape) -> Shape {
    let foot = |point: Point, w: Point| plus(point, times(dot(minus(place, point), w), w));
    match *shape {
        Shape::Line2 { point, direction } => Shape::Line2 { point: foot(point, direction), direction },
        Shape::Line { point, direction } => Shape::Line { point: foot(point, direction), direction },
        Shape::Plane { point, normal } => {
            let off = times(dot(minus(point, place), normal), normal);
            Shape::Plane { point: plus(place, off), normal }
        }
        Shape::Cylinder { point, direction, radius } => {
            Shape::Cylinder { point: foot(point, direction), direction, radius }
        }
        Shape::Cone { apex, direction, half_angle, point, .. } => {
            let point = foot(point, direction);
            let radius = dot(minus(point, apex), direction) * half_angle.tan();
            Shape::Cone { apex, direction, half_angle, point, radius }
        }
        other => other,
    }
}

/// The points with noise of standard deviation 0.01 in every direction that matters to the element.
fn noisy(points: &[crate::space::Point], kind: Kind, seed: u64) -> Vec<crate::space::Point> {
    let mut random = crate::num::random::Random::stream(99, seed);
    // Twelve uniform numbers less six: near enough to a normal one.
    let mut normal = move || 0.01 * ((0..12).map(|_| random.unit()).sum::<f64>() - 6.0);
    points
        .iter()
        .map(|p| {
            let z = if kind.is_flat() { 0.0 } else { normal() };
            [p[0] + normal(), p[1] + normal(), p[2] + z]
        })
        .collect()
}
