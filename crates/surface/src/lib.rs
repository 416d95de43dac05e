//! B-spline surfaces through scattered points: the points in, the surface and its limits out.
//!
//! [`fit`] goes the way of reverse engineering. It projects the points on their least-squares plane, and takes the minimum bounding rectangle with the longer side as `u`
//! for the parameters. Uniform clamped knots follow from degree and spans, the control points by least squares, and
//! then the deviations of the points. To that it adds other bases, a thin-plate term, parameter correction and knots
//! where a tolerance asks for them.
//!
//! | file | what |
//! |---|---|
//! | `base`, `rectangle`, `fold`, `upright` | parameters from a plane, a cylinder or a sphere; points that lie in layers over it, and the plane without |
//! | `pole` | the axis of a sphere whose poles lie far from the points |
//! | `flatten` | parameters from the facets of a mesh, laid flat |
//! | `gram`, `stencil` | normal equations, summed cell by cell |
//! | `energy` | the thin-plate term |
//! | `hold` | what holds the control points where points are few |
//! | `gaps` | gaps between rows of points, and the least weight of the thin-plate term that they ask for |
//! | `solve` | control points; the weight of the thin-plate term |
//! | `outliers` | points that contradict their neighbors |
//! | `pass` | one fit after the other: parameter correction |
//! | `tolerance` | the surface of few control points that keeps to a tolerance |
//! | `refine`, `coarser`, `grain` | knots where they are needed, and only there; the direction in which the surface bends most |
//! | `outline`, `raster`, `trimmed` | where the points end: the outline along which the surface is cut off, and facets within it |
//! | `border` | points beyond the border, and the surface that reaches over them |
//! | `crossing` | whether lines in the plane cross |
//! | `feet`, `nearest` | nearest places of the points: near their parameters, and beyond doubt |
//!
//! Sources: Hoschek, Intrinsic parametrization for approximation, Computer Aided Geometric Design 5, 1988 (parameter
//! correction). Kim and Gu, Smoothing spline Gaussian regression: more scalable computation via efficient
//! approximation, Journal of the Royal Statistical Society B 66, 2004. Theirs is the cross-validation with degrees of
//! freedom counted 1.4 times.
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "a test does not hang on the last digit"))]

mod base;
mod border;
mod coarser;
mod crossing;
pub mod curvature;
mod energy;
mod error;
mod feet;
mod flatten;
mod fold;
mod found;
mod gaps;
mod grain;
mod gram;
mod hold;
mod nearest;
mod not_a_disc;
mod options;
mod outliers;
mod outline;
mod pass;
mod pole;
mod raster;
mod rectangle;
mod refine;
mod solve;
mod stencil;
#[cfg(test)]
mod tests;
mod tolerance;
mod trimmed;
mod upright;

pub use base::Base;
pub use error::SurfaceError;
pub use found::{Reached, Support, SurfaceFit};
pub use not_a_disc::NotADisc;
pub use options::{BaseKind, Fairness, HIGHEST_DEGREE, Layout, Options};
pub use outline::{Outline, OutlineRegion};
pub use rectangle::{Rectangle, minimum_rectangle};
pub use trimmed::trimmed;

use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_geom::space::Point;
use trueness_geom::spline::basis::Knots;

/// The B-spline surface of least squares through `points` (millimeters).
///
/// The answer is the same on any number of threads. Cost: some passes over the points, and `n b²` multiplications for
/// each weight tried. `n` is the number of control points, and `b` that in a band (degree times the smaller number in a
/// direction). Memory: about 90 bytes a point and `8 n b`.
///
/// # Errors
/// [`SurfaceError`]: points or options that allow no surface.
///
/// ```
/// use trueness_geom::progress::Silent;
/// use trueness_surface::{Fairness, Layout, Options, fit};
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
        if options.robust {
            let (base, parameters) = base::level(points, options.base, progress)?;
            return without_outliers(points, &base, &parameters, progress, |out| {
                let kept = outliers::others(points, out);
                let (base, parameters) = base::parameters(&kept, options.base, progress)?;
                over(&kept, base, parameters, options, progress)
            });
        }
        let (base, parameters) = base::parameters(points, options.base, progress)?;
        over(points, base, parameters, options, progress)
    })
}

