//! Units of length of files that do not say theirs.

use std::{fmt, str::FromStr};

/// The unit in which a file's numbers are taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Unit {
    /// Micrometres.
    Micrometre,
    /// Millimetres: the unit of everything inside, and the one assumed.
    #[default]
    Millimetre,
    /// Centimetres.
    Centimetre,
    /// Metres.
    Metre,
    /// Inches of 25.4 mm.
    Inch,
}

impl Unit {
    /// All of them.
    pub const ALL: [Unit; 5] =
        [Unit::Micrometre, Unit::Millimetre, Unit::Centimetre, Unit::Metre, Unit::Inch];

    /// Its short name: `um`, `mm`, `cm`, `m`, `in`.
    pub const fn name(self) -> &'static str {
        match self {
            Unit::Micrometre => "um",
            Unit::Millimetre => "mm",
            Unit::Centimetre => "cm",
            Unit::Metre => "m",
            Unit::Inch => "in",
        }
    }
    /// `length`, in this unit, as millimetres. A division where the factor itself would have to be rounded.
    #[inline]
    pub(crate) fn to_millimetres(self, length: f64) -> f64 {
        match self {
            Unit::Micrometre => length / 1000.0,
            Unit::Millimetre => length,
            Unit::Centimetre => length * 10.0,
            Unit::Metre => length * 1000.0,
            Unit::Inch => length * 25.4,
        }
    }
    /// Turns places read in this unit into millimetres. Costs nothing when they are.
    pub(crate) fn apply(self, points: &mut [[f64; 3]]) {
        if self != Unit::Millimetre {
            points.as_flattened_mut().iter_mut().for_each(|x| *x = self.to_millimetres(*x));
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
