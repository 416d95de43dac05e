//! The cost of a model of a smooth row, and the parts of such a model.

use super::chain::{Chain, Piece, SegmentKind};
use super::least::State;

/// Cost of a model.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Criterion {
    /// Standard deviation of the noise known beforehand, and of how many degrees of freedom that knowledge is.
    pub noise: f64,
    pub degrees: f64,
    /// Distances below this are not told from 0.
    pub resolution: f64,
    /// As many points as are independent.
    pub count: f64,
    /// All that count.
    pub points: f64,
    /// The other pieces of a chain of which models are a part.
    pub rest: Option<Rest>,
}

/// Sum of squares and unknowns of the other pieces of a chain.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rest {
    pub sum: f64,
    pub unknowns: Unknowns,
}

/// In rows of fewer points a search may pass through models whose free pieces are loose.
const MIN_POINTS_TO_FORBID_LOOSE_PIECES: f64 = 60.0;

/// Cost of an arc beyond that of its unknowns. Simple kinds are likelier, by as much however far neighbors share their noise.
const ARC_COST: f64 = 1.0;
/// Cost of a free piece beyond that of its unknowns, for the same reason.
const FREE_PIECE_COST: f64 = 1.5;

impl Criterion {
    /// Twice the negative logarithm of the likelihood, the variance of the noise eliminated, plus the penalty of
    /// Schwarz for each unknown. A join counts twice, as its place was chosen among many. Where the points are few for
    /// the unknowns, these take up noise, and the variance left is less than that of the noise. So the penalty grows,
    /// up to twice, as the unknowns become as many as the points. (McQuarrie, A small-sample correction for the Schwarz
    /// SIC model selection criterion, Statistics and Probability Letters 44, 1999).
    pub fn cost(&self, state: &State) -> f64 {
        // A piece without points is made up.
        if state.breaks.windows(2).any(|w| w[0] >= w[1]) {
            return f64::INFINITY;
        }
        // An arc that meets itself is none of a contour, but a whole circle's ends may overlap by their noise. In rows of points enough
        // a free piece beside others needs more points than unknowns.
        let pieces = &state.chain.pieces;
        let meets_itself = |p: &Piece| {
            p.kind == SegmentKind::Arc && (p.length * p.curvature(0.0)).abs() >= std::f64::consts::TAU
        };
        let loose = |(p, w): (&Piece, &[usize])| {
            self.count >= MIN_POINTS_TO_FORBID_LOOSE_PIECES && p.is_loose(w[1] - w[0])
        };
        if pieces.len() > 1
            && (pieces.iter().any(meets_itself) || pieces.iter().zip(state.breaks.windows(2)).any(loose))
        {
            return f64::INFINITY;
        }
        let own = Unknowns::of(&state.chain);
        match self.rest {
            None => self.cost_of(state.sum, own),
            Some(rest) => self.cost_of(state.sum + rest.sum, own.and(rest.unknowns)),
        }
    }
    /// Cost of a sum of squares and so many unknowns.
    pub fn cost_of(&self, sum: f64, unknowns: Unknowns) -> f64 {
        let total = self.count + self.degrees;
        let floor = self.resolution * self.resolution;
        let sum = sum + self.degrees * self.noise * self.noise;
        total * libm::log(sum / total + floor) + self.penalty(unknowns)
    }
    /// The sum of squares at which a chain would cost so much.
    pub fn sum_at(&self, cost: f64, chain: &Chain) -> f64 {
        let total = self.count + self.degrees;
        let own = Unknowns::of(chain);
        let (sum, unknowns) = self.rest.map_or((0.0, own), |rest| (rest.sum, own.and(rest.unknowns)));
        let mean = libm::exp((cost - self.penalty(unknowns)) / total);
        (mean - self.resolution * self.resolution) * total - self.degrees * self.noise * self.noise - sum
    }
    fn penalty(&self, unknowns: Unknowns) -> f64 {
        let total = self.count + self.degrees;
        let spare = (total - unknowns.number - 2.0).max(MIN_FREEDOM_SHARE * total);
        let small_sample_factor = if total < SHORT_ROW_POINTS { 1.0 } else { total / spare };
        (unknowns.weight * libm::log(self.count) + unknowns.kinds * libm::log(self.points))
            * small_sample_factor
    }
}

/// In rows of fewer points all degrees of freedom count as left. Any curve along the points takes most of them there,
/// and is better all the same than one that passes them by.
const SHORT_ROW_POINTS: f64 = 24.0;
/// Share of the degrees of freedom that counts as left at least.
const MIN_FREEDOM_SHARE: f64 = 0.5;

/// The unknowns of a chain.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Unknowns {
    /// How many there are.
    pub number: f64,
    /// How many the criterion counts.
    pub weight: f64,
    /// Cost of the kinds beyond.
    pub kinds: f64,
}

impl Unknowns {
    pub fn of(chain: &Chain) -> Unknowns {
        let joins = chain.joins() as f64;
        let number = |p: &Piece| p.coefficients.len() as f64;
        let weight = |p: &Piece| match p.kind {
            SegmentKind::Line => 0.0,
            SegmentKind::Arc => 1.0,
            SegmentKind::Spline => p.coefficients.len() as f64,
        };
        let kind = |p: &Piece| match p.kind {
            SegmentKind::Line => 0.0,
            SegmentKind::Arc => ARC_COST,
            SegmentKind::Spline => FREE_PIECE_COST,
        };
        Unknowns {
            number: 2.0 + joins + chain.pieces.iter().map(number).sum::<f64>(),
            weight: 2.0 + 2.0 * joins + chain.pieces.iter().map(weight).sum::<f64>(),
            kinds: chain.pieces.iter().map(kind).sum(),
        }
    }
    /// The unknowns of a chain without those of a part of it.
    pub fn less(self, other: Unknowns) -> Unknowns {
        Unknowns {
            number: self.number - other.number,
            weight: self.weight - other.weight,
            kinds: self.kinds - other.kinds,
        }
    }
    /// The unknowns of two chains.
    pub fn and(self, other: Unknowns) -> Unknowns {
        Unknowns {
            number: self.number + other.number,
            weight: self.weight + other.weight,
            kinds: self.kinds + other.kinds,
        }
    }
}

/// A model with its cost.
#[derive(Clone, Debug)]
pub(crate) struct Model {
    pub state: State,
    pub cost: f64,
}

/// A piece to be made. It has its kind, the number of its coefficients if it is free, and where it begins and ends on
/// the model it comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PieceSpec {
    pub kind: SegmentKind,
    pub count: usize,
    pub from: f64,
    pub to: f64,
}
