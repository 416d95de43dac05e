//! Numbers that carry their derivatives: automatic differentiation, forward mode.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Most unknowns of any element.
const MOST: usize = 7;

/// A number and its derivatives by the unknowns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dual {
    pub value: f64,
    pub slope: [f64; MOST],
}

impl Dual {
    /// A number that does not change.
    pub(super) fn fixed(value: f64) -> Dual {
        Dual { value, slope: [0.0; MOST] }
    }
    /// Unknown number `k`, at `value`.
    pub(super) fn unknown(value: f64, k: usize) -> Dual {
        Dual { value, slope: std::array::from_fn(|i| f64::from(i == k)) }
    }
    /// f(self), given f and its derivative there.
    fn chain(self, value: f64, derivative: f64) -> Dual {
        Dual { value, slope: self.slope.map(|x| derivative * x) }
    }
    pub(super) fn sqrt(self) -> Dual {
        let root = self.value.sqrt();
        self.chain(root, 0.5 / root)
    }
    pub(super) fn sin(self) -> Dual {
        self.chain(self.value.sin(), self.value.cos())
    }
    pub(super) fn cos(self) -> Dual {
        self.chain(self.value.cos(), -self.value.sin())
    }
    fn both(self, other: Dual, value: f64, by: [f64; 2]) -> Dual {
        Dual { value, slope: std::array::from_fn(|k| by[0] * self.slope[k] + by[1] * other.slope[k]) }
    }
}

impl Add for Dual {
    type Output = Dual;
    fn add(self, o: Dual) -> Dual {
        self.both(o, self.value + o.value, [1.0, 1.0])
    }
}
impl Sub for Dual {
    type Output = Dual;
    fn sub(self, o: Dual) -> Dual {
        self.both(o, self.value - o.value, [1.0, -1.0])
    }
}
impl Mul for Dual {
    type Output = Dual;
    fn mul(self, o: Dual) -> Dual {
        self.both(o, self.value * o.value, [o.value, self.value])
    }
}
impl Div for Dual {
    type Output = Dual;
    fn div(self, o: Dual) -> Dual {
        self.both(o, self.value / o.value, [1.0 / o.value, -self.value / (o.value * o.value)])
    }
}
impl Neg for Dual {
    type Output = Dual;
    fn neg(self) -> Dual {
        Dual::fixed(0.0) - self
    }
}
