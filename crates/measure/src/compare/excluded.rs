//! Why a point does not count.

use trueness_geom::deviation::surface::Exclusion;

/// Why a point does not count.
///
/// Among deviations such a point is a value that is not finite, so that it keeps its place and needs no second list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub enum Excluded {
    /// Farther than the greatest distance asked for.
    MaxDistance = 1,
    /// The nearest place lies on a boundary edge.
    BoundaryEdge = 2,
    /// Its normal does not agree with that of the reference.
    Facing = 3,
    /// Beyond the limits that the rule for outliers gives.
    Outlier = 4,
    /// The line along which it is measured meets the reference nowhere, or not within the greatest distance.
    NoCrossing = 5,
    /// It has no normal to measure along.
    NoDirection = 6,
}

/// A NaN of its own, which is only ever copied: no arithmetic sees it.
const OUTLIER_BITS: u64 = 0x7ff8_0000_0000_0004;

impl From<Exclusion> for Excluded {
    fn from(e: Exclusion) -> Excluded {
        match e {
            Exclusion::MaxDistance => Excluded::MaxDistance,
            Exclusion::BoundaryEdge => Excluded::BoundaryEdge,
            Exclusion::NoCrossing => Excluded::NoCrossing,
            Exclusion::NoDirection => Excluded::NoDirection,
        }
    }
}

impl Excluded {
    /// All, in the order of their numbers.
    pub const ALL: [Excluded; 6] = [
        Excluded::MaxDistance,
        Excluded::BoundaryEdge,
        Excluded::Facing,
        Excluded::Outlier,
        Excluded::NoCrossing,
        Excluded::NoDirection,
    ];

    /// What a value among deviations stands for; `None` for a deviation.
    ///
    /// ```
    /// use trueness_measure::compare::Excluded;
    /// assert!(Excluded::ALL.iter().all(|e| Excluded::of(e.value()) == Some(*e)));
    /// assert_eq!(Excluded::of(-0.2), None);
    /// ```
    pub fn of(value: f64) -> Option<Excluded> {
        match value {
            d if d.is_finite() => None,
            f64::NEG_INFINITY => Some(Excluded::Facing),
            nan if nan.to_bits() == OUTLIER_BITS => Some(Excluded::Outlier),
            other => Exclusion::of(other).map(Excluded::from),
        }
    }

    /// The value that stands for it.
    pub fn value(self) -> f64 {
        match self {
            Excluded::MaxDistance => Exclusion::MaxDistance.value(),
            Excluded::BoundaryEdge => Exclusion::BoundaryEdge.value(),
            Excluded::Facing => f64::NEG_INFINITY,
            Excluded::Outlier => f64::from_bits(OUTLIER_BITS),
            Excluded::NoCrossing => Exclusion::NoCrossing.value(),
            Excluded::NoDirection => Exclusion::NoDirection.value(),
        }
    }

    /// The word of the result document.
    pub fn name(self) -> &'static str {
        match self {
            Excluded::MaxDistance => Exclusion::MaxDistance.name(),
            Excluded::BoundaryEdge => Exclusion::BoundaryEdge.name(),
            Excluded::Facing => "facing",
            Excluded::Outlier => "outlier",
            Excluded::NoCrossing => Exclusion::NoCrossing.name(),
            Excluded::NoDirection => Exclusion::NoDirection.name(),
        }
    }

    /// Its number in files of points; that of a point that counts is 0.
    pub fn number(self) -> u8 {
        self as u8
    }
}
