//! The iteration: closest points, one small motion that brings the points nearest to them, and again.
//!
//! The distance is measured across the facet, edge or corner where the closest place lies. (Chen, Medioni: Object modelling by
//! registration of multiple range images, Image and Vision Computing 10, 1992.) The steps then end at the least sum of squared
//! *distances to the surface*, not of distances to fixed points.
//!
//! Points that do not belong to the surface count less and less from six standard deviations on, and not at all from ten on.
//! (Hampel's redescending weights, with the standard deviation from the median: Rousseeuw and Leroy, Robust regression, 1987.)
//! Where none is that far, the result is the plain weighted least-squares pose.

use super::field::normal_of;
use super::sample::{Samples, agree};
use super::system::{Constraint, Equation, Six, Spectrum, System};
use super::twist::{Lock, Twist, directions};
use super::{AlignError, ExactFoot, ExactSurface, Target};
use crate::closest::{BoundaryEdges, Feature, Query};
use crate::num::sum::Sum;
use crate::parallel::prelude::*;
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::space::{Point, Vector, minus, norm, unit};
use crate::stats::SIGMA_OVER_MAD;

/// Standard deviations within which points count in full.
const FULL_WEIGHT_SIGMAS: f64 = 6.0;
/// Standard deviations from which on points do not count at all.
const ZERO_WEIGHT_SIGMAS: f64 = 10.0;
/// Iterations before the fit counts as not converging.
pub(super) const MAX_ITERATIONS: usize = 200;
/// Share of its own standard uncertainty below which a step counts as none.
const SETTLED_STEP_SHARE: f64 = 1e-3;

/// The problem that the iteration works on.
pub(super) struct Problem<'a> {
    pub target: &'a Target<'a>,
    /// The surfaces that places are looked up on instead of on the mesh.
    pub exact: Option<&'a dyn ExactSurface>,
    pub boundary_edges: Option<&'a BoundaryEdges>,
    pub samples: &'a Samples,
    /// Whether points far off count less.
    pub robust: bool,
    /// Mean of the samples, and their root mean square distance from it.
    pub mean: Point,
    pub radius: f64,
    /// Distances that arithmetic cannot tell from zero.
    pub rounding: f64,
    /// Motions that are not made, and components of the motion that stay zero.
    pub stay: &'a [Twist],
    pub lock: Option<&'a Lock>,
}

/// One sample at a pose.
#[derive(Clone, Copy, Debug)]
pub(super) struct Match {
    pub equation: Equation,
    /// Distance from the surface; infinite where the place does not belong to the sample.
    pub distance: f64,
    /// Normal of the facet.
    pub facet: Vector,
}

impl Match {
    /// Of a sample at `q` that has no place on the surface.
    fn none(q: Point) -> Match {
        Match {
            equation: Equation { point: q, away: [0.0; 3], hold: Constraint::Point, weight: 0.0 },
            distance: f64::INFINITY,
            facet: [0.0; 3],
        }
    }
}

/// Memory that an iteration uses in every round: asked of the system anew it would cost half as much as the search.
#[derive(Default)]
pub(super) struct Room {
    pub matches: Vec<Match>,
    moved: Vec<Point>,
    distances: Vec<(f64, f64)>,
}

/// Where an iteration ended.
pub(super) struct Ended {
    pub pose: Rigid,
    pub iterations: usize,
    pub converged: bool,
}

