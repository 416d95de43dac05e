//! The boundary of a plane feature, seen in the coordinate plane in which it is largest.

use crate::space::{Point, Vector};

/// A simple polygon in the plane of two coordinates.
pub(super) struct Polygon {
    axes: [usize; 2],
    corners: Vec<[f64; 2]>,
    /// Area of the plane for one of its projection.
    stretch: f64,
}

impl Polygon {
    /// The projection of `boundary` along the largest coordinate of `normal`; `None` where it encloses nothing.
    pub(super) fn new(_: Point, normal: Vector, boundary: &[Point]) -> Option<Polygon> {
        let dropped = (0..3).max_by(|&i, &j| normal[i].abs().total_cmp(&normal[j].abs()))?;
        let axes = [(dropped + 1) % 3, (dropped + 2) % 3];
        let corners: Vec<[f64; 2]> = boundary.iter().map(|p| axes.map(|k| p[k])).collect();
        let stretch = crate::space::norm(normal) / normal[dropped].abs();
        let polygon = Polygon { axes, corners, stretch };
        (polygon.corners.len() >= 3 && polygon.area() > 0.0 && polygon.area().is_finite()).then_some(polygon)
    }

    fn sides(&self) -> impl Iterator<Item = [[f64; 2]; 2]> {
        let n = self.corners.len();
        (0..n).map(move |k| [self.corners[k], self.corners[(k + 1) % n]])
    }

    /// Area in the plane itself.
    pub(super) fn area(&self) -> f64 {
        let twice: f64 = self.sides().map(|[a, b]| a[0] * b[1] - b[0] * a[1]).sum();
        0.5 * twice.abs() * self.stretch
    }

    /// Whether the projection of `p` lies inside, at least `margin` from the boundary, or, for a margin below zero, at most so
    /// far outside. The boundary itself is inside, to rounding.
    pub(super) fn holds(&self, p: Point, margin: f64) -> bool {
        self.within(self.axes.map(|k| p[k]), margin)
    }

    fn within(&self, q: [f64; 2], margin: f64) -> bool {
        let mut inside = false;
        let mut near = f64::INFINITY;
        let mut size = 0.0f64;
        for [a, b] in self.sides() {
            if (a[1] > q[1]) != (b[1] > q[1]) {
                let crossing = a[0] + (q[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
                inside ^= q[0] < crossing;
            }
            near = near.min(to_side(q, a, b));
            size = size.max(a[0].abs()).max(a[1].abs());
        }
        let rounding = 1e-12 * size;
        if margin > 0.0 { inside && near >= margin } else { inside || near <= rounding.max(-margin) }
    }

    /// The two coordinates.
    pub(super) fn axes(&self) -> [usize; 2] {
        self.axes
    }

    fn range(&self, k: usize) -> [f64; 2] {
        let each = || self.corners.iter().map(|c| c[k]);
        [each().fold(f64::INFINITY, f64::min), each().fold(f64::NEG_INFINITY, f64::max)]
    }

    /// The corners of the box around it that reaches so far beyond.
    pub(super) fn around(&self, beyond: f64) -> [[f64; 2]; 4] {
        let [x, y] = [self.range(0), self.range(1)].map(|[low, high]| [low - beyond, high + beyond]);
        [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]]
    }

    /// Places inside, on a grid of 5 × 5 over the box.
    pub(super) fn places(&self) -> Vec<[f64; 2]> {
        const GRID: usize = 5;
        let (x, y) = (self.range(0), self.range(1));
        let at = |[low, high]: [f64; 2], i: usize| low + (high - low) * (i as f64 + 0.5) / GRID as f64;
        let cells = (0..GRID * GRID).map(|n| [at(x, n % GRID), at(y, n / GRID)]);
        cells.filter(|q| self.within(*q, 0.0)).collect()
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
        assert!(polygon.holds(lift(0.5, 2.5), 0.0) && polygon.holds(lift(3.5, 0.5), 0.4));
        assert!(!polygon.holds(lift(2.0, 2.0), 0.0) && !polygon.holds(lift(3.5, 0.5), 0.6));
        assert!(polygon.holds(lift(-0.1, 1.0), -0.2) && !polygon.holds(lift(-0.1, 1.0), -0.05));
        assert!(polygon.holds(lift(0.0, 3.0), 0.0) && !polygon.holds(lift(-0.1, 1.0), 0.0));
        assert!(Polygon::new([0.0; 3], [0.0, 0.0, 1.0], &boundary[..2]).is_none());
    }
}
