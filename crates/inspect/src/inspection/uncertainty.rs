//! Uncertainties of the values: the points are moved by noise again and again, and all is evaluated anew.
//!
//! Propagation of distributions by a Monte Carlo method (JCGM 101:2008), of the noise that the plan states, through the association of
//! the elements, the datums, and the evaluation. What the points of a feature are, and the alignment, stay as they were found.

use super::data::Stop;
use super::measure::measured;
use super::take::again;
use crate::characteristic::{Taken, Value};
use crate::plan::{Noise, Plan, Spec};
use std::collections::HashMap;
use trueness_geom::num::random::Random;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::Progress;
use trueness_geom::space::{Point, Vector};

/// Coverage factor of an expanded uncertainty.
const K: f64 = 2.0;
/// Share of the draws that must give a value.
const ENOUGH: f64 = 0.9;
/// Cells from zero up to which places within a cell are told apart.
const FINEST: f64 = 1e12;
/// Corners of cells that are held in memory, about 50 bytes each.
const MOST_CORNERS: usize = 200_000;

/// The expanded uncertainty of a value (k = 2), and where it comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertainty {
    /// Millimeters, or degrees for an angle.
    pub expanded: f64,
    /// `plan`, `noise`, or `plan and noise`.
    pub source: &'static str,
}

/// The uncertainty of each characteristic: what the plan states and what its noise makes, as the root of the sum of squares. `None`
/// where the plan says nothing of it, and where its noise leaves too few draws a value: then it is not known.
pub(super) fn found(
    plan: &Plan,
    features: &[Taken],
    seed: u64,
    progress: &dyn Progress,
) -> Result<Vec<Option<Uncertainty>>, Stop> {
    let Some(noise) = &plan.decision.noise else {
        let stated = |spec: &Spec| Some(Uncertainty { expanded: spec.uncertainty?, source: "plan" });
        return Ok(plan.specs.iter().map(stated).collect());
    };
    let both = |(spec, found): (&Spec, Option<f64>)| {
        let found = K * found?;
        Some(match spec.uncertainty {
            None => Uncertainty { expanded: found, source: "noise" },
            Some(stated) => Uncertainty { expanded: libm::hypot(stated, found), source: "plan and noise" },
        })
    };
    let by_noise = by_noise(plan, features, noise, seed, progress)?;
    let finite = |u: &Uncertainty| u.expanded.is_finite();
    Ok(plan.specs.iter().zip(by_noise).map(|pair| both(pair).filter(finite)).collect())
}

/// The standard deviation of each value over the draws.
fn by_noise(
    plan: &Plan,
    features: &[Taken],
    noise: &Noise,
    seed: u64,
    progress: &dyn Progress,
) -> Result<Vec<Option<f64>>, Stop> {
    let draw = |number: u64| -> Result<Vec<Option<f64>>, Stop> {
        let mut field = Field::new(noise, Random::stream(seed, number).next_u64());
        let moved = |taken: &mut Taken| {
            for p in &mut taken.points {
                let mut shift = field.at(p);
                // Points of two coordinates stay in their plane.
                shift[2] *= f64::from(u8::from(!taken.planar));
                *p = [0, 1, 2].map(|k| p[k] + shift[k]);
            }
            true
        };
        let features = again(plan, features, moved, progress)?;
        let value = |spec: &Spec| measured(spec, &features, progress);
        let values = plan.specs.iter().map(value).collect::<Result<Vec<Result<Value, String>>, Stop>>()?;
        Ok(values.into_iter().map(|v| v.ok().map(|v| v.value)).collect())
    };
    let draws: Vec<Vec<Option<f64>>> =
        (0..u64::from(noise.draws)).into_par_iter().map(draw).collect::<Result<_, Stop>>()?;
    Ok((0..plan.specs.len()).map(|n| deviation(draws.iter().map(|values| values[n]))).collect())
}

/// The standard deviation of what there is; `None` where too much is missing.
fn deviation(values: impl ExactSizeIterator<Item = Option<f64>>) -> Option<f64> {
    let all = values.len();
    let values: Vec<f64> = values.flatten().collect();
    if values.len() < 2 || (values.len() as f64) < ENOUGH * all as f64 {
        return None;
    }
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let squares: f64 = values.iter().map(|v| (v - mean) * (v - mean)).sum();
    Some((squares / (values.len() - 1) as f64).sqrt())
}

