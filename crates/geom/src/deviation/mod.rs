//! Deviations of points from a reference, and what can be said about them.

pub mod histogram;
pub mod moments;
pub mod neighbours;
pub mod paired;
pub mod paper;
mod part;
pub mod quantiles;
pub mod research;
pub mod sample;
pub mod sign_choice;
pub mod sketch;
pub mod statistics;
pub mod surface;
