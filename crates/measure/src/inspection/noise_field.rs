//! The noise of one draw: a vector for each place. The same place has the same noise in all features.

use crate::plan::Noise;
use std::collections::HashMap;
use trueness_geom::num::random::Random;
use trueness_geom::space::{Point, Vector, plus, times};

/// Cells from zero up to which places within a cell are told apart.
const MAX_CELL_NUMBER: f64 = 1e12;
/// Corners of cells that are held in memory, about 50 bytes each.
const MAX_HELD_CORNERS: usize = 200_000;

/// Corners of a cell.
const CORNERS_PER_CELL: usize = 8;

/// What a vector of independent normal numbers belongs to: a place, or a corner of a cell.
pub(super) type Source = [u64; 3];

/// The noise of one draw.
pub(super) struct Field {
    noise: Noise,
    seed: u64,
    /// Vectors at the corners of cells. Looked up only, never walked through.
    corners: HashMap<Source, Vector>,
}

impl Field {
    pub fn new(noise: &Noise, seed: u64) -> Field {
        Field { noise: *noise, seed, corners: HashMap::new() }
    }

    /// Three independent normal numbers of the stated deviation. With a correlation length they are interpolated between the corners of
    /// cells of that size, and brought back to that deviation. So places within about half of it move together.
    pub fn at(&mut self, p: &Point) -> Vector {
        let (parts, count) = parts(p, &self.noise);
        if self.corners.len() > MAX_HELD_CORNERS {
            self.corners.clear();
        }
        let mut sum = [0.0; 3];
        for (number, (source, weight)) in parts.into_iter().take(count).enumerate() {
            let known = self.corners.get(&source).copied();
            let g = known.unwrap_or_else(|| self.vector(source));
            // No other point asks for what each has alone.
            if number < CORNERS_PER_CELL && count > 1 {
                self.corners.insert(source, g);
            }
            sum = plus(sum, times(weight, g));
        }
        times(self.noise.deviation, sum)
    }

    /// Three normal numbers for three whole ones (G. E. P. Box and M. E. Muller, 1958).
    pub fn vector(&self, of: Source) -> Vector {
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

/// What the noise of a place is made of, with weights whose squares add up to 1, and their number: itself, or the eight corners about it and
/// itself.
pub(super) fn parts(p: &Point, noise: &Noise) -> ([(Source, f64); CORNERS_PER_CELL + 1], usize) {
    let correlation = noise.correlation;
    let own = p.map(|x| (x + 0.0).to_bits());
    let mut parts = [([0; 3], 0.0); CORNERS_PER_CELL + 1];
    let cell = p.map(|x| (x / correlation).floor());
    // Also where numbers cannot tell the places within a cell: each point moves alone there.
    if correlation <= 0.0 || !cell.iter().all(|c| c.abs() < MAX_CELL_NUMBER) {
        parts[0] = (own, 1.0);
        return (parts, 1);
    }
    let (corners, _) = parts.split_at_mut(CORNERS_PER_CELL);
    for (corner, part) in corners.iter_mut().enumerate() {
        let up = [0, 1, 2].map(|k| ((corner >> k) & 1) as f64);
        let along = |k: usize| 1.0 - (p[k] / correlation - cell[k] - up[k]).abs();
        let place = [0, 1, 2].map(|k| (cell[k] + up[k]) as i64 as u64);
        *part = (place, along(0) * along(1) * along(2));
    }
    let size = (corners.iter().map(|part| part.1 * part.1).sum::<f64>() / (1.0 - noise.white)).sqrt();
    corners.iter_mut().for_each(|part| part.1 /= size);
    parts[CORNERS_PER_CELL] = (own, noise.white.sqrt());
    (parts, if noise.white > 0.0 { CORNERS_PER_CELL + 1 } else { CORNERS_PER_CELL })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(correlation: f64, white: f64) -> Noise {
        Noise { deviation: 0.1, correlation, white, draws: 1 }
    }

    /// Standard deviation, and correlation between places `apart` along x.
    fn seen([correlation, white]: [f64; 2], apart: f64) -> [f64; 2] {
        let (mut squares, mut products, n) = (0.0, 0.0, 4000);
        for draw in 0..n {
            let mut field = Field::new(&noise(correlation, white), draw);
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
            ([0.0, 0.0], 0.01, -0.05, 0.05),
            ([1e-300, 0.0], 0.01, -0.05, 0.05),
            ([5e-324, 0.0], 0.01, -0.05, 0.05),
            ([2.0, 0.0], 0.1, 0.9, 1.0),
            ([2.0, 0.0], 0.9, 0.3, 0.9),
            ([2.0, 0.0], 4.1, -0.05, 0.05),
            ([2.0, 0.4], 0.01, 0.55, 0.65),
            ([2.0, 1.0], 0.01, -0.05, 0.05),
        ] {
            let [deviation, correlated] = seen(correlation, apart);
            assert!((deviation / 0.1 - 1.0).abs() < 0.04, "{correlation:?} {apart}: {deviation}");
            assert!((least..=greatest).contains(&correlated), "{correlation:?} {apart}: {correlated}");
        }
    }
}
