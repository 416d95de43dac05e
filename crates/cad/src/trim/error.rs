//! What contradicts itself in the border of a face.

/// Why a face has no inside. Loops and edges are named by their numbers.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TrimError {
    /// The face has an edge number that no edge has.
    #[error("edge {0} does not exist")]
    NoEdge(u32),
    /// A curve or surface has no place where it needs one.
    #[error("edge {0} has no finite place on the surface")]
    NotFinite(u32),
    /// An edge is used twice in the same direction, or more than twice.
    #[error("the border uses edge {0} twice in the same direction")]
    SameDirection(u32),
    /// An edge is far from the surface.
    #[error("edge {edge} is {distance} mm off the surface")]
    Off {
        /// The edge.
        edge: u32,
        /// Its greatest distance from the surface, millimeters.
        distance: f64,
    },
    /// An edge does not begin where the one before ends.
    #[error("the border is open by {distance} mm before edge {edge}")]
    Open {
        /// The edge that should go on.
        edge: u32,
        /// How far it is away, millimeters.
        distance: f64,
    },
    /// A surface without loops has sides where the face would end without an edge.
    #[error("the face has no border")]
    NoBorder,
    /// The loops lie so that they bound no part of the surface on their left.
    #[error("the loops contradict each other: they do not part an inside from an outside")]
    Contradiction,
    /// Two parts of the border cross.
    #[error("edges {0} and {1} of the border cross")]
    Crossing(u32, u32),
}
