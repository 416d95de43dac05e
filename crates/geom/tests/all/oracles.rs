//! Distribution functions and fitted distributions against those of the crate `statrs`.

use statrs::distribution::{
    Binomial, ChiSquared, Continuous, ContinuousCDF, DiscreteCDF, Exp, Gamma, Laplace, LogNormal, Normal,
    StudentsT,
};
use trueness_geom::num::random::Random;
use trueness_geom::num::special::{
    beta_share, chi_square_quantile, coin_p, gamma_share, normal_below, normal_p, normal_quantile, student_p,
    student_quantile,
};
use trueness_geom::stats::research::distributions::{Family, Fit, fits};

/// Equal to `digits` of the value, or of 1 where it is smaller.
fn near(found: f64, expected: f64, digits: f64, what: &str) {
    assert!((found - expected).abs() <= digits * expected.abs().max(1e-3), "{what}: {found} for {expected}");
}

#[test]
fn distribution_functions_are_those_of_statrs() {
    let normal = Normal::new(0.0, 1.0).unwrap();
    for z in [-6.0, -3.0, -1.3, -0.2, 0.0, 0.7, 2.5, 5.0] {
        near(normal_below(z), normal.cdf(z), 1e-10, "normal");
        near(normal_p(z), 2.0 * normal.sf(f64::abs(z)), 1e-10, "normal, two-sided");
    }
    for share in [1e-9, 1e-4, 0.025, 0.5, 0.84, 0.999, 1.0 - 1e-9] {
        near(normal_quantile(share), normal.inverse_cdf(share), 1e-8, "normal quantile");
    }
    for degrees in [1.0, 2.0, 5.0, 30.0, 400.0] {
        let student = StudentsT::new(0.0, 1.0, degrees).unwrap();
        for t in [0.1, 0.9, 2.2, 4.0, 9.0] {
            near(student_p(t, degrees), 2.0 * student.sf(t), 1e-9, "Student");
        }
        for p in [0.5, 0.1, 0.05, 0.01, 1e-4] {
            near(
                student_quantile(p, degrees),
                student.inverse_cdf(1.0 - 0.5 * p),
                1e-6,
                "Student's quantile",
            );
        }
        let chi = ChiSquared::new(degrees).unwrap();
        for share in [0.01, 0.2, 0.5, 0.95, 0.999] {
            // Their own quantile is no number for few degrees; their distribution is one.
            near(chi.cdf(chi_square_quantile(share, degrees)), share, 1e-9, "χ²");
        }
    }
    for (a, x) in [(0.5, 0.2), (1.0, 3.0), (4.5, 2.0), (40.0, 55.0), (300.0, 280.0)] {
        near(gamma_share(a, x), Gamma::new(a, 1.0).unwrap().cdf(x), 1e-9, "gamma");
    }
    for (a, b, x) in [(0.5, 0.5, 0.3), (2.0, 7.0, 0.1), (30.0, 4.0, 0.9), (200.0, 300.0, 0.41)] {
        near(beta_share(a, b, x), statrs::function::beta::beta_reg(a, b, x), 1e-9, "beta");
    }
    for (heads, tosses) in [(0, 9), (3, 10), (40, 100), (480, 1000)] {
        let below = Binomial::new(0.5, tosses).unwrap().cdf(heads);
        near(coin_p(heads, tosses), (2.0 * below).min(1.0), 1e-9, "coin");
    }
}

/// The logarithm of the likelihood, the criteria and the greatest difference of shares follow from the parameters of every
/// fitted family. They do so by other functions than ours.
#[test]
fn fitted_distributions_are_judged_as_by_statrs() {
    let mut random = Random::new(7);
    let values: Vec<f64> = (0..400).map(|_| 0.02 + 0.05 * (-(1.0 - random.unit()).ln())).collect();
    let mut sorted = values.clone();
    sorted.sort_unstable_by(f64::total_cmp);
    let found = fits(&values, 1000, 1).unwrap();
    let mut seen = 0;
    for fit in &found {
        let Some((log_density, below)) = theirs(fit) else { continue };
        seen += 1;
        let n = sorted.len() as f64;
        let likelihood: f64 = sorted.iter().map(|&x| log_density(x)).sum();
        near(fit.log_likelihood, likelihood, 1e-9, &format!("{:?}", fit.family));
        let unknowns = 0.5 * (fit.aic + 2.0 * likelihood);
        near(unknowns, unknowns.round(), 1e-6, "unknowns");
        near(fit.bic, unknowns.round() * n.ln() - 2.0 * likelihood, 1e-9, "BIC");
        let worst = sorted.iter().enumerate().fold(0.0f64, |worst, (i, &x)| {
            worst.max(below(x) - i as f64 / n).max((i + 1) as f64 / n - below(x))
        });
        near(fit.ks_distance, worst, 1e-8, &format!("{:?}", fit.family));
    }
    assert_eq!(seen, 5, "{found:?}");
}

type Function = Box<dyn Fn(f64) -> f64>;

/// Logarithm of the density and share below of a fitted distribution; `None` of families that `statrs` does not have.
fn theirs(fit: &Fit) -> Option<(Function, Function)> {
    fn both<D: Continuous<f64, f64> + ContinuousCDF<f64, f64> + Copy + 'static>(
        d: D,
    ) -> (Function, Function) {
        (Box::new(move |x| d.ln_pdf(x)), Box::new(move |x| d.cdf(x)))
    }
    let (location, scale) = (fit.location, fit.scale);
    Some(match fit.family {
        Family::Normal => both(Normal::new(location, scale).unwrap()),
        Family::Laplace => both(Laplace::new(location, scale).unwrap()),
        Family::StudentT => both(StudentsT::new(location, scale, fit.shape.unwrap()).unwrap()),
        Family::Exponential => both(Exp::new(1.0 / scale).unwrap()),
        Family::LogNormal => both(LogNormal::new(location, scale).unwrap()),
        Family::Logistic | Family::HalfNormal => return None,
    })
}
