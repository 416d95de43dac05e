//! The least of a function of one angle: all directions that stand at a given angle to an axis.
//!
//! The width of a feature as a function of the angle about a datum has many local minima over a full turn. Near each of them it
//! is all but convex: the greatest of functions that are straight to second order in the height of the feature. So the turn is
//! sampled, and each low sample is followed to the bottom by golden section, which needs no derivative. (J. Kiefer, Sequential
//! minimax search for a maximum, 1953.)

use crate::num::golden::golden;
use crate::rigid::Rigid;
use crate::space::{Vector, least_axis, plus, times};

/// Samples of a full turn.
const SAMPLES_PER_TURN: usize = 1440;
/// Sampled minima that are followed.
const MAX_FOLLOWED_MINIMA: usize = 12;
/// Steps of the golden section: the range is then 1e-19 of what it was.
const GOLDEN_STEPS: usize = 90;

/// Directions at a fixed angle to an axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    along: Vector,
    across: [Vector; 2],
    period: f64,
}

impl Cone {
    /// Unit vectors whose scalar product with `axis` is the cosine of `angle`; `None` where `axis` has no direction.
    /// A direction and its opposite are one zone, so half a turn is all there is where they stand across the axis.
    pub(super) fn about(axis: Vector, angle: f64) -> Option<Cone> {
        let [u, v, w] = Rigid::into_frame([0.0; 3], axis, least_axis(axis))?.rotation();
        let right = angle == std::f64::consts::FRAC_PI_2;
        let (sine, cosine) = if right { (1.0, 0.0) } else { (libm::sin(angle), libm::cos(angle)) };
        let period = std::f64::consts::TAU * if right { 0.5 } else { 1.0 };
        Some(Cone { along: times(cosine, w), across: [times(sine, u), times(sine, v)], period })
    }

    /// The direction at the azimuth `phi`.
    pub(super) fn direction(&self, phi: f64) -> Vector {
        let across = plus(times(libm::cos(phi), self.across[0]), times(libm::sin(phi), self.across[1]));
        plus(self.along, across)
    }

    /// The azimuth of the least `value`.
    pub(super) fn least(&self, value: impl Fn(Vector) -> f64) -> f64 {
        let step = self.period / SAMPLES_PER_TURN as f64;
        let at = |phi: f64| value(self.direction(phi));
        let samples: Vec<f64> = (0..SAMPLES_PER_TURN).map(|k| at(k as f64 * step)).collect();
        let around = |k: usize| {
            [samples[(k + SAMPLES_PER_TURN - 1) % SAMPLES_PER_TURN], samples[(k + 1) % SAMPLES_PER_TURN]]
        };
        let mut low: Vec<usize> = (0..SAMPLES_PER_TURN)
            .filter(|&k| around(k).iter().all(|neighbor| samples[k] <= *neighbor))
            .collect();
        low.sort_by(|&i, &j| samples[i].total_cmp(&samples[j]).then(i.cmp(&j)));
        low.truncate(MAX_FOLLOWED_MINIMA);
        let bottoms = low.into_iter().map(|k| {
            let (phi, value) = golden(&at, (k as f64 - 1.0) * step, (k as f64 + 1.0) * step, GOLDEN_STEPS);
            (value, phi)
        });
        bottoms.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |b| b.1)
    }
}
