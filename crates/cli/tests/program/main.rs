//! The program as a user runs it: a module for each question. They share an executable, as each would link all libraries again.
//!
//! What measures time, and what documents call by name, stands beside this folder.
#![allow(missing_docs)]

#[path = "../common/mod.rs"]
mod common;

mod align;
mod bunny;
mod cad_nominal;
mod check;
mod compare_along;
mod compare_choice;
mod compare_regions;
mod compare_surfaces;
mod compare_verdict;
mod convert;
mod curvature;
mod examples;
mod files_of_a_run;
mod fit;
mod inspect;
mod inspect_datums;
mod inspect_deviation;
mod inspect_many_parts;
mod inspect_names;
mod inspect_plans;
mod inspect_plate;
mod inspect_qif;
mod option_ranges;
mod output;
mod progress;
mod repair;
mod section;
mod section_airfoil;
mod section_corpus;
mod section_drawing;
mod section_exact;
mod section_facing;
mod section_hints;
mod section_near_arc;
mod section_nominal_fit;
mod section_strays;
mod segment;
mod surface;
mod surface_bases;
mod tables;
mod tasks;
mod trend;
mod wrong_inputs;
mod wrong_questions;
