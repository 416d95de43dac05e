//! Boxes, as all documents have them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An axis-parallel box, millimeters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Bounds {
    /// Least coordinates.
    pub min: [f64; 3],
    /// Greatest coordinates.
    pub max: [f64; 3],
}
