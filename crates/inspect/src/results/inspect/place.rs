//! Where features lie, measured and nominal.

use crate::characteristic::{FrameOf, Place};
use crate::results::Word;
use crate::results::word::named;
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
    /// Of a place that was found.
    pub(crate) fn of(place: &Place) -> PlaceRecord {
        let [x, _, z] = place.frame.rotation();
        PlaceRecord {
            frame: Word(match place.of {
                FrameOf::Datums => FrameSource::Datums,
                FrameOf::Plan => FrameSource::Plan,
                FrameOf::Aligned => FrameSource::Aligned,
            }),
            origin: place.frame.inverse().point([0.0; 3]),
            x,
            z,
            measured: place.measured,
            exact: place.exact,
            deviation: std::array::from_fn(|k| place.exact[k].map(|exact| place.measured[k] - exact)),
        }
    }

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
