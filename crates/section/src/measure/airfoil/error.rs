//! Reasons why a contour cannot be measured as an airfoil.

use trueness_geom::progress::Cancelled;

/// Least number of points around a profile.
pub(super) const MIN_POINTS_OF_PROFILE: usize = 12;

/// Why a contour has no measures of an airfoil, or an edge no radius.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum AirfoilError {
    /// Fewer points than a profile needs.
    #[error("a profile needs at least {MIN_POINTS_OF_PROFILE} points, there are {found}")]
    TooFewPoints {
        /// Points there are.
        found: usize,
    },
    /// The ends of an open row are not those of one trailing edge.
    #[error(
        "the points do not run around a profile: their ends are {gap:.4} apart, more than a fifth of the chord of \
         {chord:.4}"
    )]
    Open {
        /// Distance between the ends.
        gap: f64,
        /// Greatest distance of a point from the middle between the ends.
        chord: f64,
    },
    /// The profile crosses itself: it has no inside.
    #[error("the profile crosses itself near ({x:.4}, {y:.4}): it has no inside to measure")]
    Crosses {
        /// Where, first coordinate.
        x: f64,
        /// Where, second coordinate.
        y: f64,
    },
    /// No curve runs through the points, or no circle fits inside.
    #[error("no circles can be inscribed: the points cross over themselves or enclose nothing")]
    Inside,
    /// The edge has corners, so no radius.
    #[error("the edge has no radius: it is {0}")]
    Cornered(&'static str),
    /// Too few points around the edge.
    #[error("{found} points around the edge tell no radius; 7 are needed")]
    FewAround {
        /// Points there are.
        found: usize,
    },
    /// The points around the edge scatter too much.
    #[error("the points scatter too much around the edge to tell its radius")]
    Hidden,
    /// The points around the edge bend the other way or not at all.
    #[error("the points around the edge do not bend")]
    Flat,
    /// No line touches one side of the profile at two places.
    #[error("no line touches one side of the profile at two places: none of them is hollow or flat")]
    NotHollow,
    /// Stopped through the progress argument.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
