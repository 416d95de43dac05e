//! Oddities of the files of scanners.

use crate::Unit;
use std::fmt;

/// An oddity of a scan, and how it was handled.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ScanWarning {
    /// The file has further values for each point, which were not read.
    ColumnsUnread {
        /// Their names.
        names: Vec<String>,
    },
    /// The place of the scanner is given and was not applied: the points are as they are stored.
    ViewpointUnused {
        /// As the file gives it.
        viewpoint: String,
    },
    /// Several scans became one cloud.
    Scans {
        /// How many.
        count: u64,
        /// How many of them have no points.
        empty: u64,
    },
    /// Points with a NaN or infinite coordinate were left out.
    NotFinite {
        /// How many.
        count: u64,
    },
    /// Directions from which no light came back were left out.
    NoReturn {
        /// How many.
        count: u64,
    },
    /// Points that the file marks as invalid were left out.
    Invalid {
        /// How many.
        count: u64,
    },
    /// Points that the file marks as withheld were read.
    Withheld {
        /// How many.
        count: u64,
    },
    /// Points whose time is not finite; it is not used.
    TimeNotFinite {
        /// How many.
        count: u64,
    },
    /// A geographic file without coordinate system, so without a unit.
    UnitUnstated,
    /// What the file says of its unit is of no use, and the user named one, which was taken.
    UnitUnusable {
        /// Why.
        why: String,
    },
    /// The file gives its lengths in feet.
    Feet {
        /// The unit.
        unit: Unit,
    },
    /// Heights have another unit than the other two coordinates; all were taken in that of the latter.
    HeightUnit {
        /// Of x and y, which was taken.
        taken: Unit,
        /// Of z.
        height: Unit,
    },
    /// The shapes of returned pulses were not read.
    WavePackets,
    /// Pictures were not read.
    Images {
        /// How many.
        count: u64,
    },
}

/// The text of a warning about so many records, if there are any.
pub(crate) fn remark(count: u64, warning: impl FnOnce(u64) -> ScanWarning) -> Option<String> {
    (count > 0).then(|| warning(count).to_string())
}

impl fmt::Display for ScanWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ScanWarning::ColumnsUnread { names } => write!(f, "columns not read: {}", names.join(", ")),
            ScanWarning::ViewpointUnused { viewpoint } => write!(
                f,
                "VIEWPOINT {viewpoint} tells where the scanner stood; it was not applied, the points are as stored"
            ),
            ScanWarning::Scans { count, empty: 0 } => write!(f, "{count} scans read as one cloud"),
            ScanWarning::Scans { count, empty } => {
                write!(f, "{count} scans read as one cloud, {empty} of them empty")
            }
            ScanWarning::NotFinite { count } => {
                write!(f, "{count} point(s) with a coordinate that is not finite left out")
            }
            ScanWarning::NoReturn { count } => write!(f, "{count} record(s) without a return left out"),
            ScanWarning::Invalid { count } => {
                write!(f, "{count} point(s) that the file marks as invalid left out")
            }
            ScanWarning::Withheld { count } => {
                write!(f, "{count} point(s) that the file marks as withheld were read like the others")
            }
            ScanWarning::TimeNotFinite { count } => {
                write!(f, "{count} point(s) whose GPS time is not finite; times are not used")
            }
            ScanWarning::UnitUnstated => {
                write!(f, "the file names no coordinate system, so no unit of length; --units says it")
            }
            ScanWarning::UnitUnusable { why } => {
                write!(f, "{why}; the numbers were taken in the unit that --units names, whatever they are")
            }
            ScanWarning::Feet { unit } => write!(f, "the file gives lengths in {}", long_name(*unit)),
            ScanWarning::HeightUnit { taken, height } => write!(
                f,
                "the unit of heights is the {}, that of x and y the {}; heights were taken in the latter: convert the file to one unit",
                long_name(*height),
                long_name(*taken)
            ),
            ScanWarning::WavePackets => write!(f, "the wave packets of the points were not read"),
            ScanWarning::Images { count } => write!(f, "{count} image(s) not read"),
        }
    }
}

/// The name of a unit in a sentence.
fn long_name(unit: Unit) -> &'static str {
    match unit {
        Unit::Foot => "foot",
        Unit::SurveyFoot => "US survey foot",
        Unit::Meter => "meter",
        other => other.name(),
    }
}