/// The noise of one draw: a vector for each place. The same place has the same noise in all features.
struct Field {
    sigma: f64,
    correlation: f64,
    seed: u64,
    /// Vectors at the corners of cells. Looked up only, never walked through.
    corners: HashMap<[i64; 3], Vector>,
}

impl Field {
    fn new(noise: &Noise, seed: u64) -> Field {
        Field { sigma: noise.deviation, correlation: noise.correlation, seed, corners: HashMap::new() }
    }

    /// Three independent normal numbers of the stated deviation. With a correlation length they are interpolated between the
    /// corners of cells of that size and brought back to that deviation, so places within about half of it move together.
    fn at(&mut self, p: &Point) -> Vector {
        let cell = p.map(|x| (x / self.correlation).floor());
        // Also where numbers cannot tell the places within a cell: each point moves alone there.
        if self.correlation <= 0.0 || !cell.iter().all(|c| c.abs() < FINEST) {
            return self.vector(p.map(|x| (x + 0.0).to_bits())).map(|g| self.sigma * g);
        }
        if self.corners.len() > MOST_CORNERS {
            self.corners.clear();
        }
        let (mut sum, mut squares) = ([0.0; 3], 0.0);
        for corner in 0..8u8 {
            let up = [0, 1, 2].map(|k| f64::from((corner >> k) & 1));
            let along = |k: usize| 1.0 - (p[k] / self.correlation - cell[k] - up[k]).abs();
            let weight = along(0) * along(1) * along(2);
            let place = [0, 1, 2].map(|k| (cell[k] + up[k]) as i64);
            let known = self.corners.get(&place).copied();
            let g = known.unwrap_or_else(|| self.vector(place.map(|x| x as u64)));
            self.corners.insert(place, g);
            sum = [0, 1, 2].map(|k| sum[k] + weight * g[k]);
            squares += weight * weight;
        }
        sum.map(|s| self.sigma * s / squares.sqrt())
    }

    /// Three normal numbers for three whole ones (G. E. P. Box and M. E. Muller, 1958).
    fn vector(&self, of: [u64; 3]) -> Vector {
        let seed = of.iter().fold(self.seed, |seed, x| Random::stream(seed, *x).next_u64());
        let mut random = Random::new(seed);
        let mut pair = || {
            let radius = (-2.0 * libm::log(1.0 - random.unit())).sqrt();
            let turn = std::f64::consts::TAU * random.unit();
            [radius * libm::cos(turn), radius * libm::sin(turn)]
        };
        let ([a, b], [c, _]) = (pair(), pair());
        [a, b, c]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(correlation: f64) -> Noise {
        Noise { deviation: 0.1, correlation, draws: 1 }
    }

    /// Standard deviation, and correlation between places `apart` along x.
    fn seen(correlation: f64, apart: f64) -> [f64; 2] {
        let (mut squares, mut products, n) = (0.0, 0.0, 4000);
        for draw in 0..n {
            let mut field = Field::new(&noise(correlation), draw);
            let p = [0.317 * draw as f64, 1.7, -0.4];
            let (a, b) = (field.at(&p), field.at(&[p[0] + apart, p[1], p[2]]));
            assert_eq!(a, field.at(&p));
            squares += a[0] * a[0];
            products += a[0] * b[0];
        }
        [(squares / f64::from(n as u32)).sqrt(), products / squares]
    }

    #[test]
    fn the_noise_has_the_stated_deviation_and_reach() {
        // Of 4,000 numbers the deviation is known to 1.1 %, a correlation to 0.016.
        for (correlation, apart, least, greatest) in [
            (0.0, 0.01, -0.05, 0.05),
            (1e-300, 0.01, -0.05, 0.05),
            (5e-324, 0.01, -0.05, 0.05),
            (2.0, 0.1, 0.9, 1.0),
            (2.0, 0.9, 0.3, 0.9),
            (2.0, 4.1, -0.05, 0.05),
        ] {
            let [deviation, correlated] = seen(correlation, apart);
            assert!((deviation / 0.1 - 1.0).abs() < 0.04, "{correlation} {apart}: {deviation}");
            assert!((least..=greatest).contains(&correlated), "{correlation} {apart}: {correlated}");
        }
    }

    #[test]
    fn too_few_values_have_no_deviation() {
        let of = |values: &[Option<f64>]| deviation(values.iter().copied());
        assert_eq!(of(&[Some(1.0), Some(3.0)]), Some(2f64.sqrt()));
        assert_eq!(of(&[Some(1.0), Some(3.0), None]), None);
        assert_eq!((of(&[Some(1.0)]), of(&[])), (None, None));
    }
}
