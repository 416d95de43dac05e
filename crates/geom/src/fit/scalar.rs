//! One text of each formula for single numbers and for four numbers at a time.
//!
//! Only operations that IEEE 754 rounds alike everywhere are used (no fused multiply-add): the sums are the
//! same bits with wide registers and without.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Points evaluated side by side.
pub(super) const LANES: usize = 4;

/// A number, or several side by side.
pub(super) trait Scalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// `x` in every lane.
    fn of(x: f64) -> Self;
    /// Square root, lane by lane.
    fn root(self) -> Self;
    /// The greater, lane by lane.
    fn at_least(self, floor: Self) -> Self;
    /// The magnitude of `self` with the sign of `other`, lane by lane.
    fn signed_as(self, other: Self) -> Self;
}

impl Scalar for f64 {
    #[inline(always)]
    fn of(x: f64) -> f64 {
        x
    }
    #[inline(always)]
    fn root(self) -> f64 {
        self.sqrt()
    }
    #[inline(always)]
    fn at_least(self, floor: f64) -> f64 {
        if self > floor { self } else { floor }
    }
    #[inline(always)]
    fn signed_as(self, other: f64) -> f64 {
        self.copysign(other)
    }
}

/// [`LANES`] numbers side by side, one wide register where the processor has it.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(super) struct Lane(pub [f64; LANES]);

impl Lane {
    /// `f` of each lane of both.
    #[inline(always)]
    pub(super) fn zip(self, other: Lane, f: impl Fn(f64, f64) -> f64) -> Lane {
        Lane(std::array::from_fn(|k| f(self.0[k], other.0[k])))
    }
    /// Sum over the lanes, always in the same order.
    #[inline(always)]
    pub(super) fn sum(self) -> f64 {
        (self.0[0] + self.0[1]) + (self.0[2] + self.0[3])
    }
}

impl Add for Lane {
    type Output = Lane;
    #[inline(always)]
    fn add(self, other: Lane) -> Lane {
        self.zip(other, |a, b| a + b)
    }
}
impl Sub for Lane {
    type Output = Lane;
    #[inline(always)]
    fn sub(self, other: Lane) -> Lane {
        self.zip(other, |a, b| a - b)
    }
}
impl Mul for Lane {
    type Output = Lane;
    #[inline(always)]
    fn mul(self, other: Lane) -> Lane {
        self.zip(other, |a, b| a * b)
    }
}
impl Div for Lane {
    type Output = Lane;
    #[inline(always)]
    fn div(self, other: Lane) -> Lane {
        self.zip(other, |a, b| a / b)
    }
}
impl Neg for Lane {
    type Output = Lane;
    #[inline(always)]
    fn neg(self) -> Lane {
        Lane(self.0.map(|a| -a))
    }
}
impl Scalar for Lane {
    #[inline(always)]
    fn of(x: f64) -> Lane {
        Lane([x; LANES])
    }
    #[inline(always)]
    fn root(self) -> Lane {
        Lane(self.0.map(f64::sqrt))
    }
    #[inline(always)]
    fn at_least(self, floor: Lane) -> Lane {
        self.zip(floor, |a, b| if a > b { a } else { b })
    }
    #[inline(always)]
    fn signed_as(self, other: Lane) -> Lane {
        self.zip(other, f64::copysign)
    }
}
