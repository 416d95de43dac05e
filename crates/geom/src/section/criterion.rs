//! What a model of a smooth row costs, and what it is made of.

use super::chain::{Chain, Piece, SegmentKind};
use super::least::State;

/// What a model costs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Criterion {
    /// Standard deviation of the noise known beforehand, and of how many degrees of freedom that knowledge is.
    pub noise: f64,
    pub degrees: f64,
    /// Distances below this are not told from 0.
    pub resolution: f64,
    /// Points that count.
    pub count: f64,
}

/// Cost beyond that of its unknowns of an arc and of a free piece: simple kinds are the likelier ones.
const ARC: f64 = 1.0;
const FREE: f64 = 1.5;
impl Criterion {
    /// Twice the negative logarithm of the likelihood, the variance of the noise eliminated, plus the penalty of Schwarz
    /// for each unknown; a join counts twice, as its place was chosen among many.
    pub fn cost(&self, state: &State) -> f64 {
        // A piece without points is made up.
        if state.breaks.windows(2).any(|w| w[0] >= w[1]) {
            return f64::INFINITY;
        }
        // An arc that meets itself is none of a contour, but a whole circle's ends may overlap by their noise.
        let pieces = &state.chain.pieces;
        let meets_itself = |p: &Piece| {
            p.kind == SegmentKind::Arc && (p.length * p.curvature(0.0)).abs() >= std::f64::consts::TAU
        };
        if pieces.len() > 1 && pieces.iter().any(meets_itself) {
            return f64::INFINITY;
        }
        self.cost_of(state.sum, self.penalty(&state.chain))
    }
    /// What a sum of squares and so many unknowns cost.
    pub fn cost_of(&self, sum: f64, unknowns: f64) -> f64 {
        let total = self.count + self.degrees;
        let floor = self.resolution * self.resolution;
        let sum = sum + self.degrees * self.noise * self.noise;
        total * libm::log(sum / total + floor) + unknowns * libm::log(self.count)
    }
    /// The sum of squares at which a chain would cost so much.
    pub fn sum_at(&self, cost: f64, chain: &Chain) -> f64 {
        let total = self.count + self.degrees;
        let mean = libm::exp((cost - self.penalty(chain) * libm::log(self.count)) / total);
        (mean - self.resolution * self.resolution) * total - self.degrees * self.noise * self.noise
    }
    /// Unknowns of a chain as the criterion counts them.
    pub fn penalty(&self, chain: &Chain) -> f64 {
        let each = |p: &Piece| match p.kind {
            SegmentKind::Line => 0.0,
            SegmentKind::Arc => 1.0 + ARC,
            SegmentKind::Spline => p.coefficients.len() as f64 + FREE,
        };
        2.0 + 2.0 * chain.joins() as f64 + chain.pieces.iter().map(each).sum::<f64>()
    }
}

/// A model with what it costs.
#[derive(Clone, Debug)]
pub(super) struct Model {
    pub state: State,
    pub cost: f64,
}

/// A piece to be made: its kind, the number of its coefficients if it is free, and where it begins and ends on the model it
/// comes from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    pub kind: SegmentKind,
    pub count: usize,
    pub from: f64,
    pub to: f64,
}
