//! Numbers as long as they need to be: what decides where rounding would.
//!
//! A number is a whole number in base 2^64 with a sign, times a power of that base. Sums, differences and products are
//! exact, whatever the magnitudes; every finite `f64` is one. There is no division: a quotient is only ever asked for as the
//! two neighboring `f64` around it.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Sub};

/// ± Σ `limbs[i]` · 2^(64 (i + `exponent`)). Neither the first nor the last limb is zero; the number 0 has none.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Big {
    negative: bool,
    exponent: i32,
    limbs: Vec<u64>,
}

impl Big {
    /// A finite number; 0 for any other.
    pub fn of(x: f64) -> Big {
        let bits = x.to_bits();
        let (raw, fraction) = ((bits >> 52 & 0x7FF) as i32, bits & ((1 << 52) - 1));
        if raw == 0x7FF {
            return Big::default();
        }
        let (mantissa, power) = if raw == 0 { (fraction, -1074) } else { (fraction | 1 << 52, raw - 1075) };
        let shifted = u128::from(mantissa) << power.rem_euclid(64);
        Big {
            negative: x < 0.0,
            exponent: power.div_euclid(64),
            limbs: vec![shifted as u64, (shifted >> 64) as u64],
        }
        .trimmed()
    }

    /// −1, 0 or 1.
    pub fn sign(&self) -> i32 {
        match (self.limbs.is_empty(), self.negative) {
            (true, _) => 0,
            (false, true) => -1,
            (false, false) => 1,
        }
    }

    /// The same number with the other sign.
    pub fn negated(mut self) -> Big {
        self.negative = !self.negative && !self.limbs.is_empty();
        self
    }

    fn trimmed(mut self) -> Big {
        let zeros_above = self.limbs.iter().rev().take_while(|l| **l == 0).count();
        self.limbs.truncate(self.limbs.len() - zeros_above);
        let zeros_below = self.limbs.iter().take_while(|l| **l == 0).count();
        self.limbs.drain(..zeros_below);
        self.exponent += zeros_below as i32;
        if self.limbs.is_empty() {
            return Big::default();
        }
        self
    }

    /// One past the power of the highest limb.
    fn top(&self) -> i32 {
        self.exponent + self.limbs.len() as i32
    }

    /// The limb of power `power`.
    fn limb(&self, power: i32) -> u64 {
        usize::try_from(power - self.exponent).ok().and_then(|i| self.limbs.get(i)).copied().unwrap_or(0)
    }

    fn compare_magnitude(&self, o: &Big) -> Ordering {
        match (self.limbs.is_empty(), o.limbs.is_empty()) {
            (false, false) => {}
            (a, b) => return b.cmp(&a),
        }
        let low = self.exponent.min(o.exponent);
        self.top().cmp(&o.top()).then_with(|| {
            let powers = (low..self.top()).rev();
            powers.map(|p| self.limb(p).cmp(&o.limb(p))).find(|c| c.is_ne()).unwrap_or(Ordering::Equal)
        })
    }

    /// Sum of this number and `o`, the sign of which is taken to be `negative`.
    fn sum(&self, o: &Big, negative: bool) -> Big {
        if o.limbs.is_empty() {
            return self.clone();
        }
        if self.limbs.is_empty() {
            return Big { negative, ..o.clone() };
        }
        let exponent = self.exponent.min(o.exponent);
        if self.negative == negative {
            let top = self.top().max(o.top());
            let mut carry = 0;
            let limb = |p: i32| {
                let sum = u128::from(self.limb(p)) + u128::from(o.limb(p)) + carry;
                carry = sum >> 64;
                sum as u64
            };
            return Big { negative, exponent, limbs: (exponent..=top).map(limb).collect() }.trimmed();
        }
        let (large, small, negative) = match self.compare_magnitude(o) {
            Ordering::Equal => return Big::default(),
            Ordering::Greater => (self, o, self.negative),
            Ordering::Less => (o, self, negative),
        };
        let mut borrow = false;
        let limb = |p: i32| {
            let (d, first) = large.limb(p).overflowing_sub(small.limb(p));
            let (d, second) = d.overflowing_sub(u64::from(borrow));
            borrow = first || second;
            d
        };
        Big { negative, exponent, limbs: (exponent..large.top()).map(limb).collect() }.trimmed()
    }

    /// Good to some 60 bits: a number of up to 128 bits, and the power of 2^64 that it is to be multiplied with.
    fn rough(&self) -> (f64, i32) {
        /// Values of one limb.
        const LIMB_BASE: f64 = 18_446_744_073_709_551_616.0;
        let high = self.limb(self.top() - 1) as f64 * LIMB_BASE + self.limb(self.top() - 2) as f64;
        (if self.negative { -high } else { high }, self.top() - 2)
    }

