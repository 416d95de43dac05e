//! Further looks from a best fit. They begin where much does not lie on the reference, near the pose, about an axis, in a
//! mirror. They also begin in poses that fit as well.

use super::alignment::POOR_RESIDUAL_SHARE;
use super::alternatives::{better, is_same};
use super::mirror::Mirror;
use super::sample::Samples;
use super::settle::Settle;
use super::start::Search;
use super::work::{RIVAL_SAMPLES, START_SAMPLES, Work};
use super::{AlignError, AlignWarning, Alignment, Freedom, near, revolved};
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::stats::SIGMA_OVER_MAD;

/// Share of the measured that counts below which the start is looked for again.
const MIN_COUNTED_SHARE: f64 = 0.95;
/// Times that it is looked for again, each with other samples and pairs.
const REPEATED_SEARCHES: usize = 2;
/// Rounds of the search about a pose, each from where the last one ended.
const MAX_LOOK_ROUNDS: usize = 3;
/// Share of the spacing within which two poses are one.
const SAME_POSE_SPACINGS: f64 = 0.02;

/// The means of looking further.
pub(super) struct Look<'a> {
    pub settle: &'a Settle<'a>,
    pub search: &'a Search,
    /// All that is measured.
    pub samples: &'a Samples,
}

impl Look<'_> {
    /// Puts the best pose found in place of the result, at whose start the distances had the deviation `sigma`. Adds the poses
    /// found to those of the start. Gives what is to be said.
    pub fn around(
        &self,
        poses: &mut Vec<Rigid>,
        (result, sigma): (&mut Alignment, f64),
        progress: &dyn Progress,
    ) -> Result<Vec<AlignWarning>, AlignError> {
        let Look { settle, search, samples } = *self;
        let (work, subset) = (settle.work, settle.subset);
        let mut warnings = vec![];
        if work.options.robust && result.share < MIN_COUNTED_SHARE {
            warnings.extend(self.again(poses, result, progress)?);
        }
        if result.share < MIN_COUNTED_SHARE || result.median > POOR_RESIDUAL_SHARE * work.size(samples) {
            match work.mirror(search, result, samples, subset, progress)? {
                Mirror::Same => {}
                Mirror::Better(pose) => {
                    poses.push(result.reference_from_measured);
                    let (pose, sigma) =
                        work.choose(&[result.reference_from_measured, pose], subset, progress)?;
                    *result = settle.from(pose, sigma, progress)?;
                }
                Mirror::Mirrored { ratio } => warnings.push(AlignWarning::Mirrored { ratio }),
            }
        }
        let revolved = work.revolved(search, result, subset, progress)?;
        let own = result.reference_from_measured;
        if let Some(near) = revolved.iter().find(|p| search.apart(p, &own) <= search.spacing) {
            let (pose, sigma) = work.choose(&[own, *near], subset, progress)?;
            if search.apart(&own, &pose) > SAME_POSE_SPACINGS * search.spacing {
                *result = settle.from(pose, sigma, progress)?;
            }
        }
        let poses = (&poses[..], &revolved[..]);
        result.alternatives = work.alternatives(search, poses, result, subset, progress)?;
        if let Some(pose) = better(search, result) {
            *result = settle.from(pose, sigma, progress)?;
            result.alternatives = work.alternatives(search, poses, result, subset, progress)?;
        }
        Ok(warnings)
    }

    /// Looks for the start again, and beside where it leads.
    fn again(
        &self,
        poses: &mut Vec<Rigid>,
        result: &mut Alignment,
        progress: &dyn Progress,
    ) -> Result<Option<AlignWarning>, AlignError> {
        let Look { settle, search, samples } = *self;
        let (work, subset) = (settle.work, settle.subset);
        let own = result.reference_from_measured;
        let again = work.sought_again(search, result, samples, subset, progress)?;
        poses.push(own);
        poses.extend(&again);
        let (pose, sigma) = work.choose(&[&[own][..], &again].concat(), subset, progress)?;
        *result = settle.from(pose, sigma, progress)?;
        for _ in 0..MAX_LOOK_ROUNDS {
            let pose = work.around(search, result, subset, progress)?;
            if search.apart(&result.reference_from_measured, &pose) <= SAME_POSE_SPACINGS * search.spacing {
                break;
            }
            *result = settle.from(pose, sigma, progress)?;
        }
        let found = [own].iter().chain(&again).filter(|pose| is_same(search, result, pose)).count();
        Ok((found < 2).then_some(AlignWarning::Unconfirmed { searches: 1 + REPEATED_SEARCHES }))
    }
}

impl Work<'_> {
    /// The best pose of each further search, with samples and pairs of its own. Where much does not lie on the reference, a
    /// search may miss the place. As soon as one ends at that of the result it is enough; else [`REPEATED_SEARCHES`] poses,
    /// fewer where a search finds nothing.
    fn sought_again(
        &self,
        search: &Search,
        result: &Alignment,
        samples: &Samples,
        subset: &Samples,
        progress: &dyn Progress,
    ) -> Result<Vec<Rigid>, AlignError> {
        let mut found = vec![];
        for k in 1..=REPEATED_SEARCHES as u64 {
            let seed = self.options.seed.wrapping_add(k);
            let again = search.again(samples.oriented_subset(START_SAMPLES, seed), seed);
            let poses = self.briefly(&again, &[Rigid::IDENTITY], progress)?;
            if !poses.is_empty() {
                found.push(self.choose(&poses, subset, progress)?.0);
            }
            if found.last().is_some_and(|pose| is_same(search, result, pose)) {
                break;
            }
        }
        Ok(found)
    }

    /// The best pose about that of the result.
    pub(super) fn around(
        &self,
        search: &Search,
        result: &Alignment,
        subset: &Samples,
        progress: &dyn Progress,
    ) -> Result<Rigid, AlignError> {
        let pose = result.reference_from_measured;
        let coarse = self.problem(&search.samples);
        let mut matches = coarse.matches(&pose, f64::INFINITY, progress)?;
        let sigma = coarse.deviation(&matches);
        coarse.weigh(&mut matches, sigma);
        let system = coarse.system_of_facets(&matches, &pose);
        let tried = near::poses(&system, &result.freedoms, &pose, search.spacing);
        let cap = self.cap(SIGMA_OVER_MAD * result.median);
        let best = search.nearest_of(&tried, &pose, &coarse, cap, progress)?;
        if best.is_empty() {
            return Ok(pose);
        }
        Ok(self.choose(&[&[pose][..], &best].concat(), subset, progress)?.0)
    }

    /// Poses turned about the axis of a reference that is a body of revolution but for a detail. There are none where the shape
    /// leaves a turn free.
    fn revolved(
        &self,
        search: &Search,
        result: &Alignment,
        subset: &Samples,
        progress: &dyn Progress,
    ) -> Result<Vec<Rigid>, AlignError> {
        if result.freedoms.iter().any(|f| matches!(f, Freedom::Turns { .. })) {
            return Ok(vec![]);
        }
        let finer = subset.first(RIVAL_SAMPLES);
        let [coarse, finer] = [&search.samples, &finer].map(|s| self.problem(s));
        let cap = self.cap(SIGMA_OVER_MAD * result.median);
        revolved::poses(search, &result.reference_from_measured, [&coarse, &finer], cap, progress)
    }
}
