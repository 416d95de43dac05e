//! Smooth rows of which the first partition makes many pieces.

use super::*;
use crate::progress::Progress;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Counts how often it is asked whether to stop: once for each round of the search.
#[derive(Default)]
struct Rounds(AtomicUsize);

impl Progress for Rounds {
    fn cancelled(&self) -> bool {
        self.0.fetch_add(1, Ordering::Relaxed);
        false
    }
}

/// A smooth curve is one free curve, and the rounds that find it do not grow with the number of points.
#[test]
fn smooth_curves_are_found_in_few_rounds() {
    for noise in [0.0, 0.001, 0.002] {
        for count in [250, 500, 1000] {
            let random = &mut Random::new(count as u64);
            let mut row = |at: &dyn Fn(f64) -> [f64; 2]| -> Vec<[f64; 2]> {
                (0..count)
                    .map(|i| at(f64::from(i) / f64::from(count)))
                    .map(|p| [p[0] + noise * normal(random), p[1] + noise * normal(random)])
                    .collect()
            };
            let closed = row(&|t| {
                let a = std::f64::consts::TAU * t;
                [10.0 * libm::cos(a), 6.0 * libm::sin(a) + 0.5 * libm::sin(3.0 * a)]
            });
            let wave = row(&|t| [120.0 * t, 12.0 * t * libm::cos(12.0 * t)]);
            for points in [closed, wave] {
                let rounds = Rounds::default();
                let contour = contour(&points, &Options::default(), &rounds).unwrap();
                assert_eq!(kinds(&contour), [Kind::Spline], "{noise} {count}");
                assert!(contour.noise < 1.2 * noise + 1e-4, "{noise} {count}: {}", contour.noise);
                let rounds = rounds.0.into_inner();
                assert!(rounds <= 12, "{noise} {count}: {rounds} rounds");
            }
        }
    }
}

/// A wave that no free piece of most coefficients follows is a few of them, not lines and arcs by the dozen.
#[test]
fn long_waves_are_few_free_curves() {
    let random = &mut Random::new(3);
    for (count, noise) in [(1500, 0.002), (1200, 0.002)] {
        let at = |i: usize| 60.0 * i as f64 / (count - 1) as f64;
        let points: Vec<[f64; 2]> = (0..count)
            .map(at)
            .map(|x| [x, 3.0 * libm::sin(x / 5.0) + libm::cos(x / 1.7)])
            .map(|p| [p[0] + noise * normal(random), p[1] + noise * normal(random)])
            .collect();
        let rounds = Rounds::default();
        let contour = contour(&points, &Options::default(), &rounds).unwrap();
        assert!(kinds(&contour).iter().all(|k| *k == Kind::Spline), "{count}: {:?}", kinds(&contour));
        assert!(contour.segments.len() <= 4 && contour.noise < 1.2 * noise, "{count}: {}", contour.noise);
        assert!(rounds.0.into_inner() <= 12, "{count}");
    }
}
