//! The boundary of a plane feature, seen along its normal.

use crate::space::{Point, Vector, cross, dot, least_axis, minus, plus, times, unit};

/// A simple polygon in its plane.
pub(super) struct Polygon {
    origin: Point,
    axes: [Vector; 2],
    corners: Vec<[f64; 2]>,
}

impl Polygon {
    /// The projection of `boundary` along `normal` onto the plane through `origin`; `None` where it encloses nothing.
    pub(super) fn new(origin: Point, normal: Vector, boundary: &[Point]) -> Option<Polygon> {
        let (normal, _) = unit(normal)?;
        let least = least_axis(normal);
        let (u, _) = unit(minus(least, times(dot(least, normal), normal)))?;
        let mut polygon = Polygon { origin, axes: [u, cross(normal, u)], corners: vec![] };
        polygon.corners = boundary.iter().map(|p| polygon.flat(*p)).collect();
        (polygon.corners.len() >= 3 && polygon.area() > 0.0 && polygon.area().is_finite()).then_some(polygon)
    }

    fn flat(&self, p: Point) -> [f64; 2] {
        self.axes.map(|axis| dot(minus(p, self.origin), axis))
    }

    fn lifted(&self, [x, y]: [f64; 2]) -> Point {
        plus(self.origin, plus(times(x, self.axes[0]), times(y, self.axes[1])))
    }

    fn sides(&self) -> impl Iterator<Item = [[f64; 2]; 2]> {
        let n = self.corners.len();
        (0..n).map(move |k| [self.corners[k], self.corners[(k + 1) % n]])
    }

    /// Area.
    pub(super) fn area(&self) -> f64 {
        let twice: f64 = self.sides().map(|[a, b]| a[0] * b[1] - b[0] * a[1]).sum();
        0.5 * twice.abs()
    }

    /// Whether the projection of `p` lies inside, at least `margin` from the boundary, or, for a margin below zero, at most so
    /// far outside. The boundary itself is inside, to rounding.
    pub(super) fn holds(&self, p: Point, margin: f64) -> bool {
        let greatest = |m: f64, c: &[f64; 2]| m.max(c[0].abs()).max(c[1].abs());
        let rounding = 1e-12 * self.corners.iter().fold(0.0, greatest);
        let within = self.within(p);
        if margin > 0.0 { within >= margin } else { within >= -rounding.max(-margin) }
    }

    /// How far the projection of `p` lies inside of the boundary; below zero outside of it.
    pub(super) fn within(&self, p: Point) -> f64 {
        let q = self.flat(p);
        let mut inside = false;
        let mut near = f64::INFINITY;
        for [a, b] in self.sides() {
            if (a[1] > q[1]) != (b[1] > q[1]) {
                let crossing = a[0] + (q[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
                inside ^= q[0] < crossing;
            }
            near = near.min(to_side(q, a, b));
        }
        if inside { near } else { -near }
    }

    fn range(&self, k: usize) -> [f64; 2] {
        let each = || self.corners.iter().map(|c| c[k]);
        [each().fold(f64::INFINITY, f64::min), each().fold(f64::NEG_INFINITY, f64::max)]
    }

    /// The corners of the rectangle around it that reaches so far beyond.
    pub(super) fn around(&self, beyond: f64) -> [Point; 4] {
        let [x, y] = [self.range(0), self.range(1)].map(|[low, high]| [low - beyond, high + beyond]);
        [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]].map(|q| self.lifted(q))
    }

    /// Places inside, on a grid of 5 × 5 over the rectangle.
    pub(super) fn places(&self) -> Vec<Point> {
        /// Places along each side of the grid.
        const GRID_SIDE: usize = 5;
        let (x, y) = (self.range(0), self.range(1));
        let at = |[low, high]: [f64; 2], i: usize| low + (high - low) * (i as f64 + 0.5) / GRID_SIDE as f64;
        let cells =
            (0..GRID_SIDE * GRID_SIDE).map(|n| self.lifted([at(x, n % GRID_SIDE), at(y, n / GRID_SIDE)]));
        cells.filter(|p| self.within(*p) >= 0.0).collect()
    }
}

fn to_side(q: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [q[0] - a[0], q[1] - a[1]]);
    let length = u[0] * u[0] + u[1] * u[1];
    let t = if length > 0.0 { ((u[0] * v[0] + u[1] * v[1]) / length).clamp(0.0, 1.0) } else { 0.0 };
    libm::hypot(v[0] - t * u[0], v[1] - t * u[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An L-shaped boundary on a tilted plane: its area, its inside, its margin.
    #[test]
    fn an_l_on_a_slope() {
        let lift = |x: f64, y: f64| [x, y, 0.75 * x];
        let corners = [(0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)];
        let boundary: Vec<Point> = corners.iter().map(|c| lift(c.0, c.1)).collect();
        let polygon = Polygon::new([0.0; 3], [-0.75, 0.0, 1.0], &boundary).unwrap();
        assert!((polygon.area() - 6.0 * 1.25).abs() < 1e-12);
        // Along the slope 0.5 is 0.625.
        assert!(polygon.holds(lift(0.5, 2.5), 0.0) && polygon.holds(lift(3.5, 0.5), 0.49));
        assert!(!polygon.holds(lift(2.0, 2.0), 0.0) && !polygon.holds(lift(3.5, 0.5), 0.51));
        assert!((polygon.within(lift(0.25, 2.0)) - 0.3125).abs() < 1e-12);
        assert!(polygon.holds(lift(-0.1, 1.0), -0.13) && !polygon.holds(lift(-0.1, 1.0), -0.12));
        assert!(polygon.holds(lift(0.0, 3.0), 0.0) && !polygon.holds(lift(-0.1, 1.0), 0.0));
        assert!(Polygon::new([0.0; 3], [0.0, 0.0, 1.0], &boundary[..2]).is_none());
    }
}
