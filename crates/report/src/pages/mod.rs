//! What the report says of each document: its page.

pub(crate) mod align;
pub(crate) mod check;
pub(crate) mod compare;
pub(crate) mod curvature;
mod fit;
mod inspect;
mod repair;
mod section;
mod segment;
mod surface;
mod trend;

pub use trend::MapPage;
