//! Where a face is cut open.

use super::chart::Chart;
use super::ring::{Piece, Ring};

/// The cuts that are compared at most.
const MAX_CANDIDATES: usize = 6;
/// A cut keeps this share of the distance from corners that it could keep: next to one it would be met by chance.
const LEAST_SHARE: f64 = 0.2;
/// A gap between edges narrower than this share of a period may be rounding.
const LEAST_GAP: f64 = 1e-9;

/// A value that is crossed by as few edges as can be, far from corners.
pub fn best_cut(chart: &Chart, k: usize, period: f64, rings: &[Ring]) -> f64 {
    let first = chart.domain[k][0];
    let reduced = |x: f64| x - period * ((x - first) / period).floor();
    // From the start of each covered part to its end, and all corners.
    let mut covered: Vec<[f64; 2]> = vec![];
    let mut corners: Vec<f64> = vec![];
    let mut is_around = false;
    for ring in rings {
        let xs = || ring.pieces.iter().flat_map(Piece::places).map(|(at, band)| (at[k], band[k]));
        let low = xs().map(|(x, b)| x - b).fold(f64::INFINITY, f64::min);
        let high = xs().map(|(x, b)| x + b).fold(f64::NEG_INFINITY, f64::max);
        is_around |= high - low >= period || ring.winding[k] != 0;
        covered.push([reduced(low), reduced(low) + (high - low)]);
        corners.extend(ring.pieces.iter().map(|p| reduced(p.ends()[0][k])));
    }
    if corners.is_empty() {
        return first;
    }
    if let Some(c) = uncovered(covered, period).filter(|_| !is_around) {
        return c;
    }
    corners.sort_by(f64::total_cmp);
    let after = corners.iter().skip(1).copied().chain([corners[0] + period]);
    let mut gaps: Vec<[f64; 2]> = corners.iter().zip(after).map(|(a, b)| [b - a, 0.5 * (a + b)]).collect();
    gaps.sort_by(|a, b| b[0].total_cmp(&a[0]));
    gaps.truncate(MAX_CANDIDATES);
    let least = LEAST_SHARE * gaps[0][0];
    gaps.retain(|g| g[0] >= least);
    let count = |c: f64| -> usize {
        let index = |at: [f64; 2]| ((at[k] - c) / period).floor();
        let of = |piece: &Piece| piece.places().windows(2).filter(|w| index(w[0].0) != index(w[1].0)).count();
        rings.iter().flat_map(|r| &r.pieces).map(of).sum()
    };
    gaps.iter().map(|g| (count(g[1]), g[1])).min_by_key(|(n, _)| *n).map_or(first, |(_, c)| c)
}

/// The middle of the widest gap between covered parts of a circle.
fn uncovered(mut covered: Vec<[f64; 2]>, period: f64) -> Option<f64> {
    covered.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut reach = covered.iter().map(|c| c[1] - period).fold(f64::NEG_INFINITY, f64::max);
    let mut best = [0.0, 0.0];
    for [low, high] in covered {
        if low - reach > best[0] {
            best = [low - reach, 0.5 * (low + reach)];
        }
        reach = reach.max(high);
    }
    (best[0] > LEAST_GAP * period).then_some(best[1])
}
