//! The result documents: what a command found out, as the one thing that tables, reports and scripts read.
//!
//! Every document starts with the same header and names its inputs. A number that does not exist is `null`
//! beside a reason; NaN and infinity never appear.

pub mod check;
pub mod compare;
pub mod fit;
pub mod repair;
pub mod research;
pub mod segment;

use compare::Bounds;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Version of the program that wrote the document.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
/// The unit of every length in every document.
pub const UNITS: &str = "mm";

/// A file that was read.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct InputRecord {
    /// What it was taken for.
    pub role: Role,
    /// As given on the command line; `-` is the standard input.
    pub path: String,
    /// Name of the format found by content.
    pub format: String,
    /// Size of the file as it lies on disk; of the data read, for the standard input.
    pub bytes: u64,
    /// SHA-256 of those bytes, hexadecimal.
    pub sha256: Option<String>,
    /// Why there is no hash.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub sha256_reason: Option<String>,
    /// The unit its numbers were taken for.
    pub unit_assumed: String,
    /// Points of a cloud, or distinct vertices of a mesh.
    pub points: u64,
    /// Facets; absent for a cloud.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub facets: Option<u64>,
    /// Box of its points or vertices, mm, after units were converted; `null` where there are none.
    pub bounds: Option<Bounds>,
    /// What the reader noticed and mended or passed over.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub warnings: Vec<String>,
}

/// What a file is taken for. The reference never moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// Scan, points, the part as it is.
    Measured,
    /// Nominal, or the mesh under test.
    Reference,
    /// A mesh that is looked at by itself, beside no other.
    Mesh,
}

/// The answer to a question about conformity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Conforms.
    Pass,
    /// Does not conform.
    Fail,
    /// The uncertainty does not allow an answer.
    Undecided,
    /// There is no measurement to judge.
    NotMeasured,
}

impl Verdict {
    /// The word for people.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Pass => "pass",
            Verdict::Fail => "fail",
            Verdict::Undecided => "undecided",
            Verdict::NotMeasured => "not measured",
        }
    }
}

/// Name and JSON schema of every result document, as kept under `docs/schema/`.
pub fn schemas() -> Vec<(&'static str, String)> {
    let text = |schema: schemars::Schema| {
        let mut text = serde_json::to_string_pretty(&schema).unwrap_or_default();
        text.push('\n');
        text
    };
    vec![
        ("check", text(schemars::schema_for!(check::CheckDocument))),
        ("compare", text(schemars::schema_for!(compare::CompareDocument))),
        ("repair", text(schemars::schema_for!(repair::RepairDocument))),
        ("fit", text(schemars::schema_for!(fit::FitDocument))),
        ("segment", text(schemars::schema_for!(segment::SegmentDocument))),
    ]
}
