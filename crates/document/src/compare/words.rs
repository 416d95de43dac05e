//! The words of comparisons.

use crate::word::{named, words};

/// What was measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeasuredKind {
    /// Points of a file.
    Points,
    /// All vertices of a mesh.
    Vertices,
    /// Places drawn on a mesh's surface.
    Samples,
}

named!(
    MeasuredKind,
    "kind of measured points",
    [MeasuredKind::Points, MeasuredKind::Vertices, MeasuredKind::Samples],
    |kind| match kind {
        MeasuredKind::Points => "points",
        MeasuredKind::Vertices => "vertices",
        MeasuredKind::Samples => "samples",
    }
);

words! {
    /// How the signs of deviations were found.
    SignBy, "sign method", {
        /// Side of the angle-weighted pseudonormal of the facet, edge or vertex hit.
        Pseudonormal = "pseudonormal",
        /// Inside where the winding number exceeds one half.
        Winding = "winding",
        /// Side of the normal of a B-spline surface.
        Normal = "normal",
        /// No sign: distances.
        None = "none",
        /// Each reference has a method of its own.
        Several = "several",
    }
}

/// Along what lines deviations are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AlongKind {
    /// One direction for all points.
    Direction,
    /// The reference's normal at the nearest place.
    Reference,
    /// Each point's own normal.
    Measured,
}

named!(
    AlongKind,
    "kind of line",
    [AlongKind::Direction, AlongKind::Reference, AlongKind::Measured],
    |kind| match kind {
        AlongKind::Direction => "direction",
        AlongKind::Reference => "reference",
        AlongKind::Measured => "measured",
    }
);

/// How distances are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Method {
    /// The true minimum over all facets.
    #[default]
    Exact,
    /// The nearest-vertex method of the paper.
    Paper,
}

impl Method {
    /// The word of the result document.
    pub fn name(self) -> &'static str {
        match self {
            Method::Exact => "exact",
            Method::Paper => "paper",
        }
    }
}

named!(Method, "method of a comparison", [Self::Exact, Self::Paper], |method| method.name());
