//! Vector arithmetic behind two small traits, so that every kernel is written once.
//!
//! * [`Lanes`]: `N` single-precision numbers. They only *exclude* triangles, so an implementation may fuse multiply
//!   and add as it likes; the error bounds hold either way.
//! * [`Real`]: one or several double-precision numbers. They make the answer, so each operation is one correctly rounded IEEE
//!   operation, in one order, never fused. A vector of eight gives the same bits as eight scalars, and AVX2, AVX-512 and plain
//!   Rust agree to the last bit.
//!
//! Values come into being only through `splat` and `load`, which are unsafe because they need the instructions. All else is
//! safe on a value that exists. The methods are `inline(always)` and become vector instructions once inlined into a function
//! with the matching `#[target_feature]` (see `answer_items` in the module `query`).
#![expect(unsafe_code, reason = "constructing a vector needs instructions that the processor may lack")]

use std::ops::{Add, Div, Mul, Sub};

/// Addition to division, lane by lane.
pub trait Arithmetic:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
}
impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T> + Div<Output = T>> Arithmetic for T {}

/// `N` lanes of `f32`.
pub trait Lanes<const N: usize>: Arithmetic {
    /// `x` in every lane.
    ///
    /// # Safety
    /// The processor has the instructions of this type.
    unsafe fn splat(x: f32) -> Self;
    /// Lane `i` is `p[i]`.
    ///
    /// # Safety
    /// The processor has the instructions of this type.
    unsafe fn load(p: &[f32; N]) -> Self;
    /// Writes lane `i` to `out[i]`.
    fn store(self, out: &mut [f32; N]);
    /// `self * b + c`
    fn mul_add(self, b: Self, c: Self) -> Self;
    /// `c - self * b`
    fn neg_mul_add(self, b: Self, c: Self) -> Self;
    /// `self * b + c`, rounded once with every type: for kernels whose results must not depend on it. [`mul_add`](Lanes::mul_add) is
    /// rounded twice where the processor has no instruction for it.
    #[inline(always)]
    fn fused(self, b: Self, c: Self) -> Self {
        self.mul_add(b, c)
    }
    /// `c - self * b`, rounded once with every type.
    #[inline(always)]
    fn neg_fused(self, b: Self, c: Self) -> Self {
        self.neg_mul_add(b, c)
    }
    /// Lesser of the two.
    fn min(self, o: Self) -> Self;
    /// Greater of the two.
    fn max(self, o: Self) -> Self;
    /// Bit `i` is set where lane `i` of `self` <= lane `i` of `o`.
    fn le(self, o: Self) -> u32;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Least lane.
    fn least(self) -> f32;
    /// Zero in the lanes where `s < 0`, else `self`.
    fn zero_where_negative(self, s: Self) -> Self;
    /// `self` in the lanes whose bit in `mask` is set, zero in the others.
    fn keep(self, mask: u32) -> Self;
    /// The lanes as an array.
    #[inline(always)]
    fn array(self) -> [f32; N] {
        let mut out = [0.0; N];
        self.store(&mut out);
        out
    }
    /// Bit `i` is set where integer `i` is negative.
    ///
    /// # Safety
    /// The processor has the instructions of this type.
    unsafe fn negative(p: &[i32; N]) -> u32 {
        (0..N).fold(0, |m, i| m | ((p[i] < 0) as u32) << i)
    }
    /// Writes the pairs `(tag, p[i])` for the set bits of `mask` to `out`, and clobbers the rest of `N` places.
    ///
    /// # Safety
    /// The processor has the instructions of this type, and `out` has room for `N`.
    unsafe fn compress(mut mask: u32, tag: i32, p: &[i32; N], out: *mut [i32; 2]) {
        let mut n = 0;
        while mask != 0 {
            unsafe { out.add(n).write([tag, p[mask.trailing_zeros() as usize]]) };
            mask &= mask - 1;
            n += 1;
        }
    }
}

/// One or several `f64`; every method is one IEEE operation per lane.
pub trait Real: Arithmetic {
    /// The outcome of a comparison, lane by lane.
    type Mask: Copy;
    /// Lanes in this type, at most 8.
    const LANES: usize;
    /// `x` in every lane.
    ///
    /// # Safety
    /// The processor has the instructions of this type.
    unsafe fn splat(x: f64) -> Self;
    /// The first `N` of `p`.
    ///
    /// # Safety
    /// The processor has the instructions of this type.
    unsafe fn load(p: &[f64; 8]) -> Self;
    /// Writes the lanes to the first `N` of `out`.
    fn store(self, out: &mut [f64; 8]);
    /// `self < o ? self : o`
    fn least(self, o: Self) -> Self;
    /// `self > o ? self : o`
    fn most(self, o: Self) -> Self;
    /// `self > o`
    fn above(self, o: Self) -> Self::Mask;
    /// `self >= o`
    fn at_least(self, o: Self) -> Self::Mask;
    /// Both.
    fn both(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// `m ? a : b`
    fn select(m: Self::Mask, a: Self, b: Self) -> Self;
}

/// Plain Rust lanes: the fallback, and the twin that the vector versions are tested against.
#[derive(Clone, Copy)]
pub struct Plain<const N: usize>([f32; N]);

impl<const N: usize> Plain<N> {
    #[inline(always)]
    fn zip(self, o: Self, f: impl Fn(f32, f32) -> f32) -> Self {
        Plain(std::array::from_fn(|i| f(self.0[i], o.0[i])))
    }
}

/// Writes the operators of [`Plain`].
macro_rules! operators {
    ($($op:ident $name:ident $sign:tt),*) => { $(
        impl<const N: usize> $op for Plain<N> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, o: Self) -> Self {
                self.zip(o, |a, b| a $sign b)
            }
        }
    )* };
}
operators!(Add add +, Sub sub -, Mul mul *, Div div /);

