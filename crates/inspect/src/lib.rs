//! What measured numbers mean: result documents, verdicts, reports.
//!
//! | task | where |
//! |---|---|
//! | defects of a mesh | [`check`] |
//! | what a repair did | [`repair`] |
//! | deviations from references | [`compare`] |
//! | curvatures of meshes and clouds | [`curvature`] |
//! | elements through points | [`fit`] |
//! | surfaces through points | [`surface`] |
//! | inspection plans, as people write them | [`plan`] |
//! | kinds of characteristics | [`characteristic`] |
//! | a plan and data make verdicts | [`inspection`] |
//! | mean and spread over many parts, as reports draw them | [`trend`] |
//! | result documents, as JSON and for reports | [`results`] |
//! | reports, one HTML file each | [`report`] |
//! | color scale | [`scale`] |
//! | tolerance | [`tolerance`] |
//! | tolerance classes by letters | [`tolerance_class`] |
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "a test does not hang on the last digit"))]

pub mod characteristic;
pub mod check;
pub mod compare;
pub mod curvature;
pub mod file_numbers;
pub mod fit;
pub mod inspection;
pub mod plan;
pub mod repair;
pub mod report;
pub mod results;
pub mod scale;
pub mod segment;
mod spacing;
pub mod surface;
pub mod tolerance;
pub mod tolerance_class;
pub mod trend;
