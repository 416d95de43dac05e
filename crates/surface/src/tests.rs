//! Fits against reference coefficients, closed forms, and things that must not happen.

mod grain;
mod holes;
mod nearest;
mod outline;
mod references;
mod rows;
mod standing;

use super::*;
use std::f64::consts::PI;
use trueness_geom::num::random::Random;
use trueness_geom::progress::{Cancelled, Silent};
use trueness_geom::shape::{Kind, Shape};
use trueness_geom::space::{dot, minus, norm};
use trueness_geom::spline::surface::Surface;

fn franke(x: f64, y: f64) -> f64 {
    let square = |a: f64, b: f64| (9.0 * x - a) * (9.0 * x - a) / b + (9.0 * y - 2.0) * (9.0 * y - 2.0) / 4.0;
    0.75 * (-square(2.0, 4.0)).exp()
        + 0.75 * (-(9.0 * x + 1.0) * (9.0 * x + 1.0) / 49.0 - (9.0 * y + 1.0) / 10.0).exp()
        + 0.5 * (-((9.0 * x - 7.0) * (9.0 * x - 7.0) + (9.0 * y - 3.0) * (9.0 * y - 3.0)) / 4.0).exp()
        - 0.2 * (-(9.0 * x - 4.0) * (9.0 * x - 4.0) - (9.0 * y - 7.0) * (9.0 * y - 7.0)).exp()
}

/// Franke's function over 100 mm, 10 mm high, with normal noise.
fn scan(count: usize, noise: f64, seed: u64) -> Vec<Point> {
    let random = &mut Random::new(seed);
    (0..count)
        .map(|_| {
            let (x, y) = (random.unit(), random.unit());
            let normal = (-2.0 * (1.0 - random.unit()).ln()).sqrt() * (2.0 * PI * random.unit()).cos();
            [100.0 * x, 100.0 * y, 10.0 * franke(x, y) + noise * normal]
        })
        .collect()
}

fn spans(n: usize) -> Options {
    Options { layout: Layout::Spans([n, n]), base: BaseKind::Xy, ..Options::default() }
}

#[test]
fn nine_points_have_the_surface_of_the_paper() {
    let points: Vec<Point> = (0..9)
        .map(|k| [f64::from(1 + k / 3), f64::from(1 + k % 3), if k == 4 { 0.3 } else { 0.0 }])
        .collect();
    for base in [BaseKind::Plane, BaseKind::Xy] {
        let options = Options {
            degree: [2, 2],
            layout: Layout::Spans([1, 1]),
            fairness: Fairness::Weight(0.0),
            base,
            ..Options::default()
        };
        let found = fit(&points, &options, &Silent).unwrap();
        for (k, (control, point)) in found.surface.points().iter().zip(&points).enumerate() {
            let expected = if k == 4 { [2.0, 2.0, 1.2] } else { *point };
            assert!(norm(trueness_geom::space::minus(*control, expected)) < 1e-12, "{k}: {control:?}");
        }
        let [(u0, u1), (v0, v1)] = found.surface.domain();
        let bend = found.surface.bend(0.5 * (u0 + u1), 0.5 * (v0 + v1)).unwrap();
        assert!((bend.mean.abs() - 0.6).abs() < 1e-12 && (bend.gaussian - 0.36).abs() < 1e-12);
        assert!(bend.principal.iter().all(|p| (p.curvature.abs() - 0.6).abs() < 1e-10));
        assert!(found.deviations.iter().all(|d| d.abs() < 1e-13));
    }
}