    /// The two neighboring numbers around `x / w`, or twice the same one if the quotient is a number. It depends on
    /// the value of the quotient alone. `w` is not zero, and the quotient in the range of `f64`.
    pub fn quotient(x: &Big, w: &Big) -> [f64; 2] {
        if x.sign() == 0 || w.sign() == 0 {
            return [0.0; 2];
        }
        let ((a, p), (b, q)) = (x.rough(), w.rough());
        let step = if p > q { 64 } else { -64 };
        let rough = (0..(p - q).abs().min(64)).fold(a / b, |x, _| x * 2f64.powi(step));
        let mut low = rough.clamp(-f64::MAX, f64::MAX);
        // Is the quotient above the number (1), below it (-1), or the number?
        let side = |number: f64| (x - &(&Big::of(number) * w)).sign() * w.sign();
        let mut at = side(low);
        while at < 0 && low > -f64::MAX {
            low = low.next_down();
            at = side(low);
        }
        loop {
            let high = low.next_up();
            if at == 0 || high == f64::INFINITY {
                return [low + 0.0; 2];
            }
            match side(high) {
                -1 => return [low, high],
                next => (low, at) = (high, next),
            }
        }
    }
}

impl Add for &Big {
    type Output = Big;
    fn add(self, o: &Big) -> Big {
        self.sum(o, o.negative)
    }
}

impl Sub for &Big {
    type Output = Big;
    fn sub(self, o: &Big) -> Big {
        self.sum(o, !o.negative)
    }
}

impl Mul for &Big {
    type Output = Big;
    fn mul(self, o: &Big) -> Big {
        if self.limbs.is_empty() || o.limbs.is_empty() {
            return Big::default();
        }
        let mut limbs = vec![0u64; self.limbs.len() + o.limbs.len()];
        for (i, a) in self.limbs.iter().enumerate() {
            let mut carry = 0u128;
            for (j, b) in o.limbs.iter().enumerate() {
                let sum = u128::from(*a) * u128::from(*b) + u128::from(limbs[i + j]) + carry;
                limbs[i + j] = sum as u64;
                carry = sum >> 64;
            }
            limbs[i + o.limbs.len()] = carry as u64;
        }
        Big { negative: self.negative != o.negative, exponent: self.exponent + o.exponent, limbs }.trimmed()
    }
}

/// The vector product.
pub fn cross(a: &[Big; 3], b: &[Big; 3]) -> [Big; 3] {
    let part = |i: usize, j: usize| &(&a[i] * &b[j]) - &(&a[j] * &b[i]);
    [part(1, 2), part(2, 0), part(0, 1)]
}

/// The scalar product.
pub fn dot(a: &[Big; 3], b: &[Big; 3]) -> Big {
    &(&(&a[0] * &b[0]) + &(&a[1] * &b[1])) + &(&a[2] * &b[2])
}

/// Difference of two places.
pub fn minus(a: [f64; 3], b: [f64; 3]) -> [Big; 3] {
    std::array::from_fn(|k| &Big::of(a[k]) - &Big::of(b[k]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;
    use num_bigint::BigInt;

    /// The number times 2^2200, which makes it whole.
    fn whole(x: &Big) -> BigInt {
        let mut sum = BigInt::from(0);
        for (i, limb) in x.limbs.iter().enumerate() {
            sum += BigInt::from(*limb) << (64 * (i as i32 + x.exponent) + 2240) as usize;
        }
        if x.negative { -sum } else { sum }
    }

    fn any(random: &mut Random) -> f64 {
        let x = (2.0 * random.unit() - 1.0) * 2f64.powi(random.below(120) as i32 - 60);
        if random.below(8) == 0 { 0.0 } else { x }
    }

    #[test]
    fn sums_and_products_are_those_of_whole_numbers() {
        let random = &mut Random::new(11);
        for _ in 0..3000 {
            let [a, b, c, d] = [(); 4].map(|()| Big::of(any(random)));
            let (ab, cd) = (&a * &b, &c * &d);
            let scale = BigInt::from(1) << 2240usize;
            assert_eq!(whole(&ab) * &scale, whole(&a) * whole(&b));
            assert_eq!(whole(&(&ab - &cd)), whole(&ab) - whole(&cd));
            assert_eq!(whole(&(&ab + &c)), whole(&ab) + whole(&c));
            assert_eq!((&ab - &ab).sign(), 0);
            assert_eq!(
                (&ab - &cd).sign(),
                i32::from((whole(&ab) > whole(&cd)) as i8 - (whole(&ab) < whole(&cd)) as i8)
            );
        }
        for x in [0.0, -0.0, 5e-324, -f64::MAX, f64::MIN_POSITIVE, 1.0, 0.1] {
            assert_eq!(Big::quotient(&Big::of(x), &Big::of(1.0)), [x + 0.0; 2]);
        }
    }

    #[test]
    fn quotients_are_enclosed_by_neighbors() {
        let random = &mut Random::new(12);
        for _ in 0..3000 {
            let [a, b, c] = [(); 3].map(|()| any(random));
            if b == 0.0 || c == 0.0 {
                continue;
            }
            // The same quotient, whatever it is written as.
            let (x, w) = (&Big::of(a) * &Big::of(c), &Big::of(b) * &Big::of(c));
            let [low, high] = Big::quotient(&x, &w);
            assert_eq!([low, high], Big::quotient(&Big::of(a), &Big::of(b)));
            assert!(low <= a / b && a / b <= high && (low == high || low.next_up() == high));
            if low == high {
                assert_eq!(&Big::of(low) * &w, x);
            }
        }
    }
}
