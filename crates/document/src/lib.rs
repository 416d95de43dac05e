//! Result documents, verdicts, and inspection plans as people write them: values and texts, without geometry.
//!
//! | task | where |
//! |---|---|
//! | what a command found out | a module and a document each: [`align`], [`check`], [`compare`], [`convert`], [`curvature`], [`fit`], [`info`], [`inspect`], [`repair`], [`section`], [`segment`], [`surface`], [`trend`] |
//! | the files that were read | [`InputRecord`] |
//! | verdicts and their reasons | [`Verdict`], [`VerdictReason`] |
//! | statistics and counts of values | [`Statistics`], [`Histogram`] |
//! | words of documents | [`Word`], [`Named`] |
//! | inspection plans, as people write them | [`plan`] |
//! | color scale | [`scale`] |
//! | tolerance | [`tolerance`] |
//! | tolerance classes by letters | [`tolerance_class`] |
//! | documents from JSON | [`json`] |
//! | JSON schemas | [`schemas`] |
//!
//! Every document starts with the same header and names its inputs. A number that does not exist is `null`
//! beside a reason; NaN and infinity never appear.
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "a test does not hang on the last digit"))]

pub mod align;
mod bounds;
pub mod check;
pub mod compare;
pub mod convert;
pub mod curvature;
pub mod face;
pub mod fit;
pub mod info;
mod input;
pub mod inspect;
pub mod json;
pub mod noise;
mod percent;
pub mod place_map;
pub mod plan;
mod reason;
pub mod repair;
pub mod research;
mod result;
pub mod scale;
pub mod section;
pub mod segment;
pub mod shape;
pub mod statistics;
pub mod surface;
pub mod tolerance;
pub mod tolerance_class;
pub mod trend;
pub mod verdict;
pub mod word;

pub use bounds::Bounds;
pub use input::{
    CadInputRecord, ColumnRecord, IncompleteRecord, InputRecord, Role, TableRecord, UNITS, VERSION,
};
pub use noise::SharedNoise;
pub use percent::{NoPercent, of_percent, percent, percents};
pub use reason::{ReasonKind, VerdictReason, judged};
pub use result::ResultDocument;
pub use statistics::{BySide, Histogram, Percentiles, Statistics};
pub use verdict::{Verdict, overall, worst};
pub use word::{Named, Word};

/// Name and JSON schema of every result document, as kept under `docs/schema/`.
pub fn schemas() -> Vec<(&'static str, String)> {
    let text = |schema: schemars::Schema| {
        let mut text = serde_json::to_string_pretty(&schema).unwrap_or_default();
        text.push('\n');
        text
    };
    vec![
        ("align", text(schemars::schema_for!(align::AlignDocument))),
        ("check", text(schemars::schema_for!(check::CheckDocument))),
        ("compare", text(schemars::schema_for!(compare::CompareDocument))),
        ("convert", text(schemars::schema_for!(convert::ConvertDocument))),
        ("curvature", text(schemars::schema_for!(curvature::CurvatureDocument))),
        ("info", text(schemars::schema_for!(info::InfoDocument))),
        ("inspect", text(schemars::schema_for!(inspect::InspectDocument))),
        ("plan", text(plan::schema())),
        ("repair", text(schemars::schema_for!(repair::RepairDocument))),
        ("fit", text(schemars::schema_for!(fit::FitDocument))),
        ("section", text(schemars::schema_for!(section::SectionDocument))),
        ("segment", text(schemars::schema_for!(segment::SegmentDocument))),
        ("surface", text(schemars::schema_for!(surface::SurfaceDocument))),
        ("trend", text(schemars::schema_for!(trend::TrendDocument))),
    ]
}
