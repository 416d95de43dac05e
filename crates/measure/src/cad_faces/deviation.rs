//! Deviations of points from the faces.

use super::faces::CadFaces;
use trueness_cad::search::{Nearest, Side};
use trueness_geom::closest::QueryError;
use trueness_geom::deviation::sign_choice::SignRequest;
use trueness_geom::deviation::surface::{Exclusion, SurfaceOptions};
use trueness_geom::progress::Progress;
use trueness_geom::space::{Point, dot, minus};

impl CadFaces {
    /// The deviation of each point, mm, in their order: + outside, − inside; see [`Exclusion`] for points that have none.
    ///
    /// # Errors
    /// [`QueryError::BadPoint`] for a point that is not finite, [`QueryError::Cancelled`]. `progress` hears of points.
    pub fn deviations(
        &self,
        points: &[Point],
        options: &SurfaceOptions,
        progress: &dyn Progress,
    ) -> Result<Vec<f64>, QueryError> {
        self.search.map(points, progress, |i, near| deviation(&points[i], &near, options))
    }
}

/// The deviation of a point from the place that is nearest to it; see [`Exclusion`] for a value that is not finite.
pub fn deviation(p: &Point, near: &Nearest, options: &SurfaceOptions) -> f64 {
    if near.distance > options.max_distance {
        return Exclusion::MaxDistance.value();
    }
    if options.skip_boundary && near.side == Side::Open {
        return Exclusion::BoundaryEdge.value();
    }
    if options.sign == SignRequest::None {
        return near.distance;
    }
    // At the border of an open shell the normal tells the side, as it does beside it.
    let by_normal = || {
        let inside = near.normal.is_some_and(|n| dot(n, minus(*p, near.place)) < 0.0);
        if inside { -near.distance } else { near.distance }
    };
    near.signed().unwrap_or_else(by_normal)
}
