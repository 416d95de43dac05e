//! Why there is no surface.

use super::not_a_disc::NotADisc;
use super::options::HIGHEST_DEGREE;
use trueness_geom::fit::FitError;
use trueness_geom::progress::Cancelled;
use trueness_geom::spline::surface::FootError;

/// Why there is no surface.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SurfaceError {
    /// Fewer points than a surface needs at all.
    #[error("a surface needs at least 4 points, there are {found}")]
    TooFewPoints {
        /// Points given.
        found: usize,
    },
    /// More points than are numbered.
    #[error("{found} points are too many: at most {} are taken", u32::MAX)]
    TooManyPoints {
        /// Points given.
        found: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("point {index} has a coordinate that is not a finite number; remove it")]
    NotFinite {
        /// Index of the first such point.
        index: usize,
    },
    /// A degree outside of 1 to [`HIGHEST_DEGREE`].
    #[error("degree {degree}: it must be from 1 to {HIGHEST_DEGREE}")]
    Degree {
        /// The degree asked for.
        degree: usize,
    },
    /// No spans.
    #[error("spans {}x{}: there must be at least 1 in each direction", spans[0], spans[1])]
    Spans {
        /// The spans asked for.
        spans: [usize; 2],
    },
    /// A tolerance that is not a length above 0.
    #[error("tolerance {0}: it must be a length above 0")]
    Tolerance(f64),
    /// A weight that is negative or not a number.
    #[error("fairness {0}: it must be a finite number of at least 0")]
    Fairness(f64),
    /// The matrix would take more memory than allowed.
    #[error("{} x {} control points need {} MB for their equations, {} MB are allowed: ask for fewer spans", counts[0], counts[1], bytes.map_or("too many".into(), |b| (b >> 20).to_string()), memory >> 20)]
    TooLarge {
        /// Control points in both directions.
        counts: [usize; 2],
        /// Memory that the matrix takes; `None` where no number holds it.
        bytes: Option<usize>,
        /// Memory that was allowed.
        memory: usize,
    },
    /// A point beyond the knots given.
    #[error(
        "point {index} has the parameter {axis} = {value}, the knots along {axis} run from {} to {}: give knots that hold all points, which lie from {} to {}",
        domain.0, domain.1, points.0, points.1
    )]
    OutsideKnots {
        /// The point.
        index: usize,
        /// `u` or `v`.
        axis: char,
        /// Its parameter.
        value: f64,
        /// First and last knot.
        domain: (f64, f64),
        /// Least and greatest parameter of all points.
        points: (f64, f64),
    },
    /// All parameters lie on one line.
    #[error(
        "all points lie on one straight line as seen on the base, or one lies very far from the others: they determine no surface"
    )]
    Line,
    /// Points without facets, where these are to be laid flat.
    #[error(
        "points without facets cannot be laid flat: give a mesh, or take plane, xy, cylinder or sphere as the base"
    )]
    NoFacets,
    /// A mesh that cannot be laid flat.
    #[error(transparent)]
    NotADisc(#[from] NotADisc),
    /// The base could not be fitted.
    #[error("no base: {0}")]
    Base(FitError),
    /// Some control points are near no data.
    #[error(
        "the points determine only some of the {total} control points ({points} points, {unsupported} control points without any near them): ask for fewer spans or a fairness above 0, or leave out points that lie far from all others"
    )]
    Undetermined {
        /// Control points sought.
        total: usize,
        /// Points given.
        points: usize,
        /// Control points without data.
        unsupported: usize,
    },
    /// The surface found cannot be searched for nearest places.
    #[error("nearest places on the surface: {0}")]
    Search(FootError),
    /// Stopped through the progress argument.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl From<FootError> for SurfaceError {
    fn from(error: FootError) -> SurfaceError {
        match error {
            FootError::Cancelled(e) => e.into(),
            other => SurfaceError::Search(other),
        }
    }
}
