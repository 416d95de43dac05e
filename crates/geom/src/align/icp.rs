//! The iteration: closest points, one small motion that brings the points nearest to them, and again.
//!
//! Chen, Medioni: Object modelling by registration of multiple range images, Image and Vision Computing 10, 1992: the
//! distance is measured across the facet, edge or corner where the closest place lies. The steps then end at the least sum
//! of squared *distances to the surface*, not of distances to fixed points.
//!
//! Points that do not belong to the surface count less and less from six and not at all from ten standard deviations on
//! (Hampel's redescending weights, with the standard deviation from the median, Rousseeuw and Leroy: Robust regression,
//! 1987); where none is that far, the result is the plain weighted least-squares pose.

use super::field::facet_normal;
use super::sample::{Samples, agree};
use super::system::{Constraint, Equation, Six, Spectrum, System};
use super::{AlignError, Target};
use crate::closest::{BoundaryEdges, Feature, Query};
use crate::num::sum::Sum;
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::space::{Point, Vector, minus, norm, unit};
use crate::stats::SIGMA_OVER_MAD;

/// Standard deviations within which points count in full, and from which on not at all.
const FULL: f64 = 6.0;
const NONE: f64 = 10.0;
/// Iterations before the fit counts as not converging.
pub(super) const MOST: usize = 200;
/// Share of its own standard uncertainty below which a step is none.
const SMALL: f64 = 1e-3;