#[test]
fn the_rectangle_is_the_least_one_of_all_angles() {
    let random = &mut Random::new(4);
    for count in [3, 4, 7, 40] {
        for _ in 0..20 {
            let points: Vec<[f64; 2]> = (0..count).map(|_| [3.0 * random.unit(), random.unit()]).collect();
            let found = minimum_rectangle(&points).unwrap();
            let area = |angle: f64| {
                let (s, c) = angle.sin_cos();
                let along = |f: &dyn Fn(&[f64; 2]) -> f64| {
                    let (a, b) =
                        points.iter().map(f).fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
                    b - a
                };
                along(&|p| c * p[0] + s * p[1]) * along(&|p| c * p[1] - s * p[0])
            };
            let least = (0..20_000).map(|k| area(f64::from(k) * PI / 40_000.0)).fold(f64::MAX, f64::min);
            let own = found.sides[0] * found.sides[1];
            assert!(own <= least * (1.0 + 1e-12) && own > least * 0.99, "{own} {least}");
            assert!(found.sides[0] >= found.sides[1] * (1.0 - 1e-12));
            // It holds all points.
            let [a, b] = found.along;
            for p in &points {
                let d = [p[0] - found.corner[0], p[1] - found.corner[1]];
                let own = [a * d[0] + b * d[1], a * d[1] - b * d[0]];
                assert!((0..2).all(|k| own[k] > -1e-12 && own[k] < found.sides[k] + 1e-12));
            }
        }
    }
    assert!(minimum_rectangle(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]).is_none());
    assert!(minimum_rectangle(&[[1.0, 1.0]; 5]).is_none());
}

#[test]
fn a_surface_of_the_space_is_found_again_and_the_same_on_any_threads() {
    // Points on a spline surface of the same knots: the control points come back.
    let knots = [Knots::uniform(3, 7, 0.0, 50.0), Knots::uniform(2, 5, 0.0, 30.0)];
    let random = &mut Random::new(6);
    let (m, n) = (knots[0].count(), knots[1].count());
    let (a, b) = (knots[0].greville(), knots[1].greville());
    let control = (0..m * n).map(|k| [a[k / n], b[k % n], 5.0 * random.unit()]).collect();
    let truth = Surface::new(knots.clone(), control).unwrap();
    let points: Vec<Point> =
        (0..4000).map(|_| truth.at(50.0 * random.unit(), 30.0 * random.unit())).collect();
    let options = Options {
        layout: Layout::Knots(knots),
        base: BaseKind::Xy,
        fairness: Fairness::Weight(0.0),
        ..Options::default()
    };
    let found = fit(&points, &options, &Silent).unwrap();
    for (a, b) in found.surface.points().iter().zip(truth.points()) {
        assert!(norm(trueness_geom::space::minus(*a, *b)) < 1e-10);
    }
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| fit(&scan(20_000, 0.01, 3), &spans(20), &Silent).unwrap())
    };
    let (one, many) = (on(1), on(4));
    assert_eq!(one.surface, many.surface);
    assert_eq!((one.deviations, one.fairness), (many.deviations, many.fairness));
}

#[test]
fn the_thin_plate_term_is_the_integral() {
    // Energy of a surface by a fine sum, against the matrix.
    let knots = [Knots::clamped(3, 0.0, &[1.0, 1.5], 4.0).unwrap(), Knots::uniform(2, 3, 0.0, 3.0)];
    let random = &mut Random::new(2);
    let count = knots[0].count() * knots[1].count();
    let control: Vec<Point> = (0..count).map(|_| [random.unit(), random.unit(), random.unit()]).collect();
    let surface = Surface::new(knots.clone(), control.clone()).unwrap();
    let spans = [
        trueness_geom::spline::spans::Spans::new(&knots[0]),
        trueness_geom::spline::spans::Spans::new(&knots[1]),
    ];
    let energy = energy::thin_plate(&spans, [knots[0].count(), knots[1].count()]);
    let bent = energy.times(&control);
    let own: f64 = bent.iter().flatten().zip(control.iter().flatten()).map(|(a, b)| a * b).sum();
    let (steps, mut sum) = (600, 0.0);
    for i in 0..steps {
        for j in 0..steps {
            let at = |k: i32, to: f64| to * (f64::from(k) + 0.5) / f64::from(steps);
            let d = surface.derivatives(at(i, 4.0), at(j, 3.0), 2);
            let square = |v: Point| norm(v) * norm(v);
            sum += square(d[2][0]) + 2.0 * square(d[1][1]) + square(d[0][2]);
        }
    }
    sum *= 12.0 / f64::from(steps * steps);
    assert!((own - sum).abs() < 1e-4 * sum, "{own} {sum}");
}

