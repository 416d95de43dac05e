//! The chain of least squared orthogonal distances, by the method of Levenberg and Marquardt.
//!
//! A change of an unknown moves all that follows on the chain as a rigid body. So the distances of the points of a
//! piece depend on the pieces before it through three numbers alone. One pass over the points sums products of these
//! and of the piece's own unknowns, and serves for any number of unknowns.

mod constrained;
mod normal;
mod work;

pub(crate) use work::{Held, Work};

use super::chain::{Chain, Ends, Layout, Pose, SegmentKind, arc_end, arc_to};
use super::result::Uncertainty;
use constrained::Constrained;
use normal::end_coefficient;
use work::{PieceSums, TRIAL_CONDITION_WEIGHT, Variable};

/// Weight of a squared distance that must vanish, against one that is to be least, where it is to vanish at last.
const FINAL_CONDITION_WEIGHT: f64 = 1e8;
/// Steps back to where the conditions hold, after one along their tangents. Each squares the residual of the
/// conditions.
const RESTORING_STEPS: usize = 4;

/// The points that a chain is fitted to, seen from near their middle, and how much each counts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row<'a> {
    pub points: &'a [[f64; 2]],
    pub weights: &'a [f64],
}

/// A chain with the pieces that the points belong to.
#[derive(Clone, Debug)]
pub(crate) struct State {
    pub chain: Chain,
    /// First point of each piece, and the end; of a closed chain numbered on beyond the last point.
    pub breaks: Vec<usize>,
    /// Parameter of the foot of each point on a free piece.
    pub feet: Vec<f64>,
    /// Weighted sum of squared distances.
    pub sum: f64,
}

/// How well the data determine a chain.
#[derive(Clone, Debug, Default)]
pub(crate) struct Spread {
    /// Deviations of the place of each join along the chain.
    pub places: Vec<f64>,
    /// Deviations of the jump of curvature at each join.
    pub jumps: Vec<f64>,
    /// Deviations of the first and last point of the chain, across it.
    pub ends: [f64; 2],
    /// Uncertainties of each line and arc; `None` for a free piece.
    pub pieces: Vec<Option<Uncertainty>>,
    /// Deviations of the length of each piece between its joins; none beyond the first and last.
    pub lengths: Vec<f64>,
}

/// A step is not taken that gains less than this share of the least gain.
const MIN_GAIN_SHARE: f64 = 0.01;
/// Gain of a step, in variances of the noise, below which no shorter one is tried where it was refused. Rounding refuses such a
/// step, and the unknowns are within a hundredth of their uncertainty.
const SETTLED_GAIN_VARIANCES: f64 = 1e-4;

/// Products in the time of one distance.
const PRODUCTS_PER_DISTANCE: usize = 40;

/// When to stop.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stop {
    pub steps: usize,
    /// Share of the sum of squares that a step must gain.
    pub gain: f64,
    /// Least length of a piece.
    pub shortest: f64,
    /// Whether the conditions hold in every step; otherwise they are weighed against the distances.
    pub exact: bool,
    /// Sum of squares that is asked for: where a step gains less than a tenth of the missing part, it will not be
    /// reached. Infinite where none is.
    pub target: f64,
}

fn place(pose: &Pose, point: [f64; 2]) -> f64 {
    (point[0] - pose.at[0]) * pose.along[0] + (point[1] - pose.at[1]) * pose.along[1]
}

impl Row<'_> {
    fn point(&self, i: usize) -> [f64; 2] {
        self.points[i % self.points.len()]
    }
}

/// Moves the borders between pieces to where the points pass the joins.
fn assign(row: &Row, layout: &Layout, closed: bool, breaks: &mut [usize], feet: &mut [f64]) {
    let last = breaks.len() - 1;
    let count = row.points.len();
    let range = if closed { 0..last } else { 1..last };
    for j in range {
        let pose = &layout.poses[j];
        let (low, high) = match j {
            0 => (breaks[last - 1] - count, breaks[1]),
            _ => (breaks[j - 1], breaks[j + 1]),
        };
        while breaks[j] > low && place(pose, row.point(breaks[j] - 1)) > 0.0 {
            breaks[j] -= 1;
            feet[breaks[j] % count] = 0.0;
        }
        while breaks[j] < high && place(pose, row.point(breaks[j])) <= 0.0 {
            feet[breaks[j] % count] = 1.0;
            breaks[j] += 1;
        }
        if j == 0 {
            breaks[last] = breaks[0] + count;
        }
    }
    if closed && breaks[0] < count {
        breaks.iter_mut().for_each(|b| *b += count);
    } else if closed && breaks[0] >= 2 * count {
        breaks.iter_mut().for_each(|b| *b -= count);
    }
}

