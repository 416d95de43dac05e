//! What an inspection is given, and why it may stop.

use std::collections::BTreeMap;
use std::ops::Range;
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Cancelled;
use trueness_geom::scan::Scan;
use trueness_geom::space::{Point, Vector};

/// What was measured, in measured coordinates, millimeters.
#[derive(Clone, Debug, Default)]
pub struct Data {
    /// The measured mesh or cloud.
    pub measured: Option<Scan>,
    /// The normals of a measured cloud, where the plan asks which way its points face; empty otherwise.
    pub normals: Vec<Vector>,
    /// The nominal mesh, where the plan names one and has a use for it: alignment, deviations, features sought by nominals or seeds.
    pub reference: Option<Mesh>,
    /// Facets of its file that are not in the mesh, as a coordinate is not finite: their numbers, ascending.
    pub reference_left_out: Vec<u32>,
    /// Points that a report can show; 0 without a report.
    pub shown: usize,
    /// Whether deviations are kept at places that are the same for every part.
    pub places: bool,
    /// The points of features that have files of their own, by the number of the feature.
    pub points: BTreeMap<usize, OwnPoints>,
    /// Seed of the random choices of the alignment.
    pub seed: u64,
}

/// Points of a feature's own.
#[derive(Clone, Debug, Default)]
pub struct OwnPoints {
    /// The points.
    pub points: Vec<Point>,
    /// Whether they have two coordinates only.
    pub planar: bool,
}

/// Why an inspection stops without an answer.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Stop {
    /// The plan asks for what cannot be, as the data show.
    #[error("{what}")]
    Plan {
        /// Bytes of the plan's text.
        span: Range<usize>,
        /// What is wrong.
        what: String,
    },
    /// What is the same for every part cannot be used: the reference, or the places that the plan aligns by.
    #[error("{0}")]
    Nominal(String),
    /// The measured mesh cannot be searched.
    #[error("{0}")]
    Mesh(String),
    /// The measured data could not be aligned.
    #[error("the measured data cannot be aligned to the reference: {0}")]
    Align(String),
    /// There are no deviations from the reference.
    #[error("the measured data cannot be compared with the reference: {0}")]
    Deviation(String),
    /// The result is no longer wanted.
    #[error("cancelled")]
    Cancelled,
}

impl Stop {
    /// Whether it is of this part: another one of the same plan may be inspected all the same.
    pub fn of_part(&self) -> bool {
        match self {
            Stop::Mesh(_) | Stop::Align(_) | Stop::Deviation(_) => true,
            Stop::Plan { .. } | Stop::Nominal(_) | Stop::Cancelled => false,
        }
    }

    /// The same, known to be of every part.
    pub(super) fn nominal(self) -> Stop {
        if self.of_part() { Stop::Nominal(self.to_string()) } else { self }
    }
}

impl From<Cancelled> for Stop {
    fn from(_: Cancelled) -> Stop {
        Stop::Cancelled
    }
}
