//! Surfaces that cannot be searched.

use super::Nurbs;
use crate::progress::Cancelled;
use crate::space::{Aabb, Point};

/// Why surfaces cannot be searched.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum FootError {
    /// There is none.
    #[error("there is no surface")]
    NoSurface,
    /// A coordinate is not finite, or far beyond all measure.
    #[error(
        "control point {point} of surface {surface} is not a finite number of at most 10¹² mm, beyond which places round to more than 0.0001 mm: correct it"
    )]
    BadPoint {
        /// The surface, from 0.
        surface: usize,
        /// The control point, from 0.
        point: usize,
    },
    /// Weights so different that nearest places are not found to rounding.
    #[error(
        "the weights of surface {surface} differ by a factor of {ratio:.3e}, more than 10000: export it with weights nearer to each other"
    )]
    Weights {
        /// The surface, from 0.
        surface: usize,
        /// The greatest by the least.
        ratio: f64,
    },
    /// A knot within stands as often as the degree and one.
    #[error("surface {surface} is torn at the knot {knot}, which stands {times} times: split it there")]
    Torn {
        /// The surface, from 0.
        surface: usize,
        /// The knot.
        knot: f64,
        /// How often it stands.
        times: usize,
    },
    /// More spans than cells can be numbered.
    #[error(
        "the surfaces have {0} pairs of spans, more than can be searched: divide them among several files"
    )]
    TooMany(usize),
    /// The work was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Larger coordinates, millimeters, round to more than a ten-thousandth: distances from such a surface are its rounding.
const MAX_SURFACE_COORDINATE: f64 = 1e12;

/// Factor between weights beyond which steps through the parameters are lost in rounding. A surface with 10⁶ had places 0.6 mm
/// off. Arcs of half a circle have weights of 2 at most.
const MAX_WEIGHT_RATIO: f64 = 1e4;

/// The box of the control points of surfaces that can be searched.
pub(super) fn check(surfaces: &[Nurbs]) -> Result<Aabb, FootError> {
    if surfaces.is_empty() {
        return Err(FootError::NoSurface);
    }
    let mut bounds = Aabb::EMPTY;
    for (surface, s) in surfaces.iter().enumerate() {
        let points = s.control_points();
        let bad = |(p, w): &(Point, f64)| {
            !p.iter().all(|x| x.abs() <= MAX_SURFACE_COORDINATE) || w.is_nan() || *w <= 0.0
        };
        if let Some(point) = points.iter().position(bad) {
            return Err(FootError::BadPoint { surface, point });
        }
        let (least, most) =
            points.iter().fold((f64::INFINITY, 0.0f64), |(low, high), (_, w)| (low.min(*w), high.max(*w)));
        if most > MAX_WEIGHT_RATIO * least {
            return Err(FootError::Weights { surface, ratio: most / least });
        }
        for knots in s.knots() {
            if let Some((knot, times)) = knots.torn() {
                return Err(FootError::Torn { surface, knot, times });
            }
        }
        bounds = points.iter().fold(bounds, |b, (p, _)| b.union(&Aabb { min: *p, max: *p }));
    }
    Ok(bounds)
}
