//! Control charts and capability: by hand, by their definitions, and by the share of intervals that hold the truth.

use trueness_geom::num::random::Random;
use trueness_geom::num::special::{chi_square_quantile, normal_quantile};
use trueness_geom::stats::process::{Capability, ControlChart, Rule};

fn close(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found} is not {expected}");
}

/// An exponential distribution is the χ² distribution of two degrees, a squared normal number that of one.
#[test]
fn chi_square_has_its_closed_forms() {
    for share in [1e-6, 0.025, 0.3, 0.7, 0.975, 1.0 - 1e-4] {
        close(chi_square_quantile(share, 2.0), -2.0 * (-share).ln_1p(), 1e-12);
        let z = normal_quantile(0.5 + 0.5 * share);
        close(chi_square_quantile(share, 1.0), z * z, 1e-9);
    }
    // For even degrees the share above is a sum of Poisson's terms.
    for (degrees, share) in [(10.0, 0.95), (24.0, 0.025), (24.0, 0.975), (58.0, 0.5)] {
        let half = 0.5 * chi_square_quantile(share, degrees);
        let mut term = (-half).exp();
        let mut above = 0.0;
        for k in 0..(degrees / 2.0) as u32 {
            above += term;
            term *= half / f64::from(k + 1);
        }
        close(1.0 - above, share, 1e-11);
    }
    // Far out on many degrees it is normal (Wilson and Hilferty's approximation is good to some 1e-6 there).
    let (n, z) = (1e5f64, normal_quantile(0.975));
    let cube = 1.0 - 2.0 / (9.0 * n) + z * (2.0 / (9.0 * n)).sqrt();
    close(chi_square_quantile(0.975, n), n * cube * cube * cube, 1e-6);
    assert_eq!((chi_square_quantile(0.0, 3.0), chi_square_quantile(1.0, 3.0)), (0.0, f64::INFINITY));
}

fn rules(values: &[f64]) -> Vec<(usize, Rule)> {
    ControlChart::of(values).unwrap().signals.iter().map(|s| (s.index, s.rule)).collect()
}

#[test]
fn a_course_by_hand() {
    // Mean 5, squares 4 + 1 + 1 + 4 + 0, moving ranges 1, 2, 1, 2.
    let chart = ControlChart::of(&[3.0, 4.0, 6.0, 7.0, 5.0]).unwrap();
    assert_eq!((chart.mean, chart.min, chart.max), (5.0, 3.0, 7.0));
    assert!((chart.std_dev - 2.5f64.sqrt()).abs() < 1e-15);
    assert_eq!(chart.moving_range, 1.5);
    // The factors of the tables of control charts: 2.66 and 3.267.
    assert!((chart.limits[1] - 5.0 - 2.6587 * 1.5).abs() < 1e-3 * 1.5);
    assert!((chart.range_limit - 3.267 * 1.5).abs() < 1e-3 * 1.5);
    let c = chart.capability(Some(1.0), Some(11.0), 0.95);
    assert!((c.pp.unwrap().value - 10.0 / (6.0 * chart.std_dev)).abs() < 1e-15);
    assert!((c.ppk.unwrap().value - 4.0 / (3.0 * chart.std_dev)).abs() < 1e-15);
    assert!((c.cp.unwrap().value - 10.0 / (6.0 * chart.within)).abs() < 1e-15);
    let one = chart.capability(None, Some(11.0), 0.95);
    assert!(one.cp.is_none() && one.pp.is_none());
    assert!((one.ppk.unwrap().value - 6.0 / (3.0 * chart.std_dev)).abs() < 1e-15);
    assert_eq!(chart.capability(None, None, 0.95), Capability::default());
}

#[test]
fn what_chance_seldom_does_is_told() {
    let calm: Vec<f64> = (0..20).map(|k| if k % 2 == 0 { 1.0 } else { -1.0 }).collect();
    assert_eq!(rules(&calm), []);
    let mut jump = calm.clone();
    jump[10] = 30.0;
    let found = rules(&jump);
    assert!(found.contains(&(10, Rule::Beyond)) && found.contains(&(10, Rule::Range)), "{found:?}");
    assert!(found.contains(&(11, Rule::Range)), "{found:?}");
    // Nine above the mean, with a value far below to balance: the ninth is told.
    let mut above: Vec<f64> = (0..9).map(|k| 1.0 + 0.1 * f64::from(k % 2)).collect();
    above.extend([-9.0, -1.0, 1.0]);
    assert!(rules(&above).contains(&(8, Rule::Run)) && !rules(&above).contains(&(7, Rule::Run)));
    let rising = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 4.0];
    let found = rules(&rising);
    assert!(found.contains(&(5, Rule::Steady)) && !found.contains(&(4, Rule::Steady)), "{found:?}");
    assert!(!rules(&[0.0, 1.0, 1.0, 2.0, 3.0, 4.0]).iter().any(|s| s.1 == Rule::Steady));
}

#[test]
fn what_has_no_course() {
    assert_eq!(ControlChart::of(&[]), None);
    assert_eq!(ControlChart::of(&[1.0]), None);
    assert_eq!(ControlChart::of(&[1.0, f64::NAN]), None);
    let still = ControlChart::of(&[2.0; 9]).unwrap();
    assert_eq!((still.std_dev, still.within, still.signals.len()), (0.0, 0.0, 0));
    assert_eq!(still.capability(Some(1.0), Some(3.0), 0.95), Capability::default());
}

/// Over many normal processes the stated share of the intervals holds the true index.
#[test]
fn intervals_hold_the_truth_as_often_as_they_say() {
    let mut random = Random::new(23);
    let (lower, upper) = (-4.0, 5.0);
    // Standard deviation 1 and mean 0.
    let truth = [9.0 / 6.0, 4.0 / 3.0, 9.0 / 6.0, 4.0 / 3.0];
    let mut held = [0u32; 4];
    let runs = 4000;
    for _ in 0..runs {
        let values: Vec<f64> = (0..30).map(|_| normal_quantile(random.unit().max(1e-300))).collect();
        let c = ControlChart::of(&values).unwrap().capability(Some(lower), Some(upper), 0.95);
        for (k, index) in [c.cp, c.cpk, c.pp, c.ppk].into_iter().enumerate() {
            let index = index.unwrap();
            held[k] += u32::from(index.low <= truth[k] && truth[k] <= index.high);
        }
    }
    let share = held.map(|h| f64::from(h) / f64::from(runs));
    // Five standard deviations of a share of 95 %, and what the approximations lack: Pp alone is exact.
    let chance = 5.0 * (0.95f64 * 0.05 / f64::from(runs)).sqrt();
    assert!((share[2] - 0.95).abs() < chance, "{share:?}");
    assert!(share.iter().all(|s| (s - 0.95).abs() < chance + 0.01), "{share:?}");
}
