//! The form below the noise: heights over an element, as they would be if nothing but noise were taken off them.
//!
//! Waves come first: polynomials of the places, restricted to the surface, of as many degrees as lower the estimated risk.
//! (Mallows: Some comments on Cp, Technometrics 15, 1973.) With correlated noise each coefficient has the variance that the
//! noise gives it. Only polynomials that stand out of the noise are kept. On a plane they are polynomials of two coordinates,
//! about a cylinder waves around times polynomials along, on a sphere spherical harmonics. The basis grows by a coordinate at a
//! time and keeps new functions alone, so no shape has parameters of its own here. (Brubeck, Nakatsukasa, Trefethen:
//! Vandermonde with Arnoldi, SIAM Review 63, 2021.) Then single places that no wave and no noise explains. The rest, if it is
//! larger than noise, is a rough form. It is kept in the size that its variance tells.

use crate::num::banded::dot;
use crate::num::random::Random;
use crate::space::{Aabb, Point};

/// Most functions.
const MAX_FUNCTIONS: usize = 120;
/// Multiplications that the basis may cost, about.
const MAX_BASIS_WORK: f64 = 4e8;
/// Least points for each function.
const POINTS_PER_FUNCTION: usize = 4;
/// Share of its own size that a function must have beyond the others to be a new one.
const MIN_NEW_FUNCTION_SHARE: f64 = 1e-6;
/// Standard deviations of its noise from which on a coefficient stands out.
const SIGNIFICANT_SIGMAS: f64 = 2.0;
/// Deviations of the noise beyond the greatest to be expected of all, from which on a place is single.
const SINGLE_PLACE_EXCESS: f64 = 0.7;
/// Places for each single one at least: more single ones are a rough form.
const PLACES_PER_SINGLE: usize = 20;
/// Most rounds in which waves and single places are parted.
const MAX_PARTING_ROUNDS: usize = 6;
/// Draws that tell a mean range, to about 3 %.
const RANGE_DRAWS: usize = 16;
/// Standard errors of a variance beyond which it is larger than that of the noise.
const LARGER_VARIANCE_ERRORS: f64 = 3.0;

/// A form below noise.
#[derive(Clone, Debug, PartialEq)]
pub struct Smooth {
    /// As many heights as were given, millimeters.
    pub heights: Vec<f64>,
    /// Range of the noise left in its waves and single places over the range of the noise of the points, 0 to 1. It tells how
    /// far its extremes stand out too far.
    pub noise_left: f64,
    /// Share of the rest beyond waves and single places that is kept as a rough form, 0 to 1. Its places are not known one by
    /// one.
    pub rough: f64,
}

/// The form that `heights` (millimeters, signed, over the `places` of an element) have below noise of standard deviation `noise`.
/// `drawn` are heights of noise alone, where it is correlated; empty where each point has its own. Without noise the heights stay.
///
/// Fewer than two points, or numbers that are not finite: the heights as they are. Cost: up to 4 · 10⁸ multiplications.
///
/// ```
/// use trueness_geom::zone::smooth;
/// // A wave of 0.2 mm, and noise of 0.01 mm that alternates.
/// let places: Vec<_> = (0..400).map(|i| [f64::from(i % 20), f64::from(i / 20), 0.0]).collect();
/// let wave = |p: &[f64; 3]| 0.001 * (p[0] - 10.0) * (p[0] - 10.0);
/// let sign = |p: &[f64; 3]| if (p[0] + p[1]) % 2.0 == 0.0 { 0.01 } else { -0.01 };
/// let heights: Vec<f64> = places.iter().map(|p| wave(p) + sign(p)).collect();
/// let form = smooth(&places, &heights, 0.01, &[]);
/// assert!(places.iter().zip(&form.heights).all(|(p, h)| (h - wave(p)).abs() < 0.003));
/// ```
pub fn smooth(places: &[Point], heights: &[f64], noise: f64, drawn: &[Vec<f64>]) -> Smooth {
    let as_it_is = Smooth { heights: heights.to_vec(), noise_left: 1.0, rough: 0.0 };
    let finite = places.iter().flatten().chain(heights).all(|x| x.is_finite());
    if !finite || !noise.is_finite() || noise <= 0.0 || heights.len() < 2 || places.len() != heights.len() {
        return as_it_is;
    }
    let basis = Basis::new(places);
    let variances = basis.variances(noise, drawn);
    let n = heights.len();
    let limit = noise * ((2.0 * libm::log(n as f64)).sqrt() + SINGLE_PLACE_EXCESS);
    let mut single = vec![0.0; n];
    let mut waves = basis.waves(heights, &variances);
    for _ in 0..MAX_PARTING_ROUNDS {
        let beyond = |(h, w): (&f64, &f64)| if (h - w).abs() > limit { h - w } else { 0.0 };
        let next: Vec<f64> = heights.iter().zip(&waves.heights).map(beyond).collect();
        let count = next.iter().filter(|s| **s != 0.0).count();
        if count * PLACES_PER_SINGLE > n {
            single = vec![0.0; n];
            waves = basis.waves(heights, &variances);
            break;
        }
        let same = next.iter().zip(&single).all(|(a, b)| (*a == 0.0) == (*b == 0.0));
        single = next;
        if same {
            break;
        }
        let others: Vec<f64> = heights.iter().zip(&single).map(|(h, s)| h - s).collect();
        waves = basis.waves(&others, &variances);
    }
    let rest: Vec<f64> = (0..n).map(|i| heights[i] - waves.heights[i] - single[i]).collect();
    let squares: f64 = rest.iter().map(|r| r * r).sum();
    let of_noise = n as f64 * noise * noise;
    let expected = (of_noise - waves.noise_squares).max(0.0);
    let clear = 1.0 + LARGER_VARIANCE_ERRORS * (2.0 / n as f64).sqrt();
    let rough = if squares > clear * expected { (1.0 - expected / squares).sqrt() } else { 0.0 };
    Smooth {
        heights: (0..n).map(|i| waves.heights[i] + single[i] + rough * rest[i]).collect(),
        noise_left: basis.remaining(waves.degrees, &single, (&variances, noise, drawn)),
        rough,
    }
}

