//! One file a command.

pub mod align;
pub mod check;
pub mod compare;
pub mod curvature;
pub mod fit;
pub mod inspect;
pub mod plan;
pub mod repair;
pub mod section;
pub mod segment;
pub mod surface;
pub mod trend;
