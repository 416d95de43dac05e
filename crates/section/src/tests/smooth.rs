//! Smooth rows of which the first partition makes many pieces.

use super::*;
use crate::model::prior::Prior;
use crate::row::contour::contour_within;
use std::sync::atomic::{AtomicUsize, Ordering};
use trueness_geom::progress::Progress;

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
                assert_eq!(kinds(&contour), [SegmentKind::Spline], "{noise} {count}");
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
        assert!(kinds(&contour).iter().all(|k| *k == SegmentKind::Spline), "{count}: {:?}", kinds(&contour));
        assert!(contour.segments.len() <= 4 && contour.noise < 1.2 * noise, "{count}: {}", contour.noise);
        let rounds = rounds.0.into_inner();
        assert!(rounds <= 12, "{count}: {rounds} rounds");
    }
}

/// A search that may take little ends with a contour along the points all the same, and says so.
#[test]
fn a_search_cut_short_says_so() {
    let random = &mut Random::new(5);
    let points: Vec<[f64; 2]> = (0..600)
        .map(|i| 0.1 * f64::from(i))
        .map(|x| [x, 3.0 * libm::sin(x / 5.0) + libm::cos(x / 1.7) + 0.002 * normal(random)])
        .collect();
    let within = |products| {
        contour_within(products, &points, &Prior::default(), &Options::default(), &Silent).unwrap()
    };
    let (whole, part) = (within(3e10), within(1e6));
    assert!(!whole.cut_short && part.cut_short);
    assert!(part.unreliable.is_empty() && part.noise < 0.1, "{}", part.noise);
    // The result of a few steps is no better than that of the whole search.
    assert!(part.noise > 0.999 * whole.noise && part.segments.len() >= whole.segments.len());
}

/// The edge of a blade between two free curves is an arc, at any noise. A search that begins with free pieces alone
/// puts their join into it and keeps it there.
#[test]
fn an_arc_between_free_curves_is_found() {
    // Curvature along the length: a wave, an arc of radius 2.2 that turns by 170 degrees, another wave.
    let turn = 170.0_f64.to_radians();
    let (first, second) = (28.0, 28.0 + 2.2 * turn);
    let curvature = |s: f64| match s {
        s if s < first => 0.02 + 0.03 * libm::sin(s / 6.0),
        s if s < second => 1.0 / 2.2,
        s => 0.01 + 0.02 * libm::sin((s - second) / 5.0),
    };
    let (mut rows, mut found) = (0, 0);
    for (n, noise) in [0.001, 0.003, 0.01].into_iter().cycle().take(9).enumerate() {
        let random = &mut Random::new(n as u64);
        let (mut at, mut heading, mut points) = ([0.0; 2], 0.0, vec![]);
        let step = 0.01;
        for k in 0..5900 {
            let s = f64::from(k) * step;
            if k % 10 == 0 {
                points.push([at[0] + noise * normal(random), at[1] + noise * normal(random)]);
            }
            let middle = heading + 0.5 * step * curvature(s);
            at = [at[0] + step * libm::cos(middle), at[1] + step * libm::sin(middle)];
            heading += step * curvature(s + 0.5 * step);
        }
        let contour = contour(&points, &Options::default(), &Silent).unwrap();
        rows += 1;
        found += usize::from(kinds(&contour) == [SegmentKind::Spline, SegmentKind::Arc, SegmentKind::Spline]);
    }
    assert!(found + 1 >= rows, "{found} of {rows}");
}
