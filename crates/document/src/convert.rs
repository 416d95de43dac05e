//! `trueness/convert/1`: what was written in another format, and what of it was lost.

use super::word::words;
use super::{InputRecord, ResultDocument, UNITS, VERSION, Word};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Name of this document's schema.
pub const SCHEMA: &str = "trueness/convert/1";

words! {
    /// What was written.
    Written, "content that is written", {
        /// Facets.
        Mesh = "mesh",
        /// Points without facets.
        Points = "points",
    }
}

/// The whole document.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct ConvertDocument {
    /// `trueness/convert/1`.
    pub schema: String,
    /// Version of the program.
    pub version: String,
    /// Always `mm`: the unit of the file written.
    pub units: String,
    /// The file read.
    pub inputs: Vec<InputRecord>,
    /// The file written.
    pub output: String,
    /// What was written.
    pub written: Word<Written>,
    /// Points, or vertices of the mesh.
    pub points: u64,
    /// Facets of the mesh.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub facets: Option<u64>,
    /// How far the format moved a coordinate at most, mm; 0 where it kept all digits, `null` where that is not known.
    pub farthest_moved: Option<f64>,
    /// What the file written does not hold, a sentence each.
    pub lost: Vec<String>,
}

impl ConvertDocument {
    /// A document of a conversion that lost nothing yet.
    pub fn new(input: InputRecord, output: String, written: Written) -> ConvertDocument {
        ConvertDocument {
            schema: SCHEMA.into(),
            version: VERSION.into(),
            units: UNITS.into(),
            inputs: vec![input],
            output,
            written: Word(written),
            points: 0,
            facets: None,
            farthest_moved: None,
            lost: vec![],
        }
    }
}

/// Whether all that was read is written. Faces that could not be read are missing.
impl ResultDocument for ConvertDocument {
    fn conforms(&self) -> bool {
        self.inputs.iter().all(|input| input.incomplete.is_none())
    }
}