/// The fit without the points that contradict their neighbors, with the deviations and nearest places of all; `fit` leaves out those with
/// these numbers.
fn without_outliers(
    points: &[Point],
    base: &Base,
    parameters: &[[f64; 2]],
    progress: &dyn Progress,
    fit: impl Fn(&[u32]) -> Result<SurfaceFit, SurfaceError>,
) -> Result<SurfaceFit, SurfaceError> {
    let out = outliers::outliers(points, base, parameters, progress)?;
    fit_without(points, fit(&out)?, out, progress)
}

/// The fit of all points but those `out`, with the deviations and nearest places of all.
fn fit_without(
    points: &[Point],
    found: SurfaceFit,
    out: Vec<u32>,
    progress: &dyn Progress,
) -> Result<SurfaceFit, SurfaceError> {
    let mut all = SurfaceFit {
        deviations: vec![f64::INFINITY; points.len()],
        feet: vec![[0.0; 2]; points.len()],
        doubtful: out.clone(),
        left_out: out,
        ..found.clone()
    };
    let kept: Vec<usize> = all.kept().collect();
    for (k, i) in kept.into_iter().enumerate() {
        (all.deviations[i], all.feet[i]) = (found.deviations[k], found.feet[k]);
    }
    let all = nearest::with_true_distances(points, all, 0.0, progress)?;
    Ok(SurfaceFit { unsettled: found.unsettled + all.doubtful.len(), ..all })
}

/// The B-spline surface of least squares through the vertices of a mesh. With [`BaseKind::Mesh`] the parameters come from its facets,
/// which are laid flat; with the other bases it is [`fit`] of the vertices.
///
/// Facets count that name three different vertices. The mesh has one part with a rim and without handles; holes are
/// allowed. Lengths of the facets are kept as far as they can be; an unrolled surface keeps them all. Parameters run
/// along the minimum bounding rectangle; the normal looks as that of the facets does. Cost: besides that of the fit
/// some dozens of rounds over the facets, and 1 kB a vertex.
///
/// # Errors
/// [`SurfaceError`]: as of [`fit`], and [`NotADisc`].
///
/// ```
/// use trueness_geom::mesh::Mesh;
/// use trueness_geom::progress::Silent;
/// use trueness_surface::{BaseKind, Options, fit_mesh};
/// // Three quarters of a pipe.
/// let place = |k: u32| {
///     let angle = f64::from(k % 61) * 0.0785;
///     [10.0 * angle.cos(), 10.0 * angle.sin(), f64::from(k / 61)]
/// };
/// let cells = (0..20).flat_map(|j| (0..60).map(move |i| 61 * j + i));
/// let faces = cells.flat_map(|a| [[a, a + 1, a + 62], [a, a + 62, a + 61]]).collect();
/// let mesh = Mesh { positions: (0..61 * 21).map(place).collect(), faces };
/// let options = Options { base: BaseKind::Mesh, ..Options::default() };
/// let found = fit_mesh(&mesh, &options, &Silent).unwrap();
/// assert!(found.deviations.iter().all(|d| d.abs() < 1e-2));
/// ```
pub fn fit_mesh(mesh: &Mesh, options: &Options, progress: &dyn Progress) -> Result<SurfaceFit, SurfaceError> {
    if options.base != BaseKind::Mesh {
        return fit(&mesh.positions, options, progress);
    }
    check(&mesh.positions, options)?;
    rayon::scope(|_| {
        let (base, parameters) = base::laid_flat(mesh, progress)?;
        let points = &mesh.positions;
        if options.robust {
            return without_outliers(points, &base, &parameters, progress, |out| {
                let (kept, parameters) = (outliers::others(points, out), outliers::others(&parameters, out));
                over(&kept, base, parameters, options, progress)
            });
        }
        over(points, base, parameters, options, progress)
    })
}

