//! The features with the form that they have below the noise.
//!
//! Where a distance from the element has a sign, it is the height over the place below; of a line or circle in space the three coordinates
//! of the way from the element to the point are such heights, one by one.

use super::extract_features::associated_anew;
use super::noise_field::Field;
use super::stop::Stop;
use crate::characteristic::{Element, MeasuredFeature};
use crate::plan::{Noise, Plan};
use std::collections::BTreeMap;
use trueness_geom::num::random::Random;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::Progress;
use trueness_geom::shape::{Shape, Sides};
use trueness_geom::space::{Point, Vector, dot, minus, plus, times, unit};
use trueness_geom::zone::{Smooth, smooth};

/// Draws of correlated noise that tell its variance in a wave, to a quarter.
const VARIANCE_DRAWS: u64 = 32;
/// Sets their stream apart from those of the values' draws.
const VARIANCE_STREAM: u64 = 1 << 40;

/// What is not known of a form below the noise, see [`Smooth`].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Unknown {
    pub noise_left: f64,
    pub rough: f64,
}

impl Unknown {
    /// The greater of both.
    pub fn most(self, other: Unknown) -> Unknown {
        Unknown { noise_left: self.noise_left.max(other.noise_left), rough: self.rough.max(other.rough) }
    }
}

/// The features with their forms below the noise, and what is not known of each.
pub(super) fn denoised(
    plan: &Plan,
    noise: &Noise,
    seed: u64,
    features: &[MeasuredFeature],
    progress: &dyn Progress,
) -> Result<(Vec<MeasuredFeature>, Vec<Unknown>), Stop> {
    let form = |taken: &MeasuredFeature| match &taken.element {
        Ok(Element::Fit(fit)) if !progress.cancelled() => Some(below(taken, &fit.shape, noise, seed)),
        _ => None,
    };
    let forms: Vec<Option<(Vec<Point>, Unknown)>> = features.par_iter().map(form).collect();
    let unknown = forms.iter().map(|f| f.as_ref().map_or(Unknown::default(), |f| f.1)).collect();
    let mut points: BTreeMap<&str, Vec<Point>> = BTreeMap::new();
    for (taken, form) in features.iter().zip(forms) {
        points.extend(form.map(|(points, _)| (taken.id.as_str(), points)));
    }
    let onto = |taken: &mut MeasuredFeature| match points.remove(taken.id.as_str()) {
        Some(points) => {
            taken.points = points;
            true
        }
        None => false,
    };
    Ok((associated_anew(plan, features, onto, progress)?, unknown))
}

/// The points of a feature as its form below the noise has them.
fn below(taken: &MeasuredFeature, shape: &Shape, noise: &Noise, seed: u64) -> (Vec<Point>, Unknown) {
    // Where there are many nearest places a point has no height.
    let out: Vec<Vector> =
        taken.points.iter().map(|p| unit(shape.normal(*p)).map_or([0.0; 3], |n| n.0)).collect();
    let feet: Vec<Point> = (taken.points.iter().zip(&out))
        .map(|(p, n)| if *n == [0.0; 3] { *p } else { minus(*p, times(shape.distance(*p), *n)) })
        .collect();
    let drawn: Vec<Vec<Vector>> = match noise.correlation > 0.0 {
        false => vec![],
        true => (0..VARIANCE_DRAWS)
            .map(|draw| {
                let mut field = Field::new(noise, Random::stream(seed, VARIANCE_STREAM + draw).next_u64());
                taken.points.iter().map(|p| field.at(p)).collect()
            })
            .collect(),
    };
    let mut points = feet.clone();
    let mut unknown = Unknown::default();
    let mut add = |along: &dyn Fn(usize) -> Vector| {
        let height = |(i, p): (usize, &Point)| dot(minus(*p, feet[i]), along(i));
        let heights: Vec<f64> = taken.points.iter().enumerate().map(height).collect();
        let of_noise = |d: &Vec<Vector>| d.iter().enumerate().map(|(i, e)| dot(*e, along(i))).collect();
        let drawn: Vec<Vec<f64>> = drawn.iter().map(of_noise).collect();
        let Smooth { heights, noise_left, rough } = smooth(&feet, &heights, noise.deviation, &drawn);
        points
            .iter_mut()
            .zip(&heights)
            .enumerate()
            .for_each(|(i, (p, h))| *p = plus(*p, times(*h, along(i))));
        unknown = unknown.most(Unknown { noise_left, rough });
    };
    if shape.kind().sides() == Sides::None {
        for axis in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
            add(&|_| axis);
        }
    } else {
        add(&|i| out[i]);
    }
    (points, unknown)
}
