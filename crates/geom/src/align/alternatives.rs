//! Other poses that fit about as well as the one that was found: what the points alone cannot tell apart.

use super::icp::Problem;
use super::sample::Samples;
use super::start::{Candidate, Search};
use super::work::{BRIEF_STARTS, COMPARED_ITERATIONS, MAX_RIVAL_RATIO, RIVAL_SAMPLES, Work};
use super::{AlignError, Alignment, Alternative, Freedom, wall};
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::space::{cross, dot, norm, times};
use crate::stats::SIGMA_OVER_MAD;

/// A pose whose capped root mean square distance is within this ratio of the best one's fits as well.
const AS_GOOD_RATIO: f64 = 1.25;
/// Within this ratio a pose fits equally: a symmetric part is not turned without need.
const EQUAL_RATIO: f64 = 1.01;

impl Work<'_> {
    /// Other poses that fit about as well. The candidates are where it lies, the other starts, those of a `revolved` body, and
    /// turns that common symmetries have. For points without sides the other side of a wall joins them. A motion that the
    /// freedom of the shape allows makes no other pose.
    pub fn alternatives(
        &self,
        search: &Search,
        (poses, revolved): (&[Rigid], &[Rigid]),
        result: &Alignment,
        subset: &Samples,
        progress: &dyn Progress,
    ) -> Result<Vec<Alternative>, AlignError> {
        let pose = result.reference_from_measured;
        let coarse = self.problem(&search.samples);
        let mut candidates = search.symmetric(&pose);
        let candidate = |&pose: &Rigid| Candidate { pose, score: search.score(&pose) };
        candidates.extend(poses.iter().map(candidate));
        // More poses that fit equally may be found than are kept: the one that moves least is sought on its own.
        let [home, candidates] = [vec![candidate(&Rigid::IDENTITY)], candidates].map(|mut of| {
            of.retain(|c| search.apart(&c.pose, &pose) > search.spacing);
            of
        });
        let (problem, finer) = (self.problem(subset), subset.first(RIVAL_SAMPLES));
        let finer = self.problem(&finer);
        let cap = self.cap(SIGMA_OVER_MAD * result.median);
        let (own_coarse, own_finer) = (coarse.cost(&pose, cap, progress)?, finer.cost(&pose, cap, progress)?);
        let own = problem.distances(&pose, cap, progress)?;
        let floor = self.rounding * self.rounding * 256.0;
        let ratio = |other: &Rigid| -> Result<f64, AlignError> {
            let others = problem.distances(other, cap, progress)?;
            let [cost, least] = costs(&problem, [&others, &own], cap);
            Ok(((cost + floor) / (least + floor)).sqrt())
        };
        let mut others: Vec<Rigid> = vec![];
        let known = search.score(&pose);
        let mut refined = search.refine(&home, known, &coarse, progress)?;
        refined.extend(search.refine(&candidates, known, &coarse, progress)?);
        for (_, other) in refined {
            // With few samples first, then with a part of them: most are far worse.
            if !is_worse(coarse.cost(&other, cap, progress)?, own_coarse, 4.0, cap) {
                others.push(other);
            }
        }
        others.extend(revolved);
        let mut found: Vec<Alternative> = vec![];
        for other in others {
            let reach = self.reach(result.median);
            let other = finer.run(other, reach, COMPARED_ITERATIONS, progress)?.pose;
            if is_worse(finer.cost(&other, cap, progress)?, own_finer, MAX_RIVAL_RATIO, cap) {
                continue;
            }
            let other = problem.run(other, reach, 30, progress)?.pose;
            let ratio = ratio(&other)?;
            let apart = |p: &Rigid| search.apart(p, &other) > search.spacing;
            let between = other.after(&pose.inverse());
            let new = apart(&pose) && found.iter().all(|f| apart(&f.reference_from_measured));
            if ratio <= AS_GOOD_RATIO && new && !allowed(&between, &unheld(result), search.spacing) {
                found.push(Alternative { reference_from_measured: other, angle: between.angle(), ratio });
            }
        }
        if !search.samples.oriented
            && let Some(through) = wall::through(&coarse, &pose, progress)?
        {
            let bases: Vec<Rigid> =
                std::iter::once(pose).chain(found.iter().map(|f| f.reference_from_measured)).collect();
            for base in bases.iter().take(BRIEF_STARTS) {
                // From the other side of the wall the way through it is the opposite one.
                for sign in [1.0, -1.0] {
                    let other = Rigid::translation_by(times(sign, through)).after(base);
                    let other = problem.run(other, self.reach(result.median), 30, progress)?.pose;
                    let ratio = ratio(&other)?;
                    let apart = |p: &Rigid| search.apart(p, &other) > 0.5 * norm(through);
                    let new = apart(&pose) && found.iter().all(|f| apart(&f.reference_from_measured));
                    if ratio <= AS_GOOD_RATIO && new {
                        let angle = other.after(&pose.inverse()).angle();
                        found.push(Alternative { reference_from_measured: other, angle, ratio });
                    }
                }
            }
        }
        found.sort_by(|a, b| a.ratio.total_cmp(&b.ratio));
        Ok(found)
    }
}

