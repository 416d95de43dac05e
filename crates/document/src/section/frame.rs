//! Where a section lies.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The plane of a section: a place of it and the directions of its two axes.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
pub struct FrameRecord {
    /// The place with the coordinates 0, 0.
    pub origin: [f64; 3],
    /// Direction of the first axis.
    pub x: [f64; 3],
    /// Direction of the second axis.
    pub y: [f64; 3],
    /// Greatest distance of a point from the plane.
    pub flatness: f64,
}

impl FrameRecord {
    /// The plane of points of two columns: that of the first two coordinates.
    pub const FLAT: FrameRecord =
        FrameRecord { origin: [0.0; 3], x: [1.0, 0.0, 0.0], y: [0.0, 1.0, 0.0], flatness: 0.0 };

    /// Whether coordinates in it are others than the first two in space.
    pub fn is_in_space(&self) -> bool {
        let flat = FrameRecord::FLAT;
        [self.origin, self.x, self.y] != [flat.origin, flat.x, flat.y]
    }

    /// A place of the plane, in space.
    pub fn place(&self, p: [f64; 2]) -> [f64; 3] {
        std::array::from_fn(|k| self.origin[k] + p[0] * self.x[k] + p[1] * self.y[k])
    }
}
