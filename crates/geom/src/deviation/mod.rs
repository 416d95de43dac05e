//! Deviations of points from a reference, and what can be said about them.

pub mod moments;
pub mod neighbours;
pub mod paper;
pub mod quantiles;
pub mod sketch;
pub mod statistics;
