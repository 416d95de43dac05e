//! Alignment: the rigid motion that brings what was measured onto its reference.
//!
//! | task | where |
//! |---|---|
//! | best fit of a scan from any pose | [`best_fit`] |
//! | pairs of places that belong together | [`pairs`] |
//! | 3-2-1 and reference point systems (RPS) | [`constrained`] |
//!
//! [`best_fit`] goes three steps:
//! 1. *Start* (`features`, `field`, `start`): poses from principal axes and from pairs of points with normals, each tried
//!    on a grid of distances about the reference; the best are refined on a few hundred samples.
//! 2. *Iteration* (`icp`, `system`): closest points and small motions, all samples, area-weighted, normals compatible,
//!    outliers without weight, until a step is less than a thousandth of its own uncertainty.
//! 3. *What the result is worth* (`freedom`): covariance, freedom that the shape leaves, other poses that fit as well.
//!
//! All answers are the same for any number of threads; random choices depend on the seed alone.

#![allow(clippy::needless_range_loop, reason = "matrices are read by row and column")]

mod best_fit;
mod features;
mod field;
mod freedom;
mod icp;
mod rows;
mod sample;
mod start;
mod system;
#[cfg(test)]
mod tests;

pub use best_fit::best_fit;
pub use freedom::Freedom;
pub use rows::{Row, RowFit, constrained, pairs};
pub use sample::Measured;

use crate::closest::{MeshError, QueryError, Tree};
use crate::mesh::Mesh;
use crate::progress::Cancelled;
use crate::rigid::Rigid;
use crate::space::{Aabb, Point};

/// The reference: a mesh with its search tree.
#[derive(Clone, Copy)]
pub struct Target<'a> {
    mesh: &'a Mesh,
    tree: &'a Tree,
    bounds: Aabb,
}

impl<'a> Target<'a> {
    /// Of a mesh, millimetres, whose search tree is `tree`. Vertices should be shared by index (weld an STL first).
    pub fn new(mesh: &'a Mesh, tree: &'a Tree) -> Target<'a> {
        let used = mesh.faces.iter().flatten().map(|&v| &mesh.positions[v as usize]);
        Target { mesh, tree, bounds: Aabb::of(used) }
    }
}

/// Where a best fit starts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Start {
    /// Anywhere: the start is looked for.
    #[default]
    Anywhere,
    /// From this motion, which should be near: `reference_from_measured`.
    Given(Rigid),
}

/// How a best fit is done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BestFit {
    /// Where it starts.
    pub start: Start,
    /// Points from six standard deviations of the distances on count less, from ten on not at all. Else all count in full.
    pub robust: bool,
    /// Seed of the random choices.
    pub seed: u64,
}

impl Default for BestFit {
    fn default() -> Self {
        BestFit { start: Start::Anywhere, robust: true, seed: 0 }
    }
}

/// Another pose that fits nearly as well.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alternative {
    /// The motion to it.
    pub reference_from_measured: Rigid,
    /// Angle of the rotation between the two poses, radians.
    pub angle: f64,
    /// Its root mean square distance, no distance counted for more than twenty standard deviations, over that of the result.
    pub ratio: f64,
}

/// What is to be said about a best fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AlignWarning {
    /// Half of the points are farther from the reference than this share of the size of the smaller of both: it is hardly
    /// the same part, or the start was not found.
    Poor {
        /// Median distance over the diagonal.
        share: f64,
    },
    /// Other poses fit about as well.
    Ambiguous {
        /// How many were found.
        count: usize,
    },
    /// The shape leaves this freedom.
    Free(Freedom),
    /// The normals of the measured and of the reference point to opposite sides.
    NormalsTurned,
    /// The measured fits when it is made this many times as large.
    Scale {
        /// 25.4, 10, 1000 or their inverses.
        factor: f64,
    },
    /// So few points that a pose which fits them may be found by chance, or the right one missed.
    Few {
        /// Points given.
        count: usize,
    },
    /// The iteration did not settle.
    NotConverged,
}

/// The result of a best fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Alignment {
    /// Takes measured coordinates to those of the reference.
    pub reference_from_measured: Rigid,
    /// Root of the weighted mean square distance of the points that count, millimetres.
    pub rms: f64,
    /// Their weighted mean distance.
    pub mean_abs: f64,
    /// Weighted median distance of all points that have a place on the reference.
    pub median: f64,
    /// Steps of the last iteration.
    pub iterations: usize,
    /// Whether the last step was below a thousandth of its uncertainty, or below what arithmetic can tell.
    pub converged: bool,
    /// Points with a weight.
    pub used: u64,
    /// Points without: outliers, those beside a free edge, those whose normal looks away.
    pub left_out: u64,
    /// Share of the measured surface that counts, 0 to 1.
    pub share: f64,
    /// Covariance of the rotation vector about `center` (radians) and the translation (mm), in the frame of the
    /// reference; zero along what the shape leaves free.
    pub covariance: [[f64; 6]; 6],
    /// Mean of the measured points in the frame of the reference.
    pub center: Point,
    /// Greatest over least eigenvalue of the normal equations, rotations counted as displacements at the points' root mean
    /// square distance from `center`; `None` where a motion is free.
    pub condition: Option<f64>,
    /// Motions that the shape leaves free.
    pub freedoms: Vec<Freedom>,
    /// Other poses that fit nearly as well, best first.
    pub alternatives: Vec<Alternative>,
    /// What is to be said about it.
    pub warnings: Vec<AlignWarning>,
}

/// Why there is no alignment.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AlignError {
    /// Too little is measured.
    #[error("{found} points do not determine a pose: at least {needed} are needed")]
    TooFewPoints {
        /// Points that would do.
        needed: usize,
        /// Points given.
        found: usize,
    },
    /// The points lie on one line or at one place.
    #[error("the points lie on one line or at one place: they do not determine a pose")]
    Collinear,
    /// Lists that go together differ in length.
    #[error("{what}: {found} are given where {expected} are needed")]
    Uneven {
        /// Which.
        what: &'static str,
        /// Of the points.
        expected: usize,
        /// Of the others.
        found: usize,
    },
    /// A weight is negative or no number, or all are zero.
    #[error("row {row} has a weight that is not a number from 0 upwards")]
    BadWeight {
        /// From 0.
        row: usize,
    },
    /// A direction has no length.
    #[error("row {row} has a direction of no length")]
    NoDirection {
        /// From 0.
        row: usize,
    },
    /// The rows leave a motion free.
    #[error("the rows leave {free} of the six degrees of freedom open")]
    Underdetermined {
        /// How many.
        free: usize,
    },
    /// No point of the measured has a place on the reference from the given start.
    #[error("no point lies near the reference from this start")]
    NoOverlap,
    /// A mesh cannot be used.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A point cannot be used.
    #[error(transparent)]
    Point(QueryError),
    /// Stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl From<QueryError> for AlignError {
    fn from(e: QueryError) -> Self {
        match e {
            QueryError::Cancelled(e) => AlignError::Cancelled(e),
            e => AlignError::Point(e),
        }
    }
}
