//! The values that a spline combines: anything that can be added and multiplied by a number.
//!
//! Weights that sum to 1 make a point of points, weights that sum to 0 a vector. A point with its mass is a vector of one more
//! dimension (the Grassmann space). Combining mass points needs no rule about the sum of the weights, and one division finds
//! the place at the end.

/// Values that can be combined linearly.
pub trait Value: Copy {
    /// The neutral element of addition.
    const ZERO: Self;
    /// `self + weight · other`.
    fn plus(self, weight: f64, other: Self) -> Self;
    /// Greatest magnitude of a coordinate.
    fn size(self) -> f64;
    /// `(1 − t) · self + t · other`: the linear interpolation all pyramids are made of.
    fn between(self, t: f64, other: Self) -> Self {
        Self::ZERO.plus(1.0 - t, self).plus(t, other)
    }
    /// `weight · self`.
    fn times(self, weight: f64) -> Self {
        Self::ZERO.plus(weight, self)
    }
    /// `self − other`.
    fn minus(self, other: Self) -> Self {
        self.plus(-1.0, other)
    }
}

impl<const D: usize> Value for [f64; D] {
    const ZERO: Self = [0.0; D];
    #[inline]
    fn plus(self, weight: f64, other: Self) -> Self {
        std::array::from_fn(|k| self[k] + weight * other[k])
    }
    fn size(self) -> f64 {
        self.iter().fold(0.0, |m, x| m.max(x.abs()))
    }
}

/// A place with its mass: the place is `moment / mass`. Without mass it is a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mass<const D: usize> {
    /// Place times mass.
    pub moment: [f64; D],
    /// The mass; the weight of a NURBS control point.
    pub mass: f64,
}

impl<const D: usize> Mass<D> {
    /// The point `place` with this mass.
    pub fn new(place: [f64; D], mass: f64) -> Mass<D> {
        Mass { moment: place.map(|x| x * mass), mass }
    }
    /// Where it is, or `None` without mass.
    pub fn place(&self) -> Option<[f64; D]> {
        let place = self.moment.map(|x| x / self.mass);
        place.iter().all(|x| x.is_finite()).then_some(place)
    }
}

impl<const D: usize> Value for Mass<D> {
    const ZERO: Self = Mass { moment: [0.0; D], mass: 0.0 };
    #[inline]
    fn plus(self, weight: f64, other: Self) -> Self {
        Mass { moment: self.moment.plus(weight, other.moment), mass: self.mass + weight * other.mass }
    }
    fn size(self) -> f64 {
        self.moment.size().max(self.mass.abs())
    }
}
