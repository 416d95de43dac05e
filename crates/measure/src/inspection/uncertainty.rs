//! Uncertainties of the values: the points are moved by noise again and again, and all is evaluated anew.
//!
//! Propagation of distributions by a Monte Carlo method (JCGM 101:2008). The noise that the plan states goes through the association of
//! the elements, the alignment, the datums, and the evaluation. What the points of a feature are stays as it was found.
//!
//! What the farthest points decide, a form, a run-out, the largest cylinder in a bore, noise does not only scatter: it makes the one
//! wider and the other smaller, each time. How much depends on the form that is there: most where it is perfect, half of it and less
//! where few places are the farthest. So the points are first brought to the form that they have below the noise ([`super::denoised`]).
//! Then what the noise makes of that is drawn (parametric bootstrap: Efron, Tibshirani, An introduction to the bootstrap, 1993, 6.5). The
//! mean of what it adds is the bias, its scatter the spread. The value stays what the standard defines; the interval lies about the value
//! less the bias, as the basic bootstrap has it (13.4 there). It goes on to the value where that is beyond, and is made longer by what is
//! not known of the form:
//! - Downward, as a form found may be made by the noise in part, and noise adds more to a smaller one. The end is the smallest form of
//!   its kind to which the noise of the value may belong (inversion of a test, see [`smaller`]). It lies some farther for the noise that
//!   is left in the form, which makes its extremes stand out too far.
//! - Upward, where the form does not show by as much as the noise adds, by the share of the bias that it does not explain: below the
//!   noise a form may hide, and then the value is its own. As much by the share of a rough form, whose places are not known one by one; and at
//!   least by some of the noise left in the form, whose extremes may stand out too little too.

use super::Alignment;
use super::data::Data;
use super::denoised::{Unknown, denoised};
use super::extract_features::associated_anew;
use super::measure::measured;
use super::noise_field::Field;
use super::pose_noise::PoseNoise;
use super::stop::Stop;
use crate::characteristic::{Element, MeasuredFeature, Spec};
use crate::noise::NoiseOrReason;
use crate::plan::{Noise, Plan};
use crate::requirement::Limits;
use std::collections::BTreeMap;
use trueness_geom::num::random::Random;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::Progress;
use trueness_geom::space::{minus, times, unit};

/// Coverage factor of an expanded uncertainty.
const COVERAGE_FACTOR: f64 = 2.0;
/// Share of the draws that must give a value.
const MIN_DRAWN_SHARE: f64 = 0.9;
/// Draws of features of perfect and of half the form at most: their mean is then known to an eighth of the standard deviation.
const MAX_FORM_DRAWS: u32 = 64;
/// Standard errors of a mean beyond which it tells of more than chance.
const CLEAR_STANDARD_ERRORS: f64 = 3.0;
/// Share of the range of the noise left in a form by which its extremes stand out too far, beside what [`smaller`] tells; twice of it
/// where the form is rough, as the places are not known then. Counted with 200 copies each of planes, cylinders and spheres of 100 to 400
/// points. They have waves, corners, steps, single and rough points of 1 to 20 deviations. With this and with 0.3 some 92 % and more are
/// covered, with 0.2 83 % of single points.
const OVERSTATED_NOISE_SHARE: f64 = 0.35;
/// Share by which they may stand out too little: without it 90 % of waves of 10 deviations on 100 points were covered.
const UNDERSTATED_NOISE_SHARE: f64 = 0.1;

/// The expanded uncertainty of a value (k = 2), and where it comes from. Millimeters, or degrees for an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertainty {
    /// The value less and plus this hold the true one: the longer of both sides.
    pub expanded: f64,
    /// By what scatters.
    pub spread: f64,
    /// What noise adds to the value on the average; 0 where it adds nothing.
    pub bias: f64,
    /// How far the true value may lie below and above the measured one: 0 where it lies on the other side.
    pub sides: [f64; 2],
    /// `plan`, `noise`, or `plan and noise`.
    pub source: &'static str,
}

impl Uncertainty {
    fn new(spread: f64, bias: f64, unknown: [f64; 2], source: &'static str) -> Uncertainty {
        // The value is one that the part may have: what it is judged by begins there at least.
        let sides = [spread + bias + unknown[0], spread - bias + unknown[1]].map(|side| side.max(0.0));
        Uncertainty { expanded: sides[0].max(sides[1]), spread, bias, sides, source }
    }
}

