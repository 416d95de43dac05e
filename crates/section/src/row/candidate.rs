//! A question about the contour of a row, and the answers that are proposed.

use super::clean::Clean;
use super::corner_search::RESOLUTION_SPACINGS;
use super::noise_levels::Partition;
use crate::model::budget::Budget;
use crate::model::prior::Prior;
use crate::model::result::{Continuity, Contour, Options, SectionError};
use crate::search::parts::noise;
use std::cell::OnceCell;
use trueness_geom::progress::Progress;

/// The question: the contour of a row in one direction, without strays.
pub(super) struct Question<'a> {
    pub points: &'a [[f64; 2]],
    pub prior: Prior<'a>,
    pub options: &'a Options,
    pub budget: &'a Budget,
    /// The row made fit for a search.
    pub clean: Clean,
    partition: OnceCell<Partition>,
}

/// A contour that is proposed.
pub(super) struct Candidate {
    contour: Contour,
    chosen_by: ChosenBy,
}

/// The rule by which a contour is chosen.
enum ChosenBy {
    /// By its cost.
    Cost,
    /// The points speak against the one found before.
    Instead,
    /// The points tell it, beyond chance: nothing more is asked.
    BeyondChance,
}

/// A way to a contour, in view of the one found so far; `None` where it has none to propose.
pub(super) type Proposer =
    fn(&Question, Option<&Contour>, &dyn Progress) -> Result<Option<Candidate>, SectionError>;

/// Where points scatter this many times as much about a contour as about local fits, it hides form.
const MAX_SCATTER_RATIO: f64 = 1.3;

impl<'a> Question<'a> {
    pub fn new(
        points: &'a [[f64; 2]],
        prior: Prior<'a>,
        options: &'a Options,
        budget: &'a Budget,
    ) -> Result<Question<'a>, SectionError> {
        let clean = Clean::new(points, options)?;
        Ok(Question { points, prior, options, budget, clean, partition: OnceCell::new() })
    }

    /// Where a search by likelihood begins.
    pub fn partition(&self) -> &Partition {
        self.partition.get_or_init(|| Partition::new(self.clean.clone(), &self.prior, self.options))
    }

    /// Whether noise and joins are left to the points.
    pub fn is_free(&self) -> bool {
        self.prior.noise.is_none() && self.options.continuity.is_none()
    }

    /// Whether points may be exact, too.
    pub fn may_be_exact(&self) -> bool {
        self.is_free() && self.options.resolution.is_none()
    }

    /// Whether segments of a contour are unreliable, or its points scatter more than about local fits.
    pub fn doubts(&self, found: &Contour) -> bool {
        let own = self.prior.noise.map_or_else(|| noise(self.points, found.closed).0, |n| n.deviation);
        !found.unreliable.is_empty() || own > 0.0 && found.rms() > MAX_SCATTER_RATIO * own
    }

    /// Cost of a contour, to be compared. Its unreliable segments count first, then twice the negative logarithm of the
    /// likelihood and the penalty for the unknowns.
    fn cost(&self, found: &Contour) -> (usize, f64) {
        // As many points as are independent.
        let count = self.prior.weights.map_or(self.points.len() as f64, |all| all.iter().sum());
        let floor = RESOLUTION_SPACINGS * found.spacing;
        let off = found.rms();
        let cost = count * libm::log(off * off + floor * floor)
            + (found.unknowns + found.joins.len() as f64) * libm::log(count);
        (found.unreliable.len(), cost)
    }

    /// The contour that all ways lead to. The cheaper one of each proposal and the contour found before is taken,
    /// unless the points tell.
    pub fn cheapest(
        &self,
        proposers: &[Proposer],
        progress: &dyn Progress,
    ) -> Result<Option<Contour>, SectionError> {
        let mut best: Option<Contour> = None;
        for propose in proposers {
            let Some(Candidate { contour, chosen_by }) = propose(self, best.as_ref(), progress)? else {
                continue;
            };
            let costs_less = || best.as_ref().is_none_or(|b| self.cost(&contour) < self.cost(b));
            match chosen_by {
                ChosenBy::BeyondChance => return Ok(Some(contour)),
                ChosenBy::Instead => best = Some(contour),
                ChosenBy::Cost if costs_less() => best = Some(contour),
                ChosenBy::Cost => {}
            }
        }
        Ok(best)
    }
}

