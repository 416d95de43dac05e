//! Fits that outliers do not pull: a start from random trials, then the biweight.
//!
//! Each trial fits few random points. Its measure is the median distance of a sample of all points, which stays meaningful as
//! long as less than half of them are outliers. (P. J. Rousseeuw, "Least median of squares regression", JASA 79, 1984.) From
//! the best trial on, the sum of J. W. Tukey's biweight is minimized. Its weights fall to zero at 4.685 standard deviations,
//! which keeps 95 % of the efficiency of least squares on normal noise.

use super::family::{Element, Family};
use super::gauss::{FULL, ROUGH, minimize};
use super::gaussian;
use super::normal::{Placing, Weighing};
use super::sample::Sample;
use super::solution::{Fit, Residuals};
use super::{FitError, Kind, Options};
use crate::num::random::Random;
use crate::progress::Progress;
use crate::space::Point;
use crate::stats::SIGMA_OVER_MAD;

/// Points that trials are judged by.
const JUDGING_POINTS: usize = 512;
/// Points that the standard deviation is found from.
const DEVIATION_POINTS: usize = 8192;
/// Most trials: enough for 40 % outliers and nine points a trial.
const MAX_TRIALS: usize = 700;
/// Standard deviations beyond which a point has no weight.
const BIWEIGHT_CUTOFF: f64 = 4.685;

/// The biweight: c²/3·(1 − (1 − d²/c²)³) up to the cutoff c, constant beyond.
struct Biweight {
    /// 1/c².
    sharpness: f64,
}

impl Biweight {
    /// 1 − d²/c², not below zero.
    #[inline(always)]
    fn rest(&self, d: f64) -> f64 {
        (1.0 - d * d * self.sharpness).max(0.0)
    }
}

impl Weighing for Biweight {
    const EVEN: bool = false;

    #[inline(always)]
    fn loss(&self, d: f64) -> f64 {
        let rest = self.rest(d);
        (1.0 - rest * rest * rest) * 1.0 / (3.0 * self.sharpness)
    }
    #[inline(always)]
    fn weight(&self, d: f64) -> f64 {
        let rest = self.rest(d);
        rest * rest
    }
}

/// The robust fit.
pub(super) fn robust<const P: usize, F: Family<P>>(
    sample: &Sample,
    kind: Kind,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Fit, FitError> {
    let start = match &options.start {
        Some(shape) => F::element(shape, sample).ok_or(FitError::WrongStart { kind })?,
        None => trials::<P, F>(sample, kind, options.seed, progress)?,
    };
    let subset = sample.thinned(DEVIATION_POINTS);
    let mut element = F::settled(start);
    let mut biweight = Biweight { sharpness: 1.0 };
    // The scale and the element settle together.
    for _ in 0..6 {
        let cutoff = BIWEIGHT_CUTOFF * SIGMA_OVER_MAD * median::<P, F>(&element, &subset);
        // Points without noise: anything off is an outlier, rounding is not.
        biweight.sharpness = cutoff.max(1e-13).powi(-2);
        let Some(better) = minimize::<P, F, _>(&element, &subset, &biweight, ROUGH) else { break };
        element = better.element;
    }
    if progress.cancelled() {
        return Err(FitError::Cancelled);
    }
    let optimum = minimize::<P, F, _>(&F::settled(element), sample, &biweight, FULL)
        .ok_or_else(|| gaussian::nothing(sample, kind))?;
    progress.advance(sample.len() as u64);
    let inverse = gaussian::determined(&optimum).ok_or_else(|| gaussian::nothing(sample, kind))?;
    let element = optimum.element;
    let cutoff = biweight.sharpness.sqrt().recip();
    let residuals =
        inliers::<P, F>(&element, sample, cutoff).ok_or_else(|| gaussian::nothing(sample, kind))?;
    let covariance = residuals
        .std_dev
        .and_then(|std_dev| gaussian::covariance::<P, F>(&element, &inverse, std_dev * sample.scale, sample));
    Ok(Fit {
        shape: F::shape(&element, sample),
        method: options.method,
        outliers: sample.len() - residuals.count,
        residuals,
        covariance,
        touching: Vec::new(),
        iterations: optimum.steps,
        converged: optimum.converged,
    })
}

/// The best element of random trials and of all points.
fn trials<const P: usize, F: Family<P>>(
    sample: &Sample,
    kind: Kind,
    seed: u64,
    progress: &dyn Progress,
) -> Result<Element, FitError> {
    let judging = sample.thinned(JUDGING_POINTS);
    let judged = |element: Element| (median::<P, F>(&element, &judging), element);
    let mut best = gaussian::quick::<P, F>(&judging).map(judged);
    let mut random = Random::new(seed);
    let each = (P + 2).min(sample.len());
    let mut enough = MAX_TRIALS;
    let mut trial = 0;
    while trial < enough {
        trial += 1;
        if progress.cancelled() {
            return Err(FitError::Cancelled);
        }
        let points: Vec<Point> =
            random.choose(each, sample.len()).into_iter().map(|k| sample.points[k]).collect();
        let drawn = sample.with(points.into());
        let Some(found) = gaussian::quick::<P, F>(&drawn).map(judged) else { continue };
        if best.as_ref().is_none_or(|b| found.0 < b.0) {
            let near = 3.0 * SIGMA_OVER_MAD * found.0;
            let share = share_within::<P, F>(&found.1, &judging, near);
            let clean = share.powi(each as i32);
            // So many that with 99.9 % one of them had no outlier.
            let needed = (libm::log(0.001f64) / libm::log(1.0 - clean)).ceil();
            enough = MAX_TRIALS.min(needed.max(8.0) as usize);
            best = Some(found);
        }
    }
    best.map(|b| b.1).ok_or_else(|| gaussian::nothing(sample, kind))
}

/// Magnitudes of the distances, in the unit frame.
fn magnitudes<const P: usize, F: Family<P>>(element: &Element, sample: &Sample) -> Vec<f64> {
    let placing = Placing::new(element, sample);
    sample.points.iter().map(|&p| F::distance(element.size, placing.local(p)).abs()).collect()
}

/// Median magnitude of the distances.
fn median<const P: usize, F: Family<P>>(element: &Element, sample: &Sample) -> f64 {
    let mut all = magnitudes::<P, F>(element, sample);
    crate::num::median::median(&mut all).unwrap_or(0.0)
}

fn share_within<const P: usize, F: Family<P>>(element: &Element, sample: &Sample, near: f64) -> f64 {
    let all = magnitudes::<P, F>(element, sample);
    all.iter().filter(|&&d| d <= near).count() as f64 / all.len() as f64
}

/// Statistics of the points within the cutoff; `None` if there are none.
fn inliers<const P: usize, F: Family<P>>(
    element: &Element,
    sample: &Sample,
    cutoff: f64,
) -> Option<Residuals> {
    let placing = Placing::new(element, sample);
    let (mut count, mut square) = (0, 0.0);
    let mut min = (f64::INFINITY, 0);
    let mut max = (f64::NEG_INFINITY, 0);
    for (index, &p) in sample.points.iter().enumerate() {
        let d: f64 = F::distance(element.size, placing.local(p));
        if d.abs() <= cutoff {
            count += 1;
            square += d * d;
            if d < min.0 {
                min = (d, index);
            }
            if d > max.0 {
                max = (d, index);
            }
        }
    }
    (count > 0).then(|| gaussian::statistics::<P, F>(sample, count, square, min, max))
}
