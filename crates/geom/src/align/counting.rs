//! The common ground of searches for the least greatest distance: the points that count, and the report on the others.
//!
//! A best fit does without what is many standard deviations off. Here that is what the search is about: of a part without noise and with a
//! dent, the dent. Only what lies so far off that it is hardly the part's, clutter, does not count, and is told.

use super::icp::{Match, Problem};
use super::sample::{Measured, Samples};
use super::{AlignError, AlignWarning, Alignment, BestFit, Target};
use crate::closest::{BoundaryEdges, Hit, Query};
use crate::num::sum::Sum;
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::space::Point;
use crate::zone::ZoneError;

/// Share of the diagonal of the reference within which every point counts, however little the others scatter.
const ALWAYS_COUNTED_SHARE: f64 = 0.01;

/// The points that count in a search from a best fit, with their weights.
pub(super) struct Counting {
    pub points: Vec<Point>,
    pub weights: Vec<f64>,
    others: Vec<Point>,
    limit: f64,
}

/// The points that do not count in a search for the least greatest distance. They lie beyond a limit, at a boundary edge of the
/// reference, or on no facet. Or their normal looks to the other side of a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NotCounted {
    /// How many.
    pub count: u64,
    /// Distance of the farthest of them from the surface, in the pose that was found, millimeters; 0 where there are none.
    pub farthest: f64,
    /// Distance in the best fit up to which all others count, millimeters; infinite where none is too far.
    pub limit: f64,
}

impl Counting {
    /// Near the best fit `from`, which must leave nothing free. Points within `near`, millimeters, count in any case.
    pub fn of(
        measured: &Measured,
        reference: &Target,
        from: &Alignment,
        options: &BestFit,
        near: f64,
        progress: &dyn Progress,
    ) -> Result<Counting, AlignError> {
        if !from.freedoms.is_empty() {
            return Err(AlignError::Free { free: from.freedoms.len() });
        }
        let all = Samples::vertices(measured);
        let samples = if from.warnings.contains(&AlignWarning::NormalsTurned) { all.turned() } else { all };
        let edges = BoundaryEdges::watched(reference.tree, progress)?;
        let moments = samples.moments();
        let problem = Problem {
            target: reference,
            exact: None,
            boundary_edges: (edges.count() > 0).then_some(&edges),
            samples: &samples,
            mean: moments.mean,
            robust: options.robust,
            radius: moments.radius(),
            rounding: 4.0 * f64::EPSILON * moments.radius().max(reference.bounds.diagonal()),
            stay: &[],
            lock: None,
        };
        let matches = problem.matches(&from.reference_from_measured, f64::INFINITY, progress)?;
        let limit = match options.robust {
            true => problem
                .limit(problem.deviation(&matches))
                .max(ALWAYS_COUNTED_SHARE * reference.bounds.diagonal())
                .max(near),
            false => f64::INFINITY,
        };
        let within = |m: &Match| m.distance.is_finite() && m.distance <= limit && m.equation.weight > 0.0;
        let counts: Vec<usize> = (0..matches.len()).filter(|&i| within(&matches[i])).collect();
        if counts.is_empty() {
            return Err(AlignError::NoOverlap);
        }
        let points: Vec<Point> = counts.iter().map(|&i| samples.points[i]).collect();
        // They have the order of the measured, in which there are vertices of no facet besides.
        let mut counted = points.iter().peekable();
        let is_other = |p: &&Point| counted.next_if_eq(p).is_none();
        let others = measured.points().iter().filter(is_other).copied().collect();
        let weights = counts.iter().map(|&i| samples.weights[i]).collect();
        Ok(Counting { points, weights, others, limit })
    }

    /// The report on the others in a pose.
    pub fn not_counted(
        &self,
        motion: &Rigid,
        reference: &Target,
        progress: &dyn Progress,
    ) -> Result<NotCounted, AlignError> {
        let moved: Vec<Point> = self.others.iter().map(|p| motion.point(*p)).collect();
        let far = |_, hit: Option<Hit>| hit.map_or(0.0, |hit| hit.distance());
        let distances = reference.tree.map_closest(&moved, &Query::default(), progress, far)?;
        let farthest = distances.into_iter().fold(0.0, f64::max);
        Ok(NotCounted { count: self.others.len() as u64, farthest, limit: self.limit })
    }
}

/// Why a search found nothing.
pub(super) fn unsettled(error: ZoneError) -> AlignError {
    match error {
        ZoneError::Cancelled => AlignError::Cancelled(crate::progress::Cancelled),
        _ => AlignError::NotSettled,
    }
}

/// Weighted mean of `f` of the values.
pub(super) fn weighted_mean(weights: &[f64], values: &[f64], f: &dyn Fn(f64) -> f64) -> f64 {
    let terms = weights.iter().zip(values).map(|(w, d)| w * f(*d));
    terms.fold(Sum::default(), Sum::plus).value() / weights.iter().sum::<f64>()
}
