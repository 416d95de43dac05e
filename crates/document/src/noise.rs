//! The noise of what was measured, and how far neighbors share it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The noise of what was measured: what its points scatter by about smooth surfaces, and how far neighbors share it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SharedNoise {
    /// Standard deviation of a point across the surface, millimeters.
    pub deviation: f64,
    /// Distance beyond which two points share no noise, millimeters; 0 where none do.
    pub reach: f64,
    /// Points that tell as much as one independent point, 1 or more. Uncertainties are its root times those of independent points.
    pub points_per_independent: f64,
    /// Distance of neighboring points, millimeters.
    pub spacing: f64,
    /// Patches of the surface that it is told from.
    pub patches: u64,
    /// Patches left out, which lie over edges or form.
    pub left_out: u64,
}

/// Points that tell as much as an independent one, where neighbors share noise.
pub fn shared(noise: Option<SharedNoise>) -> Option<f64> {
    noise.map(|n| n.points_per_independent).filter(|points| *points > 1.0)
}