#[test]
fn automatic_fairness_leaves_the_noise_out() {
    let (noise, points) = (0.1, scan(4_000, 0.1, 7));
    let found = fit(&points, &spans(30), &Silent).unwrap();
    let wild = fit(&points, &Options { fairness: Fairness::Weight(0.0), ..spans(30) }, &Silent).unwrap();
    let error = |f: &SurfaceFit| {
        let mut sum = 0.0;
        for i in 1..60 {
            for j in 1..60 {
                let (x, y) = (f64::from(i) / 60.0, f64::from(j) / 60.0);
                let [(a, b), (c, d)] = f.surface.domain();
                let z = f.surface.at((100.0 * x).clamp(a, b), (100.0 * y).clamp(c, d))[2];
                sum += (z - 10.0 * franke(x, y)).powi(2);
            }
        }
        (sum / 3481.0f64).sqrt()
    };
    assert!(error(&found) < 0.35 * noise, "{}", error(&found));
    assert!(error(&found) < 0.6 * error(&wild), "{} {}", error(&found), error(&wild));
    let dof = found.degrees_of_freedom.unwrap();
    assert!(dof > 30.0 && dof < 600.0, "{dof}");
    // The residual is the noise itself.
    let rms = (found.sum_of_squares / (4000.0 - dof)).sqrt();
    assert!((rms - noise).abs() < 0.05 * noise, "{rms}");
    assert!(wild.degrees_of_freedom.is_none());
}

#[test]
fn holes_and_l_shapes_keep_their_control_points_near() {
    let outline = |keep: &dyn Fn(f64, f64) -> bool| -> Vec<Point> {
        scan(6_000, 0.01, 9).into_iter().filter(|p| keep(p[0], p[1])).collect()
    };
    let hole = outline(&|x, y| (x - 50.0).hypot(y - 50.0) > 25.0);
    let ell = outline(&|x, y| x < 40.0 || y < 40.0);
    for (points, least) in [(hole, 0.05), (ell, 0.25)] {
        let found = fit(&points, &spans(25), &Silent).unwrap();
        let support = found.support;
        let share = support.unsupported as f64 / support.control_points as f64;
        assert!(share > least && share < 0.5, "{share}");
        assert!(support.empty_cells > 0);
        assert_eq!(found.far_control_points, 0);
        assert!(found.sum_of_squares / (points.len() as f64) < 0.02 * 0.02, "{}", found.sum_of_squares);
        let refused = fit(&points, &Options { fairness: Fairness::Weight(0.0), ..spans(25) }, &Silent);
        assert!(
            matches!(refused, Err(SurfaceError::Undetermined { unsupported, .. }) if unsupported > 0),
            "{:?}",
            refused.map(|f| f.far_control_points)
        );
    }
}

