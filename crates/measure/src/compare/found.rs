//! All that a comparison found.

use super::reference::Compared;
use super::shown::ShownPoints;
use trueness_geom::space::Aabb;
use trueness_geom::stats::paired::Paired;

/// All that the comparison found.
pub struct Comparisons {
    /// Number of points.
    pub count: u64,
    /// Their box.
    pub bounds: Aabb,
    /// One entry a reference.
    pub references: Vec<Compared>,
    /// `(first, second, differences)` for every pair of references.
    pub paired: Vec<(usize, usize, Paired)>,
    /// The sample of the points by which it is told how far differences of neighbors go together; empty of one reference.
    pub together: ShownPoints,
    /// Sample for the report.
    pub shown: ShownPoints,
    /// The worst places of every reference, as far as the sample lacks them.
    pub flagged: ShownPoints,
}
