//! Units of length of files that do not say theirs.

use std::{fmt, str::FromStr};

/// The unit in which a file's numbers are taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Unit {
    /// Micrometers.
    Micrometer,
    /// Millimeters: the unit of everything inside, and the one assumed.
    #[default]
    Millimeter,
    /// Centimeters.
    Centimeter,
    /// Meters.
    Meter,
    /// Inches of 25.4 mm.
    Inch,
    /// Feet of 304.8 mm. Only files of land surveys say it.
    Foot,
    /// Feet of 1200/3937 m. Only files of land surveys say it.
    SurveyFoot,
}

impl Unit {
    /// Those that can be asked for.
    pub const ALL: [Unit; 5] =
        [Unit::Micrometer, Unit::Millimeter, Unit::Centimeter, Unit::Meter, Unit::Inch];

    /// Its short name: `um`, `mm`, `cm`, `m`, `in`, `ft`, `us-ft`.
    pub const fn name(self) -> &'static str {
        match self {
            Unit::Micrometer => "um",
            Unit::Millimeter => "mm",
            Unit::Centimeter => "cm",
            Unit::Meter => "m",
            Unit::Inch => "in",
            Unit::Foot => "ft",
            Unit::SurveyFoot => "us-ft",
        }
    }
    /// `length`, in this unit, as millimeters. A division where the factor itself would have to be rounded.
    #[inline]
    pub(crate) fn to_millimeters(self, length: f64) -> f64 {
        match self {
            Unit::Micrometer => length / 1000.0,
            Unit::Millimeter => length,
            Unit::Centimeter => length * 10.0,
            Unit::Meter => length * 1000.0,
            Unit::Inch => length * 25.4,
            Unit::Foot => length * 304.8,
            Unit::SurveyFoot => length * 1_200_000.0 / 3937.0,
        }
    }
    /// Turns places read in this unit into millimeters. Costs nothing when they are.
    pub(crate) fn apply(self, points: &mut [[f64; 3]]) {
        if self != Unit::Millimeter {
            points.as_flattened_mut().iter_mut().for_each(|x| *x = self.to_millimeters(*x));
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Not the name of a unit.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("\"{0}\" is not a unit: use um, mm, cm, m or in")]
pub struct UnitError(String);

impl FromStr for Unit {
    type Err = UnitError;
    fn from_str(s: &str) -> Result<Unit, UnitError> {
        Unit::ALL.into_iter().find(|u| u.name() == s).ok_or_else(|| UnitError(s.into()))
    }
}
