//! Why an inspection stops without an answer.

use crate::characteristic::{Impossible, NotMeasured};
use crate::compare::{CompareError, RegionError};
use std::convert::Infallible;
use std::ops::Range;
use trueness_geom::align::AlignError;
use trueness_geom::closest::MeshError;
use trueness_geom::partition::PartitionError;
use trueness_geom::progress::Cancelled;
use trueness_geom::segment::SegmentError;
use trueness_geom::topology::TopologyError;

/// Why an inspection stops without an answer.
#[derive(Debug, thiserror::Error)]
pub enum Stop {
    /// The plan asks for what cannot be, as the data show.
    #[error("{what}")]
    Plan {
        /// Bytes of the plan's text.
        span: Range<usize>,
        /// What is wrong.
        what: String,
    },
    /// The reference, which is the same for every part, cannot be used.
    #[error(transparent)]
    Nominal(NominalFault),
    /// The measured mesh cannot be searched.
    #[error(transparent)]
    Mesh(PartitionError),
    /// The measured data could not be aligned.
    #[error("the measured data cannot be aligned to the reference: {reason}")]
    Align {
        /// Why.
        reason: NotAligned,
        /// Whether another part of the same plan may be aligned all the same: not where the reference, or the places that the plan
        /// aligns by, do not allow it.
        of_part: bool,
    },
    /// There are no deviations from the reference.
    #[error("the measured data cannot be compared with the reference: {0}")]
    Deviation(NotCompared),
    /// The result is no longer wanted.
    #[error("cancelled")]
    Cancelled,
}

/// Why a reference cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum NominalFault {
    /// It cannot be searched.
    #[error(transparent)]
    Search(MeshError),
    /// It cannot be cut into faces.
    #[error("the reference cannot be cut into faces: {0}")]
    Faces(SegmentError),
    /// Nothing can be parted among its faces.
    #[error(transparent)]
    Partition(PartitionError),
    /// Nothing can be compared with it.
    #[error(transparent)]
    Compare(CompareError<Infallible, Infallible>),
}

/// Why measured data cannot be aligned.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NotAligned {
    /// There is no reference, or nothing was measured.
    #[error("one of them is not there")]
    NotThere,
    /// There is no best pose.
    #[error(transparent)]
    Search(AlignError),
    /// The reference has no inside.
    #[error(transparent)]
    Reference(TopologyError),
    /// A region with a tolerance of its own is not there.
    #[error(transparent)]
    Region(RegionError),
    /// A datum was not measured.
    #[error(transparent)]
    Datum(NotMeasured),
    /// The datums make no system.
    #[error(transparent)]
    Datums(Impossible),
    /// Its datums were not found; in another unit they may be.
    #[error("{reason}; {hint}")]
    InOtherUnit {
        /// Why.
        reason: Box<NotAligned>,
        /// In which unit the data would lie where the plan has them.
        hint: String,
    },
}

/// Why measured data cannot be compared.
#[derive(Debug, thiserror::Error)]
pub enum NotCompared {
    /// There is no reference, or nothing was measured.
    #[error("one of them is not there")]
    NotThere,
    /// There are no deviations.
    #[error(transparent)]
    Compare(CompareError<Infallible, Infallible>),
}

impl Stop {
    /// Whether it is of this part: another one of the same plan may be inspected all the same.
    pub fn of_part(&self) -> bool {
        match self {
            Stop::Mesh(_) | Stop::Deviation(_) => true,
            Stop::Align { of_part, .. } => *of_part,
            Stop::Plan { .. } | Stop::Nominal(_) | Stop::Cancelled => false,
        }
    }

    /// The same, known to be of every part.
    pub(super) fn of_every_part(self) -> Stop {
        match self {
            Stop::Align { reason, .. } => Stop::Align { reason, of_part: false },
            stop => stop,
        }
    }
}

impl From<NotAligned> for Stop {
    fn from(reason: NotAligned) -> Stop {
        Stop::Align { reason, of_part: true }
    }
}

impl From<Cancelled> for Stop {
    fn from(_: Cancelled) -> Stop {
        Stop::Cancelled
    }
}