/// The uncertainty of each characteristic: what the plan states and what its noise makes, as the root of the sum of squares. `None`
/// where the plan says nothing of it, and where its noise leaves too few draws a value: then it is not known.
pub(super) fn found(
    plan: &Plan,
    aligned: (&Data, &Alignment),
    (features, noise): (&[MeasuredFeature], &NoiseOrReason),
    progress: &dyn Progress,
) -> Result<Vec<Option<Uncertainty>>, Stop> {
    let Some(source) = plan.decision.noise else {
        let stated = |spec: &Spec| Some(Uncertainty::new(spec.uncertainty?, 0.0, [0.0; 2], "plan"));
        return Ok(plan.specs.iter().map(stated).collect());
    };
    let Ok(noise) = &source.noise(noise) else { return Ok(vec![None; plan.specs.len()]) };
    let pose = PoseNoise::new(plan, noise, aligned, features, progress)?;
    let seed = aligned.0.seed;
    let draws = Draws { plan, noise, pose: &pose, seed, progress };
    let none = perfect(plan, features, progress)?;
    let (formed, unknown) = denoised(plan, noise, seed, features, progress)?;
    let of = |features: &[MeasuredFeature], count: u32| -> Result<Added, Stop> {
        Ok(Added { without: draws.values(features, None)?, with: draws.of(features, count)? })
    };
    let half = of(&between(plan, &none, &formed, progress)?, noise.draws.min(MAX_FORM_DRAWS))?;
    let perfect = of(&none, noise.draws.min(MAX_FORM_DRAWS))?;
    let formed = of(&formed, noise.draws)?;
    let values = draws.values(features, None)?;
    let one = |n: usize| {
        let spec = &plan.specs[n];
        let found = COVERAGE_FACTOR * formed.with[n]?.deviation;
        let (spread, source) = match spec.uncertainty {
            None => (found, "noise"),
            Some(stated) => (libm::hypot(stated, found), "plan and noise"),
        };
        let of_form = spec.features.iter().fold(Unknown::default(), |most, f| most.most(unknown[*f]));
        let bias = formed.bias(n);
        // To the side that noise leads away from, and to the other.
        let led = Some(if bias == 0.0 { perfect.bias(n) } else { bias }).filter(|b| *b != 0.0);
        let led = led.map_or(0.0, f64::signum);
        let left = (of_form.noise_left * perfect.bias(n) * led).max(0.0);
        let smaller = smaller(values[n], spread, led, [&perfect, &half, &formed].map(|a| a.at(n)));
        let away = smaller + OVERSTATED_NOISE_SHARE * (1.0 + of_form.rough) * left;
        let zone = matches!(spec.limits, Limits::Greatest(_));
        // A zone has the whole value from what is there.
        let shown = formed.without[n].zip(if zone { Some(0.0) } else { perfect.without[n] });
        let share = shown.map_or(0.0, |(form, none)| ((form - none) / bias).abs().min(1.0));
        let hidden = (bias * (1.0 - share * (1.0 - of_form.rough))).abs().max(UNDERSTATED_NOISE_SHARE * left);
        let unknown = if led > 0.0 { [away, hidden] } else { [hidden, away] };
        Some(Uncertainty::new(spread, bias, unknown, source)).filter(|u| u.expanded.is_finite())
    };
    Ok((0..plan.specs.len()).map(one).collect())
}

/// By how much more noise leads away from the true value (`side` 1: above it) where the form is smaller than the one found, but may have given
/// `value` all the same. Of the features of perfect form, of half the form found and of all of it: value without noise, and what noise adds.
///
/// With the form found in a share of its size, what noise makes of it is a convex function of the share: a range is, and so is the least range
/// over all elements. So it is at most the straight lines from one of the three to the next. The smallest share at which these come to the value less
/// its spread is the form that is looked for; by the lines it is too small rather than too large. At the share 1 nothing is more, at 0 it is what
/// noise adds to a perfect form.
fn smaller(value: Option<f64>, spread: f64, side: f64, shares: [Option<[f64; 2]>; 3]) -> f64 {
    let (Some(value), [Some(perfect), Some(half), Some(whole)]) = (value, shares) else { return 0.0 };
    let shares = [perfect, half, whole].map(|[without, added]| [side * (without + added), side * added]);
    let least = side * value - spread;
    let within = |[from, to]: [[f64; 2]; 2]| {
        let way = if least > from[0] { (least - from[0]) / (to[0] - from[0]) } else { 0.0 };
        (least < to[0]).then_some(from[1] + way * (to[1] - from[1]))
    };
    let added = within([shares[0], shares[1]]).or_else(|| within([shares[1], shares[2]]));
    added.map_or(0.0, |added| (added - shares[2][1]).max(0.0))
}

/// The values of features without noise and with it.
struct Added {
    without: Vec<Option<f64>>,
    with: Vec<Option<Scatter>>,
}

impl Added {
    /// The value without noise, and what noise adds.
    fn at(&self, n: usize) -> Option<[f64; 2]> {
        Some([self.without[n]?, self.bias(n)])
    }

    /// What the noise adds on the average; 0 where that may be chance.
    fn bias(&self, n: usize) -> f64 {
        let added =
            self.with[n].zip(self.without[n]).map(|(with, without)| (with.mean - without, with.error));
        added.filter(|(bias, error)| bias.abs() > CLEAR_STANDARD_ERRORS * error).map_or(0.0, |b| b.0)
    }
}

