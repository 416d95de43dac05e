//! What of a nominal and of a part makes their deviations doubtful.

use crate::compare::{Warning, WarningKind};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Something that makes the deviations doubtful, although each is computed right.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct NominalWarning {
    /// What was noticed.
    pub kind: NominalWarningKind,
    /// The number that it was noticed by.
    pub value: f64,
    /// The same in words.
    pub text: String,
}

/// What can be noticed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum NominalWarningKind {
    /// The sizes of part and nominal stand in a ratio as two units do. `value`: diagonal of the part's box over that of the nominal.
    SizeRatio,
    /// Their boxes hardly overlap. `value`: the common share of the smaller box, both widened by a margin.
    HardlyOverlapping,
    /// Ends of an outline of the nominal nearly meet: it is open, and has a left and a right in place of an inside. `value`: how far they are
    /// apart.
    NearlyClosed,
    /// All of a contour of the part lies far off the nominal, as one that is not of it. `value`: the least distance.
    NowhereNear,
    /// Entities of the drawing lie on layers of no plane of the section. `value`: their number.
    LayersPassedOver,
    /// Faces of the nominal lie in a plane of the section, which is then that just below. `value`: their number.
    FaceInPlane,
}

impl From<Warning> for NominalWarning {
    fn from(Warning { kind, value, text }: Warning) -> NominalWarning {
        let kind = match kind {
            WarningKind::SizeRatio => NominalWarningKind::SizeRatio,
            WarningKind::HardlyOverlapping => NominalWarningKind::HardlyOverlapping,
        };
        NominalWarning { kind, value, text }
    }
}
