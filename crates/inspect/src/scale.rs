//! The colour scale: one object that alone colours map, legend, histogram, flags and exports.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// `trueness/scale/1`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Scale {
    /// For people.
    pub name: String,
    /// How values become colours.
    pub mode: Mode,
    /// Low end; values below have the low cap's colour.
    pub lower: f64,
    /// High end; values above have the high cap's colour.
    pub upper: f64,
    /// The tolerance zone, which is then the middle band.
    pub tolerance: Option<[f64; 2]>,
    /// Number of bands between the ends.
    pub bands: u32,
    /// `inspect`, `safe` (colour-blind) or `mono` (print).
    pub palette: String,
    /// Digits after the point in the legend.
    pub decimals: u32,
    /// Always `mm`.
    pub unit: String,
}

/// How values become colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Mode {
    /// Equal bands, the tolerance zone in the middle.
    Bands,
    /// Without steps.
    Continuous,
    /// Below, in, above the tolerance zone.
    GoNoGo,
}
