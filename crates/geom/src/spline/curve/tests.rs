//! Identities of curves, and numbers of SciPy on the same knots.

use super::super::basis::Knots;
use super::super::value::Value;
use super::*;
use crate::num::random::Random;
use crate::spline::rational::Rational;
use crate::spline::value::Mass;

/// A curve with knots of every multiplicity.
fn wild(degree: usize, seed: u64) -> Curve<[f64; 2]> {
    let random = &mut Random::new(seed);
    let mut inner: Vec<f64> = (0..5).map(|_| 0.1 + 0.8 * random.unit()).collect();
    inner.extend(std::iter::repeat_n(0.5, degree.saturating_sub(1)));
    inner.sort_by(f64::total_cmp);
    let knots = Knots::clamped(degree, 0.0, &inner, 1.0).unwrap();
    let points = (0..knots.count()).map(|_| [10.0 * random.unit(), 10.0 * random.unit()]).collect();
    Curve::new(knots, points).unwrap()
}

fn places() -> impl Iterator<Item = f64> {
    (0..=200).map(|i| f64::from(i) / 200.0)
}

fn differ<V: Value>(a: &Curve<V>, b: &Curve<V>) -> f64 {
    places().map(|t| a.at(t).minus(b.at(t)).size()).fold(0.0, f64::max)
}

#[test]
fn inserting_and_elevating_change_nothing() {
    for degree in 1..=6 {
        for seed in 0..10 {
            let curve = wild(degree, seed);
            let inserted = curve.insert(0.3).unwrap().insert(0.77).unwrap();
            assert_eq!(inserted.points().len(), curve.points().len() + 2);
            assert!(differ(&curve, &inserted) < 1e-12, "{degree} {seed}");
            let elevated = curve.elevated();
            assert_eq!(elevated.knots().degree(), degree + 1);
            assert!(differ(&curve, &elevated) < 1e-12, "{degree} {seed}");
            assert!(differ(&curve, &elevated.elevated()) < 1e-12);
        }
    }
}

#[test]
fn a_curve_is_the_bezier_curves_it_consists_of() {
    for degree in 1..=5 {
        let curve = wild(degree, 11);
        let (control, knots) = (curve.bezier(), curve.knots().distinct());
        assert_eq!(control.len(), degree * (knots.len() - 1) + 1);
        for (span, ends) in knots.windows(2).enumerate() {
            let own = control[span * degree..=(span + 1) * degree].to_vec();
            let piece = Curve::new(Knots::uniform(degree, 1, 0.0, 1.0), own).unwrap();
            for t in places() {
                let off = piece.at(t).minus(curve.at(ends[0] + t * (ends[1] - ends[0]))).size();
                assert!(off < 1e-12, "{degree} {span} {t}: {off}");
            }
        }
    }
}

/// Halving ends where the digits end: before, a curve of a micrometer a meter away was halved 2⁴⁰ times.
#[test]
fn lengths_of_curves_shorter_than_their_digits_end() {
    let knots = Knots::uniform(3, 2, 0.0, 1.0);
    for size in [0.0, 1e-13, 1e-9, 1e-6, 1e-3] {
        let points = [[0.0, 0.0], [0.3, 0.2], [0.5, -0.1], [0.8, 0.1], [1.0, 0.0]];
        let near = Curve::new(knots.clone(), points.map(|p| p.map(|x| size * x)).to_vec()).unwrap();
        let far = Curve::new(knots.clone(), points.map(|p| p.map(|x| 1000.0 + size * x)).to_vec()).unwrap();
        assert!((far.length(0.0, 1.0) - near.length(0.0, 1.0)).abs() < 1e-11, "{size}");
    }
    let none = Curve::new(knots, vec![[f64::NAN, 0.0]; 5]).unwrap();
    assert!(none.length(0.0, 1.0).is_nan());
}

