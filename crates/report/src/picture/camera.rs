//! The first view: orthographic, the part in the middle.

use super::super::up::Up;
use trueness_geom::space::{Aabb, Point, Vector, cross, dot, minus, unit};

/// Share of the picture's smaller side that the part fills at most.
const MAX_FILLED_SHARE: f64 = 0.86;

/// The model's axis that points up on the screen, and the way its front looks.
pub fn vertical_and_front(up: Up) -> (Vector, Vector) {
    match up {
        Up::Z => ([0.0, 0.0, 1.0], [0.0, -1.0, 0.0]),
        Up::Y => ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]),
    }
}

/// Orthographic projection to pixels.
pub struct Camera {
    right: Vector,
    up: Vector,
    /// Unit vector from the part to the eye.
    pub toward: Vector,
    center: [f64; 2],
    /// Pixels a millimeter.
    pub scale: f64,
    size: [f64; 2],
}

impl Camera {
    /// Looks at `places` from `toward`, the vertical upright, leaving `margin` pixels free on the left and on the right.
    pub fn first_view<'a>(
        places: impl Iterator<Item = &'a Point>,
        up: Up,
        toward: Vector,
        [width, height, margin]: [u32; 3],
    ) -> Camera {
        let (vertical, _) = vertical_and_front(up);
        let across = [vertical[1], vertical[2], vertical[0]];
        let along = |v: Vector, otherwise: Vector| unit(v).map_or(otherwise, |(v, _)| v);
        let right = along(cross(vertical, toward), across);
        let up = cross(toward, right);
        let flat = places.map(|p| [dot(*p, right), dot(*p, up), 0.0]).collect::<Vec<_>>();
        let bounds = Aabb::of(&flat);
        let [w, h, _] = if bounds.is_empty() { [1.0; 3] } else { bounds.sides() };
        let size = [f64::from(width), f64::from(height)];
        let free = f64::from(width.saturating_sub(2 * margin).max(width / 3));
        let scale = MAX_FILLED_SHARE * (free / w.max(1e-300)).min(size[1] / h.max(1e-300)).min(1e300);
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
