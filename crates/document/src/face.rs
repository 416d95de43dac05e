//! Faces of CAD models, as documents name them.

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
