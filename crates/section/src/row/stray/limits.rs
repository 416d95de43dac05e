//! Limits common to strays anywhere in a row and to those beside its ends.

/// How many times shorter the longest step is without a stray that lies farther from the row than the row is large.
pub(super) const FAR_STEP_RATIO: f64 = 2.0;
/// Fewer points do not tell which of them is stray: the first for certain, the second at all.
pub(super) const MIN_POINTS_TO_TELL_STRAYS: [usize; 2] = [8, 4];
/// A line goes on straight where its far end lies off its direction by no more than this, radians. Half the turn of a
/// step is added. It is the sagitta of coordinates that are rounded to a hundredth of a step.
pub(super) const STRAIGHT_TURN: f64 = 0.02;
/// A piece beyond a gap is off by half of the row's turn over as long a stretch, and by as much again. Beyond this
/// nobody knows.
pub(super) const BENT_TURN_SHARE: f64 = 0.5;
