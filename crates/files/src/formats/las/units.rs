//! Units of length as surveyors' files say them: by name, by number of EPSG, by their length.

use crate::Unit;

/// The unit of a name.
pub(super) fn named(name: &str) -> Option<Unit> {
    const UNIT_NAMES: [(Unit, &[&str]); 3] = [
        (Unit::Meter, &["metre", "meter", "m", "metres", "meters"]),
        (Unit::Foot, &["foot", "international foot", "ft", "feet"]),
        (
            Unit::SurveyFoot,
            &["us survey foot", "foot_us", "us_survey_foot", "us survey feet", "ftus", "us-ft"],
        ),
    ];
    let is = |own: &&str| own.eq_ignore_ascii_case(name.trim());
    UNIT_NAMES.iter().find(|(_, names)| names.iter().any(is)).map(|(unit, _)| *unit)
}

/// The unit of a number of EPSG.
pub(super) fn numbered(code: u16) -> Option<Unit> {
    match code {
        9001 => Some(Unit::Meter),
        9002 => Some(Unit::Foot),
        9003 => Some(Unit::SurveyFoot),
        1025 => Some(Unit::Millimeter),
        1033 => Some(Unit::Centimeter),
        _ => None,
    }
}

/// The unit of so many meters. The feet differ by two millionths; files write ten digits and more.
pub(super) fn sized(meters: f64) -> Option<Unit> {
    const SAME_UNIT_SHARE: f64 = 1e-7;
    const SIZES: [(f64, Unit); 7] = [
        (1.0, Unit::Meter),
        (0.3048, Unit::Foot),
        (1200.0 / 3937.0, Unit::SurveyFoot),
        (0.01, Unit::Centimeter),
        (0.001, Unit::Millimeter),
        (1e-6, Unit::Micrometer),
        (0.0254, Unit::Inch),
    ];
    SIZES.iter().find(|(size, _)| (meters / size - 1.0).abs() < SAME_UNIT_SHARE).map(|(_, unit)| *unit)
}
