//! Why a mesh is not repaired.

use crate::check::CheckError;
use crate::progress::Cancelled;
use crate::topology::TopologyError;
use crate::topology::weld::WeldError;

/// Why a mesh was not repaired.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RepairError {
    /// The faces cannot be connected.
    #[error(transparent)]
    Weld(#[from] WeldError),
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
