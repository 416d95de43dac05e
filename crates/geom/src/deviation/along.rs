//! Deviations along a line through each point instead of to its nearest place.
//!
//! The size is the distance to the nearest crossing of that line with the mesh, ahead or behind. The sign is that of the
//! nearest place, since a point's side of a surface does not depend on where one looks.

use super::surface::{Exclusion, OnlyCancels, ReferenceSurface};
use crate::closest::{Crossing, QueryError, Signs};
use crate::progress::{Cancelled, Progress};
use crate::space::{Point, Vector};
use std::sync::Arc;

/// Along what line the deviation of each point is measured.
#[derive(Clone)]
pub enum Along {
    /// One direction for all, of any length.
    Direction(Vector),
    /// The normal of the reference at the nearest place: of the facet; on an edge the sum of both, at a corner weighted by angle.
    Reference(Arc<Signs>),
    /// Each point's own normal, of any length; none where it is zero.
    Measured(Arc<[Vector]>),
}

impl std::fmt::Debug for Along {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Along::Direction(d) => write!(f, "Direction({d:?})"),
            Along::Reference(_) => f.write_str("Reference"),
            Along::Measured(n) => write!(f, "Measured({})", n.len()),
        }
    }
}

impl ReferenceSurface {
    /// The reference's own normals as lines to measure along. Linear time.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn normals(&self, progress: &dyn Progress) -> Result<Along, Cancelled> {
        Ok(Along::Reference(Arc::new(Signs::watched(self.tree(), progress)?)))
    }

    /// `f(index, deviation, crossing)` of each point, in the order of `points`. The deviation along a line is in millimeters, +
    /// outside, − inside. See [`Exclusion`] for points that have none, which have no crossing either. `start` is the number of
    /// the first point among the normals of [`Along::Measured`].
    ///
    /// A reason that excludes a point from a nearest distance excludes it here. A line that meets nothing within the greatest
    /// distance excludes it too. Cost: twice that of the nearest places; see
    /// [`Tree::crossing`](crate::closest::Tree::crossing).
    ///
    /// # Errors
    /// The errors of [`ReferenceSurface::deviations`]. `progress` hears of points once.
    ///
    /// ```
    /// use trueness_geom::closest::Tree;
    /// use trueness_geom::deviation::along::Along;
    /// use trueness_geom::deviation::surface::{ReferenceSurface, SurfaceOptions};
    /// use trueness_geom::{mesh::Mesh, progress::Silent};
    /// // A plane at 45°: the point 1 above it along z lies √½ away from it.
    /// let positions = vec![[0.0, 0.0, 0.0], [4.0, 0.0, 4.0], [0.0, 4.0, 0.0]];
    /// let mesh = Mesh { positions, faces: vec![[0, 1, 2]] };
    /// let tree = Tree::build(&mesh)?;
    /// let surface = ReferenceSurface::new(&tree, &mesh, &SurfaceOptions::default(), &Silent)?;
    /// let up = Along::Direction([0.0, 0.0, 1.0]);
    /// let points = [[1.0, 1.0, 2.0]];
    /// assert_eq!(surface.map_along(0, &points, &up, &Silent, |_, d, _| d)?, [1.0]);
    /// assert!((surface.deviations(&points, &Silent)?[0] - 0.5f64.sqrt()).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn map_along<T: Copy + Send>(
        &self,
        start: u64,
        points: &[Point],
        along: &Along,
        progress: &dyn Progress,
        f: impl Fn(usize, f64, Option<&Crossing>) -> T + Sync,
    ) -> Result<Vec<T>, QueryError> {
        let lines: Vec<(f64, Option<Vector>)> = self.map(points, progress, |i, deviation, hit| {
            let direction = match (along, hit) {
                (_, None) => None,
                (Along::Direction(d), _) => Some(*d),
                (Along::Reference(signs), Some(hit)) => signs.normal(&points[i], hit),
                (Along::Measured(normals), _) => {
                    usize::try_from(start).ok().and_then(|s| normals.get(s + i)).copied()
                }
            };
            let is_direction = |d: &Vector| d.iter().any(|x| *x != 0.0) && d.iter().all(|x| x.is_finite());
            (deviation, direction.filter(|d| deviation.is_finite() && is_direction(d)))
        })?;
        let other = OnlyCancels(progress);
        self.tree().map_crossings(
            points,
            |i| lines[i].1,
            self.max_distance(),
            &other,
            |i, crossing| {
                let (nearest, line) = lines[i];
                match (line, &crossing) {
                    _ if !nearest.is_finite() => f(i, nearest, None),
                    (None, _) => f(i, Exclusion::NoDirection.value(), None),
                    (_, None) => f(i, Exclusion::NoCrossing.value(), None),
                    (_, Some(c)) => f(i, c.along.abs().copysign(nearest), crossing.as_ref()),
                }
            },
        )
    }
}