/// Functions of the places, orthonormal over them.
struct Basis {
    functions: Vec<Vec<f64>>,
    /// Number of functions up to each degree.
    ends: Vec<usize>,
}

/// Waves found in heights.
struct Waves {
    heights: Vec<f64>,
    /// Sum of squares of the noise in the functions that are used.
    noise_squares: f64,
    /// Functions of the degrees among which they were chosen.
    degrees: usize,
}

impl Basis {
    /// As many whole degrees as points and time allow.
    fn new(places: &[Point]) -> Basis {
        let n = places.len();
        let most =
            MAX_FUNCTIONS.min(n / POINTS_PER_FUNCTION).min((MAX_BASIS_WORK / n as f64).sqrt() as usize);
        let bounds = Aabb::of(places);
        let half = 0.5 * bounds.diagonal();
        let coordinate = |k: usize| -> Option<Vec<f64>> {
            let (middle, reach) =
                (0.5 * (bounds.min[k] + bounds.max[k]), 0.5 * (bounds.max[k] - bounds.min[k]));
            (reach > MIN_NEW_FUNCTION_SHARE * half)
                .then(|| places.iter().map(|p| (p[k] - middle) / reach).collect())
        };
        let coordinates: Vec<Vec<f64>> = (0..3).filter_map(coordinate).collect();
        let mut functions = vec![vec![1.0 / (n as f64).sqrt(); n]];
        let mut ends = vec![1];
        let mut first = 0;
        loop {
            let end = functions.len();
            for (last, axis) in (first..end).flat_map(|last| coordinates.iter().map(move |axis| (last, axis)))
            {
                if functions.len() > most {
                    break;
                }
                let grown = functions[last].iter().zip(axis).map(|(f, x)| f * x).collect();
                functions.extend(orthogonal_part(grown, &functions));
            }
            if functions.len() > most || functions.len() == end {
                functions.truncate(end);
                return Basis { functions, ends };
            }
            ends.push(functions.len());
            first = end;
        }
    }

    /// Variance that the noise gives to each coefficient.
    fn variances(&self, noise: f64, drawn: &[Vec<f64>]) -> Vec<f64> {
        if drawn.is_empty() {
            return vec![noise * noise; self.functions.len()];
        }
        let of =
            |f: &Vec<f64>| drawn.iter().map(|d| dot(f, d)).map(|c| c * c).sum::<f64>() / drawn.len() as f64;
        self.functions.iter().map(of).collect()
    }