/// Signed distance to the left of an arc or line through a pose, and the normal at the foot.
#[inline]
fn distance(pose: &Pose, curvature: f64, point: [f64; 2]) -> (f64, [f64; 2]) {
    let p = [point[0] - pose.at[0], point[1] - pose.at[1]];
    let normal = pose.normal();
    if curvature == 0.0 {
        return (normal[0] * p[0] + normal[1] * p[1], normal);
    }
    let q = 2.0 * (normal[0] * p[0] + normal[1] * p[1]) - curvature * (p[0] * p[0] + p[1] * p[1]);
    let root = (1.0 - curvature * q).max(0.0).sqrt();
    let inverse = 1.0 / root.max(f64::MIN_POSITIVE);
    let n = [(normal[0] - curvature * p[0]) * inverse, (normal[1] - curvature * p[1]) * inverse];
    (q / (1.0 + root), n)
}

impl Work {
    /// Lays the state's chain out, finds which points belong to which piece, and the sum of squares; with `full`, the
    /// products of each piece too.
    fn measure(&mut self, row: &Row, state: &mut State, full: bool) {
        self.layout.fill(&state.chain);
        assign(row, &self.layout, state.chain.closed, &mut state.breaks, &mut state.feet);
        let count = row.points.len();
        self.blocks.resize_with(state.chain.pieces.len(), PieceSums::default);
        self.distances.resize(count, 0.0);
        state.sum = 0.0;
        for (g, piece) in state.chain.pieces.iter().enumerate() {
            let (from, to) = (state.breaks[g], state.breaks[g + 1]);
            let block = &mut self.blocks[g];
            block.reset(3 + usize::from(piece.kind == SegmentKind::Spline) + piece.coefficients.len());
            let pose = &self.layout.poses[g];
            let curvature = piece.coefficients.first().copied().unwrap_or(0.0);
            let table = &self.layout.tables[g];
            if piece.kind == SegmentKind::Spline {
                self.effort += table.products();
            }
            let mut products = [0.0; 64];
            let size = block.size;
            // A distance takes about as long as so many products.
            self.effort += (to.saturating_sub(from)
                * (PRODUCTS_PER_DISTANCE + if full { size * size / 2 } else { 0 }))
                as f64;
            let mut next = from % count;
            for _ in from..to {
                let i = next;
                next = if i + 1 == count { 0 } else { i + 1 };
                let (point, weight) = (row.points[i], row.weights[i]);
                let (d, n) = if piece.kind == SegmentKind::Spline {
                    let local = pose.into_frame([point[0] - pose.at[0], point[1] - pose.at[1]]);
                    let (t, place) = table.foot(local, state.feet[i]);
                    state.feet[i] = t;
                    let normal = [-place.along[1], place.along[0]];
                    let d = (local[0] - place.at[0]) * normal[0] + (local[1] - place.at[1]) * normal[1];
                    if full {
                        table.motions_along(t, normal, &mut products[3..size]);
                    }
                    (d, pose.out(normal))
                } else {
                    distance(pose, curvature, point)
                };
                self.distances[i] = d;
                state.sum += weight * d * d;
                if !full {
                    continue;
                }
                let foot = [point[0] - d * n[0], point[1] - d * n[1]];
                // How a turn about the origin moves the foot along the normal.
                (products[0], products[1], products[2]) = (n[0], n[1], n[1] * foot[0] - n[0] * foot[1]);
                if piece.kind == SegmentKind::Arc {
                    let chord = [foot[0] - pose.at[0], foot[1] - pose.at[1]];
                    products[3] = 0.5 * (chord[0] * chord[0] + chord[1] * chord[1]);
                }
                block.add(&products[..size], weight, d);
            }
        }
    }

    /// Sum of squares and the terms that conditions add to it.
    fn cost(&self, state: &State, held: Option<&Held>) -> f64 {
        let weight = if self.exact { FINAL_CONDITION_WEIGHT } else { TRIAL_CONDITION_WEIGHT };
        state.sum + weight * self.off(&state.chain, held).iter().map(|x| x * x).sum::<f64>()
    }

