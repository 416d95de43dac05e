//! Boxes, as all documents have them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trueness_geom::space::Aabb;

/// An axis-parallel box, millimeters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Bounds {
    /// Least coordinates.
    pub min: [f64; 3],
    /// Greatest coordinates.
    pub max: [f64; 3],
}

impl Bounds {
    /// The box of points; none of no points.
    pub fn of(points: &Aabb) -> Option<Bounds> {
        (!points.is_empty()).then_some(Bounds { min: points.min, max: points.max })
    }
}
