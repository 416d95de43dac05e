//! Deviations of points from a reference.

pub mod along;
pub mod paper;
pub mod sample;
pub mod sign_choice;
pub mod surface;
