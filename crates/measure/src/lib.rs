//! From geometry to result documents: characteristics, comparisons, inspections and their decisions.
//!
//! | task | where |
//! |---|---|
//! | what is in a CAD model | [`cad`] |
//! | faces of a CAD model as a reference | [`cad_faces`] |
//! | defects of a mesh | [`check`] |
//! | faults of a CAD model | [`model_check`] |
//! | what a repair did | [`repair`] |
//! | deviations from references | [`compare`] |
//! | a CAD model in pictures | [`drawn_faces`] |
//! | curvatures of meshes and clouds | [`curvature`] |
//! | elements through points | [`fit`] |
//! | elements found in a scan | [`segment`] |
//! | surfaces through points | [`surface`] |
//! | what a plan requires, as values | [`requirement`] |
//! | kinds of characteristics | [`characteristic`] |
//! | inspection plans that can be evaluated | [`plan`] |
//! | a plan and data make verdicts | [`inspection`] |
//! | a nominal makes a plan | [`proposal`] |
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "a test does not hang on the last digit"))]

pub mod align;
mod area;
mod bounds;
pub mod cad;
pub mod cad_faces;
pub mod characteristic;
pub mod check;
pub mod compare;
pub mod curvature;
pub mod drawn_faces;
pub mod file_numbers;
pub mod fit;
pub mod inspection;
pub mod model_check;
mod no_solid;
mod noise;
pub mod plan;
pub mod proposal;
pub mod repair;
pub mod requirement;
pub mod section;
pub mod segment;
pub mod spacing;
mod statistics;
pub mod surface;
pub mod trend;
pub mod words;

pub use bounds::bounds;
pub use noise::{NoSharedNoise, NoiseOrReason, noise_or_reason, points_per_independent};
pub use statistics::{by_side, counted, histogram, statistics};
