//! The cheapest row of lines and arcs, each fitted by itself, by dynamic programming.

use super::parts::{Part, Sums};
use crate::model::chain::SegmentKind;

/// Places at which a part may start: time grows with the square of their number.
pub(crate) const MAX_PART_STARTS: usize = 1200;

/// Costs of the parts, in units of the noise's variance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Penalty {
    pub line: f64,
    pub arc: f64,
    pub noise: f64,
    /// Fewest points of a part.
    pub fewest: usize,
    /// Most places that a part may start at.
    pub places: usize,
}

/// The cheapest row of lines and arcs, each fitted by itself: sum of squares over the noise's variance, and a penalty
/// for each. Jackson et al., An Algorithm for Optimal Partitioning of Data on an Interval, 2005. Starts that can never
/// win any more are dropped (Killick, Fearnhead and Eckley, 2012). Time grows with the square of `places` at worst.
pub(crate) fn partition(points: &[[f64; 2]], weights: &[f64], penalty: &Penalty) -> Vec<Part> {
    let sums = Sums::new(points, weights);
    let mut breaks = vec![];
    let stride = penalty.stride(points.len());
    for Stretch { from, to, kind } in cheapest(&sums, points.len(), penalty, 0, None) {
        breaks.push((from, kind));
        if to == points.len() {
            breaks.push((to, SegmentKind::Line));
        }
    }
    if stride > 1 {
        sharpen(&sums, &mut breaks, stride, penalty);
    }
    breaks.windows(2).map(|w| sums.part(points, w[0].1, w[0].0, w[1].0)).collect()
}

/// The same where up to so many points between two parts may belong to neither, for the price of a line.
pub(crate) fn partition_with_gaps(
    points: &[[f64; 2]],
    weights: &[f64],
    penalty: &Penalty,
    most: usize,
) -> Vec<Part> {
    let sums = Sums::new(points, weights);
    let gap = most.div_ceil(penalty.stride(points.len()));
    let stretches = cheapest(&sums, points.len(), penalty, if most == 0 { 0 } else { gap }, None);
    stretches.into_iter().map(|s| sums.part(points, s.kind, s.from, s.to)).collect()
}

/// Cost of a free curve along the row, in units of the noise's variance.
pub(crate) struct FreeCost {
    /// Each part that is one.
    pub each: f64,
    /// Sums over the points before each: the squares of their distances, and the unknowns.
    pub before: Vec<f64>,
}

/// The kinds of the parts of a partition in which parts of this free curve are one kind more.
pub(crate) fn kinds_with_free(
    points: &[[f64; 2]],
    weights: &[f64],
    penalty: &Penalty,
    free: &FreeCost,
) -> Vec<SegmentKind> {
    let sums = Sums::new(points, weights);
    cheapest(&sums, points.len(), penalty, 0, Some(free)).into_iter().map(|s| s.kind).collect()
}

/// A part by its kind and its points alone.
struct Stretch {
    from: usize,
    to: usize,
    kind: SegmentKind,
}

impl Penalty {
    /// Every so many points a part may start.
    fn stride(&self, count: usize) -> usize {
        count.div_ceil(self.places.max(1)).max(1)
    }
}

