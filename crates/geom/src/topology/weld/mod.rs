//! Weld: corners at the same position become one vertex, or those within a distance of one another.

mod bits;
mod error;
mod exact;
mod within;

pub use error::{MOST_FACETS, WeldError};
pub(crate) use exact::check_corners;
pub use exact::{Position, Welded, corners, mesh};
pub use within::within;