#[test]
fn points_that_determine_nothing_are_refused() {
    let line: Vec<Point> = (0..50).map(|k| [f64::from(k), 2.0 * f64::from(k), 3.0]).collect();
    for base in [BaseKind::Plane, BaseKind::Xy] {
        assert_eq!(
            fit(&line, &Options { base, ..Options::default() }, &Silent).unwrap_err(),
            SurfaceError::Line
        );
    }
    let few: Vec<Point> = [0.0, 1.0, 2.0, 3.0, 5.0].map(|x| [x; 3]).to_vec();
    assert_eq!(fit(&few, &Options::default(), &Silent).unwrap_err(), SurfaceError::Line);
    let same = vec![[1.0, 2.0, 3.0]; 20];
    assert_eq!(fit(&same, &Options::default(), &Silent).unwrap_err(), SurfaceError::Line);
    let mut points = scan(100, 0.0, 1);
    assert_eq!(
        fit(&points[..3], &Options::default(), &Silent).unwrap_err(),
        SurfaceError::TooFewPoints { found: 3 }
    );
    // Fewer points than control points: refused without a thin plate, bounded with one.
    let strict = Options { fairness: Fairness::Weight(0.0), ..spans(20) };
    assert!(matches!(
        fit(&points, &strict, &Silent),
        Err(SurfaceError::Undetermined { total: 529, points: 100, .. })
    ));
    let found = fit(&points, &spans(20), &Silent).unwrap();
    assert!(found.degrees_of_freedom.unwrap() < 100.0 / 1.4);
    assert_eq!(found.far_control_points, 0);
    // Every point twice is the same surface.
    let twice: Vec<Point> = points.iter().chain(&points).copied().collect();
    let weight = Options { fairness: Fairness::Weight(1.0), ..spans(5) };
    let doubled = Options { fairness: Fairness::Weight(2.0), ..spans(5) };
    let (a, b) = (fit(&points, &weight, &Silent).unwrap(), fit(&twice, &doubled, &Silent).unwrap());
    assert!(
        a.surface
            .points()
            .iter()
            .zip(b.surface.points())
            .all(|(a, b)| norm(trueness_geom::space::minus(*a, *b)) < 1e-9)
    );
    points[7][1] = f64::NAN;
    assert_eq!(fit(&points, &Options::default(), &Silent).unwrap_err(), SurfaceError::NotFinite { index: 7 });
}

#[test]
fn wrong_options_are_refused() {
    let points = scan(200, 0.0, 1);
    let refused = |options: Options| fit(&points, &options, &Silent).unwrap_err();
    assert_eq!(refused(Options { degree: [3, 0], ..Options::default() }), SurfaceError::Degree { degree: 0 });
    assert_eq!(
        refused(Options { degree: [10, 3], ..Options::default() }),
        SurfaceError::Degree { degree: 10 }
    );
    let none = Options { layout: Layout::Spans([3, 0]), ..Options::default() };
    assert_eq!(refused(none), SurfaceError::Spans { spans: [3, 0] });
    let zero = Options { layout: Layout::Tolerance(0.0), ..Options::default() };
    assert_eq!(refused(zero), SurfaceError::Tolerance(0.0));
    assert_eq!(
        refused(Options { fairness: Fairness::Weight(-1.0), ..Options::default() }),
        SurfaceError::Fairness(-1.0)
    );
    assert!(matches!(refused(spans(100_000)), SurfaceError::TooLarge { .. }));
    assert!(matches!(refused(spans(usize::MAX / 2)), SurfaceError::TooLarge { .. }));
    let knots = || Knots::uniform(3, 2, 0.0, 50.0);
    let short =
        Options { layout: Layout::Knots([knots(), knots()]), base: BaseKind::Xy, ..Options::default() };
    assert!(matches!(refused(short), SurfaceError::OutsideKnots { value, .. } if value > 50.0));
}

#[test]
fn layers_are_told() {
    let random = &mut Random::new(12);
    let ball: Vec<Point> = (0..5000)
        .map(|_| {
            let (z, a) = (2.0 * random.unit() - 1.0, 2.0 * PI * random.unit());
            let r = (1.0 - z * z).sqrt();
            [20.0 * r * a.cos(), 20.0 * r * a.sin(), 20.0 * z]
        })
        .collect();
    let whole = fit(&ball, &spans(6), &Silent).unwrap();
    assert!(whole.base.folded_share > 0.5, "{}", whole.base.folded_share);
    let cap: Vec<Point> = ball.iter().filter(|p| p[2] > 4.0).copied().collect();
    assert_eq!(fit(&cap, &spans(6), &Silent).unwrap().base.folded_share, 0.0);
    // A step is no layer, even a high one along a slant.
    let step: Vec<Point> = scan(5000, 0.01, 5)
        .iter()
        .map(|p| [p[0], p[1], if p[0] + 0.7 * p[1] > 80.0 { 40.0 } else { 0.0 }])
        .collect();
    let share = fit(&step, &spans(6), &Silent).unwrap().base.folded_share;
    assert!(share < 0.01, "{share}");
}

