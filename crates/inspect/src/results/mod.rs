//! The result documents: what a command found out, as the one thing that tables, reports and scripts read.
//!
//! One file each, and beside it, in `NAME/page.rs`, what its page says ([`Subject`](crate::report::Subject)).
//! Every document starts with the same header and names its inputs. A number that does not exist is `null`
//! beside a reason; NaN and infinity never appear.

pub mod align;
mod bounds;
pub mod check;
pub mod compare;
pub mod curvature;
pub mod fit;
mod input;
pub mod inspect;
mod noise;
mod percent;
pub mod place_map;
mod reason;
pub mod repair;
pub mod research;
pub mod section;
pub mod segment;
pub mod statistics;
pub mod surface;
pub mod trend;
mod verdict;
mod word;

pub use bounds::Bounds;
pub use input::{ColumnRecord, IncompleteRecord, InputRecord, Role, TableRecord, UNITS, VERSION};
pub use noise::{NoiseOrReason, SharedNoise, noise_or_reason};
pub(crate) use noise::{points_per_independent, record as noise_record};
pub use percent::{of_percent, percent, percents};
pub(crate) use reason::judged;
pub use reason::{ReasonKind, VerdictReason};
pub use statistics::{BySide, Histogram, Percentiles, Statistics};
pub use verdict::Verdict;
pub(crate) use verdict::{overall, worst};
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
        ("curvature", text(schemars::schema_for!(curvature::CurvatureDocument))),
        ("inspect", text(schemars::schema_for!(inspect::InspectDocument))),
        ("plan", text(crate::plan::schema())),
        ("repair", text(schemars::schema_for!(repair::RepairDocument))),
        ("fit", text(schemars::schema_for!(fit::FitDocument))),
        ("section", text(schemars::schema_for!(section::SectionDocument))),
        ("segment", text(schemars::schema_for!(segment::SegmentDocument))),
        ("surface", text(schemars::schema_for!(surface::SurfaceDocument))),
        ("trend", text(schemars::schema_for!(trend::TrendDocument))),
    ]
}
