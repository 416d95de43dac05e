//! The noise of what was measured, as documents have it.

use trueness_document::SharedNoise;
use trueness_geom::noise::{NoNoise, Noise};
use trueness_geom::progress::Cancelled;

/// The noise, or why none is told and points count as independent.
pub type NoiseOrReason = Result<Noise, NoSharedNoise>;

/// Why no noise is told that neighbors share.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoSharedNoise {
    /// The data do not tell.
    #[error(transparent)]
    Data(NoNoise),
    /// The element is a curve.
    #[error("it is a curve: how far neighbors share noise is found along surfaces")]
    Curve,
    /// A plan names no measured data.
    #[error("there is no measured surface: all points are from files of features")]
    NoSurface,
    /// Nothing was looked for, as errors were said to be independent.
    #[error("errors are independent, as --independent says")]
    Independent,
}

/// Both, as documents hold them.
pub fn record(noise: &NoiseOrReason) -> (Option<SharedNoise>, Option<String>) {
    match noise {
        Ok(noise) => (Some(shared(noise)), None),
        Err(why) => (None, Some(why.to_string())),
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
        found => Ok(found.map_err(NoSharedNoise::Data)),
    }
}

/// Points that tell as much as an independent one.
pub fn points_per_independent(noise: &NoiseOrReason) -> f64 {
    noise.as_ref().map_or(1.0, |n| n.points_per_independent)
}
