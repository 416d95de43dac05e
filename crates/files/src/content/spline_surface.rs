//! A surface as CAD programs know it.

use trueness_geom::spline::curve::Curve;

/// A B-spline surface with clamped knots, millimeters. Its control points lie row after row, those of the first knot of `u`
/// first.
#[derive(Clone, Copy, Debug)]
pub struct SplineSurface<'a> {
    /// Degrees along `u` and `v`.
    pub degree: [usize; 2],
    /// Whole knots of both directions.
    pub knots: [&'a [f64]; 2],
    /// Control points.
    pub points: &'a [[f64; 3]],
    /// The faces that it is cut into; without any the whole is one.
    pub faces: &'a [TrimmedFace],
}

/// A part of a surface within closed lines.
#[derive(Clone, Debug)]
pub struct TrimmedFace {
    /// Around it, against the clock as seen against the normal.
    pub outer: Bound,
    /// Around its holes, with the clock.
    pub holes: Vec<Bound>,
}

/// A closed line on a surface, straight in its parameters from corner to corner.
#[derive(Clone, Debug)]
pub struct Bound {
    /// Parameters of the corners.
    pub corners: Vec<[f64; 2]>,
    /// The curve from each corner to the next, the last one to the first.
    pub sides: Vec<Curve<[f64; 3]>>,
}

impl SplineSurface<'_> {
    /// Control points along `u` and `v`.
    pub(crate) fn counts(&self) -> [usize; 2] {
        [0, 1].map(|k| self.knots[k].len() - self.degree[k] - 1)
    }
    /// The control point in this row and column.
    pub(crate) fn point(&self, i: usize, j: usize) -> [f64; 3] {
        self.points[i * self.counts()[1] + j]
    }
}
