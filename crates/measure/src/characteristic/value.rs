//! What was measured of a characteristic, or why nothing was.

use super::reason::{Impossible, NotMeasured};
use trueness_geom::fit::FitError;
use trueness_geom::rigid::Rigid;
use trueness_geom::space::Point;
use trueness_geom::zone::ZoneError;
use trueness_geom::zone::datum::DatumError;

/// What was measured. Lengths in millimeters, angles in degrees.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Value {
    /// The value.
    pub value: f64,
    /// What a material requirement adds to the greatest allowed value; below 0 where the size is beyond its limit.
    pub bonus: f64,
    /// Places where the value is reached.
    pub witness: Vec<Point>,
    /// Further numbers, by name.
    pub parts: Vec<(&'static str, f64)>,
    /// Where the feature lies in the frame that its true place is given in.
    pub place: Option<Place>,
    /// What the reader should know.
    pub notes: Vec<String>,
}

/// Where a feature was measured, beside its true place. Millimeters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Takes the coordinates of the aligned data to those of the frame, with the motions that its datums leave free.
    pub frame: Rigid,
    /// What the frame comes from.
    pub of: FrameOf,
    /// The measured place: the middle of the feature's axis or points, or its center.
    pub measured: Point,
    /// The true place; the coordinates that place nothing are `None`.
    pub exact: [Option<f64>; 3],
}

/// What a frame comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameOf {
    /// The datums of the characteristic.
    Datums,
    /// Numbers of the plan.
    Plan,
    /// The coordinates of the aligned data.
    Aligned,
}

/// Why there is no value.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Missing {
    /// The result is no longer wanted.
    #[error("cancelled")]
    Cancelled,
    /// The data do not allow it.
    #[error(transparent)]
    NotMeasured(#[from] NotMeasured),
    /// The plan asks for what cannot be, as the data show.
    #[error(transparent)]
    Impossible(#[from] Impossible),
}

impl From<FitError> for Missing {
    fn from(e: FitError) -> Missing {
        match e {
            FitError::Cancelled => Missing::Cancelled,
            e => NotMeasured::Fit(e).into(),
        }
    }
}

impl From<ZoneError> for Missing {
    fn from(e: ZoneError) -> Missing {
        match e {
            ZoneError::Cancelled => Missing::Cancelled,
            e => NotMeasured::Zone(e).into(),
        }
    }
}

impl From<DatumError> for Missing {
    fn from(e: DatumError) -> Missing {
        match e {
            DatumError::Fit { error: FitError::Cancelled, .. } => Missing::Cancelled,
            DatumError::Zone { error: ZoneError::Cancelled, .. } => Missing::Cancelled,
            // How a part was made is no fault of the plan.
            DatumError::Fit { .. }
            | DatumError::Zone { .. }
            | DatumError::Oblique { .. }
            | DatumError::Across { .. } => NotMeasured::Datum(e).into(),
            e => Impossible::Datum(e).into(),
        }
    }
}

/// The greatest of some numbers and the first place that has it.
pub(super) fn greatest(numbers: impl Iterator<Item = f64>) -> Result<(usize, f64), Missing> {
    let found = numbers.enumerate().fold(None, |most: Option<(usize, f64)>, (i, x)| match most {
        Some((_, y)) if x <= y => most,
        _ => Some((i, x)),
    });
    let found = found.filter(|(_, x)| x.is_finite());
    found.ok_or_else(|| NotMeasured::NotFinite.into())
}