    /// The waves of the degrees with the least estimated risk that stand out of the noise.
    fn waves(&self, heights: &[f64], variances: &[f64]) -> Waves {
        let coefficients: Vec<f64> = self.functions.iter().map(|f| dot(f, heights)).collect();
        let gain = |j: usize| coefficients[j] * coefficients[j] - 2.0 * variances[j];
        let (mut gained, mut best, mut degrees, mut from) = (0.0, f64::NEG_INFINITY, 0, 0);
        for end in &self.ends {
            gained += (from..*end).map(gain).sum::<f64>();
            from = *end;
            if gained > best {
                (best, degrees) = (gained, *end);
            }
        }
        let mut waves = vec![0.0; heights.len()];
        let mut noise_squares = 0.0;
        for j in 0..degrees {
            let c = coefficients[j];
            if c * c > SIGNIFICANT_SIGMAS * SIGNIFICANT_SIGMAS * variances[j] {
                noise_squares += variances[j];
                waves.iter_mut().zip(&self.functions[j]).for_each(|(w, f)| *w += c * f);
            }
        }
        Waves { heights: waves, noise_squares, degrees }
    }

    /// The mean range of noise in the first `degrees` functions and at single places, which keep theirs, over that of the noise itself.
    fn remaining(
        &self,
        degrees: usize,
        single: &[f64],
        (variances, noise, drawn): (&[f64], f64, &[Vec<f64>]),
    ) -> f64 {
        let random = &mut Random::new(0);
        let n = self.functions[0].len();
        let (mut remaining, mut whole) = (0.0, 0.0);
        for draw in 0..RANGE_DRAWS {
            let mut waves = vec![0.0; n];
            for (f, v) in self.functions[..degrees].iter().zip(variances) {
                let c = v.sqrt() * normal(random);
                waves.iter_mut().zip(f).for_each(|(w, f)| *w += c * f);
            }
            waves
                .iter_mut()
                .zip(single)
                .filter(|s| *s.1 != 0.0)
                .for_each(|(w, _)| *w = noise * normal(random));
            remaining += range(&waves);
            whole += match drawn.get(draw) {
                Some(drawn) => range(drawn),
                None => noise * range(&(0..n).map(|_| normal(random)).collect::<Vec<_>>()),
            };
        }
        if whole > 0.0 { (remaining / whole).min(1.0) } else { 0.0 }
    }
}

/// The part of a function orthogonal to orthonormal others, of unit length; `None` where that is nothing.
fn orthogonal_part(mut function: Vec<f64>, others: &[Vec<f64>]) -> Option<Vec<f64>> {
    let whole = dot(&function, &function).sqrt();
    // Twice is enough (Giraud, Langou, Rozložník, 2005).
    for _ in 0..2 {
        for other in others {
            let c = dot(other, &function);
            function.iter_mut().zip(other).for_each(|(f, o)| *f -= c * o);
        }
    }
    let remaining = dot(&function, &function).sqrt();
    if remaining.is_nan() || remaining <= MIN_NEW_FUNCTION_SHARE * whole {
        return None;
    }
    function.iter_mut().for_each(|f| *f /= remaining);
    Some(function)
}

fn range(heights: &[f64]) -> f64 {
    let least = heights.iter().copied().fold(f64::INFINITY, f64::min);
    heights.iter().copied().fold(f64::NEG_INFINITY, f64::max) - least
}

