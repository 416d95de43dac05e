//! Distribution functions for tests and intervals: normal, Student's t, χ², binomial with even odds.
//!
//! The elementary functions are those of `libm`, so that the numbers are the same on every machine.

/// Two-sided p value of a standard normal `z`: the chance of a value at least as far from zero.
pub fn normal_p(z: f64) -> f64 {
    libm::erfc(z.abs() * std::f64::consts::FRAC_1_SQRT_2)
}
/// Share of the standard normal distribution below `z`.
pub fn normal_below(z: f64) -> f64 {
    0.5 * libm::erfc(-z * std::f64::consts::FRAC_1_SQRT_2)
}
/// The `z` with this share of the standard normal distribution below it; infinite at 0 and 1.
pub fn normal_quantile(share: f64) -> f64 {
    if share <= 0.0 || share >= 1.0 {
        return if share <= 0.0 { f64::NEG_INFINITY } else { f64::INFINITY };
    }
    // The lower tail keeps its digits; the upper one is its mirror.
    if share > 0.5 { -normal_quantile(1.0 - share) } else { bisect(-40.0, 0.0, |z| normal_below(z) < share) }
}
/// Two-sided p value of Student's `t` with `degrees` of freedom.
pub fn student_p(t: f64, degrees: f64) -> f64 {
    if !t.is_finite() {
        return 0.0;
    }
    beta_share(0.5 * degrees, 0.5, degrees / (degrees + t * t))
}
/// The `t` beyond which, on both sides together, lies the share `p` of Student's distribution.
pub fn student_quantile(p: f64, degrees: f64) -> f64 {
    let mut high = 2.0;
    while student_p(high, degrees) > p && high < 1e300 {
        high *= 2.0;
    }
    bisect(0.0, high, |t| student_p(t, degrees) > p)
}
/// The value with this share of the χ² distribution of `degrees` of freedom below it; 0 and infinity at the ends.
pub fn chi_square_quantile(share: f64, degrees: f64) -> f64 {
    if share <= 0.0 || share >= 1.0 {
        return if share <= 0.0 { 0.0 } else { f64::INFINITY };
    }
    let mut high = degrees.max(1.0);
    while gamma_share(0.5 * degrees, 0.5 * high) < share && high < 1e300 {
        high *= 2.0;
    }
    bisect(0.0, high, |x| gamma_share(0.5 * degrees, 0.5 * x) < share)
}
/// Two-sided p value of `heads` among `tosses` of a fair coin, exactly.
pub fn coin_p(heads: u64, tosses: u64) -> f64 {
    let rarer = heads.min(tosses - heads) as f64;
    // At most `rarer` heads: the incomplete beta function at one half.
    (2.0 * beta_share(tosses as f64 - rarer, rarer + 1.0, 0.5)).min(1.0)
}

/// Where `below` turns from true to false between `low` and `high`.
fn bisect(mut low: f64, mut high: f64, below: impl Fn(f64) -> bool) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if below(middle) { low = middle } else { high = middle }
    }
}

/// The incomplete beta function as a share of the complete one, for positive `a`, `b` and `x` of [0, 1].
///
/// Continued fraction 8.17.22 of the NIST Digital Library of Mathematical Functions. It is evaluated by Lentz's method as
/// modified by Thompson and Barnett (1986); some √max(a, b) steps.
pub fn beta_share(a: f64, b: f64, x: f64) -> f64 {
    if x <= 0.0 || x >= 1.0 {
        return if x <= 0.0 { 0.0 } else { 1.0 };
    }
    // The fraction converges fast below the mean only; above it the other tail is taken.
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - beta_share_below(b, a, 1.0 - x);
    }
    beta_share_below(a, b, x)
}

fn beta_share_below(a: f64, b: f64, x: f64) -> f64 {
    let factor = libm::exp(a * libm::log(x) + b * libm::log1p(-x) - log_beta(a, b)) / a;
    let keep = |y: f64| if y.abs() < 1e-300 { 1e-300 } else { y };
    let (mut c, mut d) = (1.0, 1.0 / keep(1.0 - (a + b) * x / (a + 1.0)));
    let mut fraction = d;
    for m in 1..1_000_000 {
        let m = f64::from(m);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        d = 1.0 / keep(1.0 + even * d);
        c = keep(1.0 + even / c);
        fraction *= d * c;
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        d = 1.0 / keep(1.0 + odd * d);
        c = keep(1.0 + odd / c);
        fraction *= d * c;
        if (d * c - 1.0).abs() < 1e-16 {
            break;
        }
    }
    factor * fraction
}

