//! What the report draws of each document, beside the words of its page.

pub mod check;
pub mod compare;
pub mod curvature;
pub mod fit;
pub mod inspect;
pub mod repair;
pub(crate) mod section;
pub mod segment;
pub mod surface;
pub mod trend;
