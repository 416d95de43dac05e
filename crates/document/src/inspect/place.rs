//! Where features lie, measured and nominal.

use crate::Word;
use crate::word::named;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Place and size of a feature, in the coordinates of the aligned data. Millimeters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MeasuredPlace {
    /// Its place: the middle of its axis or points, its center.
    pub place: [f64; 3],
    /// Diameter of a cylinder, circle or sphere; null of what has none.
    pub diameter: Option<f64>,
    /// Angle between the sides of a cone, degrees; null of what has none.
    pub angle: Option<f64>,
}

/// Where the feature of a characteristic lies beside its true place. Millimeters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PlaceRecord {
    /// What the frame comes from: `datums`, `plan` (numbers of the plan) or `aligned` (the coordinates of the aligned data).
    pub frame: Word<FrameSource>,
    /// Its origin in the coordinates of the aligned data.
    pub origin: [f64; 3],
    /// Direction of its x.
    pub x: [f64; 3],
    /// Direction of its z.
    pub z: [f64; 3],
    /// The measured place: the middle of the feature's axis or points, its center.
    pub measured: [f64; 3],
    /// The true place; null along what is not toleranced.
    pub exact: [Option<f64>; 3],
    /// Measured less true place: dx, dy, dz.
    pub deviation: [Option<f64>; 3],
}

impl PlaceRecord {
    /// The coordinates that count: name, true and measured one, and their difference.
    pub fn coordinates(&self) -> impl Iterator<Item = (&'static str, f64, f64, f64)> + '_ {
        let one = |k: usize| Some((["x", "y", "z"][k], self.exact[k]?, self.measured[k], self.deviation[k]?));
        (0..3).filter_map(one)
    }
}

/// What a frame comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameSource {
    /// The datums of the characteristic.
    Datums,
    /// Numbers of the plan.
    Plan,
    /// The coordinates of the aligned data.
    Aligned,
}

named!(
    FrameSource,
    "source of a frame",
    [FrameSource::Datums, FrameSource::Plan, FrameSource::Aligned],
    |source| match source {
        FrameSource::Datums => "datums",
        FrameSource::Plan => "plan",
        FrameSource::Aligned => "aligned",
    }
);