/// Normal enough up to three deviations: a sum of twelve uniform numbers.
fn normal(random: &mut Random) -> f64 {
    (0..12).map(|_| random.unit()).sum::<f64>() - 6.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Places about a cylinder, 20 around, 20 along.
    fn cylinder() -> Vec<Point> {
        let at = |i: u32| {
            let turn = TAU * f64::from(i % 20) / 20.0;
            [5.0 * libm::cos(turn), 5.0 * libm::sin(turn), f64::from(i / 20)]
        };
        (0..400).map(at).collect()
    }

    #[test]
    fn functions_are_those_of_the_surface() {
        let sizes = |places: &[Point]| Basis::new(places).ends;
        // Polynomials of two coordinates: 1, 3, 6, …; around a cylinder and along it, and on a sphere, squares; on a line one a degree.
        let tilted: Vec<Point> = (0..400)
            .map(|i| (f64::from(i % 20), f64::from(i / 20)))
            .map(|(x, y)| [x, y, 0.3 * x - y])
            .collect();
        assert_eq!(sizes(&tilted)[..5], [1, 3, 6, 10, 15]);
        assert_eq!(sizes(&cylinder())[..5], [1, 4, 9, 16, 25]);
        let ball = |p: &Point| {
            let size = crate::space::norm([p[0], p[1], p[2] - 9.3]);
            [p[0] / size, p[1] / size, (p[2] - 9.3) / size]
        };
        assert_eq!(sizes(&cylinder().iter().map(ball).collect::<Vec<_>>())[..5], [1, 4, 9, 16, 25]);
        let line: Vec<Point> = (0..40).map(|i| [f64::from(i), 0.0, 0.0]).collect();
        assert_eq!(sizes(&line)[..5], [1, 2, 3, 4, 5]);
        let basis = Basis::new(&cylinder());
        for (i, a) in basis.functions.iter().enumerate() {
            for (j, b) in basis.functions.iter().enumerate() {
                assert!((dot(a, b) - f64::from(u8::from(i == j))).abs() < 1e-12, "{i} {j}");
            }
        }
    }

    /// Next to nothing is left of noise alone. Three lobes remain, to the noise of the few waves that they are.
    #[test]
    fn lobes_are_told_from_noise() {
        let places = cylinder();
        let lobe = |p: &Point| libm::cos(3.0 * libm::atan2(p[1], p[0]));
        for size in [0.0, 5.0] {
            let (mut off, mut copies) = (0.0, 0);
            for seed in 0..40 {
                let random = &mut Random::new(seed);
                let heights: Vec<f64> = places.iter().map(|p| size * lobe(p) + normal(random)).collect();
                let form = smooth(&places, &heights, 1.0, &[]);
                off += places
                    .iter()
                    .zip(&form.heights)
                    .map(|(p, h)| h - size * lobe(p))
                    .map(|d| d * d)
                    .sum::<f64>()
                    / 400.0;
                copies += 1;
            }
            // Sixteen waves have 0.04 of the variance of the noise.
            assert!(off / f64::from(copies) < 0.04, "{size}: {off}");
        }
    }

    #[test]
    fn single_places_and_rough_forms_are_kept() {
        let places = cylinder();
        let random = &mut Random::new(5);
        let mut heights: Vec<f64> = places.iter().map(|_| normal(random)).collect();
        heights[77] += 20.0;
        let form = smooth(&places, &heights, 1.0, &[]);
        assert!((form.heights[77] - heights[77]).abs() < 1.0, "{}", form.heights[77]);
        assert!(form.heights.iter().enumerate().all(|(i, h)| i == 77 || h.abs() < 1.0));
        // The noise of that place stays: its mean size is 0.8 deviations, of a range of 5.9.
        assert!((0.08..0.3).contains(&form.noise_left), "{}", form.noise_left);
        // About that variance is left of a rough form of twice the noise.
        let heights: Vec<f64> = places.iter().map(|_| 2.0 * normal(random) + normal(random)).collect();
        let form = smooth(&places, &heights, 1.0, &[]);
        let variance = form.heights.iter().map(|h| h * h).sum::<f64>() / 400.0;
        assert!((3.2..4.8).contains(&variance), "{variance}");
        assert!((0.8..0.95).contains(&form.rough), "{}", form.rough);
    }

    /// Noise that moves all places together is no wave.
    #[test]
    fn correlated_noise_is_no_form() {
        let places = cylinder();
        let random = &mut Random::new(9);
        let mut draw = || {
            let g: Vec<f64> = (0..3).map(|_| normal(random)).collect();
            places.iter().map(|p| (g[0] * p[0] + g[1] * p[1]) / 5.0 + g[2]).collect::<Vec<f64>>()
        };
        let drawn: Vec<Vec<f64>> = (0..32).map(|_| draw()).collect();
        let heights: Vec<f64> = draw();
        let size = |h: &[f64]| dot(h, h);
        assert!(size(&smooth(&places, &heights, 1.5, &drawn).heights) < 1e-6 * size(&heights).max(1.0));
        assert!(size(&smooth(&places, &heights, 1.5, &[]).heights) > 0.1);
    }

    #[test]
    fn what_has_no_noise_stays() {
        let places = cylinder();
        let heights: Vec<f64> = places.iter().map(|p| p[2] * p[0]).collect();
        for noise in [0.0, f64::NAN, -1.0] {
            assert_eq!(smooth(&places, &heights, noise, &[]).heights, heights);
        }
        assert_eq!(smooth(&[], &[], 1.0, &[]).heights, Vec::<f64>::new());
        let odd = [f64::NAN, 1.0];
        assert!(smooth(&places[..2], &odd, 1.0, &[]).heights[0].is_nan());
    }
}