impl Problem<'_> {
    /// The closest places of all samples at `pose`, no farther than `reach`.
    pub fn matches(
        &self,
        pose: &Rigid,
        reach: f64,
        progress: &dyn Progress,
    ) -> Result<Vec<Match>, AlignError> {
        let mut room = Room::default();
        self.match_into(pose, reach, progress, &mut room)?;
        Ok(room.matches)
    }

    /// [`Problem::matches`] into memory that there is.
    fn match_into(
        &self,
        pose: &Rigid,
        reach: f64,
        progress: &dyn Progress,
        Room { matches, moved, .. }: &mut Room,
    ) -> Result<(), AlignError> {
        let samples = self.samples;
        if samples.points.len() < MIN_PARALLEL_SAMPLES {
            moved.clear();
            moved.extend(samples.points.iter().map(|p| pose.point(*p)));
        } else {
            samples.points.par_iter().map(|p| pose.point(*p)).collect_into_vec(moved);
        }
        if let Some(exact) = self.exact {
            let feet = exact.feet(moved, progress)?;
            let found = feet.into_iter().enumerate();
            *matches = found.map(|(i, foot)| self.on_surface(i, moved[i], foot, (pose, reach))).collect();
            return Ok(());
        }
        let query = Query { max_distance: reach, ..Query::default() };
        let tree = self.target.tree;
        let of_hit = |i: usize, hit| {
            let q = moved[i];
            let none = || Match::none(q);
            let Some(hit) = hit else { return none() };
            let foot = tree.foot(&q, &hit);
            let Some(facet) = normal_of(&foot.corners) else { return none() };
            if let Some(normal) = samples.normals.get(i)
                && !agree(pose.vector(*normal), facet, samples.oriented, OTHER_SIDE_COSINE)
            {
                return none();
            }
            if self.boundary_edges.is_some_and(|edges| edges.hold(hit.face, foot.feature)) {
                return none();
            }
            let hold = match foot.feature {
                Feature::Face => Constraint::Plane(facet),
                Feature::Edge(k) => Constraint::Line(edge(&foot.corners, k as usize)),
                Feature::Vertex(_) => Constraint::Point,
            };
            let away = minus(q, foot.point);
            let equation = Equation { point: q, away, hold, weight: samples.weights[i] };
            Match { equation, distance: norm(away), facet }
        };
        Ok(tree.map_closest_into(moved, &query, progress, of_hit, matches)?)
    }

    /// Sample `i`, which lies at `q`, and its place on exact surfaces.
    fn on_surface(&self, i: usize, q: Point, foot: Option<ExactFoot>, (pose, reach): (&Rigid, f64)) -> Match {
        let Some(foot) = foot.filter(|foot| !foot.is_border) else { return Match::none(q) };
        let away = minus(q, foot.place);
        let looks_away = self.samples.normals.get(i).is_some_and(|normal| {
            !agree(pose.vector(*normal), foot.normal, self.samples.oriented, OTHER_SIDE_COSINE)
        });
        if looks_away || norm(away) > reach {
            return Match::none(q);
        }
        let hold = if foot.is_within { Constraint::Plane(foot.normal) } else { Constraint::Point };
        let equation = Equation { point: q, away, hold, weight: self.samples.weights[i] };
        Match { equation, distance: norm(away), facet: foot.normal }
    }

    /// Makes of matches that an iteration left those in full weight, however far.
    pub fn complete(
        &self,
        matches: &mut [Match],
        pose: &Rigid,
        progress: &dyn Progress,
    ) -> Result<(), AlignError> {
        let mut missing = vec![];
        for (i, (m, weight)) in matches.iter_mut().zip(&self.samples.weights).enumerate() {
            m.equation.weight = *weight;
            if !m.distance.is_finite() {
                missing.push(i);
            }
        }
        let samples = self.samples.those(&missing);
        let found = Problem { samples: &samples, ..*self }.matches(pose, f64::INFINITY, progress)?;
        missing.into_iter().zip(found).for_each(|(i, m)| matches[i] = m);
        Ok(())
    }

    /// Standard deviation of the distances, from their weighted median.
    pub fn deviation(&self, matches: &[Match]) -> f64 {
        SIGMA_OVER_MAD * median_distance(matches, &mut vec![]).unwrap_or(0.0)
    }

    /// Lets far points count less, `sigma` being the standard deviation. Where nothing is robust, all count.
    pub fn weigh(&self, matches: &mut [Match], sigma: f64) {
        if !self.robust {
            return;
        }
        let limit = self.limit(sigma);
        for m in matches {
            let share =
                ZERO_WEIGHT_SIGMAS * (1.0 - m.distance / limit) / (ZERO_WEIGHT_SIGMAS - FULL_WEIGHT_SIGMAS);
            m.equation.weight *= share.clamp(0.0, 1.0);
        }
    }

    /// Distance from which on a point does not count, where any do not.
    pub fn limit(&self, sigma: f64) -> f64 {
        ZERO_WEIGHT_SIGMAS * sigma.max(16.0 * self.rounding)
    }

    /// Iterates from `start` until a step is less than a thousandth of its own uncertainty, `most` times at most.
    /// `reach` bounds the distances at the start; it closes in with them.
    pub fn run(
        &self,
        start: Rigid,
        reach: f64,
        most: usize,
        progress: &dyn Progress,
    ) -> Result<Ended, AlignError> {
        let (ended, last) = self.iterate(start, reach, most, &mut Room::default(), progress)?;
        Ok(Ended { pose: self.locked(last.after(&ended.pose)), ..ended })
    }

    /// As [`Problem::run`], but the last step is not made but given, as it moves nothing. Where the search converged, the
    /// matches in `room` are those at its final pose. The farther ones have less weight, those out of reach no distance.
    pub fn iterate(
        &self,
        start: Rigid,
        mut reach: f64,
        most: usize,
        room: &mut Room,
        progress: &dyn Progress,
    ) -> Result<(Ended, Rigid), AlignError> {
        let mut pose = start;
        let mut kept_sigma = f64::INFINITY;
        let ended = |pose, iterations, converged| Ended { pose, iterations, converged };
        for iteration in 0..most {
            self.match_into(&pose, reach, progress, room)?;
            let Room { matches, distances, .. } = &mut *room;
            // The scale may only shrink: a growing one would let in what was shut out, and the pose swing.
            let median = median_distance(matches, distances).unwrap_or(0.0);
            let sigma = (SIGMA_OVER_MAD * median).min(kept_sigma);
            kept_sigma = sigma;
            self.weigh(matches, sigma);
            let system = self.system(matches, &pose);
            if system.weight <= 0.0 {
                return Ok((ended(pose, iteration, false), Rigid::IDENTITY));
            }
            let spectrum = Spectrum::without(&system, &self.stays(&system, &pose));
            let step = spectrum.solve(&system.right, 0);
            let motion = moved(&system, &step);
            // The size of a displacement, with the rotations counted in it.
            let spread: f64 = spectrum.values[spectrum.fixed..].iter().map(|v| system.weight / v).sum();
            let uncertainty = system.rms() * (spread / system.count()).sqrt();
            let size = step.iter().map(|x| x * x).sum::<f64>().sqrt();
            if size <= (SETTLED_STEP_SHARE * uncertainty).max(self.rounding) {
                return Ok((ended(pose, iteration + 1, true), motion));
            }
            pose = self.locked(motion.after(&pose));
            if self.robust {
                reach = reach.min((2.0 * ZERO_WEIGHT_SIGMAS * sigma + 2.0 * size).max(64.0 * self.rounding));
            }
        }
        Ok((ended(pose, most, false), Rigid::IDENTITY))
    }

    /// The directions of the unknowns of a system along which nothing moves.
    pub fn stays(&self, system: &System, pose: &Rigid) -> Vec<Six> {
        let locked = self.lock.map(|lock| lock.twists(pose)).unwrap_or_default();
        directions(&[self.stay, &locked].concat(), system.center, system.radius)
    }

    /// The pose without what is locked.
    fn locked(&self, pose: Rigid) -> Rigid {
        self.lock.map_or(pose, |lock| lock.applied(&pose))
    }

    /// The equations of the matches about the mean of the samples at `pose`.
    pub fn system(&self, matches: &[Match], pose: &Rigid) -> System {
        System::new(matches, |m| m.equation, pose.point(self.mean), self.radius)
    }

    /// The same where edges and corners hold no more than their facets do.
    pub fn system_of_facets(&self, matches: &[Match], pose: &Rigid) -> System {
        let flat = |m: &Match| Equation { hold: Constraint::Plane(m.facet), ..m.equation };
        System::new(matches, flat, pose.point(self.mean), self.radius)
    }

    /// Mean of the squared distances, none counted for more than `cap`; what does not belong to the surface counts as
    /// that far.
    pub fn cost(&self, pose: &Rigid, cap: f64, progress: &dyn Progress) -> Result<f64, AlignError> {
        Ok(self.cost_of(self.distances(pose, cap, progress)?.into_iter(), cap))
    }

    /// The distances at `pose`, infinite or at least `cap` for what does not belong to the surface.
    pub fn distances(&self, pose: &Rigid, cap: f64, progress: &dyn Progress) -> Result<Vec<f64>, AlignError> {
        Ok(self.matches(pose, cap, progress)?.iter().map(|m| m.distance).collect())
    }

    /// The same where the distances are known.
    pub fn cost_of(&self, distances: impl Iterator<Item = f64>, cap: f64) -> f64 {
        let terms = distances.zip(&self.samples.weights).map(|(d, w)| w * d.min(cap) * d.min(cap));
        terms.fold(Sum::default(), Sum::plus).value()
    }
}