/// The fit over the parameters of a base.
fn over(
    points: &[Point],
    base: Base,
    parameters: Vec<[f64; 2]>,
    options: &Options,
    progress: &dyn Progress,
) -> Result<SurfaceFit, SurfaceError> {
    let domain = match &options.layout {
        Layout::Knots(knots) => knots.each_ref().map(Knots::domain),
        _ => base::ranges(parameters.iter().copied()),
    };
    for (k, domain) in domain.into_iter().enumerate() {
        let outside = |p: &[f64; 2]| p[k] < domain.0 || p[k] > domain.1;
        if let Some(index) = parameters.iter().position(outside) {
            let (axis, value) = (['u', 'v'][k], parameters[index][k]);
            let points = base::ranges(parameters.iter().copied())[k];
            return Err(SurfaceError::OutsideKnots { index, axis, value, domain, points });
        }
    }
    let uniform = |spans: [usize; 2]| {
        [0, 1].map(|k| Knots::uniform(options.degree[k], spans[k], domain[k].0, domain[k].1))
    };
    let found = match &options.layout {
        Layout::Auto => {
            let knots = uniform(automatic_spans(&base, domain, points.len(), options));
            pass::corrected(points, parameters, base, knots, options, progress)
        }
        Layout::Spans(spans) => pass::corrected(points, parameters, base, uniform(*spans), options, progress),
        Layout::Knots(knots) => pass::corrected(points, parameters, base, knots.clone(), options, progress),
        Layout::Tolerance(t) => {
            let task = refine::Task { points, tolerance: *t, options, progress };
            tolerance::to_tolerance(task, base, parameters)
        }
    };
    let mut found = nearest::with_true_distances(points, found?, 0.0, progress)?;
    // A surface that is not held goes along anything.
    if found.base.is_on_edge() && found.far_control_points == 0 {
        let base = found.base;
        found.base.standing_share = upright::passed_by(points, |p| base.up(p), &found.surface, progress)?;
    }
    Ok(found)
}

/// Spans where none are asked for.
const DEFAULT_SPANS: usize = 8;
/// Angle of a round base that one span takes at most: a cubic has the curvature of such an arc to half a percent.
const MAX_TURN_PER_SPAN: f64 = std::f64::consts::PI / 12.0;
/// Points to a control point that more spans than [`DEFAULT_SPANS`] need.
const POINTS_PER_CONTROL_POINT: usize = 4;

/// Spans that follow a round base, as far as there are points for them.
fn automatic_spans(base: &Base, domain: [(f64, f64); 2], points: usize, options: &Options) -> [usize; 2] {
    let Some(radius) = base.radius else { return [DEFAULT_SPANS; 2] };
    let along = base.round_directions();
    let wanted = [0, 1].map(|k| {
        let turns = if along[k] { (domain[k].1 - domain[k].0) / (radius * MAX_TURN_PER_SPAN) } else { 0.0 };
        (turns.ceil() as usize).max(DEFAULT_SPANS)
    });
    let count = |spans: [usize; 2]| (spans[0] + options.degree[0]) * (spans[1] + options.degree[1]);
    if POINTS_PER_CONTROL_POINT * count(wanted) <= points { wanted } else { [DEFAULT_SPANS; 2] }
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
        Layout::Auto | Layout::Tolerance(_) => None,
    };
    if let Some(counts) = counts {
        solve::allowed(counts, degrees, options.memory)?;
    }
    match points.iter().position(|p| p.iter().any(|x| !x.is_finite())) {
        Some(index) => Err(SurfaceError::NotFinite { index }),
        None => Ok(()),
    }
}
