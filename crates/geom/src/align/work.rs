//! The common ground of the steps of a best fit: problems of its samples, and the choice of the best of many poses.

use super::icp::{MAX_ITERATIONS, Problem};
use super::sample::Samples;
use super::start::{Candidate, Search};
use super::{AlignError, Alignment, BestFit, Start, Target};
use crate::closest::BoundaryEdges;
use crate::parallel::prelude::*;
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::space::{Aabb, Point, minus, norm};

/// Samples for a start.
pub(super) const START_SAMPLES: usize = 400;
/// Starts whose cost is within this ratio of the best are iterated to the end.
const MAX_PROMISING_RATIO: f64 = 4.0;
/// Samples on which poses are compared first.
pub(super) const RIVAL_SAMPLES: usize = 1000;
/// Cost over the least on these samples beyond which a pose is not compared further. Means of so many squares differ from those
/// of all by a tenth.
pub(super) const MAX_RIVAL_RATIO: f64 = 2.0;
/// Starts that a search on the way iterates to the end.
pub(super) const BRIEF_STARTS: usize = 5;
/// Iterations after which poses are compared.
pub(super) const COMPARED_ITERATIONS: usize = 20;
/// Standard deviations from which on a distance counts no more when poses are compared.
const FAR_RESIDUAL_SIGMAS: f64 = 20.0;

/// The inputs that all steps share.
pub(super) struct Work<'a> {
    pub target: &'a Target<'a>,
    pub boundary_edges: Option<&'a BoundaryEdges>,
    pub options: &'a BestFit,
    pub radius: f64,
    pub rounding: f64,
}

/// A pose where it came to lie on samples.
struct Compared {
    pose: Rigid,
    /// Standard deviation of the distances there.
    sigma: f64,
    /// Mean of the squared distances up to a cap.
    cost: f64,
}

