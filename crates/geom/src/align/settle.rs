//! The end of an iteration over all that is measured, and what the result is worth.

use super::covariance::covariance;
use super::icp::{Ended, MAX_ITERATIONS, Match, Problem, Room, median_distance};
use super::loose::{Loose, explore};
use super::sample::Samples;
use super::system::Spectrum;
use super::twist::{Twist, directions};
use super::work::Work;
use super::{AlignError, AlignWarning, Alignment, freedom};
use crate::num::sum::Sum;
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::stats::SIGMA_OVER_MAD;

/// Rounds over a part of very many samples: the iteration is then off by a few uncertainties.
const PART_ROUNDS: usize = 2;
/// Most rounds over all samples once the iteration has settled on some of them.
const MAX_SETTLED_ROUNDS: usize = 30;
/// Most rounds over all samples where it has not settled.
const MAX_UNSETTLED_ROUNDS: usize = 3;
/// Most rounds on exact surfaces: where it has settled on facets that draw them, a few do.
const MAX_EXACT_ROUNDS: usize = 10;
/// Share of the measured that does not count, from which on a warning says so.
const MIN_REPORTED_EXCLUSION: f64 = 0.1;

/// The means that the end of an iteration is made with.
pub(super) struct Settle<'a> {
    pub work: &'a Work<'a>,
    pub all: Problem<'a>,
    /// The problem of the surface of a mesh.
    pub surface: Option<Problem<'a>>,
    /// An eighth of very many.
    pub part: Option<Problem<'a>>,
    pub subset: &'a Samples,
}

impl<'a> Settle<'a> {
    /// Where the iteration over all ends, and what that is worth; `sigma` is the standard deviation of the distances at `pose`.
    pub fn from(
        &self,
        mut pose: Rigid,
        sigma: f64,
        progress: &dyn Progress,
    ) -> Result<Alignment, AlignError> {
        let Settle { work, all, surface, part, subset } = self;
        let mut reach = work.reach(sigma);
        // An iteration that does not settle on some of them does not settle on all, which would take as many times as long.
        let sampled = work.problem(subset);
        let begun = sampled.run(pose, reach, MAX_ITERATIONS, progress)?;
        let most = if begun.converged { MAX_SETTLED_ROUNDS } else { MAX_UNSETTLED_ROUNDS };
        let (within, loose) = explore(&sampled, &begun.pose, &work.start(), progress)?;
        pose = within;
        let mut stay = vec![];
        if loose.ends {
            // Elsewhere the distances are others.
            (stay, reach) = (loose.untold(), f64::INFINITY);
        }
        let staying = |problem: &Problem<'a>| Problem { stay: &stay, ..*problem };
        let all = &staying(all);
        if let Some(part) = part {
            pose = staying(part).run(pose, reach, PART_ROUNDS, progress)?.pose;
        }
        let mut room = Room::default();
        let ended = match surface {
            Some(surface) => staying(surface).run(pose, reach, most, progress)?,
            None => all.iterate(pose, reach, most, &mut room, progress)?.0,
        };
        if let Some(exact) = work.target.exact {
            let exact = Some(exact);
            let whole = Problem { exact, ..staying(surface.as_ref().unwrap_or(&self.all)) };
            let last = whole.run(ended.pose, reach, MAX_EXACT_ROUNDS, progress)?;
            let all = Problem { exact, ..*all };
            let matches = all.matches(&last.pose, f64::INFINITY, progress)?;
            let iterations = ended.iterations + last.iterations;
            return work.judged(&all, &Ended { iterations, ..last }, matches, (subset, &loose), progress);
        }
        match ended.converged && surface.is_none() {
            true => all.complete(&mut room.matches, &ended.pose, progress)?,
            false => room.matches = all.matches(&ended.pose, f64::INFINITY, progress)?,
        }
        work.judged(all, &ended, room.matches, (subset, &loose), progress)
    }
}

impl Work<'_> {
    /// Figures of the result at the pose where it ended, of the matches of all samples there.
    fn judged(
        &self,
        all: &Problem,
        ended: &Ended,
        mut matches: Vec<Match>,
        (subset, loose): (&Samples, &Loose),
        progress: &dyn Progress,
    ) -> Result<Alignment, AlignError> {
        let pose = &ended.pose;
        let median = median_distance(&matches, &mut vec![]).unwrap_or(0.0);
        let sigma = SIGMA_OVER_MAD * median;
        all.weigh(&mut matches, sigma);
        let system = all.system(&matches, pose);
        if system.weight <= 0.0 {
            return Err(AlignError::NoOverlap);
        }
        let sampled = self.problem(subset);
        let of = |twists: &[Twist]| directions(twists, system.center, system.radius);
        let slack: Vec<Twist> = loose.slack.iter().map(|s| s.0).collect();
        let hardly = of(&[&slack[..], &loose.held].concat());
        let locked = sampled.lock.map(|lock| lock.twists(pose)).unwrap_or_default();
        let lock = of(&locked);
        let mut barely = freedom::barely_held(&sampled, &system, hardly, pose, progress)?;
        if barely.is_empty() {
            // Without noise the range alone tells.
            barely.extend(loose.slack.iter().map(|(t, width)| (t.six(system.center, system.radius), *width)));
        }
        // The facets tell the free motions; edges of a faceted cylinder would hold them.
        let facets;
        let equations = match loose.free.is_empty() {
            true => &system,
            false => {
                facets = all.system_of_facets(&matches, pose);
                &facets
            }
        };
        let spectrum = Spectrum::without(equations, &of(&[locked, loose.untold()].concat()));
        let named = |twists: &[Twist]| freedom::named(system.center, system.radius, &of(twists));
        let with_width = |(twist, width): &(Twist, f64)| named(&[*twist]).first().map(|f| (*f, *width));
        let (share, limit) = (1.0 - system.weight.min(1.0), all.limit(sigma));
        let (mut used, mut farthest, mut sum) = (0, 0.0f64, Sum::default());
        for m in matches.iter().filter(|m| m.distance.is_finite()) {
            used += usize::from(m.equation.weight > 0.0);
            farthest = farthest.max(if m.distance > limit { m.distance } else { 0.0 });
            sum = sum.plus(m.equation.weight * m.distance);
        }
        let exclusion = AlignWarning::Excluded { share, farthest, limit };
        Ok(Alignment {
            reference_from_measured: *pose,
            rms: system.rms(),
            mean_abs: sum.value() / system.weight,
            median,
            iterations: ended.iterations,
            converged: ended.converged,
            used: used as u64,
            excluded_points: (matches.len() - used) as u64,
            share: system.weight.min(1.0),
            covariance: covariance(&system, &spectrum, &matches, &barely),
            center: system.center,
            condition: (loose.free.is_empty() && lock.len() < 6).then(|| {
                let held = Spectrum::without(&system, &lock);
                held.values[5] / held.values[held.stay]
            }),
            freedoms: named(&loose.free),
            slack: loose.slack.iter().filter_map(with_width).collect(),
            alternatives: vec![],
            warnings: if share > MIN_REPORTED_EXCLUSION { vec![exclusion] } else { vec![] },
        })
    }
}
