//! From the reference back to the measured mesh: what a one-way comparison cannot see is missing material.

use super::reference::Compared;
use crate::statistics::statistics;
use trueness_document::compare::Reverse;
use trueness_geom::closest::{MeshError, Query, QueryError, Tree};
use trueness_geom::deviation::sample::TwoSided;
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_geom::stats::statistics::Summary;

/// Why nothing can be measured back.
#[derive(Debug, thiserror::Error)]
pub enum ReverseError {
    /// The measured mesh cannot be measured against.
    #[error("the measured mesh: {0}")]
    Measured(#[from] MeshError),
    /// A vertex of the reference cannot be measured, or the work was stopped.
    #[error("the reference: {0}")]
    Query(#[from] QueryError),
}

/// Unsigned distances of the vertices that the reference's facets use from the measured mesh, joined with the distances `forth`.
///
/// # Errors
/// See [`ReverseError`]. `progress` hears of vertices.
pub fn reverse(
    measured: &Mesh,
    reference: &Mesh,
    forth: &Compared,
    progress: &dyn Progress,
) -> Result<Reverse, ReverseError> {
    let mut used = vec![false; reference.positions.len()];
    for &v in reference.faces.iter().flatten() {
        used[v as usize] = true;
    }
    let points: Vec<_> =
        reference.positions.iter().zip(used).filter(|(_, used)| *used).map(|(p, _)| *p).collect();
    let tree = Tree::build_watched(measured, progress).map_err(|e| match e {
        MeshError::Cancelled(e) => ReverseError::Query(e.into()),
        e => ReverseError::Measured(e),
    })?;
    let distances = tree.distances(&points, &Query::default(), progress)?;
    let back = Summary::of(&distances);
    let both = TwoSided::of(&forth.summary.all, &back.all);
    Ok(Reverse {
        hausdorff: both.hausdorff.ok(),
        mean: both.mean.ok(),
        deviation: statistics(&back.all, back.quantile_error),
    })
}
