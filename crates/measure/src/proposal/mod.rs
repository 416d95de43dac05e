//! Plans proposed from a nominal: of a mesh every element is a feature with the usual characteristics; a CAD model brings faces and its own
//! tolerances.

mod datums;
mod dimension;
mod draft;
mod faces;
mod general;
mod geometric;
mod legs;
mod mesh;
mod model;
mod sides;
#[cfg(test)]
mod tests;
mod text;
mod usual;

pub use general::{General, NoGeneral};
pub use mesh::of_mesh;
pub use model::{Proposal, of_model};