#[test]
fn what_was_inserted_can_be_removed_and_nothing_else() {
    for degree in 2..=5 {
        let curve = wild(degree, 7);
        let more = curve.insert(0.31).unwrap();
        let index = more.knots().values().iter().position(|k| *k == 0.31).unwrap();
        let (again, moved) = more.remove(index, 1e-9).unwrap();
        assert!(moved < 1e-11 && differ(&curve, &again) < 1e-11, "{degree} {moved}");
        assert!(again.remove(degree + 1, 1e-9).is_none());
        let (coarse, moved) = curve.remove(degree + 1, f64::INFINITY).unwrap();
        assert!(differ(&curve, &coarse) <= moved * (1.0 + 1e-9), "{degree}");
    }
}

#[test]
fn derivatives_are_those_of_differences_and_of_the_hodograph() {
    for degree in 1..=5 {
        let curve = wild(degree, 3);
        let first = curve.hodograph().unwrap();
        for t in places().map(|t| 0.003 + 0.99 * t) {
            let d = curve.derivatives(t, degree + 1);
            assert!(d[1].minus(first.at(t)).size() < 1e-10);
            assert_eq!(d[degree + 1], [0.0; 2]);
            let near = curve.knots().values().iter().any(|k| (k - t).abs() < 1e-5);
            for order in 1..=degree.min(3) {
                let h = 1e-6;
                let (a, b) = (curve.derivative(t - h, order - 1), curve.derivative(t + h, order - 1));
                let difference = b.minus(a).times(0.5 / h);
                assert!(near || difference.minus(d[order]).size() < 1e-5 * (1.0 + d[order].size()));
            }
        }
    }
}

/// The half circle of masses 2, 1, 2 at −1, 0, 1, as the interpolating pyramid gives it, as a Bézier curve.
#[test]
fn half_circle_is_exact() {
    let points = [([-1.0, 0.0], 2.0), ([0.0, 1.0], 1.0), ([1.0, 0.0], 2.0)].map(|(p, m)| Mass::new(p, m));
    let interpolated =
        |t: f64| crate::spline::pyramid::neville(&[-1.0, 0.0, 1.0], &points, t).unwrap().place().unwrap();
    let middle = points[1].times(2.0).plus(-0.5, points[0]).plus(-0.5, points[2]);
    let knots = Knots::uniform(2, 1, -1.0, 1.0);
    let half = Rational::of_masses(knots, vec![points[0], middle, points[2]]).unwrap();
    for i in -1000..=1000 {
        let t = f64::from(i) / 1000.0;
        let [x, y] = half.at(t).unwrap();
        assert!((libm::hypot(x, y) - 1.0).abs() <= 1e-15, "{t}");
        let [u, v] = interpolated(t);
        assert!((x - u).abs() < 1e-15 && (y - v).abs() < 1e-15 && (libm::hypot(u, v) - 1.0).abs() <= 1e-15);
        // On a circle the derivative is at right angles to the place.
        let d = half.derivatives(t, 2).unwrap();
        assert!((d[1][0] * x + d[1][1] * y).abs() < 1e-15);
        assert!((d[2][0] * x + d[2][1] * y + d[1][0] * d[1][0] + d[1][1] * d[1][1]).abs() < 1e-14);
    }
    let finer: Rational<2> = half.masses().insert(0.25).unwrap().elevated().into();
    assert!(
        places().all(|t| (libm::hypot(finer.at(t).unwrap()[0], finer.at(t).unwrap()[1]) - 1.0).abs() < 2e-15)
    );
}

/// `scipy.interpolate.BSpline(t, c, 3)` and its first three derivatives at 0.37, SciPy 1.x.
#[test]
fn equals_scipy() {
    let knots = Knots::clamped(3, 0.0, &[0.2, 0.5, 0.5, 0.8], 1.0).unwrap();
    let points =
        vec![[0.0, 1.0], [1.0, 3.0], [2.5, -1.0], [4.0, 2.0], [5.0, 5.0], [7.0, 1.5], [8.0, 0.5], [9.0, 2.0]];
    let curve = Curve::new(knots, points).unwrap();
    let expected = [
        [3.6572148148148145, 1.6104644444444443],
        [7.715555555555555, 12.304666666666664],
        [-15.111111111111114, 61.46666666666666],
        [-88.8888888888888, -626.6666666666666],
    ];
    for (d, e) in curve.derivatives(0.37, 3).iter().zip(expected) {
        assert!(d.minus(e).size() <= 1e-12 * e.size(), "{d:?} {e:?}");
    }
}

