//! Intervals that hold a number although every operation rounds: a filter before exact arithmetic.
//!
//! Each result is widened to the next number below and above, which contains what rounding to nearest has done (Moore,
//! Interval Analysis, 1966).

use std::ops::{Add, Mul, Sub};

/// All numbers from `low` to `high`. One that came to be by overflow may hold NaN; its sign is then not known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Least number.
    pub low: f64,
    /// Greatest number.
    pub high: f64,
}

impl Interval {
    /// One number alone.
    pub fn of(x: f64) -> Interval {
        Interval { low: x, high: x }
    }

    /// The sign of every number in it; `None` where they differ, or where that is not known.
    pub fn sign(self) -> Option<i32> {
        if self.low > 0.0 {
            Some(1)
        } else if self.high < 0.0 {
            Some(-1)
        } else {
            (self.low == 0.0 && self.high == 0.0).then_some(0)
        }
    }

    fn widened(low: f64, high: f64) -> Interval {
        Interval { low: low.next_down(), high: high.next_up() }
    }
}

impl Add for Interval {
    type Output = Interval;
    fn add(self, o: Interval) -> Interval {
        Interval::widened(self.low + o.low, self.high + o.high)
    }
}

impl Sub for Interval {
    type Output = Interval;
    fn sub(self, o: Interval) -> Interval {
        Interval::widened(self.low - o.high, self.high - o.low)
    }
}

impl Mul for Interval {
    type Output = Interval;
    fn mul(self, o: Interval) -> Interval {
        let [a, b, c, d] = [self.low * o.low, self.low * o.high, self.high * o.low, self.high * o.high];
        // A NaN (zero times infinity) must not be passed over, as `min` and `max` would.
        if a.is_nan() || b.is_nan() || c.is_nan() || d.is_nan() {
            return Interval { low: f64::NAN, high: f64::NAN };
        }
        Interval::widened(a.min(b).min(c.min(d)), a.max(b).max(c.max(d)))
    }
}

/// The vector product.
pub fn cross(a: [Interval; 3], b: [Interval; 3]) -> [Interval; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The scalar product.
pub fn dot(a: [Interval; 3], b: [Interval; 3]) -> Interval {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    /// Whole numbers of 50 bits: sums and products are known exactly.
    #[test]
    fn the_true_result_lies_in_it() {
        let random = &mut Random::new(2);
        for _ in 0..10_000 {
            let [a, b, c, d]: [i64; 4] = std::array::from_fn(|_| random.below(1 << 50) as i64 - (1 << 49));
            let of = |x: i64| Interval::of(x as f64);
            let r = (of(a) - of(b)) * (of(c) + of(d)) - of(a) * of(d);
            let exact = i128::from(a - b) * i128::from(c + d) - i128::from(a) * i128::from(d);
            // A double beyond 2^53 is a whole number.
            assert!(r.low as i128 <= exact && exact <= r.high as i128);
            assert!(r.sign().is_none_or(|s| s == exact.signum() as i32));
        }
        assert_eq!((Interval::of(0.0).sign(), Interval::of(-2.0).sign()), (Some(0), Some(-1)));
        assert_eq!((Interval::of(f64::INFINITY) * Interval::of(0.0)).sign(), None);
    }
}
