//! What the report draws beside the page of each document.

pub mod check;
pub mod compare;
pub mod curvature;
pub mod fit;
pub mod inspect;
pub mod repair;
pub mod segment;
pub mod surface;
pub mod trend;
