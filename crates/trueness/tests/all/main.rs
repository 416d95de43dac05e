//! Tasks, easy calls and documents, seen from outside. One program of all tests links once.
#![allow(clippy::disallowed_methods, clippy::panic, clippy::unwrap_used, reason = "a test may stop")]

mod cad_faces;
mod common;
mod incomplete_models;
mod inputs_are_kept;
mod named_paths;
mod outcomes;
mod plan_of_model;
mod schema;
mod tasks_compare;
mod tasks_curvature;
mod tasks_fit;
mod tasks_inspect;
mod tasks_plan_init;
mod tasks_repair;
mod tasks_section;
mod tasks_segment;
mod tasks_surface;
mod tasks_trend;
