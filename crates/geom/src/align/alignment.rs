//! How a best fit is asked for, and what it gives.

use super::freedom::Freedom;
use super::twist::Lock;
use crate::rigid::Rigid;
use crate::space::Point;

/// Where a best fit starts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Start {
    /// Anywhere: the start is looked for.
    #[default]
    Anywhere,
    /// From this motion, which should be near: `reference_from_measured`.
    From(Rigid),
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
    /// Components of the motion that stay zero; `None` for a motion that is looked for.
    pub lock: Option<Lock>,
}

impl Default for BestFit {
    fn default() -> Self {
        BestFit { start: Start::Anywhere, robust: true, seed: 0, lock: None }
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

/// Share of the size from which on the residuals of a fit are poor.
pub(super) const POOR_RESIDUAL_SHARE: f64 = 0.01;

/// Ratios of units that are confused.
pub(super) const CONFUSED_UNIT_RATIOS: [f64; 6] = [25.4, 1.0 / 25.4, 10.0, 0.1, 1000.0, 1e-3];

/// The warnings about an alignment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AlignWarning {
    /// Half of the points are farther from the reference than this share of the size of the smaller of both. It is hardly the
    /// same part, or the start was not found.
    Poor {
        /// Median distance over the diagonal.
        share: f64,
    },
    /// The rows that belong together still lie apart, root mean square, by more than a hundredth of their size. Some do not
    /// belong together, or they are of another part.
    PoorRows {
        /// That root mean square over the diagonal of the smaller of both boxes.
        share: f64,
        /// The worst row, from 0.
        row: usize,
        /// Its residual, millimeters.
        residual: f64,
        /// Whether a mirror image would leave less than half as much.
        mirrored: bool,
    },
    /// Other poses fit about as well.
    Ambiguous {
        /// How many were found.
        count: usize,
    },
    /// The shape leaves this freedom, and the reference is the same along it.
    Free(Freedom),
    /// The measured does not hold this motion, though the reference is not the same along it: where it lies is not known.
    Undetermined {
        /// The motion.
        motion: Freedom,
        /// How far it may go from end to end until a rim, root mean square, millimeters; `None` where none was met.
        width: Option<f64>,
    },
    /// The normals of the measured and of the reference point to opposite sides.
    NormalsTurned,
    /// The measured fits when it is made this many times as large.
    Scale {
        /// 25.4, 10, 1000 or their inverses.
        factor: f64,
    },
    /// So few points that a pose which fits them may be found by chance, or the right one missed.
    FewPoints {
        /// Points given.
        count: usize,
    },
    /// Much of the measured does not lie on the reference, and only one of several independent searches found this pose. A
    /// better one may have been missed.
    Unconfirmed {
        /// Searches made.
        searches: usize,
    },
    /// Much of the measured does not count. It is so much farther from the reference than the rest that it was taken for
    /// something else, as an outlier is. A face that was made wrong looks the same.
    Excluded {
        /// Share of it, 0 to 1.
        share: f64,
        /// Distance of the farthest of it that has a place on the reference, millimeters.
        farthest: f64,
        /// Distance from which on nothing counts, millimeters.
        limit: f64,
    },
    /// The mirror image of the measured fits much better.
    Mirrored {
        /// Root mean square distance that it leaves over what the measured leaves, no distance counted for more than twenty standard deviations.
        ratio: f64,
    },
    /// The iteration did not settle.
    NotConverged,
}

/// The result of a best fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Alignment {
    /// Takes measured coordinates to those of the reference.
    pub reference_from_measured: Rigid,
    /// Root of the weighted mean square distance of the points that count, millimeters.
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
    /// Points without: outliers, those beside a boundary edge, those whose normal looks away.
    pub excluded_points: u64,
    /// Share of the measured surface that counts, 0 to 1.
    pub share: f64,
    /// Covariance of the rotation vector about `center` (radians) and the translation (mm), in the frame of the
    /// reference; zero along what the shape leaves free.
    pub covariance: [[f64; 6]; 6],
    /// Mean of the measured points in the frame of the reference.
    pub center: Point,
    /// Greatest over least eigenvalue of the normal equations. Rotations count as displacements at the points' root mean square
    /// distance from `center`. `None` where a motion is free.
    pub condition: Option<f64>,
    /// Motions that the shape leaves free.
    pub freedoms: Vec<Freedom>,
    /// Motions that rims alone hold, with the way from end to end, root mean square, millimeters: within it any pose fits as well.
    pub slack: Vec<(Freedom, f64)>,
    /// Other poses that fit nearly as well, best first.
    pub alternatives: Vec<Alternative>,
    /// Warnings about the alignment.
    pub warnings: Vec<AlignWarning>,
}
