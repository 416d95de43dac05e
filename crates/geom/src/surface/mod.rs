//! B-spline surfaces through scattered points: the points in, the surface and what it keeps to out.
//!
//! [`fit`] goes the way of reverse engineering: least-squares plane of the points, projection on it, minimum bounding rectangle
//! with the longer side as `u`, parameters, uniform clamped knots from degree and spans, control points by least squares, deviation of the
//! points. To that it adds other bases, a thin-plate term, parameter correction and knots where a tolerance asks for them.
//!
//! | file | what |
//! |---|---|
//! | `base`, `rectangle`, `fold` | parameters from a plane, a cylinder or a sphere; points that lie in layers over it |
//! | `gram`, `stencil` | normal equations, summed cell by cell |
//! | `energy` | the thin-plate term |
//! | `solve` | control points; the weight of the thin-plate term |
//! | `pass` | one fit after the other: parameter correction, weights against outliers |
//! | `refine` | knots for a tolerance |
//!
//! Sources: Hoschek, Intrinsic parametrization for approximation, Computer Aided Geometric Design 5, 1988 (parameter correction); Kim and Gu, Smoothing
//! spline Gaussian regression: more scalable computation via efficient approximation, Journal of the Royal Statistical
//! Society B 66, 2004 (cross-validation with degrees of freedom counted 1.4 times).

mod base;
mod energy;
mod fold;
mod gram;
mod pass;
mod rectangle;
mod refine;
mod solve;
mod stencil;
#[cfg(test)]
mod tests;

pub use base::{Base, BaseKind};
pub use rectangle::{Rectangle, minimum_rectangle};

use crate::fit::FitError;
use crate::progress::{Cancelled, Progress};
use crate::space::Point;
use crate::spline::basis::Knots;
use crate::spline::surface::Surface;

/// Highest degree that is fitted.
pub const HIGHEST_DEGREE: usize = 9;

/// Where the knots come from.
#[derive(Clone, Debug, PartialEq)]
pub enum Layout {
    /// So many equal spans along `u` and `v`.
    Spans([usize; 2]),
    /// These knots. Their degrees count.
    Knots([Knots; 2]),
    /// As many as keep all points within this distance, millimetres, or as the noise of the points allows.
    Tolerance(f64),
}

/// The weight of the thin-plate term.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fairness {
    /// That of least generalized cross-validation.
    Auto,
    /// This one, mm²; 0 for none. What is made least is the sum of the squared distances plus the weight times the integral
    /// of `|S_uu|² + 2 |S_uv|² + |S_vv|²` over the parameters.
    Weight(f64),
}

/// How to fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Degrees along `u` and `v`, from 1 to [`HIGHEST_DEGREE`].
    pub degree: [usize; 2],
    /// Where the knots come from.
    pub layout: Layout,
    /// Where the parameters come from.
    pub base: BaseKind,
    /// The weight of the thin-plate term.
    pub fairness: Fairness,
    /// How often the parameters are replaced by those of the nearest places at most. With [`BaseKind::Xy`] they never are.
    pub corrections: usize,
    /// Whether points far off count less (Tukey's weights).
    pub robust: bool,
    /// Bytes that the matrix of the normal equations may take.
    pub memory: usize,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            degree: [3, 3],
            layout: Layout::Spans([8, 8]),
            base: BaseKind::Plane,
            fairness: Fairness::Auto,
            corrections: 5,
            robust: false,
            memory: 2 << 30,
        }
    }
}

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
        /// What was asked for.
        degree: usize,
    },
    /// No spans.
    #[error("spans {}x{}: there must be at least 1 in each direction", spans[0], spans[1])]
    Spans {
        /// What was asked for.
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
        /// What the matrix takes; `None` where no number holds it.
        bytes: Option<usize>,
        /// What was allowed.
        memory: usize,
    },
    /// A point beyond the knots given.
    #[error("point {index} has the parameter {value}, the knots run from {} to {}: give knots that hold all points", domain.0, domain.1)]
    OutsideKnots {
        /// The point.
        index: usize,
        /// Its parameter.
        value: f64,
        /// First and last knot.
        domain: (f64, f64),
    },
    /// All parameters lie on one line.
    #[error("all points lie on one straight line as seen on the base: they determine no surface")]
    Line,
    /// The base could not be fitted.
    #[error("no base: {0}")]
    Base(FitError),
    /// Some control points are near no data.
    #[error(
        "the points determine only some of the {total} control points ({points} points, {unsupported} control points without any near them): ask for fewer spans or a fairness above 0"
    )]
    Undetermined {
        /// Control points sought.
        total: usize,
        /// Points given.
        points: usize,
        /// Control points without data.
        unsupported: usize,
    },
    /// Stopped through the progress argument.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// How well the data hold the control points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Support {
    /// Control points whose basis functions, squared and summed over all points, come to less than 10⁻⁴: what they are is the
    /// thin-plate term's doing.
    pub unsupported: usize,
    /// Control points in all.
    pub control_points: usize,
    /// Knot cells without a point.
    pub empty_cells: usize,
    /// Knot cells in all.
    pub cells: usize,
}

/// Why no more knots were set for a tolerance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reached {
    /// All points are within the tolerance.
    Tolerance,
    /// More knots followed the noise of the points only.
    Noise,
    /// There would be more control points than points, or spans without points to set knots by.
    Points,
    /// The matrix would take more memory than allowed.
    Memory,
}