/// Ground that rises to one corner, with a steep hill: it folds over its least-squares plane, but not over the ground plan.
#[test]
fn steep_ground_has_a_plane_without_layers() {
    let random = &mut Random::new(31);
    let ground: Vec<Point> = (0..20_000)
        .map(|_| {
            let [x, y] = [100.0 * random.unit(), 100.0 * random.unit()];
            let square = (x - 60.0) * (x - 60.0) + (y - 45.0) * (y - 45.0);
            [x, y, 1.2 * (x + y) + 60.0 * libm::exp(-square / 300.0) + 0.01 * (random.unit() - 0.5)]
        })
        .collect();
    let flat =
        trueness_geom::fit::fit(&ground, Kind::Plane, &trueness_geom::fit::Options::default(), &Silent)
            .unwrap();
    let Shape::Plane { normal, .. } = flat.shape else { panic!("{:?}", flat.shape) };
    let over_plane = |n: usize| Options { base: BaseKind::Plane, ..spans(n) };
    let found = fit(&ground, &over_plane(40), &Silent).unwrap();
    let axis = found.base.axes[2];
    assert_eq!(found.base.folded_share, 0.0);
    assert!(
        (libm::cos(found.base.tilted) - dot(axis, normal).abs()).abs() < 1e-12 && found.base.tilted > 0.2,
        "{:?} {normal:?}",
        found.base
    );
    // No facet of the ground is at right angles to the axis: its steepest slopes are 57 degrees up and 70 down.
    assert!(axis[2] > 0.8, "{axis:?}");
    // The noise is 0.0029 in height.
    let rms = pass::rms(&found.deviations);
    assert!(rms < 0.004, "{rms}");
    // A pipe with a slit has no such direction, and keeps its plane.
    let pipe: Vec<Point> = (0..5000)
        .map(|_| (5.5 * random.unit(), 60.0 * random.unit()))
        .map(|(a, z)| [15.0 * a.cos(), z, 15.0 * a.sin()])
        .collect();
    let kept = fit(&pipe, &over_plane(8), &Silent).unwrap();
    assert!(kept.base.tilted == 0.0 && kept.base.folded_share > 0.1, "{:?}", kept.base);
}