/// Cosine of the angle between the normals of sample and facet beyond which they lie on different sides of a wall. At a sharp
/// edge both may be those of either side, so a smaller angle would shut out matches that belong there.
const OTHER_SIDE_COSINE: f64 = -0.5;

/// Samples from which on their places are worked out on all threads.
const MIN_PARALLEL_SAMPLES: usize = 1 << 14;

/// Unit direction of edge `k` of a triangle.
fn edge(corners: &[Point; 3], k: usize) -> Vector {
    unit(minus(corners[(k + 1) % 3], corners[k % 3])).map_or([1.0, 0.0, 0.0], |u| u.0)
}

/// The motion that a step stands for.
pub(super) fn moved(system: &System, step: &Six) -> Rigid {
    small_motion(system.center, system.radius, step)
}

/// The same about a center, rotations counted at `radius`.
pub(super) fn small_motion(center: Point, radius: f64, step: &Six) -> Rigid {
    let turn: Vector = std::array::from_fn(|k| step[k] / radius);
    let shift: Vector = std::array::from_fn(|k| step[k + 3]);
    Rigid::translation_by(shift).after(&Rigid::rotation_about(center, turn))
}

/// The distance up to which half of the weight lies, of those that are finite and have weight. `values` is scratch.
pub(super) fn median_distance(matches: &[Match], values: &mut Vec<(f64, f64)>) -> Option<f64> {
    values.clear();
    let counts = |m: &&Match| m.distance.is_finite() && m.equation.weight > 0.0;
    values.extend(matches.iter().filter(counts).map(|m| (m.distance, m.equation.weight)));
    let half = 0.5 * values.iter().map(|v| v.1).sum::<f64>();
    // The values still open, and the weight of those that are less.
    let (mut left, mut less) = (&mut values[..], 0.0);
    while left.len() > 1 {
        let middle = left.len() / 2;
        let order = |a: &(f64, f64), b: &(f64, f64)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1));
        left.select_nth_unstable_by(middle, order);
        let (low, high) = left.split_at_mut(middle);
        let below = less + low.iter().map(|v| v.1).sum::<f64>();
        (left, less) = if below >= half { (low, less) } else { (high, below) };
    }
    left.first().map(|v| v.0)
}
