//! Effect of noise that neighbors share on a least-squares fit.

use super::jet::Fitter;
use trueness_geom::noise::Noise;
use trueness_geom::space::{minus, norm};

/// Up to so many data all pairs are looked at. The value asked for varies little from neighbor to neighbor in more data: each
/// stands for as many as share its noise.
const MAX_DATA_IN_ALL_PAIRS: usize = 300;

impl Fitter {
    /// Standard deviation of a sum of coefficients from
    /// `first` on, for data of standard deviation 1 with this noise. It is `√(wᵀCw)` for the weights
    /// `w` of the data and the correlations `C`. Residuals tell little of noise that most of a neighborhood shares.
    pub(super) fn shared(&self, first: usize, weights: [f64; 3], noise: &Noise) -> f64 {
        let m = self.local.len();
        // The weights of the data: Q R⁻ᵀ g.
        let mut turned = vec![0.0; m];
        let weights = self.turned_weights(first, weights);
        turned.iter_mut().skip(first).zip(weights).for_each(|(of, weight)| *of = weight);
        self.turn(&mut turned);
        let squares: f64 = turned.iter().map(|x| x * x).sum();
        if m > MAX_DATA_IN_ALL_PAIRS {
            return (noise.points_per_independent * squares).sqrt();
        }
        let pair = |i: usize, j: usize| {
            noise.correlation(norm(minus(self.local[i], self.local[j]))) * turned[i] * turned[j]
        };
        let pairs: f64 = (0..m).map(|i| (0..i).map(|j| pair(i, j)).sum::<f64>()).sum();
        (squares + 2.0 * pairs).max(0.0).sqrt()
    }

    /// Applies the reflections of the elimination, last first.
    fn turn(&self, u: &mut [f64]) {
        let m = u.len();
        for k in (0..self.unknowns).rev() {
            let column = &self.columns[k * m..(k + 1) * m];
            let (head, alpha) = (self.heads[k], column[k]);
            let half = -alpha * head;
            if half == 0.0 {
                continue;
            }
            let below = |u: &[f64]| column[k + 1..].iter().zip(&u[k + 1..]).map(|(v, x)| v * x).sum::<f64>();
            let share = (head * u[k] + below(u)) / half;
            u[k] -= share * head;
            u[k + 1..].iter_mut().zip(&column[k + 1..]).for_each(|(x, v)| *x -= share * v);
        }
    }
}
