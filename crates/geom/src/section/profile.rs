//! Where a join may lie: the likelihood as a function of its place, everything else fitted anew.

use super::least::{Held, STIFF, State, Stop};
use super::search::{Model, Search};
use crate::num::special::student_quantile;

/// The places that the data allow for a join.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The join with everything fitted anew, at either end.
    pub ends: [[f64; 2]; 2],
    /// Standard uncertainty of the place along the curve: the interval's length over that of the unit normal, or Student's,
    /// distribution.
    pub uncertainty: f64,
    /// The end is that of a neighboring segment, or the interval was not followed farther: the data allow more.
    pub open: [bool; 2],
}

/// Farthest that an interval is followed to either side, in distances between points.
const FARTHEST: f64 = 25.0;

/// Of longer rows the likelihood is normal, and its second derivative tells the intervals: nothing is fitted anew.
const PROFILED: usize = 6000;

impl Search<'_> {
    /// Standard deviation of the noise, its square, and its degrees of freedom.
    pub fn variance(&self, state: &State) -> (f64, f64) {
        let unknowns = 2.0
            + state.chain.joins() as f64
            + state.chain.pieces.iter().map(|p| p.coefficients.len() as f64).sum::<f64>();
        let degrees = (self.criterion.count - unknowns).max(1.0) + self.criterion.degrees;
        let sum = state.sum + self.criterion.degrees * self.criterion.noise * self.criterion.noise;
        ((sum / degrees).max(self.criterion.resolution * self.criterion.resolution), degrees)
    }

    /// Intervals of all joins at the confidence `level`, and a better model if one was found on the way.
    pub fn intervals(&mut self, model: &Model, level: f64) -> (Vec<Interval>, Option<State>) {
        let (variance, degrees) = self.variance(&model.state);
        let quantile = student_quantile(1.0 - level, degrees);
        let limit = model.state.sum + variance * quantile * quantile;
        let mut state = model.state.clone();
        let row = self.row;
        let spreads = self.work.spread(&row, &mut state);
        let first = usize::from(!state.chain.closed);
        let poses = self.work.layout.poses.clone();
        let mut better: Option<State> = None;
        let mut all = vec![];
        for join in first..state.chain.pieces.len() {
            let spread = spreads.as_ref().map_or(self.spacing, |s| s.places[join - first] * variance.sqrt());
            let spread = spread.clamp(1e-7 * self.spacing, 5.0 * self.spacing);
            let mut interval = Interval { ends: [poses[join].at; 2], uncertainty: 0.0, open: [false; 2] };
            if row.points.len() > PROFILED {
                let reach = quantile * spread;
                let (at, along) = (poses[join].at, poses[join].along);
                interval.ends = [-reach, reach].map(|x| [at[0] + x * along[0], at[1] + x * along[1]]);
                interval.uncertainty = spread;
                all.push(interval);
                continue;
            }
            for (side, sign) in [-1.0, 1.0].into_iter().enumerate() {
                let seek = Seek { join, sign, first: quantile * spread, limit, along: poses[join].along };
                let (at, open, lower) = self.follow(&state, &seek);
                (interval.ends[side], interval.open[side]) = (at, open);
                let least = better.as_ref().map_or(state.sum, |b| b.sum);
                better = lower.filter(|l| l.sum < least * (1.0 - 1e-6)).or(better);
            }
            let [a, b] = interval.ends;
            interval.uncertainty = libm::hypot(b[0] - a[0], b[1] - a[1]) / (2.0 * quantile);
            all.push(interval);
        }
        (all, better)
    }

    /// Moves a join until the sum of squares reaches the limit: secants on the root of what it grew by, which is straight
    /// where the likelihood is normal.
    fn follow(&mut self, best: &State, seek: &Seek) -> ([f64; 2], bool, Option<State>) {
        let stop =
            Stop { steps: 14, gain: 1e-5, shortest: 0.5 * self.spacing, stiff: STIFF, target: f64::INFINITY };
        let farthest = FARTHEST * self.spacing;
        let origin = self.place_of(best, seek);
        let wanted = (seek.limit - best.sum).max(f64::MIN_POSITIVE).sqrt();
        let mut low = (0.0, 0.0, best.clone());
        let mut high: Option<(f64, f64, State)> = None;
        let mut lower: Option<State> = None;
        let mut x = seek.first.min(farthest);
        let row = self.row;
        for _ in 0..24 {
            let mut state = low.2.clone();
            let held = Held { join: seek.join, along: seek.along, value: origin.1 + seek.sign * x };
            let sound = self.work.improve(&row, &mut state, Some(&held), &stop);
            let reached = (self.place_of(&state, seek).1 - held.value).abs() < 1e-3 * x;
            if sound && reached && state.sum < best.sum * (1.0 - 1e-9) {
                lower = Some(state.clone());
            }
            let root = (state.sum - best.sum).max(0.0).sqrt();
            if !sound || !reached {
                // A neighboring join is in the way.
                high = Some((x, f64::INFINITY, state));
            } else if root >= wanted {
                high = Some((x, root, state));
            } else {
                low = (x, root, state);
            }
            match &high {
                None if low.0 >= farthest => return (self.place_of(&low.2, seek).0, true, lower),
                None => {
                    let secant = if low.1 > 0.0 { low.0 * wanted / low.1 } else { 2.0 * x };
                    x = secant.clamp(1.15 * x, 3.0 * x).min(farthest);
                }
                Some((right, root_right, state)) => {
                    if (right - low.0) < 0.02 * right || (root_right - wanted).abs() < 0.01 * wanted {
                        let open = root_right.is_infinite();
                        let at = if open { &low.2 } else { state };
                        return (self.place_of(at, seek).0, open, lower);
                    }
                    let share = (wanted - low.1) / (root_right - low.1);
                    let share = if share.is_finite() { share.clamp(0.05, 0.95) } else { 0.5 };
                    x = low.0 + (right - low.0) * share.max(0.05);
                }
            }
        }
        (self.place_of(&low.2, seek).0, high.is_none(), lower)
    }

    /// The join, and its place along the direction in which it moves.
    fn place_of(&mut self, state: &State, seek: &Seek) -> ([f64; 2], f64) {
        self.work.layout.fill(&state.chain);
        let at = self.work.layout.poses[seek.join].at;
        (at, at[0] * seek.along[0] + at[1] * seek.along[1])
    }
}

/// A join on its way to an end of its interval.
struct Seek {
    join: usize,
    sign: f64,
    first: f64,
    limit: f64,
    along: [f64; 2],
}