#[test]
fn closest_point_and_length_of_a_quarter_circle() {
    // The cubic through a quarter circle within 2e-4; its own length is known by a fine polyline.
    let k = 0.552_284_749_830_793_4;
    let points = vec![[1.0, 0.0], [1.0, k], [k, 1.0], [0.0, 1.0]];
    let curve = Curve::new(Knots::uniform(3, 1, 0.0, 1.0), points).unwrap();
    let fine = curve.sample(200_001);
    let polyline: f64 = fine.windows(2).map(|w| libm::hypot(w[1][0] - w[0][0], w[1][1] - w[0][1])).sum();
    let length = curve.length(0.0, 1.0);
    assert!((length - polyline).abs() < 1e-10, "{length} {polyline}");
    let t = curve.parameter_at_length(0.25 * length);
    assert!((curve.length(0.0, t) - 0.25 * length).abs() < 1e-14);
    assert!((curve.curvature(0.5).unwrap() - 1.0).abs() < 0.01);
    let random = &mut Random::new(1);
    for _ in 0..100 {
        let point = [2.0 * random.unit(), 2.0 * random.unit()];
        let foot = curve.closest(point);
        let brute = fine.iter().map(|p| libm::hypot(p[0] - point[0], p[1] - point[1])).fold(9.0, f64::min);
        assert!(foot.distance <= brute + 1e-12 && foot.distance > brute - 1e-5);
    }
}

#[test]
fn least_squares_reproduces_a_spline_and_keeps_to_its_ends() {
    let curve = wild(3, 5);
    let parameters: Vec<f64> = places().collect();
    let points: Vec<[f64; 2]> = parameters.iter().map(|t| curve.at(*t)).collect();
    let free = fit(&points, &parameters, curve.knots(), Ends::FREE, 0.0).unwrap();
    assert!(free.max < 1e-11, "{}", free.max);
    let n = curve.points().len();
    let direction = curve.points()[1].minus(curve.points()[0]);
    let last = curve.points()[n - 1].minus(curve.points()[n - 2]);
    let ends = Ends {
        start: End::Tangent(curve.points()[0], direction),
        end: End::Tangent(curve.points()[n - 1], last.times(0.3)),
    };
    let held = fit(&points, &parameters, curve.knots(), ends, 0.0).unwrap();
    assert!(held.max < 1e-11, "{}", held.max);
    // A direction of its own: kept exactly, at the cost of the fit.
    let ends = Ends { start: End::Tangent([0.0, 0.0], [1.0, 0.0]), end: End::Through([9.0, 9.0]) };
    let bent = fit(&points, &parameters, curve.knots(), ends, 1e-9).unwrap().curve;
    assert_eq!((bent.at(0.0), bent.at(1.0), bent.points()[1][1]), ([0.0; 2], [9.0; 2], 0.0));
    assert!(bent.points()[1][0] >= 0.0);
}

