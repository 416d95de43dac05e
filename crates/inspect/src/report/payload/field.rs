//! Deviations as whole numbers, with apart codes for what has no value.

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

/// Codes reserved at the low end for reasons.
const RESERVED: i32 = NoValue::ALL.len() as i32;
/// The step must be at least this much finer than the range that is looked at.
const FINENESS: f64 = 500.0;

/// How deviations become codes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Codes {
    /// 2 or 3.
    pub bytes: usize,
    /// Millimeters a code.
    pub step: f64,
}

impl Codes {
    /// Two bytes where that resolves a 500th of `range` (the tolerance zone or the color range), else three.
    pub fn for_values(values: &[f64], range: f64) -> Codes {
        let greatest = values.iter().filter(|v| v.is_finite()).fold(0.0f64, |m, v| m.max(v.abs()));
        let with = |bytes: usize| {
            let step = greatest / f64::from((1i32 << (8 * bytes - 1)) - RESERVED);
            Codes { bytes, step: if step > 0.0 { step } else { range.max(1e-9) / (4.0 * FINENESS) } }
        };
        let coarse = with(2);
        if coarse.step <= range / FINENESS { coarse } else { with(3) }
    }

    /// Code of a deviation, or of the reason why there is none.
    pub fn code(&self, value: f64, reason: NoValue) -> i32 {
        if value.is_finite() { (value / self.step).round() as i32 } else { self.no_value(reason) }
    }

    /// Code that stands for a reason.
    pub fn no_value(&self, reason: NoValue) -> i32 {
        -(1 << (8 * self.bytes - 1)) + reason as i32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_clipped_and_half_a_step_is_the_error() {
        for (values, bytes) in [(vec![-0.3, 0.0, 0.12345, 0.2], 2), (vec![-79.0, 0.0123, 0.2], 3)] {
            let c = Codes::for_values(&values, 0.4);
            assert_eq!(c.bytes, bytes);
            for v in values {
                let code = c.code(v, NoValue::Unknown);
                assert!((f64::from(code) * c.step - v).abs() <= 0.5 * c.step * (1.0 + 1e-9));
                assert!(code > c.no_value(NoValue::NoDirection));
            }
        }
    }

    #[test]
    fn reasons_have_their_own_codes() {
        let c = Codes::for_values(&[1.0], 1.0);
        assert_eq!(c.code(f64::NAN, NoValue::Unknown), -32_768);
        assert_eq!(c.code(f64::NAN, NoValue::BoundaryEdge), -32_766);
        // Beyond thirteen reasons.
        assert_eq!(c.code(-1.0, NoValue::Unknown), -32_755);
    }

    #[test]
    fn all_zero_has_a_step() {
        assert!(Codes::for_values(&[0.0, f64::NAN], 0.2).step > 0.0);
    }
}
