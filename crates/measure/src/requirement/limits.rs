//! What is given and what is allowed.

use trueness_geom::space::Vector;

/// Theoretically exact dimensions, millimeters and radians.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Basic {
    /// Coordinates in the datum system.
    pub place: [Option<f64>; 3],
    /// Angle.
    pub angle: Option<f64>,
    /// Angle about the first datum from the direction of the second.
    pub turn: Option<f64>,
    /// Of a place that the model gives: the axis, or the plane with its normal, in the datum system, where it stands along none of its axes.
    pub oblique: Option<[Vector; 2]>,
}

/// Where the zone of a profile lies, seen from the theoretically exact geometry (UZ and OZ of ISO 1101:2017).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum ZoneOffset {
    /// Evenly about it.
    #[default]
    None,
    /// About its offset by this many millimeters out of the material (UZ).
    By(f64),
    /// About the offset that makes it narrowest (OZ).
    Free,
}

/// What is allowed; the limits belong to it. Millimeters; degrees for angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limits {
    /// No more than this.
    Greatest(f64),
    /// Between two deviations from a nominal value.
    Between {
        /// Nominal value.
        nominal: f64,
        /// Lower limit deviation.
        lower: f64,
        /// Upper limit deviation.
        upper: f64,
    },
}

impl Limits {
    /// Least and greatest allowed value.
    pub fn range(&self) -> (Option<f64>, f64) {
        match *self {
            Limits::Greatest(t) => (None, t),
            Limits::Between { nominal, lower, upper } => (Some(nominal + lower), nominal + upper),
        }
    }

    /// With this much added to the greatest allowed value.
    pub fn widened(&self, bonus: f64) -> Limits {
        match *self {
            Limits::Greatest(t) => Limits::Greatest(t + bonus),
            between => between,
        }
    }
}
