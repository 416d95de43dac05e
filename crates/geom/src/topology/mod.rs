//! From loose facets to a connected surface: welding, edges, shells, soundness. Any mesh will do, however broken.
//!
//! | task | where |
//! |---|---|
//! | facets to a mesh whose vertices are distinct positions | [`weld`] |
//! | edges, shells, places where the mesh is not a surface | [`Topology`] |
//! | may signs and volumes be trusted? | [`Soundness`] |
//! | area, volume, center of mass | [`Properties`] |

mod connect;
mod connected;
mod edge;
mod fans;
mod properties;
pub(crate) mod same;
pub mod sides;
mod soundness;
#[cfg(test)]
pub(crate) mod tests;
pub mod union;
pub mod weld;

pub use connected::{Topology, TopologyError};
pub use edge::EdgeAt;
pub use properties::Properties;
pub use soundness::{Flaw, Soundness};
