//! The default view: isometric, orthographic, the part in the middle.

use super::super::Up;
use trueness_geom::space::{Aabb, Point, Vector, dot, minus};

/// Share of the picture's smaller side that the part fills at most.
const FILL: f64 = 0.86;

/// Orthographic projection to pixels.
pub struct Camera {
    right: Vector,
    up: Vector,
    /// Unit vector from the part to the eye.
    pub toward: Vector,
    center: [f64; 2],
    scale: f64,
    size: [f64; 2],
}

impl Camera {
    /// Looks at `places` from the right, the front and above.
    pub fn isometric<'a>(places: impl Iterator<Item = &'a Point>, up: Up, width: u32, height: u32) -> Camera {
        let (r, f, u) = match up {
            Up::Z => ([1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]),
            Up::Y => ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]),
        };
        let mixed = |a: f64, b: f64, c: f64| -> Vector {
            let n = (a * a + b * b + c * c).sqrt();
            std::array::from_fn(|k| (a * r[k] + b * f[k] + c * u[k]) / n)
        };
        let (right, up, toward) = (mixed(1.0, -1.0, 0.0), mixed(-1.0, -1.0, 2.0), mixed(1.0, 1.0, 1.0));
        let flat = places.map(|p| [dot(*p, right), dot(*p, up), 0.0]).collect::<Vec<_>>();
        let bounds = Aabb::of(&flat);
        let [w, h, _] = if bounds.is_empty() { [1.0; 3] } else { bounds.sides() };
        let size = [f64::from(width), f64::from(height)];
        let scale = FILL * (size[0] / w.max(1e-300)).min(size[1] / h.max(1e-300)).min(1e300);
        let middle = |k: usize| if bounds.is_empty() { 0.0 } else { 0.5 * (bounds.min[k] + bounds.max[k]) };
        Camera { right, up, toward, center: [middle(0), middle(1)], scale, size }
    }

    /// Pixel coordinates from the top left, and the height towards the eye in the same unit.
    pub fn project(&self, p: &Point) -> [f64; 3] {
        let d = minus(*p, [0.0; 3]);
        [
            0.5 * self.size[0] + (dot(d, self.right) - self.center[0]) * self.scale,
            0.5 * self.size[1] - (dot(d, self.up) - self.center[1]) * self.scale,
            dot(d, self.toward) * self.scale,
        ]
    }
}