impl Candidate {
    /// One that is compared by its cost.
    pub fn of(contour: Contour) -> Option<Candidate> {
        Some(Candidate { contour, chosen_by: ChosenBy::Cost })
    }

    /// One that the points speak for against the contour found before.
    pub fn instead(contour: Contour) -> Option<Candidate> {
        Some(Candidate { contour, chosen_by: ChosenBy::Instead })
    }

    /// One that the points tell, beyond chance.
    pub fn beyond_chance(contour: Contour) -> Option<Candidate> {
        Some(Candidate { contour, chosen_by: ChosenBy::BeyondChance })
    }
}

/// Whether segments do not run along their points, or join in corners.
pub(super) fn is_cornered(contour: &Contour) -> bool {
    !contour.unreliable.is_empty() || contour.joins.iter().any(|j| j.continuity == Continuity::G0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_geom::progress::Silent;

    /// Proposes a contour whose points lie so many micrometres off.
    fn off<const MICRONS: u32>(
        question: &Question,
        _: Option<&Contour>,
        _: &dyn Progress,
    ) -> Result<Option<Candidate>, SectionError> {
        let off = f64::from(MICRONS) / 1e3;
        let residuals = vec![off; question.points.len()];
        Ok(Candidate::of(Contour { residuals, spacing: 1.0, ..Contour::default() }))
    }

    /// The same, none of whose segments runs along its points.
    fn unreliable<const MICRONS: u32>(
        question: &Question,
        best: Option<&Contour>,
        progress: &dyn Progress,
    ) -> Result<Option<Candidate>, SectionError> {
        let found = off::<MICRONS>(question, best, progress)?;
        Ok(found.and_then(|c| Candidate::of(Contour { unreliable: vec![0], ..c.contour })))
    }

    fn none(_: &Question, _: Option<&Contour>, _: &dyn Progress) -> Result<Option<Candidate>, SectionError> {
        Ok(None)
    }

    fn beyond_chance(
        question: &Question,
        best: Option<&Contour>,
        progress: &dyn Progress,
    ) -> Result<Option<Candidate>, SectionError> {
        Ok(off::<9>(question, best, progress)?.and_then(|c| Candidate::beyond_chance(c.contour)))
    }

    fn instead(
        question: &Question,
        best: Option<&Contour>,
        progress: &dyn Progress,
    ) -> Result<Option<Candidate>, SectionError> {
        Ok(off::<8>(question, best, progress)?.and_then(|c| Candidate::instead(c.contour)))
    }

    /// One proposer more never raises the cost, wherever it stands in the list and whatever it proposes. A contour that
    /// the points tell ends the list.
    #[test]
    fn a_proposer_more_never_raises_the_cost() {
        let points: Vec<[f64; 2]> = (0..20).map(|i| [f64::from(i), 0.0]).collect();
        let (options, budget) = (Options::default(), Budget::new(1e9));
        let question = Question::new(&points, Prior::default(), &options, &budget).unwrap();
        let cost = |list: &[Proposer]| {
            let found = question.cheapest(list, &Silent).unwrap();
            found.map_or((usize::MAX, f64::INFINITY), |found| question.cost(&found))
        };
        let all: [Proposer; 6] = [off::<3>, none, unreliable::<1>, off::<2>, unreliable::<4>, off::<5>];
        for subset in 0..1u32 << all.len() {
            let has = |k: &usize| subset >> k & 1 == 1;
            let list: Vec<Proposer> = (0..all.len()).filter(has).map(|k| all[k]).collect();
            for more in all {
                for at in 0..=list.len() {
                    let mut longer = list.clone();
                    longer.insert(at, more);
                    assert!(cost(&longer) <= cost(&list), "{subset:b} {at}");
                }
            }
        }
        let rms = |list: &[Proposer]| question.cheapest(list, &Silent).unwrap().unwrap().residuals[0];
        assert_eq!(rms(&[off::<3>, beyond_chance, off::<1>]), 0.009);
        assert_eq!(rms(&[off::<3>, instead]), 0.008);
        assert_eq!(rms(&[instead, off::<3>]), 0.003);
    }
}
