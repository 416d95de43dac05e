//! The tasks: one file or folder for each command of the program, each a request and how it is answered.
//!
//! | command | request | document |
//! |---|---|---|
//! | `align` | [`align::AlignRequest`] | `trueness/align/1` |
//! | `check` | [`check::CheckRequest`] | `trueness/check/1` |
//! | `compare` | [`compare::CompareRequest`] | `trueness/compare/1` |
//! | `convert` | [`convert::ConvertRequest`] | `trueness/convert/1` |
//! | `curvature` | [`curvature::CurvatureRequest`] | `trueness/curvature/1` |
//! | `fit` | [`fit::FitRequest`] | `trueness/fit/1` |
//! | `info` | [`info::InfoRequest`] | `trueness/info/1` |
//! | `inspect` | [`inspect::InspectRequest`] | `trueness/inspect/1` |
//! | `plan init` | [`plan_init::PlanInitRequest`] | a text in TOML: [`plan_init::ProposedPlan`] |
//! | `repair` | [`repair::RepairRequest`] | `trueness/repair/1` |
//! | `section` | [`section::SectionRequest`] | `trueness/section/1` |
//! | `segment` | [`segment::SegmentRequest`] | `trueness/segment/1` |
//! | `surface` | [`surface::SurfaceRequest`] | `trueness/surface/1` |
//! | `trend` | [`trend::TrendRequest`] | `trueness/trend/1` |

pub mod align;
pub mod check;
pub mod compare;
pub mod convert;
pub mod curvature;
pub mod fit;
pub mod info;
pub mod inspect;
pub mod plan_init;
pub mod repair;
pub mod section;
pub mod segment;
pub mod surface;
pub mod trend;

/// Name and JSON schema of every request, as kept under `docs/schema/requests/`.
pub fn schemas() -> Vec<(&'static str, String)> {
    let text = |mut schema: schemars::Schema| {
        // Without the example, which is in Rust.
        if let Some(serde_json::Value::String(about)) = schema.get_mut("description") {
            about.truncate(about.find("\n\n```").unwrap_or(about.len()));
        }
        let mut text = serde_json::to_string_pretty(&schema).unwrap_or_default();
        text.push('\n');
        text
    };
    vec![
        ("align", text(schemars::schema_for!(align::AlignRequest))),
        ("check", text(schemars::schema_for!(check::CheckRequest))),
        ("compare", text(schemars::schema_for!(compare::CompareRequest))),
        ("convert", text(schemars::schema_for!(convert::ConvertRequest))),
        ("curvature", text(schemars::schema_for!(curvature::CurvatureRequest))),
        ("fit", text(schemars::schema_for!(fit::FitRequest))),
        ("info", text(schemars::schema_for!(info::InfoRequest))),
        ("inspect", text(schemars::schema_for!(inspect::InspectRequest))),
        ("plan-init", text(schemars::schema_for!(plan_init::PlanInitRequest))),
        ("repair", text(schemars::schema_for!(repair::RepairRequest))),
        ("section", text(schemars::schema_for!(section::SectionRequest))),
        ("segment", text(schemars::schema_for!(segment::SegmentRequest))),
        ("surface", text(schemars::schema_for!(surface::SurfaceRequest))),
        ("trend", text(schemars::schema_for!(trend::TrendRequest))),
    ]
}
