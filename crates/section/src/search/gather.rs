//! Free curves in place of runs of the lines and arcs of a first partition.
//!
//! The partition knows no free curves: each is many lines and arcs there. A run of these is gathered to one free piece
//! where a B-spline by itself costs less than they do. Dynamic programming finds the cheapest row of those left alone
//! and those gathered.

use super::model_edits::PlacedModel;
use super::parts::Sums;
use super::rounds::Search;
use crate::model::chain::SegmentKind;
use crate::model::criterion::PieceSpec;
use crate::model::free;
use trueness_geom::spline::curve::chord_parameters;

/// Coefficients of free pieces that are tried.
const GATHERED_COUNTS: [usize; 16] =
    [3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 17, 20, 24, 29, 38, free::MAX_COEFFICIENTS];
/// More lines and arcs are not gathered: time grows with the square of their number.
const MAX_PARTS_TO_GATHER: usize = 150;
/// A curve does not follow points that it lies off by so many times their variance in the mean.
const MAX_MEAN_SQUARE_VARIANCES: f64 = 9.0;

/// A free piece over a run of parts.
#[derive(Clone, Copy)]
struct Run {
    cost: f64,
    /// The first part, and the coefficients; of a part that is left alone none.
    from: usize,
    count: usize,
}

impl Search<'_> {
    /// The pieces of the base with runs gathered to free ones, where each of these is between lines and arcs that stay; else `None`.
    pub fn gathered(&self, placed: &PlacedModel) -> Option<Vec<PieceSpec>> {
        let (specs, m) = (&placed.specs, placed.specs.len());
        if m > MAX_PARTS_TO_GATHER {
            return None;
        }
        let (n, first) = (self.row.points.len(), placed.model.state.breaks[0]);
        let order: Vec<usize> = (0..n).map(|i| (first + i) % n).collect();
        let points: Vec<[f64; 2]> = order.iter().map(|i| self.row.points[*i]).collect();
        let weights: Vec<f64> = order.iter().map(|i| self.row.weights[*i]).collect();
        let sums = Sums::new(&points, &weights);
        let mut limits: Vec<usize> =
            specs.iter().map(|p| placed.order.partition_point(|s| *s < p.from)).chain([n]).collect();
        limits[0] = 0;
        let variance = self.criterion.noise.max(self.criterion.resolution).powi(2);
        let each = libm::log(self.criterion.count);
        // A join is two unknowns, as the criterion counts them.
        let alone = |k: usize| {
            let (line, arc) = sums.fit(limits[k], limits[k + 1]);
            match (specs[k].kind, arc) {
                (SegmentKind::Arc, Some((arc, ..))) => arc / variance + 4.0 * each,
                _ => line / variance + 2.0 * each,
            }
        };
        let mut best: Vec<Run> = vec![Run { cost: f64::INFINITY, from: 0, count: 0 }; m + 1];
        best[0].cost = 0.0;
        for i in 0..m {
            let before = best[i].cost;
            let mut offer = |to: usize, cost: f64, count: usize| {
                if before + cost < best[to].cost {
                    best[to] = Run { cost: before + cost, from: i, count };
                }
            };
            offer(i + 1, alone(i), 0);
            let mut level = 0;
            for to in i + 2..=m {
                let kept = (limits[i]..limits[to]).filter(|k| weights[*k] > 0.0);
                let own: Vec<[f64; 2]> = kept.map(|k| points[k]).collect();
                let weight = weights[limits[i]..limits[to]].iter().sum::<f64>() / own.len().max(1) as f64;
                let Some(parameters) = chord_parameters(&own).filter(|p| p.iter().all(|t| t.is_finite()))
                else {
                    break;
                };
                let cost = |level: usize| {
                    let count = *GATHERED_COUNTS.get(level)?;
                    let sum = self.off_curve(&own, &parameters, count + 2)?.1;
                    Some((sum * weight / variance, (count as f64 + 3.5) * each))
                };
                let Some(mut now) = cost(level) else { break };
                while let Some(next) = cost(level + 1).filter(|next| next.0 + next.1 < now.0 + now.1) {
                    (now, level) = (next, level + 1);
                }
                if now.0 > MAX_MEAN_SQUARE_VARIANCES * own.len() as f64 * weight {
                    break;
                }
                offer(to, now.0 + now.1, GATHERED_COUNTS[level]);
            }
        }
        let mut all = vec![];
        let mut to = m;
        while to > 0 {
            let Run { from, count, .. } = best[to];
            let (start, end) = (specs[from].from, specs[to - 1].to);
            all.push(match count {
                0 => specs[from],
                _ => PieceSpec { kind: SegmentKind::Spline, count, from: start, to: end },
            });
            to = from;
        }
        all.reverse();
        // Where free pieces join, joins are where those of lines and arcs happened to be.
        let is_free = |p: &PieceSpec| p.kind == SegmentKind::Spline;
        let joined = all.windows(2).any(|w| w.iter().all(is_free));
        (all.iter().any(is_free) && !all.iter().all(is_free) && !joined).then_some(all)
    }
}
