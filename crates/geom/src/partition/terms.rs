//! The request to a partition, and its result.

use super::placed::Placed;
use crate::progress::Cancelled;
use crate::segment::SegmentError;
use std::collections::BTreeMap;

/// Deviations beyond which a face does not explain a point: one point of two million is so far off by normal noise.
pub(super) const EXPLAINED_SIGMAS: f64 = 5.0;

/// The options of a partition.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// Reach of faces, millimeters. Points farther off than that do not belong to the face, wherever it really is. It is looked
    /// for within the reach of the nominal. Without it a fiftieth of the face's diagonal.
    pub distance: Option<f64>,
    /// Reach of some faces, by their numbers, instead of that.
    pub reaches: BTreeMap<u32, f64>,
    /// Seed of random choices.
    pub seed: u64,
}

/// The class of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// A point of its face, with its form: dents too.
    Face,
    /// On an edge, where scans are rounded: at a border, and explained by no face.
    Edge,
    /// Along a border of its face, farther from it than scans are rounded, and explained by none. It is a burr, a groove, a
    /// chamfer that is not drawn.
    Broken,
    /// Hangs together with what lies deeper in the material than the reach of faces: of a face where it is within its reach.
    Deep,
    /// The same, but one face alone is around it, and something was measured at each of its places. It is a dent of that face,
    /// deeper than its reach.
    Dent,
    /// Hangs together with what lies farther out of the material than the reach of faces: of a face where it is within its reach.
    High,
    /// Off its face and off another one that faces the other way, by more than both explain. It is the dent of one side of a
    /// wall or of the other.
    Between,
    /// Beyond the reach of all faces, or of a scanned face and explained by none, with no more than two such points together.
    /// It is a stray, a spike that was hit once.
    Alone,
    /// A point of no face: beyond the reach of all, such as a table.
    Beyond,
}

/// A scan parted among faces.
#[derive(Clone, Debug)]
pub struct Partition {
    /// The face of each point; [`NO_FACE`](super::NO_FACE) where it has none.
    pub owners: Vec<u32>,
    /// The class of each point.
    pub classes: Vec<Class>,
    /// Whether its face lies beneath each point: those beyond a border do not tell that anything of it was measured.
    pub inside: Vec<bool>,
    /// The face of each measured facet: that on which all of its corners lie. At a sharp edge a corner is of the faces of all facets about it, and its
    /// owner one of them. [`NO_FACE`](super::NO_FACE) of what straddles an edge.
    pub facets: Vec<u32>,
    /// Points beyond the reach of all faces that lie over faces, by face and point. They lie over the nearest one where nothing
    /// was measured beneath some of them, or where they are alone. Else they lie over those that they hang together with. Dents
    /// are not among them.
    pub beyond: Vec<Beyond>,
    /// The points of [`Class::Between`] with the faces that they may be of beside their own.
    pub between: Vec<Beyond>,
    /// Where each face really is.
    pub placed: Vec<Placed>,
    /// Distance of neighboring points, millimeters.
    pub spacing: f64,
    /// The scatter of points about the surface that their neighbors tell, millimeters.
    pub noise: f64,
    /// Whether it was measured: the points scatter by more than the rounding of single precision, or facets straddle the edges.
    /// A computed mesh has neither.
    pub is_scan: bool,
}

/// A point beyond the reach of all faces that lies over one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beyond {
    /// The point.
    pub point: u32,
    /// The face.
    pub face: u32,
    /// How far it lies off the face of the nominal, positive outside of the material, millimeters.
    pub off: f64,
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
    /// A reach is no length.
    #[error("the reach of face {face} is {value}; it must be a finite length above 0")]
    Reach {
        /// Number of the face.
        face: usize,
        /// The value that was passed.
        value: f64,
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