/// A surface through points, and what it keeps to.
#[derive(Clone, Debug)]
pub struct SurfaceFit {
    /// The surface.
    pub surface: Surface<Point>,
    /// Where the parameters came from.
    pub base: Base,
    /// Signed distance of each point from the surface, at its nearest place; positive on the side of the normal.
    pub deviations: Vec<f64>,
    /// Parameters of those places.
    pub feet: Vec<[f64; 2]>,
    /// Points whose nearest place was not found to the last digit.
    pub unsettled: usize,
    /// Sum of the squared differences between the points and the surface at the parameters of the last fit, unweighted.
    pub sum_of_squares: f64,
    /// Greatest such difference.
    pub max_residual: f64,
    /// Weight of the thin-plate term, mm².
    pub fairness: f64,
    /// Degrees of freedom that the surface uses: the trace of the matrix from points to fitted points. `None` where the
    /// fairness was given.
    pub degrees_of_freedom: Option<f64>,
    /// How well the data hold it.
    pub support: Support,
    /// Control points outside of twice the box of the points.
    pub far_control_points: usize,
    /// Parameter corrections made.
    pub corrections: usize,
    /// Points without weight; 0 but for robust fits.
    pub outliers: usize,
    /// Why no more knots were set; `None` without a tolerance.
    pub reached: Option<Reached>,
}

/// The B-spline surface of least squares through `points` (millimetres).
///
/// The answer is the same on any number of threads. Cost: some passes over the points, and `n b²` multiplications for each
/// weight tried, with `n` control points and `b` of them in a band (degree times the smaller number in a direction). Memory: about
/// 90 bytes a point and `8 n b`.
///
/// # Errors
/// [`SurfaceError`]: points or options that allow no surface.
///
/// ```
/// use trueness_geom::progress::Silent;
/// use trueness_geom::surface::{Fairness, Layout, Options, fit};
/// let heights = [0.0, 0.0, 0.0, 0.0, 0.3, 0.0, 0.0, 0.0, 0.0];
/// let points: Vec<[f64; 3]> = (0..9).map(|k| [f64::from(1 + k / 3), f64::from(1 + k % 3), heights[k as usize]]).collect();
/// let options = Options {
///     degree: [2, 2],
///     layout: Layout::Spans([1, 1]),
///     fairness: Fairness::Weight(0.0),
///     ..Options::default()
/// };
/// let found = fit(&points, &options, &Silent).unwrap();
/// let middle = found.surface.points()[4];
/// assert!([2.0, 2.0, 1.2].iter().zip(middle).all(|(a, b)| (a - b).abs() < 1e-12));
/// ```
pub fn fit(points: &[Point], options: &Options, progress: &dyn Progress) -> Result<SurfaceFit, SurfaceError> {
    check(points, options)?;
    rayon::scope(|_| {
        let (base, parameters) = base::parameters(points, options.base, progress)?;
        let domain = [0, 1].map(|k| match &options.layout {
            Layout::Knots(knots) => knots[k].domain(),
            _ => range(&parameters, k),
        });
        for (k, domain) in domain.into_iter().enumerate() {
            let outside = |p: &[f64; 2]| p[k] < domain.0 || p[k] > domain.1;
            if let Some(index) = parameters.iter().position(outside) {
                return Err(SurfaceError::OutsideKnots { index, value: parameters[index][k], domain });
            }
        }
        let uniform = |spans: [usize; 2]| {
            [0, 1].map(|k| Knots::uniform(options.degree[k], spans[k], domain[k].0, domain[k].1))
        };
        match &options.layout {
            Layout::Spans(spans) => {
                pass::corrected(points, parameters, base, uniform(*spans), options, progress)
            }
            Layout::Knots(knots) => {
                pass::corrected(points, parameters, base, knots.clone(), options, progress)
            }
            Layout::Tolerance(t) => {
                let start = refine::first_spans(domain);
                refine::to_tolerance(points, parameters, base, uniform(start), *t, options, progress)
            }
        }
    })
}

/// Least and greatest of a parameter.
fn range(parameters: &[[f64; 2]], k: usize) -> (f64, f64) {
    let both = (f64::INFINITY, f64::NEG_INFINITY);
    parameters.iter().fold(both, |(low, high), p| (low.min(p[k]), high.max(p[k])))
}

fn check(points: &[Point], options: &Options) -> Result<(), SurfaceError> {
    let degrees = match &options.layout {
        Layout::Knots(knots) => [knots[0].degree(), knots[1].degree()],
        _ => options.degree,
    };
    if let Some(degree) = degrees.into_iter().find(|d| !(1..=HIGHEST_DEGREE).contains(d)) {
        return Err(SurfaceError::Degree { degree });
    }
    match &options.layout {
        Layout::Spans(spans) if spans.contains(&0) => return Err(SurfaceError::Spans { spans: *spans }),
        Layout::Tolerance(t) if !(*t > 0.0 && t.is_finite()) => return Err(SurfaceError::Tolerance(*t)),
        _ => {}
    }
    if let Fairness::Weight(w) = options.fairness
        && !(w >= 0.0 && w.is_finite())
    {
        return Err(SurfaceError::Fairness(w));
    }
    if points.len() < 4 {
        return Err(SurfaceError::TooFewPoints { found: points.len() });
    }
    if points.len() > u32::MAX as usize {
        return Err(SurfaceError::TooManyPoints { found: points.len() });
    }
    let counts = match &options.layout {
        Layout::Spans(spans) => Some([0, 1].map(|k| spans[k].saturating_add(degrees[k]))),
        Layout::Knots(knots) => Some([knots[0].count(), knots[1].count()]),
        Layout::Tolerance(_) => None,
    };
    if let Some(counts) = counts {
        solve::allowed(counts, degrees, options.memory)?;
    }
    match points.iter().position(|p| p.iter().any(|x| !x.is_finite())) {
        Some(index) => Err(SurfaceError::NotFinite { index }),
        None => Ok(()),
    }
}
