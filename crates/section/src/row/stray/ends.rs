//! A stray point beside an end of a row, a few distances between points off where the row ends.
//!
//! One point alone is no evidence of a segment of the part where the rest of the row is dense. The points next to the
//! end lie on a curve, which tells where the next one may lie, and their steps tell how far off. A point beyond both is
//! stray in a row that was measured, as steps of a scan are alike. In a row without noise it may be the far end of a
//! line that is given by its ends: there it is doubted.

use super::limits::{BENT_TURN_SHARE, FAR_STEP_RATIO, MIN_POINTS_TO_TELL_STRAYS, STRAIGHT_TURN};
use crate::model::flat::distance;
use crate::search::parts::{noise, noise_beyond_form};

/// So many points next to an end tell how the row goes on.
const POINTS_BESIDE_END: usize = 6;
/// A step to a stray is at least so many times as long as the longest between them.
const MIN_STRAY_STEP_RATIO: f64 = 1.5;
/// A stray lies off the curve through them by more standard deviations of the noise than this.
const STRAY_SIGMAS: f64 = 8.0;
/// A point is doubted from so many standard deviations on.
const DOUBTFUL_END_SIGMAS: f64 = 3.0;
/// The points next to an end agree to so many standard deviations, or to this share of their steps: so far a parabola
/// lies off an arc.
const AGREEING_SIGMAS_AND_SHARE: (f64, f64) = (3.0, 0.05);
/// They are dense where their curve turns by less than this, radians: a parabola tells it.
const MAX_WINDOW_TURN: f64 = 1.0;
/// Rows with less noise than this share of the distance between points were not measured.
const MIN_NOISE_OF_MEASURED_ROW: f64 = 1e-3;

/// The verdict on the last point of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum End {
    Sound,
    Doubtful,
    Stray,
}

/// The scatter of a row's points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scatter {
    sigma: f64,
    /// Points are followed at this step.
    step: usize,
    beyond_form: f64,
}

impl Scatter {
    pub fn of(row: &[[f64; 2]]) -> Scatter {
        if row.len() < MIN_POINTS_TO_TELL_STRAYS[0] + POINTS_BESIDE_END {
            return Scatter { sigma: 0.0, step: 1, beyond_form: 0.0 };
        }
        let (sigma, step) = noise(row, false);
        let thinned: Vec<[f64; 2]> = row.iter().step_by(step).copied().collect();
        Scatter { sigma, step, beyond_form: noise_beyond_form(&thinned, false) }
    }
}

/// The verdict on the first point of a row.
pub(super) fn judge_first(row: &[[f64; 2]], scatter: Scatter) -> End {
    let next: Vec<[f64; 2]> =
        row.iter().skip(1).step_by(scatter.step).take(POINTS_BESIDE_END).copied().collect();
    if row.len() < MIN_POINTS_TO_TELL_STRAYS[0] + POINTS_BESIDE_END || next.len() < POINTS_BESIDE_END {
        return End::Sound;
    }
    let tip = row[0];
    let longest = next.windows(2).map(|w| distance(w[0], w[1])).fold(0.0, f64::max);
    let step = distance(tip, next[0]);
    // A closed row comes back to its other end.
    let rest = row[1..].windows(2).map(|w| distance(w[0], w[1])).fold(0.0, f64::max);
    let closes = distance(tip, row[row.len() - 1]) <= FAR_STEP_RATIO * rest;
    let measured = scatter.beyond_form > MIN_NOISE_OF_MEASURED_ROW * longest;
    // Curves without noise bend faster toward an end: of 20,000 profiles of four digits none left its nose by more than 0.47.
    let least = if measured { 0.0 } else { BENT_TURN_SHARE };
    let by = |deviations: f64| leaves(tip, &next, longest, [scatter.sigma, deviations], least);
    if step < MIN_STRAY_STEP_RATIO * longest || closes || !by(DOUBTFUL_END_SIGMAS) {
        return End::Sound;
    }
    if measured && step >= FAR_STEP_RATIO * longest && by(STRAY_SIGMAS) { End::Stray } else { End::Doubtful }
}

/// Whether a point lies off where the curve of those
/// `next` to it leads, by so many standard deviations. The curve goes straight on, or on with up to twice its curvature. The point lies off by an angle of more than `least`,
/// too.
fn leaves(tip: [f64; 2], next: &[[f64; 2]], longest: f64, [sigma, deviations]: [f64; 2], least: f64) -> bool {
    let (near, far) = (next[0], next[next.len() - 1]);
    let length = distance(far, near);
    if length == 0.0 {
        return false;
    }
    let (c, s) = ((near[0] - far[0]) / length, (near[1] - far[1]) / length);
    let local = |p: [f64; 2]| {
        let d = [p[0] - near[0], p[1] - near[1]];
        [c * d[0] + s * d[1], c * d[1] - s * d[0]]
    };
    let (mut a, mut b) = (vec![vec![0.0; 3]; 3], vec![0.0; 3]);
    let all: Vec<[f64; 2]> = next.iter().map(|p| local(*p)).map(|p| p.map(|x| x / length)).collect();
    for [t, y] in &all {
        let row = [1.0, *t, t * t];
        for i in 0..3 {
            (0..3).for_each(|j| a[i][j] += row[i] * row[j]);
            b[i] += row[i] * y;
        }
    }
    let Some(x) = trueness_geom::num::dense::solve(a.clone(), b) else { return false };
    let sum: f64 = all.iter().map(|[t, y]| (y - x[0] - x[1] * t - x[2] * t * t).powi(2)).sum();
    let rest = length * (sum / (all.len() - 3) as f64).sqrt();
    let window = libm::atan(x[1]) - libm::atan(x[1] - 2.0 * x[2]);
    if rest > (AGREEING_SIGMAS_AND_SHARE.0 * sigma).max(AGREEING_SIGMAS_AND_SHARE.1 * longest)
        || window.abs() > MAX_WINDOW_TURN
    {
        return false;
    }
    let [along, across] = local(tip);
    let (to, heading) = ([along, across - x[0] * length], libm::atan(x[1]));
    let off = libm::hypot(to[0], to[1]);
    let turned = (libm::atan2(to[1], to[0]) - heading).rem_euclid(std::f64::consts::TAU);
    let turned = if turned > std::f64::consts::PI { turned - std::f64::consts::TAU } else { turned };
    // A chord turns by half as much as its arc.
    let bend = x[2] / length / libm::pow(1.0 + x[1] * x[1], 1.5) * off;
    // As far from the points the parabola, bent half as much, is as uncertain as its coefficients are together.
    let t = off / length;
    let at = [1.0, t, 0.5 * t * t];
    let Some(moved) = trueness_geom::num::dense::solve(a, at.to_vec()) else { return false };
    let variance = 1.0 + (0..3).map(|i| at[i] * moved[i]).sum::<f64>();
    let uncertain = deviations * sigma.max(rest) * variance.sqrt() / off;
    (turned - bend).abs() > (bend.abs() + STRAIGHT_TURN + uncertain).max(least)
}
