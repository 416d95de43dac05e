//! Deviations of points from a reference.

pub mod along;
mod copies;
pub mod paper;
pub mod sample;
pub mod sign_choice;
pub mod surface;
