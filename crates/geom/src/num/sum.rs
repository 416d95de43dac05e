//! Sums that carry what rounding would drop.
//!
//! Knuth, The Art of Computer Programming 2, 4.2.2 (the sum of two numbers and its exact error).

use std::iter::Sum as IteratorSum;

/// Rounded sum of two numbers and what rounding took away: `a + b == sum + error` exactly.
#[inline(always)]
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_part = sum - a;
    (sum, (a - (sum - b_part)) + (b - b_part))
}

/// A running sum kept as two numbers, good to about 32 digits relative to the sum of the magnitudes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sum {
    /// The sum to the nearest `f64`.
    pub high: f64,
    /// The part that `high` lacks.
    pub low: f64,
}

impl Sum {
    /// The sum of `a` and `b`, exactly.
    pub fn of_two(a: f64, b: f64) -> Sum {
        let (high, low) = two_sum(a, b);
        Sum { high, low }
    }
    /// This sum and `term`.
    #[must_use]
    pub fn plus(self, term: f64) -> Sum {
        let (sum, error) = two_sum(self.high, term);
        let (high, low) = two_sum(sum, self.low + error);
        Sum { high, low }
    }
    /// The sum, rounded once.
    pub fn value(self) -> f64 {
        self.high + self.low
    }
}

/// `N` running sums side by side, as fast as vectors are. They are not brought in order after each term, as [`Sum`] is; that is
/// as good for some thousand terms (Neumaier 1974).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sums<const N: usize> {
    high: [f64; N],
    low: [f64; N],
}

impl<const N: usize> Sums<N> {
    /// The sum of nothing.
    pub const ZERO: Sums<N> = Sums { high: [0.0; N], low: [0.0; N] };

    /// Adds term `i` to sum `i`.
    #[inline(always)]
    pub fn add(&mut self, terms: [f64; N]) {
        for ((high, low), term) in self.high.iter_mut().zip(&mut self.low).zip(terms) {
            let (sum, error) = two_sum(*high, term);
            *high = sum;
            *low += error;
        }
    }
    /// The sums, each in order.
    pub fn each(&self) -> [Sum; N] {
        std::array::from_fn(|i| Sum::of_two(self.high[i], self.low[i]))
    }
}

impl IteratorSum<f64> for Sum {
    fn sum<I: Iterator<Item = f64>>(terms: I) -> Sum {
        terms.fold(Sum::default(), Sum::plus)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_terms_survive_a_large_one() {
        let terms = [1e16, 1.0, 1.0, 1.0, -1e16];
        assert_eq!(terms.into_iter().sum::<Sum>().value(), 3.0);
        let mut sums = Sums::<2>::ZERO;
        terms.into_iter().for_each(|x| sums.add([x, -x]));
        assert_eq!(sums.each().map(Sum::value), [3.0, -3.0]);
        let tenths: Sum = (0..10_000_000).map(|_| 0.1).sum();
        // 0.1 is stored as 0.1 + 5.55e-18.
        assert_eq!(tenths.value(), 1_000_000.0 + 5.551_115_123_125_783e-11);
    }

    #[test]
    fn the_error_of_one_addition_is_exact() {
        let (sum, error) = two_sum(1e100, 1.0);
        assert_eq!((sum, error), (1e100, 1.0));
        let (sum, error) = two_sum(0.1, 0.2);
        assert_eq!((sum, error), (0.300_000_000_000_000_04, -2.775_557_561_562_891_4e-17));
    }
}