    /// The chain moved by a step.
    fn step(&self, chain: &mut Chain, step: &[f64], shortest: f64) {
        let start = self.layout.poses[0];
        for (variable, x) in self.variables.iter().zip(step) {
            match *variable {
                Variable::Left => (0..2).for_each(|k| chain.start[k] += x * start.normal()[k]),
                Variable::Forward => (0..2).for_each(|k| chain.start[k] += x * start.along[k]),
                Variable::Turn => chain.heading += x,
                Variable::Join { before, after } => {
                    let low = shortest - chain.pieces[before].length;
                    let x = x.max(low.min(0.0));
                    let x = after.map_or(x, |a| x.min((chain.pieces[a].length - shortest).max(0.0)));
                    chain.pieces[before].length += x;
                    if let Some(after) = after {
                        chain.pieces[after].length -= x;
                    }
                }
                Variable::Coefficient { piece, index } => chain.pieces[piece].coefficients[index] += x,
            }
        }
    }

    /// Brings a chain back to where the conditions hold, which a step along their tangents leaves by its square.
    fn restore(&mut self, chain: &mut Chain, system: &Constrained, held: Option<&Held>, shortest: f64) {
        let off = |work: &mut Work, chain: &Chain| {
            work.layout.fill(chain);
            let off = work.off(chain, held);
            let square: f64 = off.iter().map(|x| x * x).sum();
            (off, square)
        };
        if !self.exact || self.conditions.is_empty() {
            return;
        }
        let (mut missing, mut square) = off(self, chain);
        for _ in 0..RESTORING_STEPS {
            let mut next = chain.clone();
            self.step(&mut next, &system.restore(missing), shortest);
            let found = off(self, &next);
            if found.1.is_nan() || found.1 >= square {
                return;
            }
            *chain = next;
            (missing, square) = found;
        }
    }

    /// Improves the state until the rule to stop holds. False where the unknowns are not determined.
    pub(crate) fn improve(&mut self, row: &Row, state: &mut State, held: Option<&Held>, stop: &Stop) -> bool {
        self.exact = stop.exact;
        self.measure(row, state, true);
        let mut cost = self.cost(state, held);
        let (mut lambda, mut stalled, mut steps_taken) = (1e-4, 0, 0);
        let mut fresh = true;
        let mut next = state.clone();
        let settled = SETTLED_GAIN_VARIANCES / row.points.len() as f64;
        for _ in 0..stop.steps {
            if fresh {
                let chain = std::mem::replace(&mut state.chain, Chain::EMPTY);
                self.assemble(&chain, held);
                state.chain = chain;
            }
            let k = self.variables.len();
            self.effort += (k * k * k / 6) as f64;
            let mut damped = self.matrix.clone();
            for i in 0..k {
                damped[i * k + i] += lambda * self.scale[i] + f64::MIN_POSITIVE;
            }
            let Some(system) = Constrained::new(damped, &self.conditions) else {
                lambda *= 100.0;
                fresh = false;
                if lambda > 1e10 {
                    return false;
                }
                continue;
            };
            let step = system.solve(&self.right, &self.missing);
            // The gain of the step if the distances were linear in the unknowns. Where that is far below the gain asked
            // for, nothing is measured any more.
            let gain: f64 = step.iter().zip(&self.right).map(|(x, r)| x * r).sum::<f64>()
                + (FINAL_CONDITION_WEIGHT - TRIAL_CONDITION_WEIGHT)
                    * self.missing.iter().map(|x| x * x).sum::<f64>();
            let least = if fresh { MIN_GAIN_SHARE * stop.gain } else { settled };
            if gain <= least * cost {
                break;
            }
            copy(&mut next, state);
            self.step(&mut next.chain, &step, stop.shortest);
            self.restore(&mut next.chain, &system, held, stop.shortest);
            self.measure(row, &mut next, true);
            let after = self.cost(&next, held);
            if after <= cost {
                steps_taken += 1;
                let missed = steps_taken > 1 && cost - after < 0.1 * (after - stop.target);
                stalled = if cost - after <= stop.gain * cost || missed { stalled + 1 } else { 0 };
                (cost, lambda, fresh) = (after, (lambda * 0.1).max(1e-12), true);
                std::mem::swap(state, &mut next);
                if stalled >= 1 {
                    break;
                }
            } else {
                // The products are those of the step refused.
                self.layout.fill(&state.chain);
                (lambda, fresh) = (lambda * 8.0, false);
                if lambda > 1e8 || !after.is_finite() && lambda > 1e4 {
                    break;
                }
            }
        }
        state.sum.is_finite()
    }

