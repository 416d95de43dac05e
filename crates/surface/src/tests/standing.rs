//! Points that stand on edge on their base.

use super::super::{BaseKind, Layout, Options, SurfaceFit, fit};
use super::{pass, scan, spans};
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::space::Point;

fn over_plane(points: &[Point]) -> SurfaceFit {
    fit(points, &Options { base: BaseKind::Plane, ..spans(8) }, &Silent).unwrap()
}

/// A strip of 100 × 0.5 mm whose ripples are larger than its width stands on edge on its least-squares plane. It is
/// fitted over the plane that it lies in.
#[test]
fn a_strip_is_fitted_flat() {
    let random = &mut Random::new(5);
    let height = |x: f64, y: f64| 0.3 * (x / 7.0).sin() + 0.2 * (y / 5.0).cos();
    let place = |random: &mut Random| [100.0 * random.unit(), 0.5 * random.unit()];
    let points: Vec<Point> = (0..3000).map(|_| place(random)).map(|[x, y]| [x, y, height(x, y)]).collect();
    let found = over_plane(&points);
    assert!(found.base.tilted > 1.5 && found.base.standing_share == 0.0, "{:?}", found.base);
    assert!(found.base.axes[2][2].abs() > 0.999);
    // Eight cubic spans over the seven half waves of the ripple leave some micrometers.
    for _ in 0..500 {
        let [x, y] = place(random);
        let foot = trueness_geom::spline::surface::FootSearch::new(&[found.surface.clone().into()], &Silent);
        let off = foot.unwrap().nearest(&[x, y, height(x, y)]).foot.distance;
        assert!(off < 0.03, "{x} {y}: {off}");
    }
}

/// A low fence around a yard stands on edge on every plane; a cylinder's bottom does on the cylinder. Noise wider than the distance of
/// neighbors, lines of a scanner and steps do not.
#[test]
fn what_stands_on_edge_is_told() {
    let random = &mut Random::new(6);
    let mut fence = |high: f64, noise: f64| -> Vec<Point> {
        let wall = |random: &mut Random| {
            let (angle, r) = (std::f64::consts::TAU * random.unit(), 50.0 + noise * (random.unit() - 0.5));
            [r * angle.cos(), r * angle.sin(), high * random.unit()]
        };
        (0..6000).map(|_| wall(random)).collect()
    };
    assert!(over_plane(&fence(10.0, 0.0)).base.standing_share > 0.99);
    for noise in [0.1, 0.2, 0.5, 1.0] {
        let base = over_plane(&fence(10.0, noise)).base;
        assert!(base.standing_share > 0.5 && base.tilted == 0.0, "{noise}: {base:?}");
    }
    let cylinder = Options { base: BaseKind::Cylinder, ..spans(8) };
    assert_eq!(fit(&fence(30.0, 0.1), &cylinder, &Silent).unwrap().base.standing_share, 0.0);
    // A tin with a tenth of its points on its bottom.
    let mut tin = fence(30.0, 0.0);
    let disk = |k: f64| {
        [50.0 * (k / 600.0).sqrt() * (2.4 * k).cos(), 50.0 * (k / 600.0).sqrt() * (2.4 * k).sin(), 0.0]
    };
    tin.extend((0..600).map(|k| disk(f64::from(k))));
    let share = fit(&tin, &cylinder, &Silent).unwrap().base.standing_share;
    assert!(share > 0.05 && share < 0.12, "{share}");
    for noise in [0.1, 1.0, 5.0] {
        let found = over_plane(&scan(20_000, noise, 3));
        assert!(found.base.standing_share < 0.05 && found.base.tilted == 0.0, "{noise}: {:?}", found.base);
    }
    let line = |k: u32| [f64::from(k / 20) * 0.05, f64::from(k % 20) * 5.0];
    let lines: Vec<Point> =
        (0..40_000).map(line).map(|[x, y]| [x, y, 2.0 * (x / 7.0).sin() + 0.01 * y]).collect();
    let step: Vec<Point> = scan(6000, 0.0, 4)
        .into_iter()
        .map(|[x, y, z]| [x, y, z + if x + y > 90.0 { 20.0 } else { 0.0 }])
        .collect();
    for points in [lines, step] {
        let found = over_plane(&points);
        assert!(found.base.standing_share < 0.02 && found.base.tilted == 0.0, "{:?}", found.base);
    }
}

