//! What is asked of a partition, and what it tells.

use super::placed::Placed;
use crate::progress::Cancelled;
use crate::segment::SegmentError;

/// Deviations beyond which a face does not explain a point: one point of two million is so far off by normal noise.
pub(super) const EXPLAINED: f64 = 5.0;

/// What is asked of a partition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Reach of a face, millimeters: points farther off are not its own, wherever it really is; and it is looked for within the reach of the nominal.
    /// Without it a fiftieth of the face's diagonal.
    pub distance: Option<f64>,
    /// Seed of random choices.
    pub seed: u64,
}

/// What a point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Of its face, with its form: dents too.
    Face,
    /// Along a border of its face, and explained by none: a burr, a groove, a chamfer that is not drawn.
    Edge,
    /// Within the reach of its face, and hangs together with what lies deeper in the material than that.
    Deep,
    /// Within the reach of its face, and hangs together with what lies farther out of the material than that.
    High,
    /// Of no face: beyond the reach of all, or beside them and hanging together with such points, as a table.
    Beyond,
}

/// A scan parted among faces.
#[derive(Clone, Debug)]
pub struct Partition {
    /// The face of each point; [`NO_FACE`](super::NO_FACE) where it has none.
    pub owners: Vec<u32>,
    /// What each point is.
    pub classes: Vec<Class>,
    /// Where each face really is.
    pub placed: Vec<Placed>,
    /// Distance of neighboring points, millimeters.
    pub spacing: f64,
    /// What points scatter by about the surface that their neighbors tell, millimeters.
    pub noise: f64,
}

/// Why there is no partition.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum PartitionError {
    /// The nominal cannot be cut into faces.
    #[error("the nominal: {0}")]
    Nominal(#[from] SegmentError),
    /// A measured coordinate is no number.
    #[error("point {index} has a coordinate that is not a finite number; remove it")]
    NotFinite {
        /// Index of the first such point.
        index: usize,
    },
    /// A measured facet names a vertex that does not exist.
    #[error("facet {facet} names a vertex that does not exist")]
    NoSuchVertex {
        /// Index of the first such facet.
        facet: usize,
    },
    /// Stopped through the progress argument.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