/// The least sum is where it does not fall in any direction: the twin of the constrained solution.
#[test]
fn a_constrained_fit_is_a_minimum() {
    let points: Vec<[f64; 2]> =
        places().map(|t| [10.0 * t, libm::sin(3.0 * t) + 0.01 * libm::cos(50.0 * t)]).collect();
    let parameters: Vec<f64> = places().collect();
    let knots = spread_knots(3, 8, &parameters);
    let ends = Ends { start: End::Tangent([0.0, 0.1], [1.0, 0.4]), end: End::Free };
    let best = fit(&points, &parameters, &knots, ends, 0.0).unwrap();
    let sum = |control: Vec<[f64; 2]>| -> f64 {
        let curve = Curve::new(knots.clone(), control).unwrap();
        points
            .iter()
            .zip(&parameters)
            .map(|(p, t)| curve.at(*t).minus(*p))
            .map(|d| d[0] * d[0] + d[1] * d[1])
            .sum()
    };
    for i in 1..best.curve.points().len() {
        for step in [1e-4, -1e-4] {
            for direction in if i == 1 { vec![[1.0, 0.4]] } else { vec![[1.0, 0.0], [0.0, 1.0]] } {
                let mut control = best.curve.points().to_vec();
                control[i] = control[i].plus(step, direction);
                assert!(sum(control) > best.sum_of_squares, "{i}");
            }
        }
    }
}

#[test]
fn tolerance_drives_the_number_of_knots() {
    let points: Vec<[f64; 2]> = places().map(|t| [10.0 * t, libm::sin(6.0 * t)]).collect();
    let counts = [1e-1, 1e-3, 1e-5].map(|tolerance| {
        let fitted = approximate(&points, 3, Ends::FREE, tolerance).unwrap();
        assert!(fitted.max <= tolerance);
        fitted.curve.points().len()
    });
    assert!(counts[0] < counts[1] && counts[1] < counts[2] && counts[2] < 60, "{counts:?}");
    assert!(matches!(approximate(&[[1.0, 2.0]; 5], 3, Ends::FREE, 0.1), Err(FitCurveError::TooFewPoints)));
}

/// Spans divided by their errors keep the tolerance, over about as few control points as knots taken out one by one leave.
#[test]
fn divided_spans_keep_the_tolerance() {
    let parameters: Vec<f64> = (0..300).map(|i| f64::from(i) / 299.0).collect();
    let points: Vec<[f64; 2]> = parameters
        .iter()
        .map(|t| [10.0 * t, libm::sin(6.0 * t) + 0.3 * libm::exp(-200.0 * (t - 0.7) * (t - 0.7))])
        .collect();
    let ends = Ends { start: End::Tangent(points[0], [10.0, 6.0]), end: End::Through(points[299]) };
    for tolerance in [1e-1, 1e-2, 1e-3, 1e-4, 1e-5] {
        let found = divided(&points, &parameters, 3, &[0.0, 0.5, 1.0], ends, tolerance).unwrap();
        let off = |(p, t): (&[f64; 2], &f64)| {
            let d = found.curve.at(*t).minus(*p);
            libm::hypot(d[0], d[1])
        };
        let worst = points.iter().zip(&parameters).map(off).fold(0.0, f64::max);
        assert!(found.max <= tolerance && (worst - found.max).abs() < 1e-15, "{worst} {}", found.max);
        assert_eq!([found.curve.at(0.0), found.curve.at(1.0)], [points[0], points[299]]);
        let d = found.curve.derivative(0.0, 1);
        assert!((d[0] * 6.0 - d[1] * 10.0).abs() < 1e-9 * d[0] && d[0] > 0.0, "{d:?}");
        let fewest = approximate(&points, 3, ends, tolerance).unwrap().curve.points().len();
        let count = found.curve.points().len();
        assert!(count <= 2 * fewest + 2, "{tolerance}: {count} {fewest}");
    }
    // No more spans than points tell; numbers that do not rise are refused.
    let wild: Vec<[f64; 2]> = (0..40).map(|i| [f64::from(i), f64::from(i * 17 % 7)]).collect();
    let steps: Vec<f64> = (0..40).map(|i| f64::from(i) / 39.0).collect();
    let rough = divided(&wild, &steps, 3, &[0.0, 1.0], Ends::FREE, 1e-9).unwrap();
    assert!(rough.max > 0.1 && rough.curve.points().len() <= 43);
    for spans in [&[][..], &[0.0], &[1.0, 0.0]] {
        assert_eq!(divided(&wild, &steps, 3, spans, Ends::FREE, 1.0), Err(FitCurveError::Spans));
    }
}

