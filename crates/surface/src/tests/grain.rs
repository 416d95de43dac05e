//! Control points for a tolerance: knot lines along a feature that runs aslant, and knots that are given back.

use super::*;
use trueness_geom::space::{dot, minus};

/// A dimple of 5 mm, and a step of 2 mm at this angle, over 100 by 100 mm.
fn step(degrees: Option<f64>) -> Vec<Point> {
    let (s, c) = degrees.unwrap_or(0.0).to_radians().sin_cos();
    let height = |x: f64, y: f64| {
        let dimple = -5.0 * (-((x - 37.0).powi(2) + (y - 61.0).powi(2)) / 8.0).exp();
        let across = ((x - 50.0) * c + (y - 50.0) * s - 6.0) / 1.5;
        dimple + degrees.map_or(0.0, |_| 1.0 + across.tanh())
    };
    (0..201 * 201)
        .map(|k| [f64::from(k / 201) / 2.0, f64::from(k % 201) / 2.0])
        .map(|[x, y]| [x, y, height(x, y)])
        .collect()
}

fn to(tolerance: f64) -> Options {
    Options { layout: Layout::Tolerance(tolerance), ..Options::default() }
}

/// The largest uniform net of no more than five times as many control points does not keep to the tolerance.
fn takes_a_fifth(points: &[Point], found: &SurfaceFit, tolerance: f64) {
    assert_eq!((found.reached, found.far_control_points), (Some(Reached::Tolerance), 0));
    assert!(found.deviations.iter().all(|d| d.abs() <= tolerance));
    let own = found.support.control_points;
    let side = ((5 * own) as f64).sqrt().floor() as usize - 3;
    let layout = Layout::Spans([side, side]);
    let uniform = fit(points, &Options { layout, corrections: 2, ..Options::default() }, &Silent).unwrap();
    let worst = uniform.deviations.iter().fold(0.0f64, |m, d| m.max(d.abs()));
    assert!(worst > tolerance, "{own} {side} {worst}");
}

#[test]
fn a_dimple_takes_a_fifth_of_a_uniform_net() {
    let points = step(None);
    let found = fit(&points, &to(0.01), &Silent).unwrap();
    takes_a_fifth(&points, &found, 0.01);
    assert_eq!(found.base.turned, 0.0);
}

#[test]
fn knot_lines_run_along_a_step() {
    for degrees in [45.0, 127.0f64] {
        let points = step(Some(degrees));
        let found = fit(&points, &to(0.01), &Silent).unwrap();
        takes_a_fifth(&points, &found, 0.01);
        // One direction of the parameters is across the step: over its length it is off by less than a tenth of its width.
        let (s, c) = degrees.to_radians().sin_cos();
        let across = [0, 1].map(|k| {
            let [x, y, _] = found.base.axes[k];
            (c * x + s * y) / x.hypot(y)
        });
        let angle = across[0].abs().min(across[1].abs()).asin().to_degrees();
        assert!(angle < 0.3, "{degrees} {angle}");
        // The first side is the longer one, and the parameters are lengths along the sides, from the first point on. At
        // the border the surface goes on by a part of a span.
        let [u, v] = found.surface.domain().map(|(from, to)| (from, to - from));
        assert!([u.0, v.0].iter().all(|from| (-5.0..=0.0).contains(from)) && u.1 >= v.1 - 5.0, "{u:?} {v:?}");
        for (point, foot) in points.iter().zip(&found.feet) {
            let own = minus(*point, found.base.origin);
            assert!((0..2).all(|k| (dot(own, found.base.axes[k]) - foot[k]).abs() < 5.0));
        }
    }
    // A step along the sides needs no other lines.
    assert_eq!(fit(&step(Some(0.0)), &to(0.05), &Silent).unwrap().base.turned, 0.0);
}

#[test]
fn knots_that_are_not_needed_are_given_back() {
    // Points of a surface over a few knots, which halving meets on its way.
    let inner = [&[16.0, 24.0, 32.0][..], &[8.0, 16.0, 40.0]];
    let knots = inner.map(|inner| Knots::clamped(3, 0.0, inner, 64.0).unwrap());
    let random = &mut Random::new(8);
    let (a, b) = (knots[0].greville(), knots[1].greville());
    let control = (0..49).map(|k| [a[k / 7], b[k % 7], 4.0 * random.unit()]).collect();
    let truth = Surface::new(knots, control).unwrap();
    let points: Vec<Point> = (0..65 * 65).map(|k| truth.at(f64::from(k / 65), f64::from(k % 65))).collect();
    let found = fit(&points, &Options { base: BaseKind::Xy, ..to(1e-6) }, &Silent).unwrap();
    assert_eq!(found.reached, Some(Reached::Tolerance));
    for (k, inner) in inner.into_iter().enumerate() {
        assert_eq!(found.surface.counts()[k], 7);
        let own = found.surface.knots()[k].distinct();
        assert!(own[1..4].iter().zip(inner).all(|(a, b)| (a - b).abs() < 1e-9), "{own:?}");
    }
}
