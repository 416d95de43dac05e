//! What searches near a best fit share: the points that count, and what is told of them.

use super::icp::Problem;
use super::sample::{Measured, Samples};
use super::{AlignError, AlignWarning, Alignment, BestFit, Target};
use crate::closest::BoundaryEdges;
use crate::num::sum::Sum;
use crate::progress::Progress;
use crate::space::Point;
use crate::zone::ZoneError;

/// The points that count in a best fit, which searches from it look at alone.
pub(super) struct Counting {
    pub points: Vec<Point>,
    pub weights: Vec<f64>,
    /// Number of the others.
    pub left_out: u64,
}

impl Counting {
    /// Of the best fit `from`, which must leave nothing free.
    pub fn of(
        measured: &Measured,
        reference: &Target,
        from: &Alignment,
        options: &BestFit,
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
            boundary_edges: (edges.count() > 0).then_some(&edges),
            samples: &samples,
            mean: moments.mean,
            robust: options.robust,
            radius: moments.radius(),
            rounding: 4.0 * f64::EPSILON * moments.radius().max(reference.bounds.diagonal()),
        };
        let mut matches = problem.matches(&from.reference_from_measured, f64::INFINITY, progress)?;
        let sigma = problem.deviation(&matches);
        problem.weigh(&mut matches, sigma);
        let counts: Vec<usize> = (0..matches.len()).filter(|&i| matches[i].equation.weight > 0.0).collect();
        if counts.is_empty() {
            return Err(AlignError::NoOverlap);
        }
        Ok(Counting {
            points: counts.iter().map(|&i| samples.points[i]).collect(),
            weights: counts.iter().map(|&i| samples.weights[i]).collect(),
            left_out: (matches.len() - counts.len()) as u64,
        })
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