impl<const N: usize> Lanes<N> for Plain<N> {
    #[inline(always)]
    unsafe fn splat(x: f32) -> Self {
        Plain([x; N])
    }
    #[inline(always)]
    unsafe fn load(p: &[f32; N]) -> Self {
        Plain(*p)
    }
    #[inline(always)]
    fn store(self, out: &mut [f32; N]) {
        *out = self.0;
    }
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }
    #[inline(always)]
    fn neg_mul_add(self, b: Self, c: Self) -> Self {
        c - self * b
    }
    #[inline(always)]
    fn fused(self, b: Self, c: Self) -> Self {
        Plain(std::array::from_fn(|i| fused(self.0[i], b.0[i], c.0[i])))
    }
    #[inline(always)]
    fn neg_fused(self, b: Self, c: Self) -> Self {
        Plain(std::array::from_fn(|i| fused(-self.0[i], b.0[i], c.0[i])))
    }
    #[inline(always)]
    fn min(self, o: Self) -> Self {
        self.zip(o, |a, b| if a < b { a } else { b })
    }
    #[inline(always)]
    fn max(self, o: Self) -> Self {
        self.zip(o, |a, b| if a > b { a } else { b })
    }
    #[inline(always)]
    fn le(self, o: Self) -> u32 {
        (0..N).fold(0, |m, i| m | (((self.0[i] <= o.0[i]) as u32) << i))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Plain(self.0.map(f32::sqrt))
    }
    #[inline(always)]
    fn least(self) -> f32 {
        self.0.iter().fold(f32::INFINITY, |m, &x| if x < m { x } else { m })
    }
    #[inline(always)]
    fn zero_where_negative(self, s: Self) -> Self {
        self.zip(s, |a, s| if s < 0.0 { 0.0 } else { a })
    }
    #[inline(always)]
    fn keep(self, mask: u32) -> Self {
        Plain(std::array::from_fn(|i| if mask >> i & 1 != 0 { self.0[i] } else { 0.0 }))
    }
}

/// `a * b + c`, rounded once. The product is exact in double precision. The sum is rounded to odd there, so that rounding it
/// once more is as rounding once. (Boldo & Melquiond 2008, "Emulation of a FMA and correctly rounded sums".)
#[inline(always)]
fn fused(a: f32, b: f32, c: f32) -> f32 {
    let (p, c) = (f64::from(a) * f64::from(b), f64::from(c));
    let sum = p + c;
    // The part that rounding of the sum has lost, exactly.
    let back = sum - p;
    let lost = (p - (sum - back)) + (c - back);
    let bits = sum.to_bits();
    // An even sum that lost something goes to its odd neighbor on that side.
    let away = (lost > 0.0) == (sum > 0.0);
    let odd = if away { bits.wrapping_add(1) } else { bits.wrapping_sub(1) };
    let is_inexact = lost.abs() > 0.0 && bits & 1 == 0;
    f64::from_bits(if is_inexact { odd } else { bits }) as f32
}

impl Real for f64 {
    type Mask = bool;
    const LANES: usize = 1;
    #[inline(always)]
    unsafe fn splat(x: f64) -> f64 {
        x
    }
    #[inline(always)]
    unsafe fn load(p: &[f64; 8]) -> f64 {
        p[0]
    }
    #[inline(always)]
    fn store(self, out: &mut [f64; 8]) {
        out[0] = self;
    }
    #[inline(always)]
    fn least(self, o: f64) -> f64 {
        if self < o { self } else { o }
    }
    #[inline(always)]
    fn most(self, o: f64) -> f64 {
        if self > o { self } else { o }
    }
    #[inline(always)]
    fn above(self, o: f64) -> bool {
        self > o
    }
    #[inline(always)]
    fn at_least(self, o: f64) -> bool {
        self >= o
    }
    #[inline(always)]
    fn both(a: bool, b: bool) -> bool {
        a & b
    }
    #[inline(always)]
    fn select(m: bool, a: f64, b: f64) -> f64 {
        if m { a } else { b }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    /// Compared with the mathematics library, on numbers whose sums lie at or near the middle between two others. Subnormal
    /// numbers are tried too, and those that are not finite.
    #[test]
    fn plain_fused_rounds_once() {
        let random = &mut Random::new(3);
        let mut any = |bits: u32| {
            let few = random.below(1 << bits) as u32;
            f32::from_bits(
                few << (23 - bits) | (random.below(60) as u32 + 97) << 23 | (random.below(2) as u32) << 31,
            )
        };
        let check = |a: f32, b: f32, c: f32| {
            let (own, once) = (fused(a, b, c), a.mul_add(b, c));
            assert!(
                own.to_bits() == once.to_bits() || own.is_nan() && once.is_nan(),
                "{a:e} {b:e} {c:e}: {own:e} {once:e}"
            );
        };
        let mut differs = 0;
        for round in 0..400_000 {
            let bits = [1, 4, 12, 22][round % 4];
            let (a, b, c) = (any(bits), any(23 - bits), any(1 + bits));
            check(a, b, c);
            differs += usize::from(fused(a, b, c) != a * b + c);
            check(a * 1e-30, b * 1e-9, c * f32::MIN_POSITIVE);
        }
        assert!(differs > 10_000, "{differs}");
        for special in [0.0, -0.0, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, f32::MAX, f32::MIN_POSITIVE] {
            for (b, c) in [(2.0, 1.0), (0.0, special), (special, 1.0), (-1.0, special), (special, special)] {
                check(special, b, c);
            }
        }
    }
}
