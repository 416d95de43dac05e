//! Sums without rounding.
//!
//! Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates, 1997. A sum is kept as numbers
//! that do not overlap, the largest last, and so grows by a number without loss.

use super::sum::two_sum;

/// A sum of products, exact as long as no product leaves the range of `f64`.
#[derive(Clone, Debug, Default)]
pub struct Exact(Vec<f64>);

impl Exact {
    /// Adds a number. Linear in the numbers kept: 40 at most, mostly fewer than 10.
    pub fn add(&mut self, term: f64) {
        let mut high = term;
        self.0.retain_mut(|part| {
            (high, *part) = two_sum(high, *part);
            *part != 0.0
        });
        if high != 0.0 {
            self.0.push(high);
        }
    }

    /// Adds the product of three numbers.
    pub fn add_product(&mut self, a: f64, b: f64, c: f64) {
        let (high, low) = two_product(a, b);
        for (p, q) in [two_product(low, c), two_product(high, c)] {
            self.add(q);
            self.add(p);
        }
    }

    /// Adds another sum.
    pub fn merge(&mut self, other: &Exact) {
        other.0.iter().for_each(|part| self.add(*part));
    }

    /// −1, 0 or 1.
    pub fn sign(&self) -> i32 {
        self.0.last().map_or(0, |x| if *x > 0.0 { 1 } else { -1 })
    }
}

/// Rounded product of two numbers and what rounding took away.
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    /// Whole numbers of 40 bits: products of three have 120, and the sum of a thousand is known in whole numbers.
    #[test]
    fn equals_the_sum_in_whole_numbers() {
        let random = &mut Random::new(5);
        for last in [-1, 0, 1] {
            let (mut exact, mut whole) = (Exact::default(), 0i128);
            let mut add = |a: i64, b: i64, c: i64| {
                exact.add_product(a as f64, b as f64, c as f64);
                whole += i128::from(a) * i128::from(b) * i128::from(c);
            };
            let factors: Vec<[i64; 3]> =
                (0..500).map(|_| std::array::from_fn(|_| random.below(1 << 40) as i64 - (1 << 39))).collect();
            factors.iter().for_each(|[a, b, c]| add(*a, *b, *c));
            add(last, 1, 1);
            factors.iter().rev().for_each(|[a, b, c]| add(*b, -*a, *c));
            assert_eq!((whole, exact.sign()), (i128::from(last), last as i32));
        }
    }
}
