//! From checked points to a least-squares [`Fit`]: starts, choice among them, all points, statistics.

use super::family::{Element, Family};
use super::gauss::{Effort, FULL, NEAR, Optimum, ROUGH, minimize};
use super::normal::{Alike, sums};
use super::sample::Sample;
use super::scatter::Scatter;
use super::solution::{Covariance, Fit, Residuals};
use super::{FitError, Kind, Options, Shape, hardly, survey};
use crate::num::dense;
use crate::progress::Progress;
use crate::shape::MAX_SHAPE_NUMBERS;
use crate::space::{Point, plus, times};

/// Points that starts are looked for and compared on.
const STARTING_POINTS: usize = 256;
/// Points that a single start is improved on first: it is not compared with others.
const SINGLE_START_POINTS: usize = 64;
/// Points that a start is improved on before all are looked at.
const IMPROVING_POINTS: usize = 8192;

/// Distance from a corner of the distances, in the unit frame, up to which a point may belong there.
const CORNER_REACH: f64 = 0.1;

/// Root mean square distance in the unit frame from which on a minimum may be a wrong one.
const POOR_FIT_RMS: f64 = 5e-3;

/// The least-squares fit.
pub(super) fn gaussian<const P: usize, F: Family<P>>(
    sample: &Sample,
    kind: Kind,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Fit, FitError> {
    let (optimum, inverse) = optimum::<P, F>(sample, kind, options, progress)?;
    progress.advance(sample.len() as u64);
    let element = optimum.element;
    let residuals = residuals::<P, F>(&element, sample);
    let linear = inverse.and_then(|inverse| {
        covariance::<P, F>(&element, &inverse, residuals.std_dev? * sample.scale, sample)
    });
    let is_bent = hardly::is_bent::<P, F>(&element, sample, residuals.rms * sample.scale);
    let tried = if is_bent { hardly::covariance::<P, F>(&element, sample) } else { None };
    if inverse.is_none() && tried.is_none() {
        return Err(nothing(sample, kind));
    }
    let covariance = tried.or(linear);
    Ok(Fit {
        shape: F::shape(&element, sample),
        method: options.method,
        residuals,
        covariance,
        touching: Vec::new(),
        outliers: 0,
        iterations: optimum.steps,
        converged: optimum.converged,
    })
}

/// An element near the best one: the best of some of the points.
pub(super) fn near<const P: usize, F: Family<P>>(
    sample: &Sample,
    kind: Kind,
    options: &Options,
) -> Result<Element, FitError> {
    let subset = sample.thinned(IMPROVING_POINTS);
    let (optimum, inverse) = optimum::<P, F>(&subset, kind, options, &crate::progress::Silent)?;
    inverse.map(|_| optimum.element).ok_or_else(|| nothing(&subset, kind))
}

/// An optimum, and the inverse of its normal matrix if it has one.
type Determined<const P: usize> = (Optimum<P>, Option<[[f64; P]; P]>);

/// The element with the least sum of squares.
pub(super) fn optimum<const P: usize, F: Family<P>>(
    sample: &Sample,
    kind: Kind,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Determined<P>, FitError> {
    let starts = match &options.start {
        Some(shape) => vec![F::element(shape, sample).ok_or(FitError::WrongStart { kind })?],
        None => F::starts(&sample.thinned(STARTING_POINTS).units().collect::<Vec<Point>>()),
    };
    let best = best_of::<P, F>(&starts, sample).ok_or_else(|| nothing(sample, kind))?;
    if progress.cancelled() {
        return Err(FitError::Cancelled);
    }
    let best = F::settled(best);
    let mut optimum = local_minimum::<P, F>(&best, sample, FULL).ok_or_else(|| nothing(sample, kind))?;
    let settled = F::settled(optimum.element);
    if settled != optimum.element {
        // The sums belong to the frame they were taken in.
        optimum.element = settled;
        optimum.sums = sums::<P, F, _>(&settled, sample, &Alike);
    }
    Ok((optimum, determined(&optimum)))
}

/// The local minimum reached from `start`, or the corner beside it if that is lower.
fn local_minimum<const P: usize, F: Family<P>>(
    start: &Element,
    sample: &Sample,
    effort: Effort,
) -> Option<Optimum<P>> {
    let from = |start: &Element| minimize::<P, F, _>(start, sample, &Alike, effort);
    let smooth = from(start)?;
    let corner = hardly::corner::<P, F>(&smooth.element, sample, CORNER_REACH).and_then(|start| from(&start));
    Some(corner.filter(|c| c.sums.square < smooth.sums.square).unwrap_or(smooth))
}

/// The least-squares element of the few points given, good enough to be compared with others.
pub(super) fn quick<const P: usize, F: Family<P>>(sample: &Sample) -> Option<Element> {
    let starts = F::starts(&sample.units().collect::<Vec<Point>>());
    let ends = starts.iter().filter_map(|start| minimize::<P, F, _>(start, sample, &Alike, ROUGH));
    ends.min_by(|a, b| a.sums.square.total_cmp(&b.sums.square)).map(|o| o.element)
}

/// The least-squares element near `start` to seven digits, and the root mean square distance: for those who fit again and
/// again while their points change.
pub(super) fn improved<const P: usize, F: Family<P>>(sample: &Sample, start: &Shape) -> Option<(Shape, f64)> {
    let start = F::element(start, sample)?;
    let found = local_minimum::<P, F>(&start, sample, ROUGH)?;
    let element = F::settled(found.element);
    let rms = (found.sums.square / found.sums.weight).sqrt() / sample.scale;
    Some((F::shape(&element, sample), rms))
}

/// The best of the starts, improved on as many points as that needs.
fn best_of<const P: usize, F: Family<P>>(starts: &[Element], sample: &Sample) -> Option<Element> {
    let improved = |start: &Element, count: usize, effort: Effort| {
        minimize::<P, F, _>(start, &sample.thinned(count), &Alike, effort)
    };
    let best = match starts {
        [one] if sample.len() <= 2 * SINGLE_START_POINTS => *one,
        [one] => improved(one, SINGLE_START_POINTS, NEAR).map_or(*one, |o| o.element),
        many => {
            let subset = sample.thinned(STARTING_POINTS);
            let best = |starts: &[Element]| {
                let ends =
                    starts.iter().filter_map(|start| minimize::<P, F, _>(start, &subset, &Alike, ROUGH));
                ends.min_by(|a, b| a.sums.square.total_cmp(&b.sums.square))
            };
            let first = best(many);
            if first.is_some_and(|o| o.sums.square <= POOR_FIT_RMS * POOR_FIT_RMS * subset.len() as f64) {
                first?.element
            } else {
                let further = best(&F::more_starts(&subset.units().collect::<Vec<Point>>()));
                let both = first.into_iter().chain(further);
                both.min_by(|a, b| a.sums.square.total_cmp(&b.sums.square))?.element
            }
        }
    };
    if sample.len() <= 2 * IMPROVING_POINTS {
        return Some(best);
    }
    Some(improved(&best, IMPROVING_POINTS, ROUGH).map_or(best, |o| o.element))
}

/// The inverse of the normal matrix; `None` if a distance the size of rounding could move an unknown by the size of the
/// part.
pub(super) fn determined<const P: usize>(optimum: &Optimum<P>) -> Option<[[f64; P]; P]> {
    /// Gain at which a distance of the size of rounding moves an unknown by 1e-4 of the size of the part.
    const MAX_ROUNDING_GAIN: f64 = 1e-4 / f64::EPSILON;
    let firm = |variance: f64| (variance * optimum.sums.weight).sqrt() < MAX_ROUNDING_GAIN;
    dense::inverse(&optimum.sums.symmetric()).filter(|inverse| (0..P).all(|k| firm(inverse[k][k])))
}

/// The reason why there is no element.
pub(super) fn nothing(sample: &Sample, kind: Kind) -> FitError {
    let scatter = Scatter::of(&sample.units().collect::<Vec<Point>>());
    let width = (scatter.variance[1].max(0.0) / scatter.variance[2]).sqrt();
    if width < 1e4 * f64::EPSILON { FitError::Collinear { kind } } else { FitError::Undetermined { kind } }
}

/// Statistics of the distances of all points.
pub(super) fn residuals<const P: usize, F: Family<P>>(element: &Element, sample: &Sample) -> Residuals {
    let extremes = survey::extremes::<P, F>(element, sample);
    statistics::<P, F>(sample, sample.len(), extremes.square, extremes.least, extremes.greatest)
}

/// Statistics from sums and extremes in the unit frame.
pub(super) fn statistics<const P: usize, F: Family<P>>(
    sample: &Sample,
    count: usize,
    square: f64,
    min: (f64, usize),
    max: (f64, usize),
) -> Residuals {
    let size = 1.0 / sample.scale;
    let distances = if F::SIGNED { count } else { 2 * count };
    let left = distances.saturating_sub(P);
    Residuals {
        count,
        rms: (square / count as f64).sqrt() * size,
        std_dev: (left > 0).then(|| (square / left as f64).sqrt() * size),
        min: (min.0 * size, min.1),
        max: (max.0 * size, max.1),
        form_error: if F::SIGNED { max.0 - min.0 } else { 2.0 * max.0 } * size,
    }
}

/// Covariance of the parameters from the inverse of the normal matrix of the unknowns of `element`. The standard deviation of
/// one distance in the unit frame scales it. Differences of one standard deviation of each unknown carry it over.
///
/// Along its free axes an element is given at the foot of the mean of all n points. The mean is uncertain by the standard
/// deviation over √n, noise being the same in all directions. The foot moves with the axis, if the mean lies off it.
pub(super) fn covariance<const P: usize, F: Family<P>>(
    element: &Element,
    inverse: &[[f64; P]; P],
    std_dev: f64,
    sample: &Sample,
) -> Option<Covariance> {
    let size = F::shape(element, sample).flattened().1;
    let numbers = |step: [f64; P]| -> Option<[f64; MAX_SHAPE_NUMBERS]> {
        Some(F::shape(&element.nudged(&F::LOCAL, &step)?, sample).flattened().0)
    };
    let mut slopes = [[0.0; MAX_SHAPE_NUMBERS]; P];
    for k in 0..P {
        let h = (std_dev * inverse[k][k].sqrt()).clamp(1e-9, 1e-4);
        let at = |h: f64| numbers(std::array::from_fn(|i| if i == k { h } else { 0.0 }));
        let (more, less) = (at(h)?, at(-h)?);
        slopes[k] = std::array::from_fn(|n| (more[n] - less[n]) / (2.0 * h));
    }
    // inverse · slopes
    let mut inverse_slopes = [[0.0; MAX_SHAPE_NUMBERS]; P];
    for a in 0..P {
        for b in 0..P {
            for n in 0..size {
                inverse_slopes[a][n] += inverse[a][b] * slopes[b][n];
            }
        }
    }
    let mut values = vec![0.0; size * size];
    for (i, row) in values.chunks_mut(size).enumerate() {
        for a in 0..P {
            for (n, value) in row.iter_mut().enumerate() {
                *value += slopes[a][i] * inverse_slopes[a][n] * (std_dev * std_dev);
            }
        }
    }
    let h = std_dev.clamp(1e-9, 1e-4);
    let answer = F::answer(element.size);
    for &axis in F::FREE {
        let at = |h: f64| {
            let mut there = sample.with(std::borrow::Cow::Borrowed(&sample.points));
            there.station = plus(there.station, times(h, element.pose.axes[axis]));
            F::shape(element, &there).flattened().0
        };
        let (more, less) = (at(h), at(-h));
        let slope: [f64; MAX_SHAPE_NUMBERS] = std::array::from_fn(|n| (more[n] - less[n]) / (2.0 * h));
        // The unknowns follow the mean, where they do, so that the two are not independent.
        let with: [f64; MAX_SHAPE_NUMBERS] =
            std::array::from_fn(|n| (0..P).map(|a| answer[a] * slopes[a][n]).sum());
        let variance = std_dev * std_dev / sample.len() as f64;
        for (i, row) in values.chunks_mut(size).enumerate() {
            for (n, value) in row.iter_mut().enumerate() {
                *value += variance * (slope[i] * slope[n] + slope[i] * with[n] + with[i] * slope[n]);
            }
        }
    }
    Some(Covariance { size, values })
}