#[test]
fn corrected_parameters_fit_round_bodies_better() {
    let random = &mut Random::new(21);
    // Two thirds of a cylinder and a cap beyond the equator: with their own bases, to a micrometer.
    let cylinder: Vec<Point> = (0..6000)
        .map(|_| (4.0 * random.unit(), 60.0 * random.unit()))
        .map(|(a, z)| [15.0 * a.cos() + 3.0, z, 15.0 * a.sin()])
        .collect();
    let ball: Vec<Point> = (0..6000)
        .map(|_| (2.5 * random.unit(), 1.5 * random.unit() - 0.75))
        .map(|(a, b)| [20.0 * b.cos() * a.cos(), 20.0 * b.cos() * a.sin(), 20.0 * b.sin()])
        .collect();
    for (points, base, radius) in [(&cylinder, BaseKind::Cylinder, 15.0), (&ball, BaseKind::Sphere, 20.0)] {
        let found =
            fit(points, &Options { base, layout: Layout::Spans([12, 12]), ..Options::default() }, &Silent)
                .unwrap();
        assert!((found.base.radius.unwrap() - radius).abs() < 1e-9 && !found.base.around);
        let worst = found.deviations.iter().fold(0.0f64, |m, d| m.max(d.abs()));
        assert!(worst < 5e-3, "{base:?} {worst}");
        assert_eq!((found.base.folded_share, found.unsettled), (0.0, 0));
        // The normal points outward.
        let [(u0, u1), (v0, v1)] = found.surface.domain();
        let bend = found.surface.bend(0.5 * (u0 + u1), 0.5 * (v0 + v1)).unwrap();
        assert!(bend.mean < 0.0, "{bend:?}");
    }
    // A steep dome over its plane: corrections bring the distances down.
    let dome: Vec<Point> = ball.iter().map(|[x, y, z]| [*z, *x, *y]).filter(|p| p[2] > 5.0).collect();
    let with = |corrections| {
        let options = Options { corrections, layout: Layout::Spans([10, 10]), ..Options::default() };
        let found = fit(&dome, &options, &Silent).unwrap();
        let own = (found.sum_of_squares / dome.len() as f64).sqrt();
        (pass::rms(&found.deviations), own, found.corrections)
    };
    let ((before, loose, _), (after, tight, made)) = (with(0), with(5));
    assert!(made > 0 && after < before, "{before} {after}");
    // Distances at the parameters are distances to the nearest places.
    assert!(loose > 1.2 * before && tight < 1.01 * after, "{before} {loose} {after} {tight}");
    // All around, the seam is told.
    let pipe: Vec<Point> = (0..3000)
        .map(|_| (2.0 * PI * random.unit(), 40.0 * random.unit()))
        .map(|(a, z)| [10.0 * a.cos(), 10.0 * a.sin(), z])
        .collect();
    let found = fit(&pipe, &Options { base: BaseKind::Cylinder, ..Options::default() }, &Silent).unwrap();
    assert!(found.base.around);
}

#[test]
fn a_tolerance_is_reached_or_the_noise_is_told() {
    let clean = scan(8_000, 0.0, 31);
    let to = |t| Options { layout: Layout::Tolerance(t), ..spans(1) };
    let found = fit(&clean, &to(0.05), &Silent).unwrap();
    assert_eq!(found.reached, Some(Reached::Tolerance));
    assert!(found.deviations.iter().all(|d| d.abs() <= 0.05));
    assert!(found.support.control_points < 900, "{}", found.support.control_points);
    // Noise of 0.05: a tolerance of 0.02 cannot be kept, and knots do not grow without end.
    let noisy = fit(&scan(8_000, 0.05, 32), &to(0.02), &Silent).unwrap();
    assert_eq!(noisy.reached, Some(Reached::Noise));
    assert!(noisy.support.control_points < 1500, "{}", noisy.support.control_points);
    let rms = pass::rms(&noisy.deviations);
    assert!(rms > 0.04 && rms < 0.06, "{rms}");
}

/// Waves all over, as fine as the points can tell: where all urgent knots together would be too many, the most urgent are set. The
/// surface that is left is about as fine as the points allow, and nearer than half as many knots would be.
#[test]
fn knots_are_set_as_far_as_the_points_go() {
    // A step along a curve: knots there draw lines through all of it.
    let step = |x: f64, y: f64| libm::tanh(6.0 * (x - 25.0 - 8.0 * libm::sin(0.12 * y)));
    let points: Vec<Point> =
        (0..2500).map(|k| [f64::from(k / 50), f64::from(k % 50)]).map(|[x, y]| [x, y, step(x, y)]).collect();
    let layout = Layout::Tolerance(1e-6);
    let found = fit(&points, &Options { layout, base: BaseKind::Xy, ..Options::default() }, &Silent).unwrap();
    assert_eq!(found.reached, Some(Reached::Points));
    assert!((1700..=2500).contains(&found.support.control_points), "{}", found.support.control_points);
}

