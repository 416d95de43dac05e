//! The contour of a row as chains between corners: the cheapest from a first partition, at one level of noise or several.

use super::assembly::Joined;
use super::candidate::{Candidate, Question};
use super::convert::segments;
use super::corner::crossing;
use super::corner_search::{Chains, CornerSearch};
use super::exact::missed;
use super::noise_levels::{EQUAL_COST, FINER_LEVEL_COST_MARGIN, Partition, hidden};
use crate::model::result::{Contour, Join, SectionError};
use crate::search::smooth::COST_TO_SEARCH;
use crate::search::span::{Found, single};
use trueness_geom::num::special::student_quantile;
use trueness_geom::progress::{Cancelled, Progress};

/// A crossing is followed this far from the chains' ends, in distances between points.
const MAX_EXTENSION_SPACINGS: f64 = 20.0;
/// Noise of up to so many times that of rounding is rounding.
const MAX_ROUNDING_RATIO: f64 = 3.0;

/// The contour that the search finds, where there is none yet; `None` where its chains do not run along the points.
pub(super) fn propose(
    question: &Question,
    best: Option<&Contour>,
    progress: &dyn Progress,
) -> Result<Option<Candidate>, SectionError> {
    if best.is_some() {
        return Ok(None);
    }
    if progress.cancelled() {
        return Err(Cancelled.into());
    }
    match question.searched(progress) {
        Err(SectionError::Unreliable) => Ok(None),
        found => Ok(Candidate::of(found?)),
    }
}

impl Question<'_> {
    /// The contour of the cheapest chains found.
    fn searched(&self, progress: &dyn Progress) -> Result<Contour, SectionError> {
        let fine = self.partition().fine();
        let (partition, chains) = self.at_levels(fine, progress)?;
        let mut found = partition.corner_search(self.options, self.budget).join(chains);
        // Points that are rounded lie on lines and circles by chance, and about them with a period.
        let is_rounded = found.contour.noise <= MAX_ROUNDING_RATIO * partition.clean.rounding;
        if self.prior.noise.is_none() && self.options.resolution.is_none() && !is_rounded {
            found.mark_unreliable(missed(&partition.clean.points, &found.contour));
            found.mark_unreliable(fine.map_or(vec![], |fine| hidden(&found.contour, fine)));
        }
        found.finish(&partition.clean, partition.turned, self.points.len(), partition.outliers);
        let mut contour = found.contour;
        // Outliers were brought in for the search: they are as far off as they lie.
        for k in contour.outliers.clone() {
            let own = &contour.segments[contour.labels[k] as usize];
            contour.residuals[k] = own.nearest(self.points[k]).distance;
        }
        Ok(contour)
    }

    /// The cheapest chains of all levels of noise, and the level that they are of; short fits tell the `fine` noise.
    fn at_levels(
        &self,
        fine: Option<f64>,
        progress: &dyn Progress,
    ) -> Result<(Partition, Chains), SectionError> {
        let (options, budget) = (self.options, self.budget);
        let mut partition = self.partition().clone();
        let mut chains = partition.corner_search(options, budget).chains(&partition.parts, progress)?;
        let mut finer = partition.finer(options, fine, &chains.founds);
        while let Some(other) = finer.pop_front().filter(|_| !budget.is_spent(0.0)) {
            let bar = partition.cost(&chains.founds);
            if !self.promises(&other, bar, progress)? {
                continue;
            }
            let found = match other.corner_search(options, budget).chains(&other.parts, progress) {
                Err(SectionError::Cancelled(e)) => return Err(e.into()),
                Err(_) => continue,
                Ok(found) => found,
            };
            if found.founds.len() > 1
                && let Some(tangent) = other.tangent()
            {
                finer.push_front(tangent);
            }
            let gain = bar - other.cost(&found.founds);
            if gain.abs() < EQUAL_COST && !other.tangent {
                // The search leads back to where it was.
                break;
            }
            let margin = if other.tangent { 0.0 } else { FINER_LEVEL_COST_MARGIN };
            if gain > margin {
                (partition, chains) = (other, found);
            }
        }
        Ok((partition, chains))
    }

    /// Whether a search from these parts may lead to chains that cost less than `bar`: those of the parts as they are cost little more.
    /// That takes a hundredth of the search.
    fn promises(
        &self,
        partition: &Partition,
        bar: f64,
        progress: &dyn Progress,
    ) -> Result<bool, SectionError> {
        if bar.is_infinite() {
            return Ok(true);
        }
        let search = CornerSearch { draft: true, ..partition.corner_search(self.options, self.budget) };
        match search.all(&partition.parts, progress) {
            Err(SectionError::Cancelled(e)) => Err(e.into()),
            Err(_) => Ok(false),
            Ok(found) => Ok(partition.cost(&found.founds) < bar + COST_TO_SEARCH),
        }
    }
}

impl CornerSearch<'_> {
    /// Puts the chains together.
    fn join(&self, chains: Chains) -> Joined {
        let Chains { mut founds, cornered, .. } = chains;
        let closed = self.clean.closed;
        let count = founds.len();
        let mut all = Joined::default();
        let quantile = |f: &Found| {
            let degrees = (f.span.weights.iter().sum::<f64>() - 4.0).max(1.0)
                + self.known_noise.map_or(0.0, |n| n.degrees);
            student_quantile(1.0 - self.options.level, degrees)
        };
        let crossings: Vec<Option<Join>> = (0..count)
            .map(|k| {
                let last = k + 1 == count;
                if !cornered || last && !closed {
                    return None;
                }
                let (a, b) = (&founds[k], &founds[(k + 1) % count]);
                Some(crossing(a, b, quantile(a), MAX_EXTENSION_SPACINGS * self.spacing * self.step as f64))
            })
            .collect();
        for k in 0..count {
            let before = match k {
                0 if closed => crossings[count - 1].as_ref(),
                0 => None,
                _ => crossings[k - 1].as_ref(),
            };
            let ends = [before.map(|j| j.point), crossings[k].as_ref().map(|j| j.point)];
            let found = &mut founds[k];
            all.add(found, segments(found, ends, self.spacing), self.clean.points.len());
            if let Some(join) = &crossings[k] {
                all.contour.joins.push(join.clone());
            } else if found.state.chain.closed && !single(&found.state) {
                // The join over the seam is the chain's first.
                all.contour.joins.rotate_left(1);
            }
        }
        let sum: f64 = all.contour.residuals.iter().zip(self.weights).map(|(r, w)| w * r * r).sum();
        let unknowns: f64 = founds.iter().map(Found::unknowns).sum();
        all.contour.unknowns = unknowns;
        all.contour.independent = self.weights.iter().sum();
        let degrees = (self.weights.iter().sum::<f64>() - unknowns).max(1.0);
        all.contour.noise = self.known_noise.map_or_else(
            || (sum / degrees).sqrt(),
            |n| ((sum + n.degrees * n.deviation.powi(2)) / (degrees + n.degrees)).sqrt(),
        );
        (all.contour.closed, all.contour.spacing) = (closed, self.spacing);
        all.misdrawn(&self.clean.points, self.weights, self.step);
        all.leaving(self.weights);
        all.contour.end_lengths();
        all
    }
}
