//! The surface found, and the limits that it keeps to.

use super::base::Base;
use super::outline::Outline;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::Point;
use trueness_geom::spline::surface::Surface;

/// How well the data hold the control points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Support {
    /// Control points whose basis functions, squared and summed over all points, come to less than 10⁻⁴. Their places
    /// are the thin-plate term's doing.
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

impl Reached {
    /// All of them.
    pub const ALL: [Reached; 4] = [Reached::Tolerance, Reached::Noise, Reached::Points, Reached::Memory];

    /// The word for it: `tolerance`, `noise`, …
    pub fn name(self) -> &'static str {
        match self {
            Reached::Tolerance => "tolerance",
            Reached::Noise => "noise",
            Reached::Points => "points",
            Reached::Memory => "memory",
        }
    }
}

/// A surface through points, and the limits that it keeps to.
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
    /// Points whose nearest place was not found to the last digit, or not beyond doubt.
    pub unsettled: usize,
    /// Points whose foot is that of a descent from their parameters, not shown to be the nearest place.
    pub(super) doubtful: Vec<u32>,
    /// Stiffness of the plates that hold control points where points are few.
    pub(super) stiffness: f64,
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
    /// Control points outside of twice the box of the points along the axes of the base; of a flat one, farther than half its diagonal.
    pub far_control_points: usize,
    /// Parameter corrections made.
    pub corrections: usize,
    /// Points that contradict their neighbors and had no part in the fit, in ascending order; none but of robust fits.
    pub left_out: Vec<u32>,
    /// Points that lie beyond the border of the surface, in ascending order: their distance has a part along it and is no deviation.
    pub beyond_border: Vec<u32>,
    /// Why no more knots were set; `None` without a tolerance.
    pub reached: Option<Reached>,
}

impl SurfaceFit {
    /// Numbers of the points that the surface was fitted to.
    pub fn kept(&self) -> impl Iterator<Item = usize> {
        let mut out = self.left_out.iter().map(|i| *i as usize).peekable();
        (0..self.deviations.len()).filter(move |i| out.next_if_eq(i).is_none())
    }

    /// Numbers of the points whose deviations count: of those it was fitted to, and not beyond its border.
    pub fn counted(&self) -> impl Iterator<Item = usize> {
        let mut out = self.beyond_border.iter().map(|i| *i as usize).peekable();
        self.kept().filter(move |i| out.next_if_eq(i).is_none())
    }

    /// The outline of the places nearest to the points; see [`Outline::new`].
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn outline(&self, reach: Option<f64>, progress: &dyn Progress) -> Result<Outline, Cancelled> {
        Outline::new(&self.feet, self.surface.domain(), reach, progress)
    }
}
