//! From loose facets to a connected surface.
//!
//! | task | where |
//! |---|---|
//! | facets to a mesh whose vertices are distinct positions | [`weld`] |

mod memory;
#[cfg(test)]
mod testing;
pub mod weld;
