//! The front door: an owned reference, files, and each task with its defaults.

pub mod deviations;
pub mod error;
pub mod model;
pub mod part;
pub mod reference;
pub mod tasks;