#[test]
fn wrong_knots_are_refused() {
    use crate::spline::basis::KnotError;
    assert!(matches!(Knots::new(3, vec![0.0; 8]), Err(KnotError::Multiple { .. })));
    assert!(matches!(Knots::new(1, vec![0.0, 1.0, 0.5, 2.0]), Err(KnotError::Order { index: 2, .. })));
    assert!(matches!(Knots::new(1, vec![0.0, f64::NAN, 0.5, 2.0]), Err(KnotError::Order { index: 1, .. })));
    assert!(matches!(Knots::new(3, vec![0.0, 1.0]), Err(KnotError::TooFew { .. })));
    let knots = Knots::uniform(2, 2, 0.0, 1.0);
    assert!(matches!(Curve::new(knots, vec![[0.0]; 3]), Err(KnotError::Points { found: 3, needed: 4 })));
}

/// A curve that leads steeply to its end within few points does not swing between them, however small the tolerance.
#[test]
fn divided_curves_do_not_swing_between_their_points() {
    for (count, power, size, tolerance, wave) in [
        (160, 200, 20.0, 1e-2, 0.0),
        (64, 8, 5.0, 1e-6, 5.0),
        (100, 200, 0.1, 1e-3, 20.0),
        (64, 20, 0.1, 1e-6, 5.0),
        (256, 200, 5.0, 1e-4, 5.0),
        (160, 60, 5.0, 1e-4, 20.0),
    ] {
        let parameters: Vec<f64> = (0..=count).map(|i| f64::from(i) / f64::from(count)).collect();
        let lead = |t: f64| size * (1.0 - t).powi(power);
        let steep = |t: f64| -size * f64::from(power) * (1.0 - t).powi(power - 1);
        let place = |t: f64| [10.0 * t + lead(t), libm::sin(wave * t) + lead(t)];
        let along = |t: f64| [10.0 + steep(t), wave * libm::cos(wave * t) + steep(t)];
        let points: Vec<[f64; 2]> = parameters.iter().map(|t| place(*t)).collect();
        let [start, end] = [0.0, 1.0].map(|t| End::Tangent(place(t), along(t)));
        let spans: Vec<f64> = (0..=10).map(|i| f64::from(i) / 10.0).collect();
        let found = divided(&points, &parameters, 3, &spans, Ends { start, end }, tolerance).unwrap();
        // No farther off between points than neighboring points are apart.
        let steps = points.windows(2).map(|w| libm::hypot(w[1][0] - w[0][0], w[1][1] - w[0][1]));
        let step = steps.fold(0.0, f64::max);
        for i in 0..=5000 {
            let t = f64::from(i) / 5000.0;
            let d = found.curve.at(t).minus(place(t));
            let off = libm::hypot(d[0], d[1]);
            assert!(off < step, "{count} {power} {size} {tolerance} {wave}: {off} at {t}, {step} apart");
        }
    }
}

/// Knots that do not stand as often as the degree at the ends, as the uniform ones of some files.
#[test]
fn parts_of_curves_that_are_not_clamped_begin_at_their_start() {
    let points: Vec<[f64; 1]> = [0.0, 2.0, -1.0, 3.0, 1.0, 4.0].map(|x| [x]).to_vec();
    let curve = Curve::new(Knots::new(3, (0..10).map(f64::from).collect()).unwrap(), points).unwrap();
    for (from, to) in [(3.0, 6.0), (3.0, 4.5), (4.5, 6.0), (3.7, 5.0)] {
        let part = curve.part(from, to).unwrap();
        assert_eq!(part.domain(), (from, to));
        for share in [0.0, 0.3, 0.8, 1.0] {
            let t = from + share * (to - from);
            assert!((part.at(t)[0] - curve.at(t)[0]).abs() < 1e-14, "{from} {to} {t}");
        }
    }
}
