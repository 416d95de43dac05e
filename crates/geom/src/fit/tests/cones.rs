//! Cones of every half angle from points of every pattern: a seeded generator, and how often the answer is right.

use super::{Kind, Method};
use crate::fit::{Fit, FitError, Options, fit, improved};
use crate::frame::Pose;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::shape::{Parameter, Shape};
use crate::space::{Point, cross, norm, plus, times};
use std::f64::consts::TAU;

/// How the points lie on the cone.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Pattern {
    /// The apex and one ring, as in a mesh of a pointed cone.
    Fan,
    /// The apex and several rings.
    PointedRings,
    /// Rings of a frustum.
    Rings,
    /// Points all over a full turn.
    Turn,
    /// Points all over a part of the turn, of 60° to 300°.
    Part,
    /// Points of a patch, of 20° to 60°.
    Patch,
}

pub(super) const PATTERNS: [Pattern; 6] =
    [Pattern::Fan, Pattern::PointedRings, Pattern::Rings, Pattern::Turn, Pattern::Part, Pattern::Patch];

/// Points of a cone, and the cone.
#[derive(Debug)]
pub(super) struct Case {
    pub pattern: Pattern,
    pub degrees: f64,
    pub truth: Shape,
    pub points: Vec<Point>,
    /// Standard deviation of each coordinate, with that of rounding.
    pub sigma: f64,
}

/// A number between the bounds, even in its logarithm.
fn between(random: &mut Random, low: f64, high: f64) -> f64 {
    low * (high / low).powf(random.unit())
}

fn direction(random: &mut Random) -> Point {
    let z = 2.0 * random.unit() - 1.0;
    let (sin, cos) = (TAU * random.unit()).sin_cos();
    let across = (1.0 - z * z).sqrt();
    [across * cos, across * sin, z]
}

/// The case of a seed.
pub(super) fn case(seed: u64) -> Case {
    let random = &mut Random::stream(11, seed);
    let pattern = PATTERNS[seed as usize % PATTERNS.len()];
    // As often near the cylinder and near the plane as between.
    let degrees = match random.below(3) {
        0 => between(random, 0.5, 45.0),
        1 => 90.0 - between(random, 0.3, 45.0),
        _ => 0.5 + 89.2 * random.unit(),
    };
    let half_angle = degrees.to_radians();
    let (sin, cos) = half_angle.sin_cos();
    // Distances from the apex along the generators, 1 at most.
    let least =
        if matches!(pattern, Pattern::Fan | Pattern::PointedRings) { 0.0 } else { 0.9 * random.unit() };
    let count = 12 + random.below(60) as usize;
    let chords = 6 + random.below(43) as usize;
    let rings = 2 + random.below(4) as usize;
    let turn = match pattern {
        Pattern::Part => (60.0 + 240.0 * random.unit()).to_radians(),
        Pattern::Patch => (20.0 + 40.0 * random.unit()).to_radians(),
        _ => TAU,
    };
    let ring = |at: f64| (0..chords).map(move |k| [at, TAU * k as f64 / chords as f64]);
    let even = |k: usize| least + (1.0 - least) * k as f64 / (rings - 1) as f64;
    let places: Vec<[f64; 2]> = match pattern {
        Pattern::Fan => [[0.0, 0.0]].into_iter().chain(ring(1.0)).collect(),
        Pattern::PointedRings => {
            [[0.0, 0.0]].into_iter().chain((1..rings).flat_map(|k| ring(even(k)))).collect()
        }
        Pattern::Rings => (0..rings).flat_map(|k| ring(even(k))).collect(),
        _ => (0..count).map(|_| [least + (1.0 - least) * random.unit(), turn * random.unit()]).collect(),
    };
    let size = between(random, 1e-2, 1e4);
    let far = if random.below(2) == 0 { 0.0 } else { between(random, 1.0, 1e4) };
    let noise = [0.0, 1e-5, 1e-3][random.below(3) as usize] * size;
    let pose = Pose::along(times(far * size, direction(random)), direction(random));
    let [u, v, w] = pose.axes;
    let points = places
        .into_iter()
        .map(|[r, angle]| {
            let (y, x) = angle.sin_cos();
            let rho = size * r * sin;
            let on = plus(plus(times(rho * x, u), times(rho * y, v)), times(size * r * cos, w));
            let p = plus(pose.origin, on);
            // Twelve uniform numbers less six: near enough to a normal one.
            p.map(|x| x + noise * ((0..12).map(|_| random.unit()).sum::<f64>() - 6.0))
        })
        .collect();
    let point = plus(pose.origin, times(0.5 * (1.0 + least) * size * cos, w));
    let radius = 0.5 * (1.0 + least) * size * sin;
    let truth = Shape::Cone { apex: pose.origin, direction: w, half_angle, point, radius };
    let rounding = f64::EPSILON * size * (1.0 + far);
    Case { pattern, degrees, truth, points, sigma: noise.max(rounding) }
}

