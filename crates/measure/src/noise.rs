//! The noise of what was measured, as documents have it.

use trueness_document::SharedNoise;
use trueness_geom::noise::{NoNoise, Noise};
use trueness_geom::progress::Cancelled;

/// The noise, or why none is told and points count as independent.
pub type NoiseOrReason = Result<Noise, String>;

/// Both, as documents hold them.
pub fn record(noise: &NoiseOrReason) -> (Option<SharedNoise>, Option<String>) {
    match noise {
        Ok(noise) => (Some(shared(noise)), None),
        Err(why) => (None, Some(why.clone())),
    }
}

fn shared(noise: &Noise) -> SharedNoise {
    SharedNoise {
        deviation: noise.deviation,
        reach: noise.reach,
        points_per_independent: noise.points_per_independent,
        spacing: noise.spacing,
        patches: noise.patches as u64,
        left_out: noise.excluded_patches as u64,
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

/// Points that tell as much as an independent one.
pub fn points_per_independent(noise: &NoiseOrReason) -> f64 {
    noise.as_ref().map_or(1.0, |n| n.points_per_independent)
}
