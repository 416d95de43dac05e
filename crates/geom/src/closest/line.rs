//! Where a line meets a triangle. Whether it does is decided exactly, so no line slips through between two neighbors.
//!
//! The side on which the line passes an edge is the sign of `d · ((a - p) × (b - p))`. It is rounded where that is beyond
//! doubt, else a sum without rounding. (J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
//! Predicates", 1997.) Two triangles that share an edge see it with opposite signs. The place follows from the sizes of the
//! three products, as a mean of the corners, so it never leaves the triangle. (T. Möller and B. Trumbore, "Fast, minimum
//! storage ray-triangle intersection", 1997.)

use crate::num::exact::Exact;
use crate::space::{Point, Vector, cross, dot, minus, times, unit};

/// A line through a point, both ways.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// Where distances along it begin.
    pub point: Point,
    /// Length 1; components below [`MIN_DIRECTION_COMPONENT`] are zero.
    pub direction: Vector,
}

/// Smaller components of a direction count as zero: their products would leave the range of numbers.
const MIN_DIRECTION_COMPONENT: f64 = 1e-30;

/// Bound of the rounding of an edge's product, as a share of the sum of its terms' sizes. Shewchuk's for the same seven
/// roundings is 7.8e-16.
const EDGE_PRODUCT_ROUNDING: f64 = 1e-15;

/// Where a line meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// How far along the line's direction, negative behind its point, millimeters.
    pub along: f64,
    /// Weights of the corners.
    pub weights: [f64; 3],
}

impl Line {
    /// `None` for a direction without length or that is no number.
    pub fn new(point: Point, direction: Vector) -> Option<Line> {
        let (d, _) = unit(direction)?;
        let direction = d.map(|x| if x.abs() < MIN_DIRECTION_COMPONENT { 0.0 } else { x });
        Some(Line { point, direction })
    }

    /// Where it meets a triangle, its rim included; `None` also for a triangle that is seen edge on. Accurate to a few roundings
    /// of the distance, times the slope of the triangle where the line grazes it.
    pub fn meeting(&self, [a, b, c]: &[Point; 3]) -> Option<Meeting> {
        let sides = [self.side(b, c), self.side(c, a), self.side(a, b)];
        let any = |sign: f64| sides.iter().any(|s| s.0 == sign);
        if any(1.0) == any(-1.0) {
            return None;
        }
        // A sign that rounding would have turned stands for next to nothing.
        let size = sides.map(|(sign, product)| (sign * product).max(0.0));
        let sum: f64 = size.iter().sum();
        let weights = match sum.is_normal() {
            true => size.map(|s| s / sum),
            false => {
                let weights = sides.map(|(sign, _)| sign.abs());
                times(1.0 / weights.iter().sum::<f64>(), weights)
            }
        };
        let along = [a, b, c].map(|x| dot(self.direction, minus(*x, self.point)));
        Some(Meeting { along: dot(weights, along), weights })
    }

    /// The sign (−1, 0, 1) of the side on which it passes the edge from `a` to `b`, exact, and the rounded product.
    fn side(&self, a: &Point, b: &Point) -> (f64, f64) {
        let (u, v, d) = (minus(*a, self.point), minus(*b, self.point), self.direction);
        let product = dot(d, cross(u, v));
        let terms = |k: usize| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            d[k].abs() * ((u[i] * v[j]).abs() + (u[j] * v[i]).abs())
        };
        let bound = EDGE_PRODUCT_ROUNDING * (terms(0) + terms(1) + terms(2));
        let sign = match product.abs() > bound {
            true => product.signum(),
            false => self.exact_side(a, b),
        };
        (sign, product)
    }

    /// The same without rounding: `d · (a × b + p × a + b × p)`.
    #[cold]
    fn exact_side(&self, a: &Point, b: &Point) -> f64 {
        let mut sum = Exact::default();
        for [u, v] in [[a, b], [&self.point, a], [b, &self.point]] {
            for (k, d) in self.direction.into_iter().enumerate() {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                sum.add_product(u[i], v[j], d);
                sum.add_product(-u[j], v[i], d);
            }
        }
        f64::from(sum.sign())
    }
}