#[test]
fn points_that_contradict_their_neighbors_are_left_out() {
    let mut points = scan(5_000, 0.01, 41);
    let random = &mut Random::new(1);
    for k in 0..250 {
        points[20 * k][2] += 2.0 + 5.0 * random.unit();
    }
    let error = |f: &SurfaceFit| {
        let clean = |k: &usize| !k.is_multiple_of(20);
        (0..points.len()).filter(clean).map(|k| f.deviations[k].abs()).fold(0.0, f64::max)
    };
    let plain = fit(&points, &spans(15), &Silent).unwrap();
    let robust = fit(&points, &Options { robust: true, ..spans(15) }, &Silent).unwrap();
    assert!(error(&plain) > 0.3 && error(&robust) < 0.1, "{} {}", error(&plain), error(&robust));
    let wrong = robust.left_out.iter().filter(|i| !i.is_multiple_of(20)).count();
    assert!(robust.left_out.len() - wrong == 250 && wrong < 3, "{wrong} of {}", robust.left_out.len());
    // The distance of those left out is known, too.
    let foot = |i: &u32| robust.surface.at(robust.feet[*i as usize][0], robust.feet[*i as usize][1]);
    let apart = |i: &u32| norm(minus(points[*i as usize], foot(i))) - robust.deviations[*i as usize].abs();
    assert!(robust.left_out.iter().all(|i| apart(i).abs() < 1e-12));
}

/// The shape of a part is no outlier, whatever surface has too few knots for it; and the rest keeps to the tolerance.
#[test]
fn features_are_no_outliers() {
    // A feature line 24 mm wide and 8 mm high.
    let step = |[x, y]: [f64; 2]| 4.0 * libm::tanh((x - 0.3 * y - 30.0) / 6.0);
    let mut points = scan(6000, 0.03, 5);
    for p in &mut points {
        p[2] += step([p[0], p[1]]) - 10.0 * franke(p[0] / 100.0, p[1] / 100.0);
    }
    let robust = |points: &[Point], layout| {
        fit(points, &Options { robust: true, layout, ..Options::default() }, &Silent).unwrap()
    };
    assert!(robust(&points, Layout::Spans([8, 8])).left_out.len() < 3);
    let random = &mut Random::new(5);
    for i in (0..6000).step_by(50) {
        points[i][2] += 2.0 + 38.0 * random.unit();
    }
    let found = robust(&points, Layout::Tolerance(0.15));
    let wrong = found.left_out.iter().filter(|i| !i.is_multiple_of(50)).count();
    assert!(found.left_out.len() - wrong == 120 && wrong < 3, "{wrong} of {}", found.left_out.len());
    assert_eq!((found.reached, found.base.tilted), (Some(Reached::Tolerance), 0.0));
}

/// The poles of a cap lie beyond its rim up to a half angle of 80°.
#[test]
fn points_near_a_pole_are_told() {
    let cap = |most: f64| -> Vec<Point> {
        let place = |k: i32| {
            let (down, turn) = (most * (f64::from(k) / 3000.0).sqrt(), 2.4 * f64::from(k));
            let across = 50.0 * libm::sin(down);
            [across * libm::cos(turn), across * libm::sin(turn), 50.0 * libm::cos(down)]
        };
        (0..3000).map(place).collect()
    };
    let options = Options { base: BaseKind::Sphere, ..Options::default() };
    for (degrees, pole) in [(70.0f64, false), (88.0, true)] {
        assert_eq!(fit(&cap(degrees.to_radians()), &options, &Silent).unwrap().base.pole, pole, "{degrees}");
    }
}

#[test]
fn a_stop_is_heard() {
    struct Stop;
    impl Progress for Stop {
        fn cancelled(&self) -> bool {
            true
        }
    }
    let stopped = fit(&scan(500, 0.0, 1), &spans(5), &Stop).unwrap_err();
    assert_eq!(stopped, SurfaceError::Cancelled(Cancelled));
}
