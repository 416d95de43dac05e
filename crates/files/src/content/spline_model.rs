//! Surfaces and curves as a CAD file holds them.

use trueness_geom::spline::rational::Rational;
use trueness_geom::spline::surface::Nurbs;

/// The B-spline surfaces and curves of a file, in its order.
#[derive(Clone, Debug, Default)]
pub struct SplineModel {
    /// The surfaces, each with the normal of its face outward.
    pub surfaces: Vec<Nurbs>,
    /// The curves in space; those that bound faces are among them.
    pub curves: Vec<Rational<3>>,
}