/// A strip with waves steeper than 80 degrees, seen from above: most of it stands on edge, and so does the surface there.
#[test]
fn walls_that_the_surface_follows_are_no_doubt() {
    let random = &mut Random::new(8);
    let points: Vec<Point> = (0..20_000)
        .map(|_| [60.0 * random.unit(), 3.0 * random.unit()])
        .map(|[x, y]| [x, y, 40.0 * (x / 4.0).sin()])
        .collect();
    let options = Options { base: BaseKind::Xy, layout: Layout::Spans([80, 2]), ..Options::default() };
    let found = fit(&points, &options, &Silent).unwrap();
    assert!(found.base.standing_share < 0.05, "{:?}", found.base);
    assert!(found.deviations.iter().all(|d| d.abs() < 0.05));
}

/// Ten rows of a scanner, whose points scatter: the corrected surface stays between them where the first fit was.
#[test]
fn rows_of_a_scanner_are_joined_smoothly() {
    let height = |x: f64, y: f64| 5.0 * (x / 15.0).sin() + y * y / 400.0;
    for seed in [0, 3, 4] {
        let random = &mut Random::new(seed);
        let mut noise = || 0.02 * ((0..12).map(|_| random.unit()).sum::<f64>() - 6.0);
        let place = |k: u32| [0.2 * f64::from(k % 500), 5.0 * f64::from(k / 500)];
        let points: Vec<Point> = (0..5000).map(place).map(|[x, y]| [x, y, height(x, y) + noise()]).collect();
        let options = Options { layout: Layout::Spans([16, 8]), ..Options::default() };
        let found = fit(&points, &options, &Silent).unwrap();
        let search =
            trueness_geom::spline::surface::FootSearch::new(&[found.surface.clone().into()], &Silent)
                .unwrap();
        for k in 0..900 {
            let (x, y) = (1.0 + 3.3 * f64::from(k % 30), 1.5 * f64::from(k / 30) + 0.7);
            let off = search.nearest(&[x, y, height(x, y)]).foot.distance;
            assert!(off < 0.1, "{seed}: {off} at {x} {y}");
        }
    }
}

/// Franke's function 300 mm high over 100 mm: an eighth of it is steeper than 80°, and it has one height everywhere.
#[test]
fn the_steepest_ground_is_seen_from_above() {
    let points: Vec<Point> = scan(20_000, 0.0, 3).iter().map(|p| [p[0], p[1], 30.0 * p[2]]).collect();
    let found = fit(&points, &Options { base: BaseKind::Plane, ..spans(30) }, &Silent).unwrap();
    assert!(found.base.folded_share == 0.0 && found.base.axes[2][2] > 0.99, "{:?}", found.base);
    assert!(found.far_control_points == 0 && !found.base.is_on_edge());
    let rms = pass::rms(&found.deviations);
    assert!(rms < 0.1, "{rms}");
}

/// A few points far off are no layer, a thin second layer is one.
#[test]
fn outliers_are_no_layer() {
    let random = &mut Random::new(8);
    let mut off = |share: f64, high: f64, spread: f64| -> f64 {
        let mut points = scan(20_000, 0.01, 4);
        for p in &mut points {
            if random.unit() < share {
                p[2] += high + spread * (random.unit() - 0.5);
            }
        }
        over_plane(&points).base.folded_share
    };
    let [outliers, spikes] = [off(0.05, 0.0, 100.0), off(0.02, 20.0, 0.0)];
    assert!(outliers < 0.01 && spikes < 0.01, "{outliers} {spikes}");
    let [half, thin] = [off(0.5, 20.0, 0.0), off(0.1, 20.0, 0.0)];
    assert!(half > 0.85 && thin > 0.02, "{half} {thin}");
}