fn half_angle(shape: &Shape) -> f64 {
    let Shape::Cone { half_angle, .. } = *shape else { return f64::NAN };
    half_angle
}

/// Standard uncertainty of the half angle, for points of standard deviation `sigma`.
fn uncertainty(fit: &Fit, sigma: f64) -> Option<f64> {
    let own = fit.covariance.as_ref()?.uncertainties(&fit.shape);
    let angle = own.iter().find(|u| u.0 == "half_angle")?;
    let Parameter::Number(u) = angle.1 else { return None };
    Some(u * sigma / fit.residuals.std_dev?.max(f64::MIN_POSITIVE))
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Verdict {
    Right,
    /// Refused or not converged.
    Told,
    Wrong,
    /// The points do not determine the cone: the true uncertainty of the half angle is over 3°.
    Open,
}

/// The outcome of a case, compared with the fit that starts from the truth.
pub(super) fn verdict(case: &Case, found: &Result<Fit, FitError>) -> Verdict {
    let near =
        fit(&case.points, Kind::Cone, &Options { start: Some(case.truth), ..Options::default() }, &Silent);
    let known = near.as_ref().ok().and_then(|n| uncertainty(n, case.sigma));
    let known = known.filter(|u| *u < 3f64.to_radians());
    let Ok(found) = found else { return if known.is_some() { Verdict::Told } else { Verdict::Open } };
    let Some(known) = known else { return Verdict::Open };
    let Shape::Cone { direction: found_axis, .. } = found.shape else { return Verdict::Wrong };
    let Shape::Cone { direction: axis, .. } = case.truth else { return Verdict::Wrong };
    // Its own statements count too: a fan with noise has a flat valley of cones.
    let own = found.residuals.std_dev.and_then(|s| uncertainty(found, s)).unwrap_or(0.0);
    let allowed = (5.0 * known.max(own.min(3f64.to_radians()))).max(1e-7);
    let off = (half_angle(&found.shape) - half_angle(&case.truth)).abs();
    // The direction may be uncertain where the half angle is not; a far direction is another cone.
    let turned = norm(cross(found_axis, axis));
    if off <= allowed && turned <= 0.2 {
        return Verdict::Right;
    }
    // A lower minimum than that near the truth is a right answer to the points.
    let lower = near
        .is_ok_and(|n| found.residuals.rms < 0.999 * n.residuals.rms && n.residuals.rms > 3.0 * case.sigma);
    if lower {
        return Verdict::Open;
    }
    if found.converged { Verdict::Wrong } else { Verdict::Told }
}

/// Counts of the verdicts over some seeds, and the seeds that went wrong.
fn rates(seeds: std::ops::Range<u64>, method: Method) -> ([usize; 4], Vec<String>) {
    let (mut counts, mut bad) = ([0; 4], vec![]);
    for seed in seeds {
        let case = case(seed);
        let found = fit(&case.points, Kind::Cone, &Options { method, ..Options::default() }, &Silent);
        let verdict = verdict(&case, &found);
        counts[verdict as usize] += 1;
        if matches!(verdict, Verdict::Told | Verdict::Wrong) {
            let rms = found.as_ref().map_or(f64::NAN, |f| f.residuals.rms);
            let angle = found.as_ref().map_or(f64::NAN, |f| half_angle(&f.shape).to_degrees());
            bad.push(format!(
                "{seed} {:?} {:.3}° n {} sigma {:.1e}: {verdict:?} {angle:.3}° rms {rms:.1e} {:?}",
                case.pattern,
                case.degrees,
                case.points.len(),
                case.sigma,
                found.as_ref().err()
            ));
        }
    }
    (counts, bad)
}

#[test]
fn cones_of_every_half_angle_are_found_from_every_pattern() {
    let (counts, bad) = rates(0..100, Method::Gaussian);
    assert!(bad.is_empty(), "{counts:?}\n{}", bad.join("\n"));
}

#[test]
#[ignore = "measures rates over many cones"]
fn rates_over_many_cones() {
    for method in [Method::Gaussian, Method::Robust] {
        let (counts, bad) = rates(0..if method == Method::Gaussian { 1200 } else { 240 }, method);
        println!("{method:?}: right, told, wrong, open: {counts:?}\n{}", bad.join("\n"));
    }
}

/// The apex and one ring, exact but for rounding. Distances tell of a tilt by its square only, so the half angle is sure to
/// about the root of rounding.
#[test]
fn a_fan_is_exact_though_distances_determine_it_in_second_order_only() {
    let mut random = Random::new(23);
    for k in 0..60 {
        let half_angle = (0.5 + 89.0 * random.unit()).to_radians();
        let chords = 6 + random.below(43);
        let size = between(&mut random, 1e-2, 1e4);
        let pose = Pose::along(times(3.0 * size, direction(&mut random)), direction(&mut random));
        let (sin, cos) = half_angle.sin_cos();
        let place = |[x, y, z]: Point| {
            let [u, v, w] = pose.axes;
            plus(pose.origin, plus(plus(times(size * x, u), times(size * y, v)), times(size * z, w)))
        };
        let ring = (0..chords).map(|k| {
            let (y, x) = (TAU * k as f64 / chords as f64).sin_cos();
            place([sin * x, sin * y, cos])
        });
        let points: Vec<Point> = ring.chain([pose.origin]).collect();
        let fit = fit(&points, Kind::Cone, &Options::default(), &Silent);
        let Ok(fit) = fit else { panic!("{k}: {:.3}°, {chords} chords: {fit:?}", half_angle.to_degrees()) };
        let off = (self::half_angle(&fit.shape) - half_angle).abs();
        let told = uncertainty(&fit, fit.residuals.std_dev.unwrap()).unwrap();
        assert!(
            off < 1e-8 && told < 1e-3,
            "{k}: {:.3}°, {chords} chords: off {off:.1e}, told {told:.1e}",
            half_angle.to_degrees()
        );
    }
}

/// Fans as files in single precision hold them, from the right start. No step without length leads off along the valley, and
/// the root mean square told belongs to the element returned.
#[test]
fn a_fan_in_single_precision_stays_where_it_is() {
    let mut random = Random::new(29);
    for k in 0..60 {
        let half_angle = (1.0 + 88.0 * random.unit()).to_radians();
        let (sin, cos) = half_angle.sin_cos();
        let chords = 8 + random.below(41);
        let pose = Pose::along(times(80.0, direction(&mut random)), direction(&mut random));
        let [u, v, w] = pose.axes;
        let place = |x: f64, y: f64, z: f64| {
            plus(pose.origin, times(40.0, plus(plus(times(x, u), times(y, v)), times(z, w))))
        };
        let ring = (0..chords).map(|k| {
            let (y, x) = (TAU * k as f64 / chords as f64).sin_cos();
            place(sin * x, sin * y, cos)
        });
        let points: Vec<Point> = ring.chain([pose.origin]).map(|p| p.map(|x| f64::from(x as f32))).collect();
        let start = Shape::Cone {
            apex: pose.origin,
            direction: w,
            half_angle,
            point: place(0.0, 0.0, cos),
            radius: 40.0 * sin,
        };
        let rms = |shape: &Shape| {
            (points.iter().map(|p| shape.distance(*p).powi(2)).sum::<f64>() / points.len() as f64).sqrt()
        };
        let (found, told) = improved(&points, &start).unwrap();
        let (from, to) = (rms(&start), rms(&found));
        assert!(to <= 1.01 * from && told <= 1.01 * from, "{k}: {from:e} {to:e} {told:e}");
        let options = Options { start: Some(start), ..Options::default() };
        let again = fit(&points, Kind::Cone, &options, &Silent).unwrap();
        assert!(again.residuals.rms <= 1.01 * from, "{k}: {from:e} {:e}", again.residuals.rms);
    }
}

#[test]
fn circles_determine_no_cone() {
    for chords in [6, 7, 12, 40] {
        let ring = |at: f64| {
            (0..chords)
                .map(move |k| TAU * f64::from(k) / f64::from(chords))
                .map(move |t| [3.0 * t.cos(), 3.0 * t.sin(), at])
        };
        for points in [ring(0.0).collect::<Vec<_>>(), ring(0.0).chain([[0.0; 3]]).collect()] {
            let found = fit(&points, Kind::Cone, &Options::default(), &Silent);
            assert!(
                matches!(found, Err(FitError::Undetermined { .. })),
                "{chords} chords, {} points",
                points.len()
            );
        }
    }
}
