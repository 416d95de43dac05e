//! Why places of what is drawn have no value.

use trueness_geom::deviation::surface::Exclusion;
use trueness_surface::curvature::NoCurvature;

/// Why a point or vertex has no deviation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum NoValue {
    /// No reason known.
    Unknown = 0,
    /// Farther from the reference than the maximum distance.
    MaxDistance = 1,
    /// The closest place is a boundary edge of the reference.
    BoundaryEdge = 2,
    /// No measured point lies near this place of the reference.
    NotMeasured = 3,
    /// The surface ends there.
    Boundary = 4,
    /// It has too few neighbors.
    FewNeighbors = 5,
    /// Its neighbors do not determine the value.
    Undetermined = 6,
    /// It lies on no surface, or not on one alone.
    NoSurface = 7,
    /// It looks another way than the reference there.
    Facing = 8,
    /// It is an outlier.
    Outlier = 9,
    /// The line along which it is measured meets nothing.
    NoCrossing = 10,
    /// It has no normal to measure along.
    NoDirection = 11,
    /// Not every part has a value there.
    SomeParts = 12,
}

impl NoValue {
    /// All of them, in the order of their codes.
    pub const ALL: [NoValue; 13] = [
        NoValue::Unknown,
        NoValue::MaxDistance,
        NoValue::BoundaryEdge,
        NoValue::NotMeasured,
        NoValue::Boundary,
        NoValue::FewNeighbors,
        NoValue::Undetermined,
        NoValue::NoSurface,
        NoValue::Facing,
        NoValue::Outlier,
        NoValue::NoCrossing,
        NoValue::NoDirection,
        NoValue::SomeParts,
    ];

    /// Name in the manifest and in the text table (`reason.<name>`).
    pub fn name(self) -> &'static str {
        match self {
            NoValue::Unknown => "excluded",
            NoValue::MaxDistance => Exclusion::MaxDistance.name(),
            NoValue::BoundaryEdge => Exclusion::BoundaryEdge.name(),
            NoValue::NotMeasured => "not_measured",
            NoValue::Boundary => NoCurvature::Boundary.name(),
            NoValue::FewNeighbors => NoCurvature::FewNeighbors.name(),
            NoValue::Undetermined => NoCurvature::Undetermined.name(),
            NoValue::NoSurface => NoCurvature::NotASurface.name(),
            NoValue::Facing => "facing",
            NoValue::Outlier => "outlier",
            NoValue::NoCrossing => Exclusion::NoCrossing.name(),
            NoValue::NoDirection => Exclusion::NoDirection.name(),
            NoValue::SomeParts => "some_parts",
        }
    }
}
