//! Why a mesh cannot be cut where its facets meet.

use trueness_geom::closest::{MAX_VERTEX, MIN_COORDINATE};
use trueness_geom::progress::Cancelled;
use trueness_geom::space::Point;
use trueness_geom::topology::weld::WeldError;

/// Why a mesh was not cut.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ArrangeError {
    /// The faces cannot be connected.
    #[error(transparent)]
    Weld(#[from] WeldError),
    /// The work was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The mesh is a tangle.
    #[error("more than {most} pairs of its facets meet: that is a tangle, not a surface")]
    Tangle {
        /// Pairs that would have been dealt with.
        most: usize,
    },
    /// A coordinate is too large or too small for places on cuts to be computed.
    #[error("a corner at ({:e}, {:e}, {:e}) has a coordinate that is not 0 or from {MIN_COORDINATE:e} to {MAX_VERTEX:e} mm: scale the mesh first", position[0], position[1], position[2])]
    Range {
        /// The first such corner, mm.
        position: Point,
    },
    /// The facets do not enclose anything.
    #[error("the surface is not closed near ({:.6}, {:.6}, {:.6}), or runs both ways round there", position[0], position[1], position[2])]
    Open {
        /// A place at a gap, mm.
        position: Point,
    },
    /// Facets cross again wherever the cut is rounded to.
    #[error("facets near ({:.6}, {:.6}, {:.6}) lie so close that the cut cannot be written with the numbers there are; double precision, or a place nearer to the origin, leaves more of them", position[0], position[1], position[2])]
    Unresolved {
        /// The first such place, mm.
        position: Point,
    },
}
