//! Clouds sampled at random: contours are whole, and not joined with others.

use super::*;

/// Points of the stadium of two lines of 50 and two half circles of radius 10, at random along it.
fn scattered(count: usize, noise: f64, seed: u64) -> Vec<[f64; 2]> {
    let random = &mut Random::new(seed);
    (0..count)
        .map(|_| {
            let p = on_stadium(STADIUM * random.unit());
            [p[0] + noise * normal(random), p[1] + noise * normal(random)]
        })
        .collect()
}

/// The longest gap of random points is many times the mean, and they are one closed contour all the same, whatever
/// their number and scatter. The gap reported is longer than the longest and no longer than a quarter of the part.
#[test]
fn a_scattered_contour_is_one() {
    for (count, noise) in [
        (120, 0.0),
        (120, 0.2),
        (400, 0.02),
        (1000, 0.0),
        (1000, 0.1),
        (3000, 0.02),
        (3000, 0.3),
        (9000, 0.0),
    ] {
        for seed in 0..12 {
            let points = scattered(count, noise, 100 * seed + 7);
            let found = order(&points, None, &Silent).unwrap();
            let sizes: Vec<(usize, bool)> = found.rows.iter().map(|r| (r.numbers.len(), r.closed)).collect();
            assert_eq!(sizes, [(count, true)], "{count} {noise} {seed}: {}", found.gap);
            assert!(found.gap < 20.0 && found.wider.is_none(), "{count} {noise} {seed}: {}", found.gap);
            let ratio = found.rows[0].way / STADIUM;
            assert!((0.95..1.5).contains(&ratio), "{count} {noise} {seed}: {ratio}");
        }
    }
}

/// Segments of a scattered stadium are its lines and half circles.
#[test]
fn a_scattered_stadium_has_its_joins() {
    for seed in 0..4 {
        let points = scattered(1500, 0.01, seed + 50);
        let found = order(&points, None, &Silent).unwrap();
        let contour = ordered_contour(&points, &found.rows[0], &Options::default(), &Silent).unwrap();
        has_the_joins_of_the_stadium(&contour);
    }
}

/// Two walls 2 mm apart, three times as far as the mean gap: two contours. A gap that is given divides.
#[test]
fn scattered_walls_are_not_joined() {
    for seed in 0..12 {
        let random = &mut Random::new(900 + seed);
        let mut ring = |radius: f64, count: usize| -> Vec<[f64; 2]> {
            (0..count)
                .map(|_| {
                    let (sin, cos) = libm::sincos(std::f64::consts::TAU * random.unit());
                    [radius * cos + 0.01 * normal(random), radius * sin + 0.01 * normal(random)]
                })
                .collect()
        };
        let points = [ring(10.0, 95), ring(8.0, 75)].concat();
        let found = order(&points, None, &Silent).unwrap();
        let sizes: Vec<(usize, bool)> = found.rows.iter().map(|r| (r.numbers.len(), r.closed)).collect();
        assert_eq!(sizes, [(95, true), (75, true)], "{seed}: {}", found.gap);
        let torn = order(&points, Some(1.5), &Silent).unwrap();
        assert!(torn.rows.len() > 2 && torn.gap < found.gap, "{seed}: {torn:?}");
    }
}

/// Suspiciously many contours state the gap over which they would meet; with that gap they do.
#[test]
fn torn_contours_tell_a_wider_gap() {
    let points = scattered(2000, 0.0, 3);
    let torn = order(&points, Some(0.15), &Silent).unwrap();
    assert!(torn.rows.len() > 20, "{}", torn.rows.len());
    let wider = torn.wider.unwrap();
    assert!(order(&points, Some(wider), &Silent).unwrap().rows.len() < torn.rows.len() / 2, "{wider}");
    // Many closed contours are not suspicious.
    let rings: Vec<[f64; 2]> = (0..12)
        .flat_map(|k| {
            (0..60)
                .map(move |i| libm::sincos(f64::from(i) * std::f64::consts::TAU / 60.0))
                .map(move |(s, c)| [30.0 * f64::from(k) + 8.0 * c, 8.0 * s])
        })
        .collect();
    let found = order(&rings, None, &Silent).unwrap();
    assert!(found.rows.len() == 12 && found.rows.iter().all(|r| r.closed) && found.wider.is_none());
}

/// A rectangle sampled at random without noise has its four sides: points around a corner come in order.
#[test]
fn a_scattered_rectangle_has_four_sides() {
    for (count, noise) in [(800, 0.0), (2000, 0.0), (5000, 0.0), (5000, 0.01)] {
        let random = &mut Random::new(count);
        let at = |s: f64| match s {
            s if s < 60.0 => [s, 0.0],
            s if s < 100.0 => [60.0, s - 60.0],
            s if s < 160.0 => [160.0 - s, 40.0],
            s => [0.0, 200.0 - s],
        };
        let points: Vec<[f64; 2]> = (0..count)
            .map(|_| {
                let p = at(200.0 * random.unit());
                [p[0] + noise * normal(random), p[1] + noise * normal(random)]
            })
            .collect();
        let found = order(&points, None, &Silent).unwrap();
        let contour = ordered_contour(&points, &found.rows[0], &Options::default(), &Silent).unwrap();
        assert_eq!(kinds(&contour), [SegmentKind::Line; 4], "{count} {noise}");
        assert!((contour.length() - 200.0).abs() < 0.05, "{count} {noise}: {}", contour.length());
    }
}
