//! Numbers of twice the precision: the unevaluated sum of two `f64`, good to about 31 digits.
//!
//! Dekker, A floating-point technique for extending the available precision, 1971. Joldes, Muller and Popescu, Tight and
//! rigorous error bounds for basic building blocks of double-word arithmetic, 2017 (products and sums to a few 2^-104). Right
//! where neither results nor their errors leave the range of `f64`.

use super::sum::two_sum;
use std::ops::{Add, Mul, Sub};

/// A number `high + low`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Double {
    high: f64,
    low: f64,
}

/// `a + b`, where `a` is not the smaller of the two, and its error.
fn quick_sum(a: f64, b: f64) -> Double {
    let high = a + b;
    Double { high, low: b - (high - a) }
}

impl Double {
    /// `a - b`, exactly.
    pub fn difference(a: f64, b: f64) -> Double {
        let (high, low) = two_sum(a, -b);
        Double { high, low }
    }
    /// Rounded to the nearest `f64`.
    pub fn value(self) -> f64 {
        self.high + self.low
    }
    /// Quotient.
    pub fn over(self, other: Double) -> Double {
        let first = self.high / other.high;
        let rest = self - other * Double { high: first, low: 0.0 };
        let second = rest.high / other.high;
        let rest = rest - other * Double { high: second, low: 0.0 };
        let sum = quick_sum(first, second);
        sum + Double { high: rest.high / other.high, low: 0.0 }
    }
}

impl Add for Double {
    type Output = Double;
    fn add(self, o: Double) -> Double {
        let (high, error) = two_sum(self.high, o.high);
        let (low, lost) = two_sum(self.low, o.low);
        let sum = quick_sum(high, error + low);
        quick_sum(sum.high, sum.low + lost)
    }
}

impl Sub for Double {
    type Output = Double;
    fn sub(self, o: Double) -> Double {
        self + Double { high: -o.high, low: -o.low }
    }
}

impl Mul for Double {
    type Output = Double;
    fn mul(self, o: Double) -> Double {
        let high = self.high * o.high;
        let error = self.high.mul_add(o.high, -high);
        quick_sum(high, error + (self.high * o.low + self.low * o.high))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    /// Whole numbers of 50 bits: sums and products of two have at most 100, and are known exactly.
    #[test]
    fn equals_whole_numbers() {
        let random = &mut Random::new(5);
        let whole = |x: Double| x.high as i128 + x.low as i128;
        for _ in 0..2000 {
            let mut number = || random.below(1 << 50) as i64 - (1 << 49);
            let [a, b, c, d] = [number(), number(), number(), number()];
            let of = |x: i64, y: i64| Double::difference(x as f64, y as f64);
            let (p, q) = (of(a, b) * of(c, d), i128::from(a - b) * i128::from(c - d));
            assert_eq!(whole(p), q);
            assert_eq!(whole(p + p - of(a, 0)), 2 * q - i128::from(a));
            let back = (p.over(of(c, d)) - of(a, b)).value();
            assert!(back.abs() <= 1e-29 * (a - b).abs() as f64, "{back}");
        }
    }
}
