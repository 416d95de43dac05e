//! The tasks: one file or folder for each command of the program, each a request and how it is answered.
//!
//! | command | request | document |
//! |---|---|---|
//! | `align` | [`align::AlignRequest`] | `trueness/align/1` |
//! | `check` | [`check::CheckRequest`] | `trueness/check/1` |
//! | `compare` | [`compare::CompareRequest`] | `trueness/compare/1` |
//! | `curvature` | [`curvature::CurvatureRequest`] | `trueness/curvature/1` |
//! | `fit` | [`fit::FitRequest`] | `trueness/fit/1` |
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
pub mod curvature;
pub mod fit;
pub mod inspect;
pub mod plan_init;
pub mod repair;
pub mod section;
pub mod segment;
pub mod surface;
pub mod trend;
