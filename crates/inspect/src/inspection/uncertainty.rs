//! Uncertainties of the values: the points are moved by noise again and again, and all is evaluated anew.
//!
//! Propagation of distributions by a Monte Carlo method (JCGM 101:2008), of the noise that the plan states, through the association of
//! the elements, the alignment, the datums, and the evaluation. What the points of a feature are stays as it was found.
//!
//! What the farthest points decide, a form, a run-out, the largest cylinder in a bore, noise does not only scatter: it makes the one
//! wider and the other smaller, each time. How much is found from features of perfect form, their elements, with the same noise (parametric
//! bootstrap: Efron, Tibshirani, An introduction to the bootstrap, 1993, 6.5). That is the most of it: a form deviation is a seminorm of
//! the distances, so that with noise it is at most the sum of both, and a form of the part's own leaves less. The value stays what the
//! standard defines; the interval of its uncertainty reaches farther to that side (JCGM 100:2008, F.2.4.5).

use super::Alignment;
use super::data::{Data, Stop};
use super::measure::measured;
use super::noise_field::Field;
use super::pose_noise::PoseNoise;
use super::take::again;
use crate::characteristic::{Element, Taken, Value};
use crate::plan::{Noise, Plan, Spec};
use trueness_geom::num::random::Random;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::Progress;
use trueness_geom::space::{minus, times, unit};

/// Coverage factor of an expanded uncertainty.
const K: f64 = 2.0;
/// Share of the draws that must give a value.
const ENOUGH: f64 = 0.9;
/// Draws of perfect features at most: their mean is then known to an eighth of the standard deviation.
const PERFECT: u32 = 64;
/// Standard errors of that mean beyond which it tells of more than chance.
const CLEAR: f64 = 3.0;

/// The expanded uncertainty of a value (k = 2), and where it comes from. Millimeters, or degrees for an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertainty {
    /// Half of the interval about the value that holds the true one: `spread` and the magnitude of `bias`.
    pub expanded: f64,
    /// By what scatters.
    pub spread: f64,
    /// What noise adds to the value on the average, at most; 0 where it adds nothing.
    pub bias: f64,
    /// `plan`, `noise`, or `plan and noise`.
    pub source: &'static str,
}

impl Uncertainty {
    fn new(spread: f64, bias: f64, source: &'static str) -> Uncertainty {
        Uncertainty { expanded: spread + bias.abs(), spread, bias, source }
    }

    /// How far the true value may lie below and above the measured one: farther on the side that noise leads away from.
    pub fn sides(&self) -> [f64; 2] {
        [self.spread + self.bias.max(0.0), self.spread + (-self.bias).max(0.0)]
    }
}

/// The uncertainty of each characteristic: what the plan states and what its noise makes, as the root of the sum of squares. `None`
/// where the plan says nothing of it, and where its noise leaves too few draws a value: then it is not known.
pub(super) fn found(
    plan: &Plan,
    aligned: (&Data, &Alignment),
    features: &[Taken],
    progress: &dyn Progress,
) -> Result<Vec<Option<Uncertainty>>, Stop> {
    let Some(noise) = &plan.decision.noise else {
        let stated = |spec: &Spec| Some(Uncertainty::new(spec.uncertainty?, 0.0, "plan"));
        return Ok(plan.specs.iter().map(stated).collect());
    };
    let pose = PoseNoise::new(plan, noise, aligned, features, progress)?;
    let seed = aligned.0.seed;
    let draws = Draws { plan, noise, pose: &pose, seed, progress };
    let spread = draws.of(features, noise.draws)?;
    let perfect = perfect(plan, features, progress)?;
    let exact = draws.values(&perfect, None)?;
    let with_noise = draws.of(&perfect, noise.draws.min(PERFECT))?;
    let one = |n: usize| {
        let found = K * spread[n]?.deviation;
        let bias = with_noise[n].zip(exact[n]).map(|(noisy, exact)| (noisy.mean - exact, noisy.error));
        let bias = bias.filter(|(bias, error)| bias.abs() > CLEAR * error).map_or(0.0, |b| b.0);
        let (spread, source) = match plan.specs[n].uncertainty {
            None => (found, "noise"),
            Some(stated) => (libm::hypot(stated, found), "plan and noise"),
        };
        Some(Uncertainty::new(spread, bias, source)).filter(|u| u.expanded.is_finite())
    };
    Ok((0..plan.specs.len()).map(one).collect())
}