    /// Standard deviations for distances of standard deviation 1. `None` where the unknowns are not determined.
    pub(crate) fn spread(&mut self, row: &Row, state: &mut State) -> Option<Spread> {
        self.exact = true;
        self.measure(row, state, true);
        self.assemble(&state.chain, None);
        let chain = &state.chain;
        let system = Constrained::new(self.matrix.clone(), &self.conditions)?;
        let deviation = |effect: Vec<f64>| system.deviation(&effect);
        let n = chain.pieces.len();
        let mut all = Spread::default();
        for join in usize::from(!chain.closed)..n {
            let held = Held { join, along: self.layout.poses[join].along, value: 0.0 };
            all.places.push(deviation(self.conditions_of(chain, Some(&held)).pop()?));
            let ends =
                (end_coefficient(chain, (join + n - 1) % n, true), end_coefficient(chain, join, false));
            let is = |v: &Variable, end: Option<(usize, usize)>| {
                f64::from(end.is_some_and(|(piece, index)| *v == Variable::Coefficient { piece, index }))
            };
            all.jumps.push(deviation(self.variables.iter().map(|v| is(v, ends.1) - is(v, ends.0)).collect()));
        }
        for (end, join) in all.ends.iter_mut().zip([0, n]) {
            let held = Held { join, along: self.layout.poses[join].normal(), value: 0.0 };
            *end = deviation(self.conditions_of(chain, Some(&held)).pop()?);
        }
        all.pieces = (0..n).map(|g| self.uncertainty(chain, g, &deviation)).collect();
        let longer = |g: usize, v: &Variable| match v {
            Variable::Join { before, .. } if *before == g => 1.0,
            Variable::Join { after, .. } if *after == Some(g) => -1.0,
            _ => 0.0,
        };
        all.lengths =
            (0..n).map(|g| deviation(self.variables.iter().map(|v| longer(g, v)).collect())).collect();
        Some(all)
    }

    /// Signed distances of all points to the left of the chain.
    pub(crate) fn residuals(&mut self, row: &Row, state: &mut State) -> &[f64] {
        self.measure(row, state, false);
        &self.distances
    }

    /// Lengths from the start to the feet of all points. Points before the start of a closed chain are counted on
    /// beyond its end.
    pub(crate) fn stations(&mut self, row: &Row, state: &mut State) -> Vec<f64> {
        self.measure(row, state, false);
        let count = row.points.len();
        let mut all = vec![0.0; count];
        let starts = state.chain.stations();
        for (g, piece) in state.chain.pieces.iter().enumerate() {
            let pose = &self.layout.poses[g];
            let half = 0.5 * piece.length;
            for i in state.breaks[g]..state.breaks[g + 1] {
                let i = i % count;
                let p = row.points[i];
                let own = match piece.kind {
                    SegmentKind::Spline => state.feet[i] * piece.length,
                    SegmentKind::Line => place(pose, p),
                    SegmentKind::Arc => {
                        // The angle from the middle of the arc, where it does not jump.
                        let k = piece.coefficients[0];
                        let middle = Pose::new(pose.place(arc_end(half, half * k)), pose.heading + half * k);
                        let v = middle.into_frame([p[0] - middle.at[0], p[1] - middle.at[1]]);
                        half + arc_to(v, k)
                    }
                };
                all[i] = starts[g] + own;
            }
        }
        all
    }
}

/// Makes a state that of another, in the memory that it has.
fn copy(to: &mut State, from: &State) {
    (to.chain.start, to.chain.heading) = (from.chain.start, from.chain.heading);
    for (a, b) in to.chain.pieces.iter_mut().zip(&from.chain.pieces) {
        (a.kind, a.length) = (b.kind, b.length);
        a.coefficients.clone_from(&b.coefficients);
    }
    to.breaks.clone_from(&from.breaks);
    to.feet.clone_from(&from.feet);
    to.sum = from.sum;
}

impl Chain {
    /// Stands in while the chain is elsewhere.
    const EMPTY: Chain = Chain {
        start: [0.0; 2],
        heading: 0.0,
        pieces: Vec::new(),
        closed: false,
        even: false,
        ends: Ends { start: false, end: None },
    };
}
