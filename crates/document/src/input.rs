//! The files that were read, as all documents have them.

use super::bounds::Bounds;
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
    /// Where that comes from: `option`, `header` (the names of a table's columns, or what a CAD file says) or `assumed`.
    #[serde(default = "assumed")]
    pub unit_from: String,
    /// What was taken for what in a table of text; absent for other files.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub table: Option<TableRecord>,
    /// Points of a cloud, distinct vertices of a mesh, or control points of B-spline surfaces.
    pub points: u64,
    /// Facets; absent for a cloud.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub facets: Option<u64>,
    /// What of the file was not read; absent where all of it was.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub incomplete: Option<IncompleteRecord>,
    /// Faces of a CAD model; absent for other files.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub cad: Option<CadInputRecord>,
    /// Faces of a CAD file that are less than their surface, which was taken whole; absent where there are none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub trimmed_faces: Option<u64>,
    /// Box of its points or vertices, mm, after units were converted; `null` where there are none.
    pub bounds: Option<Bounds>,
    /// What the reader noticed and mended or passed over.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub warnings: Vec<String>,
}

/// The faces of a CAD model that was read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CadInputRecord {
    /// Faces, each as often as its part stands in the assembly.
    pub faces: u64,
    /// How far the facets made of them lie from them at most, mm.
    pub facets_within: f64,
}

/// What of a file was not read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct IncompleteRecord {
    /// Faces that were read; null where they cannot be counted.
    pub read: Option<u64>,
    /// Faces of the file; null where they cannot be counted.
    pub of: Option<u64>,
    /// One sentence for people.
    pub text: String,
}

fn assumed() -> String {
    "assumed".into()
}

/// What was taken for what in a table of text.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct TableRecord {
    /// What parts the columns: `semicolons`, `tabs`, `commas` or `blanks`.
    pub separator: String,
    /// `.` or `,`.
    pub decimal_sign: char,
    /// The columns taken for x, y and, except for points in the plane, z.
    pub columns: Vec<ColumnRecord>,
    /// How many columns there are.
    pub of: usize,
    /// The line whose names were used, from 1; null if no line names the columns.
    pub header_line: Option<u64>,
    /// Lines before the first row, the header among them.
    pub lines_skipped: u64,
}

/// A column that was taken for a coordinate.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct ColumnRecord {
    /// `x`, `y` or `z`.
    pub axis: char,
    /// Its number, from 1.
    pub number: usize,
    /// Its name in the header; null without one.
    pub name: Option<String>,
}

impl InputRecord {
    /// Of data that come from no file.
    pub fn of_no_file(role: Role) -> InputRecord {
        InputRecord {
            role,
            path: String::new(),
            format: String::new(),
            bytes: 0,
            sha256: None,
            sha256_reason: None,
            unit_assumed: "mm".into(),
            unit_from: "assumed".into(),
            table: None,
            points: 0,
            facets: None,
            incomplete: None,
            cad: None,
            trimmed_faces: None,
            bounds: None,
            warnings: vec![],
        }
    }

    /// Whether it is a CAD model some of whose faces could not be read.
    pub fn lacks_faces(&self) -> bool {
        self.cad.is_some() && self.incomplete.is_some()
    }

    /// What was taken for what in a table of text, as one line for people.
    pub fn reading(&self) -> Option<String> {
        let table = self.table.as_ref()?;
        let column = |c: &ColumnRecord| match &c.name {
            Some(name) => format!("{} = column {} \"{name}\"", c.axis, c.number),
            None => format!("{} = column {}", c.axis, c.number),
        };
        let columns: Vec<String> = table.columns.iter().map(column).collect();
        let sign = if table.decimal_sign == ',' { "commas" } else { "points" };
        let unit = match self.unit_from.as_str() {
            "header" => format!(", unit {} from the header", self.unit_assumed),
            _ => String::new(),
        };
        let skipped = match table.lines_skipped {
            0 => String::new(),
            1 => ", 1 line before the rows skipped".into(),
            n => format!(", {n} lines before the rows skipped"),
        };
        let (columns, of, separator) = (columns.join(", "), table.of, &table.separator);
        Some(format!("{columns} of {of}, separated by {separator}, decimal {sign}{unit}{skipped}"))
    }
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