/// The features as their elements have them: every point where it would be if the form were perfect.
fn perfect(
    plan: &Plan,
    features: &[MeasuredFeature],
    progress: &dyn Progress,
) -> Result<Vec<MeasuredFeature>, Stop> {
    let onto = |taken: &mut MeasuredFeature| {
        let Ok(Element::Fit(fit)) = &taken.element else { return false };
        let shape = fit.shape;
        for p in &mut taken.points {
            // Where there are many nearest places it stays.
            let Some((normal, _)) = unit(shape.normal(*p)) else { continue };
            *p = minus(*p, times(shape.distance(*p), normal));
        }
        true
    };
    associated_anew(plan, features, onto, progress)
}

/// The features halfway between two forms of them.
fn between(
    plan: &Plan,
    none: &[MeasuredFeature],
    formed: &[MeasuredFeature],
    progress: &dyn Progress,
) -> Result<Vec<MeasuredFeature>, Stop> {
    let formed: BTreeMap<&str, &MeasuredFeature> =
        formed.iter().map(|taken| (taken.id.as_str(), taken)).collect();
    let onto = |taken: &mut MeasuredFeature| {
        let Some(whole) = formed.get(taken.id.as_str()) else { return false };
        for (p, q) in taken.points.iter_mut().zip(&whole.points) {
            *p = [0, 1, 2].map(|k| 0.5 * (p[k] + q[k]));
        }
        true
    };
    associated_anew(plan, none, onto, progress)
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
    fn of(&self, features: &[MeasuredFeature], draws: u32) -> Result<Vec<Option<Scatter>>, Stop> {
        let draw = |number: u64| {
            let seed = Random::stream(self.seed, number).next_u64();
            self.values(features, Some(Field::new(self.noise, seed)))
        };
        let all: Vec<Vec<Option<f64>>> =
            (0..u64::from(draws)).into_par_iter().map(draw).collect::<Result<_, Stop>>()?;
        Ok((0..self.plan.specs.len()).map(|n| Scatter::of(all.iter().map(|values| values[n]))).collect())
    }

    /// The values with the noise of one draw, or without.
    fn values(
        &self,
        features: &[MeasuredFeature],
        mut field: Option<Field>,
    ) -> Result<Vec<Option<f64>>, Stop> {
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
        let carried = |taken: &mut MeasuredFeature| {
            taken.points.iter_mut().for_each(|p| *p = motion.point(*p));
            true
        };
        let features = associated_anew(self.plan, &moved, carried, self.progress)?;
        let value = |spec: &Spec| measured(spec, &features, self.progress);
        let values = self.plan.specs.iter().map(value).collect::<Result<Vec<_>, Stop>>()?;
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
        if values.len() < 2 || (values.len() as f64) < MIN_DRAWN_SHARE * all as f64 {
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
    fn the_interval_lies_about_the_value_less_the_bias() {
        let of = |bias, unknown| Uncertainty::new(1.0, bias, unknown, "noise");
        assert_eq!((of(1.0, [0.0; 2]).sides, of(0.5, [0.0; 2]).sides), ([2.0, 0.0], [1.5, 0.5]));
        // What noise adds beyond the scatter leaves the value at the end of its interval, not outside.
        assert_eq!((of(3.0, [0.0; 2]).sides, of(3.0, [0.0; 2]).expanded), ([4.0, 0.0], 4.0));
        assert_eq!((of(-3.0, [0.0; 2]).sides, of(-3.0, [0.0; 2]).expanded), ([0.0, 4.0], 4.0));
        assert_eq!(of(3.0, [0.5, 3.0]).sides, [4.5, 1.0]);
    }

    /// Noise adds 6 to a perfect form, 4.25 to half of a form of 4, and 3 to the whole.
    #[test]
    fn of_a_smaller_form_noise_adds_more() {
        let of = |value, half, whole| smaller(Some(value), 1.0, 1.0, [Some([0.0, 6.0]), half, whole]);
        let (half, whole) = (Some([2.0, 4.25]), Some([4.0, 3.0]));
        // 7 less 1 is what a perfect form gives, 7.25 less 1 half the form and 8 less 1 the whole.
        let found = [6.0, 7.0, 7.125, 7.25, 7.625, 8.0, 9.0].map(|value| of(value, half, whole));
        assert_eq!(found, [3.0, 3.0, 2.125, 1.25, 0.625, 0.0, 0.0]);
        let mirrored = [Some([500.0, -6.0]), Some([498.0, -4.25]), Some([496.0, -3.0])];
        assert_eq!(smaller(Some(492.375), 1.0, -1.0, mirrored), 0.625);
        assert_eq!((of(7.0, None, whole), of(7.0, half, None)), (0.0, 0.0));
        // Noise that adds more to the form found, and forms that cannot be told apart.
        assert_eq!(of(7.0, Some([2.0, 7.0]), Some([4.0, 8.0])), 0.0);
        assert_eq!(of(6.5, Some([0.5, 5.5]), Some([1.0, 5.0])), 1.0);
    }
}
