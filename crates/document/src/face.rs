//! Faces of CAD models, as documents name them.

use super::Word;
use super::info::CadSurface;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A face of a CAD model.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct FaceRecord {
    /// The number of its entity in the file.
    pub face: u64,
    /// Its name; absent where the file gives none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub name: Option<String>,
    /// The names on the way from the root of the assembly to its instance; absent where there is one instance.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub instance: Option<String>,
}

/// Deviations of the points that are nearest to a face of a CAD model, or whose lines meet it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FaceDeviation {
    /// The face.
    #[serde(flatten)]
    pub face: FaceRecord,
    /// What its surface is.
    pub kind: Word<CadSurface>,
    /// Points that count.
    pub count: u64,
    /// Their mean deviation, millimeters.
    pub mean: f64,
    /// The root of their mean square.
    pub rms: f64,
    /// The least one.
    pub min: f64,
    /// The greatest one.
    pub max: f64,
    /// Share of them that keep their tolerance (0 to 1); absent where they have none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub inside: Option<f64>,
}

impl FaceDeviation {
    /// The greatest deviation to either side.
    pub fn worst(&self) -> f64 {
        if self.max >= -self.min { self.max } else { self.min }
    }
}

/// The faces with the deviations farthest to either side first, so many at most.
pub fn worst_first(faces: &[FaceDeviation], most: usize) -> Vec<&FaceDeviation> {
    let mut all: Vec<&FaceDeviation> = faces.iter().collect();
    all.sort_by(|a, b| b.worst().abs().total_cmp(&a.worst().abs()));
    all.truncate(most);
    all
}