/// The features as their elements have them: every point where it would be if the form were perfect.
fn perfect(plan: &Plan, features: &[Taken], progress: &dyn Progress) -> Result<Vec<Taken>, Stop> {
    let onto = |taken: &mut Taken| {
        let Ok(Element::Fit(fit)) = &taken.element else { return false };
        let shape = fit.shape;
        for p in &mut taken.points {
            // Where there are many nearest places it stays.
            let Some((normal, _)) = unit(shape.normal(*p)) else { continue };
            *p = minus(*p, times(shape.distance(*p), normal));
        }
        true
    };
    again(plan, features, onto, progress)
}

/// What is drawn.
struct Draws<'a> {
    plan: &'a Plan,
    noise: &'a Noise,
    pose: &'a PoseNoise,
    seed: u64,
    progress: &'a dyn Progress,
}

impl Draws<'_> {
    /// Mean and deviation of each value over the draws.
    fn of(&self, features: &[Taken], draws: u32) -> Result<Vec<Option<Scatter>>, Stop> {
        let draw = |number: u64| {
            let seed = Random::stream(self.seed, number).next_u64();
            self.values(features, Some(Field::new(self.noise, seed)))
        };
        let all: Vec<Vec<Option<f64>>> =
            (0..u64::from(draws)).into_par_iter().map(draw).collect::<Result<_, Stop>>()?;
        Ok((0..self.plan.specs.len()).map(|n| Scatter::of(all.iter().map(|values| values[n]))).collect())
    }

    /// The values with the noise of one draw, or without.
    fn values(&self, features: &[Taken], mut field: Option<Field>) -> Result<Vec<Option<f64>>, Stop> {
        let mut moved = features.to_vec();
        if let Some(field) = &mut field {
            for taken in &mut moved {
                for p in &mut taken.points {
                    let mut shift = field.at(p);
                    // Points of two coordinates stay in their plane.
                    shift[2] *= f64::from(u8::from(!taken.planar));
                    *p = [0, 1, 2].map(|k| p[k] + shift[k]);
                }
            }
        }
        let motion = match self.pose.motion(self.plan, field.as_ref(), &moved, self.progress) {
            Ok(motion) => motion,
            Err(Stop::Cancelled) => return Err(Stop::Cancelled),
            // Noise far beyond the part: its datums hold nothing.
            Err(_) => return Ok(vec![None; self.plan.specs.len()]),
        };
        let carried = |taken: &mut Taken| {
            taken.points.iter_mut().for_each(|p| *p = motion.point(*p));
            true
        };
        let features = again(self.plan, &moved, carried, self.progress)?;
        let value = |spec: &Spec| measured(spec, &features, self.progress);
        let values =
            self.plan.specs.iter().map(value).collect::<Result<Vec<Result<Value, String>>, Stop>>()?;
        Ok(values.into_iter().map(|v| v.ok().map(|v| v.value)).collect())
    }
}

/// How a value scatters.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Scatter {
    mean: f64,
    deviation: f64,
    /// Standard error of the mean.
    error: f64,
}

impl Scatter {
    /// Of what there is; `None` where too much is missing.
    fn of(values: impl ExactSizeIterator<Item = Option<f64>>) -> Option<Scatter> {
        let all = values.len();
        let values: Vec<f64> = values.flatten().collect();
        if values.len() < 2 || (values.len() as f64) < ENOUGH * all as f64 {
            return None;
        }
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|v| (v - mean) * (v - mean)).sum();
        let deviation = (squares / (count - 1.0)).sqrt();
        Some(Scatter { mean, deviation, error: deviation / count.sqrt() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn too_few_values_have_no_deviation() {
        let of = |values: &[Option<f64>]| Scatter::of(values.iter().copied()).map(|s| s.deviation);
        assert_eq!(of(&[Some(1.0), Some(3.0)]), Some(2f64.sqrt()));
        assert_eq!(of(&[Some(1.0), Some(3.0), None]), None);
        assert_eq!((of(&[Some(1.0)]), of(&[])), (None, None));
    }

    #[test]
    fn the_interval_reaches_farther_to_the_side_of_the_bias() {
        let wide = Uncertainty::new(1.0, 3.0, "noise");
        assert_eq!((wide.sides(), wide.expanded), ([4.0, 1.0], 4.0));
        let small = Uncertainty::new(1.0, -3.0, "noise");
        assert_eq!((small.sides(), small.expanded), ([1.0, 4.0], 4.0));
    }
}