/// What the iteration works on.
pub(super) struct Problem<'a> {
    pub target: &'a Target<'a>,
    pub boundary_edges: Option<&'a BoundaryEdges>,
    pub samples: &'a Samples,
    /// Whether points far off count less.
    pub robust: bool,
    /// Mean of the samples, and their root mean square distance from it.
    pub mean: Point,
    pub radius: f64,
    /// Distances that arithmetic cannot tell from zero.
    pub rounding: f64,
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
        let samples = self.samples;
        let moved: Vec<Point> = samples.points.iter().map(|p| pose.point(*p)).collect();
        let query = Query { max_distance: reach, ..Query::default() };
        let tree = self.target.tree;
        let found = tree.map_closest(&moved, &query, progress, |i, hit| {
            let q = moved[i];
            let none = || Match {
                equation: Equation { point: q, away: [0.0; 3], hold: Constraint::Point, weight: 0.0 },
                distance: f64::INFINITY,
                facet: [0.0; 3],
            };
            let Some(hit) = hit else { return none() };
            let Some(facet) = facet_normal(self.target.mesh, hit.face) else { return none() };
            if let Some(normal) = samples.normals.get(i)
                && !agree(pose.vector(*normal), facet, samples.oriented, FACING)
            {
                return none();
            }
            let place = tree.place(&q, &hit);
            if self.boundary_edges.is_some_and(|edges| edges.holds(&place)) {
                return none();
            }
            let hold = match place.feature {
                Feature::Face => Constraint::Plane(facet),
                Feature::Edge(k) => Constraint::Line(self.edge(hit.face, k as usize)),
                Feature::Vertex(_) => Constraint::Point,
            };
            let away = minus(q, place.point);
            let equation = Equation { point: q, away, hold, weight: samples.weights[i] };
            Match { equation, distance: norm(away), facet }
        })?;
        Ok(found)
    }

    /// Unit direction of an edge of a face.
    fn edge(&self, face: u32, k: usize) -> Vector {
        let mesh = self.target.mesh;
        let corner = |k: usize| mesh.positions[mesh.faces[face as usize][k % 3] as usize];
        unit(minus(corner(k + 1), corner(k))).map_or([1.0, 0.0, 0.0], |u| u.0)
    }

    /// Standard deviation of the distances, from their weighted median.
    pub fn deviation(&self, matches: &[Match]) -> f64 {
        let median = weighted_median(matches.iter().map(|m| (m.distance, m.equation.weight)));
        SIGMA_OVER_MAD * median.unwrap_or(0.0)
    }

    /// Lets far points count less, `sigma` being the standard deviation. Where nothing is robust, all count.
    pub fn weigh(&self, matches: &mut [Match], sigma: f64) {
        if !self.robust {
            return;
        }
        let limit = self.limit(sigma);
        for m in matches {
            let share = NONE * (1.0 - m.distance / limit) / (NONE - FULL);
            m.equation.weight *= share.clamp(0.0, 1.0);
        }
    }

    /// Distance from which on a point does not count, where any do not.
    pub fn limit(&self, sigma: f64) -> f64 {
        NONE * sigma.max(16.0 * self.rounding)
    }

    /// Iterates from `start` until a step is less than a thousandth of its own uncertainty, `most` times at most.
    /// `reach` bounds the distances at the start; it closes in with them.
    pub fn run(
        &self,
        start: Rigid,
        mut reach: f64,
        most: usize,
        progress: &dyn Progress,
    ) -> Result<Ended, AlignError> {
        let mut pose = start;
        let mut kept_sigma = f64::INFINITY;
        for iteration in 0..most {
            let mut matches = self.matches(&pose, reach, progress)?;
            // The scale may only shrink: a growing one would let in what was shut out, and the pose swing.
            let sigma = self.deviation(&matches).min(kept_sigma);
            kept_sigma = sigma;
            self.weigh(&mut matches, sigma);
            let system = self.system(&matches, &pose);
            if system.weight <= 0.0 {
                return Ok(Ended { pose, iterations: iteration, converged: false });
            }
            let spectrum = Spectrum::of(&system);
            let step = spectrum.solve(&system.right, 0);
            pose = moved(&system, &step).after(&pose);
            // Of a displacement: the rotations are counted in it.
            let spread: f64 = spectrum.values[spectrum.fixed..].iter().map(|v| system.weight / v).sum();
            let uncertainty = system.rms() * (spread / system.count()).sqrt();
            let size = step.iter().map(|x| x * x).sum::<f64>().sqrt();
            if size <= (SMALL * uncertainty).max(self.rounding) {
                return Ok(Ended { pose, iterations: iteration + 1, converged: true });
            }
            if self.robust {
                reach = reach.min((2.0 * NONE * sigma + 2.0 * size).max(64.0 * self.rounding));
            }
        }
        Ok(Ended { pose, iterations: most, converged: false })
    }

    /// The equations of the matches about the mean of the samples at `pose`.
    pub fn system(&self, matches: &[Match], pose: &Rigid) -> System {
        let equations: Vec<Equation> = matches.iter().map(|m| m.equation).collect();
        System::new(&equations, pose.point(self.mean), self.radius)
    }

    /// The same where edges and corners hold no more than their facets do.
    pub fn system_of_facets(&self, matches: &[Match], pose: &Rigid) -> System {
        let flat = |m: &Match| Equation { hold: Constraint::Plane(m.facet), ..m.equation };
        let equations: Vec<Equation> = matches.iter().map(flat).collect();
        System::new(&equations, pose.point(self.mean), self.radius)
    }

    /// Mean of the squared distances, none counted for more than `cap`; what does not belong to the surface counts as
    /// that far.
    pub fn cost(&self, pose: &Rigid, cap: f64, progress: &dyn Progress) -> Result<f64, AlignError> {
        let matches = self.matches(pose, cap, progress)?;
        let terms = matches.iter().zip(&self.samples.weights).map(|(m, w)| {
            let d = m.distance.min(cap);
            w * d * d
        });
        Ok(terms.fold(Sum::default(), Sum::plus).value())
    }
}

/// Cosine of the angle between the normals of sample and facet beyond which they lie on different sides of a wall. At a
/// sharp edge both may be those of either side, so that less would shut out what belongs there.
const FACING: f64 = -0.5;

/// The motion that a step stands for.
pub(super) fn moved(system: &System, step: &Six) -> Rigid {
    let turn: Vector = std::array::from_fn(|k| step[k] / system.radius);
    let shift: Vector = std::array::from_fn(|k| step[k + 3]);
    let turned = Rigid::rotation_about(system.center, turn);
    Rigid::translation_by(shift).after(&turned)
}

/// The value up to which half of the weight lies, of those that are finite and have weight.
pub(super) fn weighted_median(values: impl Iterator<Item = (f64, f64)>) -> Option<f64> {
    let mut values: Vec<(f64, f64)> = values.filter(|v| v.0.is_finite() && v.1 > 0.0).collect();
    values.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let half = 0.5 * values.iter().map(|v| v.1).sum::<f64>();
    let mut sum = 0.0;
    values.iter().find_map(|v| {
        sum += v.1;
        (sum >= half).then_some(v.0)
    })
}
