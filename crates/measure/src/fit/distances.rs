//! Distances of points from an element.

use trueness_geom::parallel::prelude::*;
use trueness_geom::shape::Shape;
use trueness_geom::space::Point;

/// Signed distance of each point from the element.
pub fn distances(shape: &Shape, points: &[Point]) -> Vec<f64> {
    points.par_iter().map(|p| shape.distance(*p)).collect()
}
