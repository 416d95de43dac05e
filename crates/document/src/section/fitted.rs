//! The best fit of a section onto its nominal.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The motion that brought the section of a plane nearest to the nominal, before its deviations were taken: from the section as it lies to the
/// nominal. Coordinates of contours, worst points and outlines stay those of the section as it lies.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct FitRecord {
    /// Number of its plane in `planes`, from 0; of points in order `null`.
    pub plane: Option<u64>,
    /// What may move: `free`, `xy`, `x`, `y` or `turn`.
    pub freedom: String,
    /// What it turns about: the middle of the points, of `turn` the origin.
    pub center: [f64; 2],
    /// Where that goes.
    pub shift: [f64; 2],
    /// Standard uncertainty of the shift; `null` of what may not move.
    pub shift_uncertainty: [Option<f64>; 2],
    /// Angle that it turns by, radians, counter-clockwise.
    pub turn: f64,
    /// Its standard uncertainty; `null` where it may not turn.
    pub turn_uncertainty: Option<f64>,
    /// Takes x, y, 1 of the section to the nominal's coordinates: two rows.
    pub transform: [[f64; 3]; 2],
    /// Root mean square distance before.
    pub rms_before: f64,
    /// Root mean square distance after it, of the same points.
    pub rms: f64,
    /// So many successive points tell as much as one alone, as their deviations go together; the uncertainties allow for it.
    pub correlated: f64,
    /// Points that count.
    pub used: u64,
    /// Points that do not: beyond an end of the nominal, or farther than `--max-distance`.
    pub left_out: u64,
    /// Steps taken.
    pub iterations: u64,
    /// Whether it came to rest.
    pub converged: bool,
}
