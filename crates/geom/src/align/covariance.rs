//! The covariance of a best fit.

use super::freedom::HELD_MOTION_SHARE;
use super::icp::Match;
use super::system::{Six, SixBySix, Spectrum, System, eigen_six, padded, slope};
use super::twist::inner;
use crate::parallel::prelude::*;
use crate::space::{Point, minus};
use std::collections::BTreeMap;

/// Cells along the radius; residuals within one cell may go together.
const CELLS_PER_RADIUS: f64 = 4.0;
/// Matches added in one go: sums do not depend on the number of threads.
const MATCHES_PER_SUM: usize = 1 << 16;
/// Largest share of the hold on a motion that one cell may count for, where the others are asked without it.
const MAX_CELL_SHARE: f64 = 0.8;

/// The cell of a point.
pub(super) fn cell_of(point: Point, system: &System) -> [i64; 3] {
    minus(point, system.center).map(|x| (x * CELLS_PER_RADIUS / system.radius).floor() as i64)
}

/// The sums over one cell.
#[derive(Clone, Copy, Default)]
struct Cell {
    /// Sums of slopes times weights, with residuals and with themselves.
    score: Six,
    holds: SixBySix,
}

impl Cell {
    fn add(&mut self, other: &Cell) {
        for i in 0..6 {
            self.score[i] += other.score[i];
            (0..6).for_each(|j| self.holds[i][j] += other.holds[i][j]);
        }
    }
}

/// Covariance of the six unknowns: rotation vector about the center of the system, radians; translation, mm. It is zero along
/// directions that were taken out of the spectrum. Along those that are `barely` held it is at least the distance that they may
/// move.
///
/// Residuals of a part go together over some distance: form deviations and a scanner's errors are waves. Samples of one cell of
/// space are therefore taken for one observation. (Cluster-robust covariance: Liang, Zeger, Longitudinal data analysis using
/// generalized linear models, Biometrika 73, 1986.) That is right for independent residuals, and for correlated ones whose
/// range is below the cells' size, a quarter of the points' radius.
///
/// A fit draws its own residuals down, most where few cells hold a motion. Such are the cells of a wall at the rim of a view of
/// one side. The measure is therefore how far the fit moves when a cell is left out. (The jackknife: Bell, McCaffrey, Bias
/// reduction in standard errors for linear regression with multi-stage samples, Survey Methodology 28, 2002.)
pub(super) fn covariance(
    system: &System,
    spectrum: &Spectrum,
    matches: &[Match],
    barely: &[(Six, f64)],
) -> SixBySix {
    let cells = cells(system, matches);
    let count = cells.len() as f64;
    let mut out = [[0.0; 6]; 6];
    for cell in cells.values() {
        let moves = shift_without_cell(spectrum, cell);
        for i in 0..6 {
            for j in 0..6 {
                out[i][j] += moves[i] * moves[j] * (count - 1.0).max(1.0) / count;
            }
        }
    }
    let along = |m: &SixBySix, v: &Six| -> f64 {
        (0..6).flat_map(|i| (0..6).map(move |j| (i, j))).map(|(i, j)| v[i] * m[i][j] * v[j]).sum()
    };
    if !barely.is_empty() {
        // How many times the variance is that of independent residuals, along what is held well.
        let alone =
            |k: usize| system.rms() * system.rms() / system.count() * system.weight / spectrum.values[k];
        let held = (spectrum.stay..6).filter(|&k| spectrum.values[k] >= HELD_MOTION_SHARE * system.weight);
        let ratio = |k: usize| along(&out, &spectrum.vectors[k]) / alone(k);
        let ratios: Vec<f64> = held.map(ratio).filter(|ratio| ratio.is_finite()).collect();
        let together = (ratios.iter().sum::<f64>() / ratios.len().max(1) as f64).max(1.0);
        for (v, way) in barely {
            let more = (together * way * way - along(&out, v)).max(0.0);
            for i in 0..6 {
                for j in 0..6 {
                    out[i][j] += more * v[i] * v[j];
                }
            }
        }
    }
    let unit = |k: usize| if k < 3 { 1.0 / system.radius } else { 1.0 };
    for i in 0..6 {
        for j in 0..6 {
            out[i][j] *= unit(i) * unit(j);
        }
    }
    out
}

/// The sums over all cells.
fn cells(system: &System, matches: &[Match]) -> BTreeMap<[i64; 3], Cell> {
    let part = |matches: &[Match]| {
        let mut cells: BTreeMap<[i64; 3], Cell> = BTreeMap::new();
        for m in matches.iter().filter(|m| m.equation.weight > 0.0) {
            let e = &m.equation;
            let cell = cells.entry(cell_of(e.point, system)).or_default();
            let row = slope(e.point, e.away, system.center, system.radius);
            (0..6).for_each(|i| cell.score[i] += e.weight * row[i]);
            let row = slope(e.point, m.facet, system.center, system.radius);
            for i in 0..6 {
                (0..6).for_each(|j| cell.holds[i][j] += e.weight * row[i] * row[j]);
            }
        }
        cells
    };
    let parts: Vec<BTreeMap<[i64; 3], Cell>> = matches.par_chunks(MATCHES_PER_SUM).map(part).collect();
    let mut cells: BTreeMap<[i64; 3], Cell> = BTreeMap::new();
    for (key, cell) in parts.into_iter().flatten() {
        cells.entry(key).or_default().add(&cell);
    }
    cells
}

/// How far the fit moves when a cell is left out, to first order. That is the pose of the others alone, in the unknowns in
/// which all say 1.
fn shift_without_cell(spectrum: &Spectrum, cell: &Cell) -> Six {
    let first = spectrum.fixed;
    let free = 6 - first;
    let white = |k: usize| spectrum.vectors[first + k].map(|x| x / spectrum.values[first + k].sqrt());
    let score = |k: usize| inner(&white(k), &cell.score);
    let holds = |i: usize, j: usize| {
        let column: Six = std::array::from_fn(|r| inner(&cell.holds[r], &white(j)));
        inner(&white(i), &column)
    };
    let (shares, rows) = eigen_six(&padded(free, &holds));
    let mut moves = [0.0; 6];
    for k in 0..free {
        let along: f64 = (0..free).map(|i| rows[k][i] * score(i)).sum();
        let more = along / (1.0 - shares[k].clamp(0.0, MAX_CELL_SHARE));
        for i in 0..free {
            let white = white(i);
            (0..6).for_each(|d| moves[d] += more * rows[k][i] * white[d]);
        }
    }
    moves
}