/// The lower incomplete gamma function as a share of the complete one, for positive `a` and `x`.
///
/// Series 8.11.4 of the NIST Digital Library of Mathematical Functions below `a + 1`, continued fraction 8.9.2 above. Lentz's
/// method as modified by Thompson and Barnett (1986) evaluates it in some √a steps.
pub fn gamma_share(a: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    let factor = libm::exp(a * libm::log(x) - x - libm::lgamma(a));
    if x < a + 1.0 {
        let (mut term, mut sum) = (1.0 / a, 1.0 / a);
        for k in 1..1_000_000 {
            term *= x / (a + f64::from(k));
            sum += term;
            if term < 1e-17 * sum {
                break;
            }
        }
        return factor * sum;
    }
    let mut b = x + 1.0 - a;
    let (mut c, mut d) = (1e300, 1.0 / b);
    let mut fraction = d;
    for k in 1..1_000_000 {
        let k = f64::from(k);
        let n = -k * (k - a);
        b += 2.0;
        d = 1.0 / (n * d + b);
        c = b + n / c;
        fraction *= d * c;
        if (d * c - 1.0).abs() < 1e-16 {
            break;
        }
    }
    1.0 - factor * fraction
}

/// Logarithm of the complete beta function.
fn log_beta(a: f64, b: f64) -> f64 {
    let (small, large) = (a.min(b), a.max(b));
    if large < 20.0 {
        return libm::lgamma(a) + libm::lgamma(b) - libm::lgamma(a + b);
    }
    // The logarithms of large gamma functions nearly cancel: take their difference term by term (Stirling).
    let ratio = stirling(large)
        - stirling(large + small)
        - small * libm::log(large)
        - (large + small - 0.5) * libm::log1p(small / large)
        + small;
    libm::lgamma(small) + ratio
}
/// The difference between the logarithm of the gamma function and Stirling's formula, for `x` of 20 and more.
fn stirling(x: f64) -> f64 {
    let y = 1.0 / (x * x);
    (1.0 / 12.0 - y * (1.0 / 360.0 - y * (1.0 / 1260.0 - y * (1.0 / 1680.0 - y / 1188.0)))) / x
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(found: f64, expected: f64, relative: f64) {
        assert!((found - expected).abs() <= relative * expected.abs(), "{found} is not {expected}");
    }

    /// Expected: SciPy 1.17 `special.betainc`, `stats.t`, `stats.norm`, `stats.binomtest`.
    #[test]
    fn equals_scipy() {
        close(beta_share(2.0, 3.0, 0.4), 0.5247999999999999, 1e-14);
        close(beta_share(0.5, 0.5, 0.1), 0.20483276469913345, 1e-14);
        close(beta_share(150.0, 0.5, 0.98), 0.013900499391097462, 1e-12);
        close(beta_share(1e6, 1e6, 0.4999), 0.38864871786231014, 1e-9);
        close(student_p(2.0, 5.0), 0.10193947882985835, 1e-14);
        close(student_p(-0.1, 1.0), 0.936548965138893, 1e-14);
        close(student_p(12.0, 30.0), 5.580185415199261e-13, 1e-12);
        close(student_p(1.96, 1e6), 0.04999606758526985, 1e-9);
        close(student_quantile(0.05, 1.0), 12.706204736174694, 1e-13);
        close(student_quantile(0.05, 10.0), 2.228138851986274, 1e-13);
        close(student_quantile(0.05, 361_000.0), 1.959970555950162, 1e-10);
        close(normal_quantile(0.975), 1.959963984540054, 1e-14);
        close(normal_quantile(1e-10), -6.361340902404056, 1e-14);
        close(normal_p(1.959963984540054), 0.05, 1e-14);
        close(coin_p(47, 98), 0.7620362195292442, 1e-12);
        assert_eq!(coin_p(5, 10), 1.0);
        close(coin_p(0, 10), 2.0 / 1024.0, 1e-13);
    }
}
