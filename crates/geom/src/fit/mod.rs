//! Elements fitted to points: line, plane, circle, ellipse, sphere, cylinder, cone, torus.
//!
//! [`fit`] is the one entrance. Distances are orthogonal distances. The points are seen from the middle of their box and at
//! unit size, so neither position nor size costs digits. The unknowns are small motions of the element about where it stands,
//! so no direction is singular.
//!
//! | file | what |
//! |---|---|
//! | `request` | what is asked |
//! | `solution` | what a fit tells |
//! | `unknown` | what an unknown does to an element |
//! | `family` | what an element is to the solvers; `line` … `torus` hold one each |
//! | `revolution`, `osculating`, `round`, `bent`, `scatter` | where to start |
//! | `normal`, `gauss`, `gaussian`, `hardly` | least squares |
//! | `linear`, `minimax`, `zone` | least greatest distance |
//! | `robust` | scans with outliers |
//! | `survey` | distances of all points |

#![allow(clippy::needless_range_loop, reason = "matrices are read by row and column")]

mod bent;
mod circle;
mod cone;
mod cylinder;
mod ellipse;
mod family;
mod gauss;
mod gaussian;
mod hardly;
mod lanes;
mod line;
mod linear;
mod minimax;
mod normal;
mod osculating;
mod plane;
mod request;
mod revolution;
mod robust;
mod round;
mod sample;
mod scatter;
mod solution;
mod sphere;
mod survey;
#[cfg(test)]
mod tests;
mod torus;
mod unknown;
mod zone;

use crate::progress::Progress;
use crate::shape::{Kind, Shape};
use crate::space::Point;
pub(crate) use linear::{Function, HIDDEN_FALL, MAX_JOINING_POINTS, MAX_POINTS_ALL_WORKING, lowest};
pub use request::{FitError, Method, Options};
pub use scatter::Scatter;
pub use solution::{Covariance, Fit, Residuals, Touching};

/// Calls the function with the family of the kind and its number of unknowns.
macro_rules! with_family {
    ($kind:expr, $function:ident ( $($argument:expr),* )) => {
        match $kind {
            Kind::Line2 => $function::<2, line::Line2>($($argument),*),
            Kind::Line => $function::<4, line::Line>($($argument),*),
            Kind::Plane => $function::<3, plane::Plane>($($argument),*),
            Kind::Circle2 => $function::<3, circle::Circle2>($($argument),*),
            Kind::Circle => $function::<6, circle::Circle>($($argument),*),
            Kind::Ellipse2 => $function::<5, ellipse::Ellipse2>($($argument),*),
            Kind::Sphere => $function::<4, sphere::Sphere>($($argument),*),
            Kind::Cylinder => $function::<5, cylinder::Cylinder>($($argument),*),
            Kind::Cone => $function::<6, cone::Cone>($($argument),*),
            Kind::Torus => $function::<7, torus::Torus>($($argument),*),
        }
    };
}

/// The best element of the given kind for `points` (millimeters). Kinds in the plane read x and y only.
///
/// The answer does not depend on the number of threads, and but for rounding not on position, attitude, size
/// or order of the points. Time grows with the number of points; beyond them nothing is stored.
///
/// # Errors
/// [`FitError`]: too few points, a coordinate that is no number, points that determine no such element, a method that this kind
/// lacks, cancelled.
pub fn fit(
    points: &[Point],
    kind: Kind,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Fit, FitError> {
    let needed = kind.fewest_points();
    if points.len() < needed {
        return Err(FitError::TooFewPoints { kind, needed, found: points.len() });
    }
    let flattened: Vec<Point>;
    let points = if kind.is_flat() && points.iter().any(|p| p[2] != 0.0) {
        flattened = points.iter().map(|p| [p[0], p[1], 0.0]).collect();
        &flattened
    } else {
        points
    };
    use gaussian::gaussian;
    use robust::robust;
    use zone::zone;
    let work = || {
        let sample = sample::Sample::new(points)?;
        match options.method {
            Method::Gaussian => with_family!(kind, gaussian(&sample, kind, options, progress)),
            Method::Robust => with_family!(kind, robust(&sample, kind, options, progress)),
            Method::MinimumZone | Method::MinimumCircumscribed | Method::MaximumInscribed => {
                with_family!(kind, zone(&sample, kind, options, progress))
            }
        }
    };
    // Among the threads once and for all: from outside, each pass over the points would wake one and wait for it.
    if points.len() <= normal::POINTS_PER_NORMAL_BLOCK { work() } else { rayon::scope(|_| work()) }
}

/// The least-squares element near `start` and the root mean square distance, to about seven digits and without the statistics
/// of [`fit`]. `None` where the points determine none.
pub(crate) fn improved(points: &[Point], start: &Shape) -> Option<(Shape, f64)> {
    let kind = start.kind();
    if points.len() < kind.fewest_points() {
        return None;
    }
    let sample = sample::Sample::new(points).ok()?;
    use gaussian::improved;
    with_family!(kind, improved(&sample, start))
}