/// Whether a cost is so many times that of the pose found that the other pose fits clearly worse.
fn is_worse(cost: f64, own: f64, by: f64, cap: f64) -> bool {
    cost > by * AS_GOOD_RATIO * AS_GOOD_RATIO * own.max(1e-3 * cap * cap)
}

/// The costs of two poses by their distances, without the points that lie on the reference in neither. A table around the part
/// tells nothing of either.
fn costs(problem: &Problem, distances: [&[f64]; 2], cap: f64) -> [f64; 2] {
    let [a, b] = distances;
    let tells: Vec<bool> = a.iter().zip(b).map(|(a, b)| a.min(*b) < cap).collect();
    distances
        .map(|of| problem.cost_of(of.iter().zip(&tells).map(|(d, tells)| if *tells { *d } else { 0.0 }), cap))
}

/// A pose that fits better than the result's; else of those that fit equally well the one that moves least, if it is another.
pub(super) fn better(search: &Search, result: &Alignment) -> Option<Rigid> {
    if let Some(best) = result.alternatives.first().filter(|a| a.ratio * EQUAL_RATIO < 1.0) {
        return Some(best.reference_from_measured);
    }
    let far = |pose: &Rigid| search.apart(&Rigid::IDENTITY, pose);
    let equal =
        result.alternatives.iter().filter(|a| a.ratio <= EQUAL_RATIO).map(|a| a.reference_from_measured);
    let least = equal.min_by(|a, b| far(a).total_cmp(&far(b)))?;
    (far(&least) + search.spacing < far(&result.reference_from_measured)).then_some(least)
}

/// Whether a pose is that of the result, but for what the shape leaves free.
pub(super) fn is_same(search: &Search, result: &Alignment, pose: &Rigid) -> bool {
    let own = result.reference_from_measured;
    let between = pose.after(&own.inverse());
    search.apart(pose, &own) <= search.spacing || allowed(&between, &unheld(result), search.spacing)
}

/// The motions that are free, and those that rims alone hold.
fn unheld(result: &Alignment) -> Vec<Freedom> {
    result.freedoms.iter().copied().chain(result.slack.iter().map(|s| s.0)).collect()
}

/// Whether a motion is one of those that the shape leaves free, to within `tolerance` of its axes.
fn allowed(motion: &Rigid, freedoms: &[Freedom], tolerance: f64) -> bool {
    let slides = freedoms.iter().any(|f| matches!(f, Freedom::Slides { .. }));
    if motion.angle() < 0.02 {
        return slides;
    }
    freedoms.iter().any(|f| match f {
        Freedom::Slides { .. } => false,
        // Its axis stays in its direction, and in its place where nothing slides.
        Freedom::Turns { point, direction } => {
            norm(cross(motion.vector(*direction), *direction)) < 0.02
                && dot(motion.vector(*direction), *direction) > 0.0
                && (slides || motion.displacement(*point) < tolerance)
        }
    })
}