impl<'a> Work<'a> {
    /// For a fit of what `samples` are all of.
    pub fn new(
        target: &'a Target<'a>,
        boundary_edges: &'a BoundaryEdges,
        options: &'a BestFit,
        samples: &Samples,
    ) -> Work<'a> {
        let far = |b: &Aabb| b.min.iter().chain(&b.max).fold(0.0f64, |m, x| m.max(x.abs()));
        let moments = samples.moments();
        let size = far(&target.bounds) + norm(moments.mean).min(far(&Aabb::of(&samples.points)));
        Work {
            target,
            boundary_edges: (boundary_edges.count() > 0).then_some(boundary_edges),
            options,
            radius: moments.radius(),
            rounding: 4.0 * f64::EPSILON * size.max(moments.radius()),
        }
    }

    /// The diagonal of the smaller of both.
    pub fn size(&self, samples: &Samples) -> f64 {
        self.target.bounds.diagonal().min(Aabb::of(&samples.points).diagonal())
    }

    /// The iteration over samples.
    pub fn problem<'b>(&'b self, samples: &'b Samples) -> Problem<'b> {
        Problem {
            target: self.target,
            exact: None,
            boundary_edges: self.boundary_edges,
            samples,
            mean: samples.moments().mean,
            robust: self.options.robust,
            radius: self.radius,
            rounding: self.rounding,
            stay: &[],
            lock: self.options.lock.as_ref(),
        }
    }

    /// The pose that motions are measured from: the given one, or that of the files.
    pub fn start(&self) -> Rigid {
        match self.options.start {
            Start::From(pose) => pose,
            Start::Anywhere => Rigid::IDENTITY,
        }
    }

    /// The best of the candidates, refined on the samples of the search.
    pub fn promising(
        &self,
        search: &Search,
        candidates: &[Candidate],
        progress: &dyn Progress,
    ) -> Result<Vec<Rigid>, AlignError> {
        let refined = search.refine(candidates, 0.0, &self.problem(&search.samples), progress)?;
        let least = refined.first().map_or(0.0, |r| r.0);
        Ok(refined.iter().filter(|r| r.0 <= MAX_PROMISING_RATIO * least).map(|r| r.1).collect())
    }

    /// A few of the best poses of one more search; none where it finds none.
    pub fn briefly(
        &self,
        search: &Search,
        from: &[Rigid],
        progress: &dyn Progress,
    ) -> Result<Vec<Rigid>, AlignError> {
        let candidates = search.candidates(from, progress)?;
        let mut poses = self.promising(search, &candidates, progress)?;
        poses.truncate(BRIEF_STARTS);
        Ok(poses)
    }

    /// How far a pose with distances of this deviation is looked around at first.
    pub fn reach(&self, sigma: f64) -> f64 {
        if self.options.robust {
            (2.0 * FAR_RESIDUAL_SIGMAS * sigma).max(64.0 * self.rounding)
        } else {
            f64::INFINITY
        }
    }

    /// The best of the poses, iterated to the end on some samples, and the standard deviation of the distances there. Most are far from
    /// the best one: a part of the samples tells which.
    pub fn choose(
        &self,
        poses: &[Rigid],
        subset: &Samples,
        progress: &dyn Progress,
    ) -> Result<(Rigid, f64), AlignError> {
        let mut rivals = poses.to_vec();
        if rivals.len() > 1 && subset.points.len() > 2 * RIVAL_SAMPLES {
            let ended = self.ended(&rivals, &subset.first(RIVAL_SAMPLES), progress)?;
            let least = ended.iter().map(|e| e.cost).fold(f64::INFINITY, f64::min);
            rivals = ended.iter().filter(|e| e.cost <= MAX_RIVAL_RATIO * least).map(|e| e.pose).collect();
        }
        let mut best: Option<Compared> = None;
        for one in self.ended(&rivals, subset, progress)? {
            if best.as_ref().is_none_or(|b| one.cost < b.cost) {
                best = Some(one);
            }
        }
        best.map(|b| (b.pose, b.sigma)).ok_or(AlignError::NoOverlap)
    }

    /// The end of the iteration from the pose where all samples counted, if that lies better. The walls of a flat plate are
    /// few, and far enough at its start to be taken for outliers. Without them the plate slides and turns in its plane.
    pub fn where_all_count(
        &self,
        result: &Alignment,
        subset: &Samples,
        progress: &dyn Progress,
    ) -> Result<Option<Rigid>, AlignError> {
        if !self.options.robust || result.excluded_points == 0 {
            return Ok(None);
        }
        let own = result.reference_from_measured;
        let all = Problem { robust: false, ..self.problem(subset) };
        let there = all.run(own, f64::INFINITY, MAX_ITERATIONS, progress)?.pose;
        let (pose, sigma) = self.choose(&[own, there], subset, progress)?;
        let moved = |p: &Point| norm(minus(pose.point(*p), own.point(*p)));
        let farthest = subset.points.iter().map(moved).fold(0.0, f64::max);
        Ok((farthest > sigma.max(self.rounding)).then_some(pose))
    }

    /// Poses iterated on samples, in their order, with what they cost there under one cap.
    fn ended(
        &self,
        poses: &[Rigid],
        samples: &Samples,
        progress: &dyn Progress,
    ) -> Result<Vec<Compared>, AlignError> {
        let problem = self.problem(samples);
        let run = |pose: &Rigid| -> Result<(Rigid, f64, Vec<f64>), AlignError> {
            let at_start = problem.matches(pose, f64::INFINITY, progress)?;
            let sigma = problem.deviation(&at_start);
            let pose = problem.run(*pose, self.reach(sigma), COMPARED_ITERATIONS, progress)?.pose;
            let matches = problem.matches(&pose, f64::INFINITY, progress)?;
            Ok((pose, problem.deviation(&matches), matches.iter().map(|m| m.distance).collect()))
        };
        let ended: Vec<(Rigid, f64, Vec<f64>)> =
            poses.par_iter().map(run).collect::<Result<_, AlignError>>()?;
        let least = ended.iter().map(|e| e.1).fold(f64::INFINITY, f64::min);
        let cost = |(pose, sigma, distances): (Rigid, f64, Vec<f64>)| Compared {
            pose,
            sigma,
            cost: problem.cost_of(distances.into_iter(), self.cap(least)),
        };
        Ok(ended.into_iter().map(cost).collect())
    }

    /// The distance from which on none counts for more when poses are compared.
    pub fn cap(&self, sigma: f64) -> f64 {
        (FAR_RESIDUAL_SIGMAS * sigma).max(1e-6 * self.radius)
    }
}
