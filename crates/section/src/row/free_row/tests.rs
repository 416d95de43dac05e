use super::*;
use crate::model::budget::Budget;
use crate::model::prior::Prior;
use crate::model::result::Options;
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;

fn free_form(points: &[[f64; 2]], progress: &dyn Progress) -> Result<Option<Contour>, SectionError> {
    let (options, budget) = (Options::default(), Budget::new(0.0));
    super::free_form(&Question::new(points, Prior::default(), &options, &budget)?, 0.3, progress)
}

/// A bell curve's number.
fn normal(random: &mut Random) -> f64 {
    (0..12).map(|_| random.unit()).sum::<f64>() - 6.0
}

/// Points about a closed curve of many bends, of this noise.
fn body(count: usize, noise: f64, random: &mut Random) -> Vec<[f64; 2]> {
    let each = |i: usize| {
        let a = std::f64::consts::TAU * i as f64 / count as f64;
        let bends = 2.0 * libm::sin(3.0 * a) + 1.3 * libm::cos(5.0 * a + 0.4) + 0.5 * libm::sin(11.0 * a);
        let r = 30.0 + bends + noise * normal(random);
        [r * libm::cos(a), r * libm::sin(a)]
    };
    (0..count).map(each).collect()
}

/// The planted form comes back: one closed curve, the noise within chance, and the area of the form to its uncertainty.
#[test]
fn bodies_are_one_curve_of_the_noise_planted() {
    let random = &mut Random::new(5);
    for (count, noise) in [(200, 0.05), (400, 0.02), (400, 0.1), (900, 0.05)] {
        for _ in 0..5 {
            let points = body(count, noise, random);
            let found = free_form(&points, &Silent).unwrap().unwrap();
            let [segment] = &found.segments[..] else { panic!("{} segments", found.segments.len()) };
            let Geometry::Spline { curve, .. } = &segment.geometry else { panic!("no spline") };
            assert!(found.closed && found.joins.is_empty() && segment.count == count);
            assert_eq!(found.independent, count as f64);
            assert!((found.noise / noise - 1.0).abs() < 0.25, "{count} {noise}: {}", found.noise);
            // Where the curve closes, it does so with a common tangent.
            let (from, to) = curve.domain();
            let gap = length_between(curve.at(from), curve.at(to));
            let [u, v] = [curve.derivative(from, 1), curve.derivative(to, 1)];
            let turn = (u[0] * v[1] - u[1] * v[0]) / (u[0] * u[0] + u[1] * u[1]);
            assert!(gap < 1e-9 && turn.abs() < 1e-9, "{gap} {turn}");
            // Stations rise, and residuals are the distances from the curve as it is given.
            assert!(found.stations.windows(2).all(|w| w[0] <= w[1]));
            for (p, off) in points.iter().zip(&found.residuals) {
                let true_off = length_between(*p, curve.closest(*p).place);
                assert!((off.abs() - true_off).abs() < 0.02 * noise, "{off} for {true_off}");
            }
        }
    }
}

fn length_between(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(b[0] - a[0], b[1] - a[1])
}

/// A curve with as many unknowns as a cubic has is that cubic, wherever its knots are.
#[test]
fn cubics_come_back_exactly() {
    let points: Vec<[f64; 2]> =
        (0..60).map(|i| f64::from(i) / 59.0).map(|t| [10.0 * t, t + 3.0 * t * t - 2.0 * t * t * t]).collect();
    let found = free_form(&points, &Silent).unwrap().unwrap();
    assert!(found.segments[0].max < 1e-4 * found.spacing, "{}", found.segments[0].max);
}

/// A flat of points enough is a part of the row that the curve is not: then lines and arcs are looked for.
#[test]
fn flats_are_no_free_form() {
    let random = &mut Random::new(6);
    for noise in [0.01, 0.03] {
        let all = body(400, noise, random);
        let cut: Vec<[f64; 2]> =
            all.iter().map(|p| [p[0], p[1].max(-20.0 + noise * normal(random))]).collect();
        assert!(free_form(&all, &Silent).unwrap().is_some());
        assert!(free_form(&cut, &Silent).unwrap().is_none(), "{noise}");
    }
}

/// Rows turned round, and begun elsewhere, have the same curve up to the effect of other knots.
#[test]
fn where_a_row_begins_hardly_matters() {
    let random = &mut Random::new(7);
    let points = body(300, 0.03, random);
    let area = |points: &[[f64; 2]]| {
        let found = free_form(points, &Silent).unwrap().unwrap();
        let Geometry::Spline { curve, .. } = &found.segments[0].geometry else { panic!("no spline") };
        let places = curve.sample(4000);
        0.5 * places.windows(2).map(|w| w[0][0] * w[1][1] - w[0][1] * w[1][0]).sum::<f64>()
    };
    let (mut turned, back): (Vec<_>, Vec<_>) = (points.clone(), points.iter().rev().copied().collect());
    turned.rotate_left(71);
    let own = area(&points);
    assert!((area(&turned) - own).abs() < 0.2 && (area(&back) + own).abs() < 0.2, "{own} {}", area(&turned));
}

/// Stops at once.
struct Stopped;

impl Progress for Stopped {
    fn cancelled(&self) -> bool {
        true
    }
}

/// A row of many points is one curve as well; whoever asks to stop is heard.
#[test]
fn long_rows_are_one_curve_and_can_be_stopped() {
    let points = body(6000, 0.004, &mut Random::new(8));
    let found = free_form(&points, &Silent).unwrap().unwrap();
    assert_eq!((found.segments.len(), found.labels.len()), (1, 6000));
    assert!(matches!(free_form(&points, &Stopped), Err(SectionError::Cancelled(_))));
}
