//! Why a mesh is not repaired.

use trueness_geom::check::CheckError;
use trueness_geom::closest::{MAX_VERTEX, MIN_COORDINATE};
use trueness_geom::progress::Cancelled;
use trueness_geom::topology::TopologyError;
use trueness_geom::topology::weld::WeldError;

/// Why a mesh was not repaired.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RepairError {
    /// The faces cannot be connected.
    #[error(transparent)]
    Weld(#[from] WeldError),
    /// A finite coordinate of this vertex is beyond [`MAX_VERTEX`], or below [`MIN_COORDINATE`] but not zero: products of such
    /// numbers say nothing.
    #[error(
        "vertex {0} has a coordinate that is not 0 or from {MIN_COORDINATE:e} to {MAX_VERTEX:e} mm: scale the mesh first"
    )]
    Range(u32),
    /// The mesh cannot be checked.
    #[error(transparent)]
    Check(CheckError),
    /// The repair was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl From<TopologyError> for RepairError {
    fn from(e: TopologyError) -> RepairError {
        CheckError::from(e).into()
    }
}

impl From<CheckError> for RepairError {
    fn from(e: CheckError) -> RepairError {
        match e {
            CheckError::Weld(e) => e.into(),
            CheckError::Cancelled(e) => e.into(),
            e => RepairError::Check(e),
        }
    }
}
