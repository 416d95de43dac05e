//! Curves that are nearly arcs.
//!
//! What a designer drew as an arc is a free curve on a real part: its form deviates by more than neighboring points scatter. The row alone
//! cannot tell that from a curve that was meant. So the arc is told, with how far the curve is from it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The arc that a curve is near to.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
pub struct NearArc {
    /// Its center.
    pub center: [f64; 2],
    /// Its radius.
    pub radius: f64,
    /// Root mean square distance of the curve from it.
    pub rms: f64,
    /// Greatest distance of the curve from it.
    pub max: f64,
}

impl NearArc {
    /// A standard deviation of the points with which the curve may be taken for the arc, mm: so much more than the distances from it that
    /// a curve takes little away.
    pub fn noise(&self) -> f64 {
        2.5 * self.rms
    }
}
