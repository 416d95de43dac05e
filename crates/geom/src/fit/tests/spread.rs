//! Stated uncertainties against the spread of many fits.

use super::{Kind, Made, Method, Options, fit};
use crate::progress::Silent;
use crate::shape::Shape;
use crate::space::{Point, dot, minus, plus, times};

/// Many sets of points with fresh noise: the standard deviation of every parameter over them is within a tenth of what the fits
/// state. The spread of least squares and robust fits, of whole elements and of pieces. The places stay the same, and of the
/// robust fits every tenth point lies 2 mm off.
#[test]
fn stated_uncertainties_are_the_spread_of_repeated_fits() {
    for (method, share, trials) in
        [(Method::Gaussian, 0.4, 1500), (Method::Gaussian, 1.0, 1500), (Method::Robust, 0.4, 1500)]
    {
        for kind in Kind::ALL {
            let made = Made { kind, count: 80, share, noise: 0.0, seed: 5 };
            let mut base = made.points();
            if method == Method::Robust {
                let off = |p: &mut Point| *p = [p[0] + 2.0, p[1] - 2.0, p[2]];
                base.iter_mut().skip(3).step_by(10).for_each(off);
            }
            let options = Options { method, start: Some(made.shape()), seed: 0 };
            let fits: Vec<(Vec<f64>, Vec<f64>)> =
                (0..trials).map(|seed| stated(&noisy(&base, kind, seed), kind, &options)).collect();
            let count = trials as f64;
            for k in 0..fits[0].0.len() {
                let mean = fits.iter().map(|f| f.0[k]).sum::<f64>() / count;
                let spread =
                    (fits.iter().map(|f| (f.0[k] - mean).powi(2)).sum::<f64>() / (count - 1.0)).sqrt();
                let stated = (fits.iter().map(|f| f.1[k]).sum::<f64>() / count).sqrt();
                assert!(
                    (spread - stated).abs() <= 0.1 * stated + 1e-12,
                    "{method:?} {kind:?} {share} parameter {k}: spread {spread} stated {stated}"
                );
            }
        }
    }
}

/// Noise across the surface alone, other than the stated kind. All that the surface itself determines has the stated spread all
/// the same. The station along its axis at which an element is told is no more uncertain than stated.
#[test]
fn noise_across_the_surface_alone_is_never_more_than_stated() {
    const TRIALS: u64 = 1500;
    for kind in [Kind::Line, Kind::Cylinder, Kind::Cone] {
        let made = Made { kind, count: 80, share: 0.4, noise: 0.0, seed: 5 };
        let base = made.points();
        let options = Options { method: Method::Gaussian, start: Some(made.shape()), seed: 0 };
        let axis = match made.shape() {
            Shape::Line { direction, .. }
            | Shape::Cylinder { direction, .. }
            | Shape::Cone { direction, .. } => direction,
            other => panic!("{other:?}"),
        };
        let fits: Vec<(Vec<f64>, Vec<f64>)> = (0..TRIALS)
            .map(|seed| {
                let moved = noisy(&base, kind, seed);
                // Without the part along the axis, for a cone nearly across.
                let across = |(p, q): (&Point, &Point)| {
                    let d = minus(*q, *p);
                    plus(*p, minus(d, times(dot(d, axis), axis)))
                };
                let points: Vec<Point> = base.iter().zip(&moved).map(across).collect();
                stated(&points, kind, &options)
            })
            .collect();
        let count = TRIALS as f64;
        for k in 0..fits[0].0.len() {
            let mean = fits.iter().map(|f| f.0[k]).sum::<f64>() / count;
            let spread = (fits.iter().map(|f| (f.0[k] - mean).powi(2)).sum::<f64>() / (count - 1.0)).sqrt();
            let stated = (fits.iter().map(|f| f.1[k]).sum::<f64>() / count).sqrt();
            assert!(
                spread <= 1.1 * stated + 1e-12,
                "{kind:?} parameter {k}: spread {spread} stated {stated}"
            );
        }
    }
}

/// The numbers of a fit and their stated variances.
fn stated(points: &[Point], kind: Kind, options: &Options) -> (Vec<f64>, Vec<f64>) {
    let fit = fit(points, kind, options, &Silent).unwrap();
    let covariance = fit.covariance.unwrap();
    let (numbers, count) = fit.shape.flattened();
    let variances = (0..covariance.size).map(|k| covariance.values[k * covariance.size + k].max(0.0));
    (numbers[..count].to_vec(), variances.collect())
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
