//! Positions as whole numbers on one cubic grid.

use trueness_geom::space::{Aabb, Point};

/// A cubic grid: the place of `q` is `origin + step · q`, with `origin` in full `f64`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Place of the grid's zero, millimeters.
    pub origin: Point,
    /// Distance of neighboring grid points along an axis, millimeters; above 0.
    pub step: f64,
    /// Greatest coordinate.
    last: f64,
}

impl Grid {
    /// The finest grid of `bits` bits a coordinate over a box. Around a single point or an empty box the step is tiny or 1.
    pub fn over(bounds: &Aabb, bits: u32) -> Grid {
        let last = f64::from((1u32 << bits) - 1);
        let longest = bounds.sides().into_iter().fold(0.0, f64::max);
        let step = longest / last;
        let origin = if bounds.is_empty() { [0.0; 3] } else { bounds.min };
        Grid { origin, step: if step > 0.0 && step.is_finite() { step } else { 1.0 }, last }
    }

    /// The nearest grid point. A coordinate outside or NaN goes to the grid's rim.
    pub fn place(&self, p: &Point) -> [u16; 3] {
        std::array::from_fn(|k| ((p[k] - self.origin[k]) / self.step).round().clamp(0.0, self.last) as u16)
    }

    /// Farthest that rounding can move a point of the box, millimeters.
    pub fn error(&self) -> f64 {
        0.5 * self.step * 3f64.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_stays_within_half_a_step() {
        let points = [[1e6, 0.0, -3.0], [1e6 + 80.0, 20.0, 7.5], [1e6 + 33.3, 1.25, 0.1]];
        for bits in [14, 16] {
            let g = Grid::over(&Aabb::of(&points), bits);
            for p in &points {
                let q = g.place(p);
                for k in 0..3 {
                    assert!(
                        (g.origin[k] + g.step * f64::from(q[k]) - p[k]).abs() <= 0.5 * g.step * 1.000_001
                    );
                }
            }
            assert_eq!(u32::from(g.place(&points[1])[0]), (1u32 << bits) - 1);
        }
    }

    #[test]
    fn one_point_and_none() {
        assert_eq!(Grid::over(&Aabb::of(&[[5.0; 3]]), 16).place(&[5.0; 3]), [0; 3]);
        assert_eq!(Grid::over(&Aabb::EMPTY, 16).step, 1.0);
    }
}