/// The parts of a partition, with gaps of up to so many points between them; with parts of a free curve where there is one.
fn cheapest(sums: &Sums, n: usize, penalty: &Penalty, gap: usize, free: Option<&FreeCost>) -> Vec<Stretch> {
    let stride = penalty.stride(n);
    let last = n / stride;
    let index = |k: usize| if k == last { n } else { k * stride };
    let variance = penalty.noise * penalty.noise;
    let fewest = penalty.fewest.max(2);
    // The least cost of the parts before a place. The last of them ends there, or up to a gap before.
    let mut best = vec![f64::INFINITY; last + 1];
    let mut entered = vec![(f64::INFINITY, 0); last + 1];
    let mut from = vec![(0, SegmentKind::Line); last + 1];
    (best[0], entered[0]) = (0.0, (0.0, 0));
    let mut starts: Vec<usize> = vec![];
    let mut costs: Vec<f64> = vec![];
    // Where a part of the free curve starts best, and the cost of the parts before it without the curve's share there.
    let mut free_start = (f64::INFINITY, 0);
    for j in 1..=last {
        if entered[j - 1].0.is_finite() {
            starts.push(j - 1);
        }
        costs.clear();
        if let Some(free) = free {
            let before = entered[j - 1].0 - free.before[index(j - 1)];
            if before < free_start.0 {
                free_start = (before, j - 1);
            }
            best[j] = free_start.0 + free.before[index(j)] + free.each;
            from[j] = (free_start.1, SegmentKind::Spline);
        }
        for &i in &starts {
            let count = index(j) - index(i);
            let before = entered[i].0;
            let mut least = f64::NEG_INFINITY;
            if count >= fewest || last < 2 {
                let (line, arc) = sums.fit(index(i), index(j));
                least = line / variance;
                let cost = before + least + penalty.line;
                if cost < best[j] {
                    (best[j], from[j]) = (cost, (i, SegmentKind::Line));
                }
                if let Some((arc, _, _)) = arc.filter(|_| count > fewest) {
                    least = least.min(arc / variance);
                    let cost = before + arc / variance + penalty.arc;
                    if cost < best[j] {
                        (best[j], from[j]) = (cost, (i, SegmentKind::Arc));
                    }
                }
            }
            costs.push(before + least);
        }
        entered[j] = (best[j], j);
        for end in j.saturating_sub(gap)..j {
            if best[end] + penalty.line < entered[j].0 {
                entered[j] = (best[end] + penalty.line, end);
            }
        }
        // A start dearer than the best end, without any penalty, stays dearer: sums of squares only grow.
        let limit = best[j];
        let mut k = 0;
        starts.retain(|_| {
            k += 1;
            costs[k - 1] <= limit
        });
    }
    let mut all = vec![];
    let mut j = entered[last].1;
    while j > 0 {
        let (i, kind) = from[j];
        all.push(Stretch { from: index(i), to: index(j), kind });
        j = entered[i].1;
    }
    all.reverse();
    all
}

/// Moves the starts of parts, each with its kind, that were looked for at every `stride`-th point alone to the best
/// point between. Short parts that are dear beside their neighbors go to these.
fn sharpen(sums: &Sums, breaks: &mut Vec<(usize, SegmentKind)>, stride: usize, penalty: &Penalty) {
    let fewest = penalty.fewest.max(2);
    let cost = |from: usize, to: usize, kind: SegmentKind| match (kind, sums.fit(from, to)) {
        (SegmentKind::Line, (line, _)) | (_, (line, None)) => line,
        (_, (_, Some((arc, _, _)))) => arc,
    };
    // The best place between two for the start of the second of two parts, and the cost of both.
    let best =
        |(a, before): (usize, SegmentKind), (c, after): (usize, SegmentKind), low: usize, high: usize| {
            let sum = |at: usize| cost(a, at, before) + cost(at, c, after);
            let places = low.max(a + fewest)..=high.min(c.saturating_sub(fewest));
            places.map(|at| (at, sum(at))).min_by(|x, y| x.1.total_cmp(&y.1))
        };
    let move_all = |breaks: &mut [(usize, SegmentKind)]| {
        for k in 1..breaks.len() - 1 {
            let [a, (at, after), c] = [breaks[k - 1], breaks[k], breaks[k + 1]];
            let now = cost(a.0, at, a.1) + cost(at, c.0, after);
            let found = best(a, (c.0, after), (at + 1).saturating_sub(stride), at + stride - 1);
            if let Some((best, _)) = found.filter(|(_, sum)| *sum < now) {
                breaks[k].0 = best;
            }
        }
    };
    move_all(breaks);
    let variance = penalty.noise * penalty.noise;
    let (mut k, count) = (1, breaks.len());
    while k + 2 < breaks.len() {
        let [a, b, c, d] = [k - 1, k, k + 1, k + 2].map(|i| breaks[i]);
        let own = if b.1 == SegmentKind::Line { penalty.line } else { penalty.arc };
        let now = cost(a.0, b.0, a.1) + cost(b.0, c.0, b.1) + cost(c.0, d.0, c.1) + own * variance;
        let without = if c.0 - b.0 <= 2 * stride { best(a, (d.0, c.1), b.0, c.0) } else { None };
        if let Some((at, _)) = without.filter(|(_, sum)| *sum <= now) {
            breaks[k + 1].0 = at;
            breaks.remove(k);
        } else {
            k += 1;
        }
    }
    if breaks.len() < count {
        move_all(breaks);
    }
}
