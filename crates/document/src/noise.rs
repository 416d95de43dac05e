//! The noise of what was measured, and how far neighbors share it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trueness_geom::noise::{NoNoise, Noise};
use trueness_geom::progress::Cancelled;

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

impl From<Noise> for SharedNoise {
    fn from(noise: Noise) -> SharedNoise {
        SharedNoise {
            deviation: noise.deviation,
            reach: noise.reach,
            points_per_independent: noise.points_per_independent,
            spacing: noise.spacing,
            patches: noise.patches as u64,
            left_out: noise.left_out as u64,
        }
    }
}

/// The noise, or why none is told and points count as independent.
pub type NoiseOrReason = Result<Noise, String>;

/// Both, as documents hold them.
pub fn record(noise: &NoiseOrReason) -> (Option<SharedNoise>, Option<String>) {
    match noise {
        Ok(noise) => (Some((*noise).into()), None),
        Err(why) => (None, Some(why.clone())),
    }
}

/// What was found; cancelled work tells nothing.
///
/// # Errors
/// Cancelled.
pub fn noise_or_reason(found: Result<Noise, NoNoise>) -> Result<NoiseOrReason, Cancelled> {
    match found {
        Err(NoNoise::Cancelled(e)) => Err(e),
        found => Ok(found.map_err(|e| e.to_string())),
    }
}

/// Points that tell as much as an independent one, where neighbors share noise.
pub fn shared(noise: Option<SharedNoise>) -> Option<f64> {
    noise.map(|n| n.points_per_independent).filter(|points| *points > 1.0)
}

/// Points that tell as much as an independent one.
pub fn points_per_independent(noise: &NoiseOrReason) -> f64 {
    noise.as_ref().map_or(1.0, |n| n.points_per_independent)
}
