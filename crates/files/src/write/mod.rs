//! Writing points and meshes. Files appear whole or not at all. Beside them what tables of text and XML documents are made with.

mod forms;
mod held;
mod mesh_file;
mod points_file;
mod regions;
#[cfg(test)]
pub(crate) mod scratch;
mod values;
mod writable;

pub use crate::csv::{Csv, LineEnd};
pub use crate::format::loss::Loss;
pub use crate::format::sink::{Block, Layout};
pub use crate::format::values::Values;
pub use crate::xml::{Attributes, Xml};
pub use held::HeldPoints;
pub use mesh_file::{MeshFile, mesh};
pub use points_file::{PointsFile, points};
pub use regions::{Pieces, regions};
pub use values::values;
pub use writable::Writable;
