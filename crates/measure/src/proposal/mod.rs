//! Plans proposed from a nominal: of a mesh every element is a feature with the usual characteristics; a CAD model brings faces and its own
//! tolerances.

mod datums;
mod dimension;
mod draft;
mod faces;
mod geometric;
mod mesh;
mod model;
mod text;
mod usual;

pub use mesh::of_mesh;
pub use model::of_model;
