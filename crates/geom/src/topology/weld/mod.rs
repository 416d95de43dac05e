//! Weld: corners at the same position become one vertex, or those within a distance of one another.

mod bits;
mod error;
mod exact;
mod within;

pub use error::{MAX_FACETS, WeldError};
pub use exact::{Position, Welded, corners, first_at_their_places, mesh};
pub use exact::{as_it_is, check_corners, compact, rejoined};
pub use within::within;
