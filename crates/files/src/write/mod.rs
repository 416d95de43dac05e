//! Writing points and meshes. Files appear whole or not at all.

pub(crate) mod columns;
pub(crate) mod corners;
mod forms;
mod held;
mod loss;
mod mesh_file;
pub(crate) mod named;
mod points_file;
mod regions;
#[cfg(test)]
pub(crate) mod scratch;
pub(crate) mod sink;
pub(crate) mod spool;
mod values;
mod writable;

pub use held::HeldPoints;
pub use loss::Loss;
pub use mesh_file::{MeshFile, mesh};
pub use named::Values;
pub use points_file::{PointsFile, points};
pub use regions::{Pieces, regions};
pub use sink::{Block, Layout};
pub use values::values;
pub use writable::Writable;
