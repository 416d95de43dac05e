//! Points in rows that lie far apart for the knots: the surface does not billow between them.

use super::super::{Layout, Options, fit};
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::space::Point;
use trueness_geom::spline::surface::FootSearch;

const NOISE: f64 = 0.1;

fn height(x: f64, y: f64) -> f64 {
    5.0 * libm::sin(x / 15.0) + y * y / 400.0
}

/// Points a tenth of a millimeter apart on rows `apart` from each other, within 100 by 100 mm; without a disk of this
/// radius. A share of them has a wrong height.
fn rows(apart: f64, degrees: f64, hole: f64, wrong: f64, seed: u64) -> Vec<Point> {
    let random = &mut Random::new(seed);
    let (s, c) = (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians()));
    let (phase, mut points) = (random.unit(), vec![]);
    for row in -50..50 {
        for n in -1500..1500 {
            let (across, along) = (apart * (f64::from(row) + phase), 0.1 * (f64::from(n) + random.unit()));
            let [x, y] = [c * along - s * across, s * along + c * across];
            if [x, y].iter().any(|x| !(0.0..=100.0).contains(x)) || libm::hypot(x - 55.0, y - 40.0) < hole {
                continue;
            }
            let noise = NOISE * ((0..12).map(|_| random.unit()).sum::<f64>() - 6.0);
            let off = if random.unit() < wrong { 2.0 + 5.0 * random.unit() } else { 0.0 };
            points.push([x, y, height(x, y) + noise + off]);
        }
    }
    points
}

/// Cells are 5 mm wide. Between the rows the surface is within twice the noise, where it was 25 to 45 times that.
#[test]
fn rows_far_apart_are_joined_smoothly() {
    let cases = [(5.0, 0.0, 0.0), (7.0, 0.0, 18.0), (10.0, 17.0, 0.0), (10.0, 45.0, 0.0)];
    for (n, (apart, degrees, hole)) in cases.into_iter().enumerate() {
        let points = rows(apart, degrees, hole, 0.0, n as u64);
        let layout = Layout::Spans([20, 20]);
        let found = fit(&points, &Options { layout, ..Options::default() }, &Silent).unwrap();
        let search = FootSearch::new(&[found.surface.clone().into()], &Silent).unwrap();
        for k in 0..625 {
            let [x, y] = [k / 25, k % 25].map(|k| 14.0 + 3.0 * f64::from(k));
            if libm::hypot(x - 55.0, y - 40.0) < hole + apart && hole > 0.0 {
                continue;
            }
            let off = search.nearest(&[x, y, height(x, y)]).foot.distance;
            assert!(off < 2.0 * NOISE, "{n}: {off} at {x} {y}");
        }
    }
}

/// Neighbors lie on one row; the outliers among them are those points of which the height is wrong, and no others.
#[test]
fn outliers_in_rows_are_left_out() {
    for seed in 0..4 {
        let points = rows(7.0, 17.0, 18.0, 0.03, seed);
        let is_wrong = |p: &Point| p[2] - height(p[0], p[1]) > 1.0;
        let wrong: Vec<u32> = (0..).zip(&points).filter(|(_, p)| is_wrong(p)).map(|(i, _)| i).collect();
        let layout = Layout::Spans([20, 20]);
        let robust =
            fit(&points, &Options { layout: layout.clone(), robust: true, ..Options::default() }, &Silent)
                .unwrap();
        assert_eq!(robust.left_out, wrong);
        let right: Vec<Point> = points.iter().filter(|p| !is_wrong(p)).copied().collect();
        let plain = fit(&right, &Options { layout, ..Options::default() }, &Silent).unwrap();
        assert_eq!(robust.surface, plain.surface);
    }
}
