//! Elements that distances determine only in second order: a cone by its apex and one ring. Each small tilt of such a cone
//! moves the distances by its square, so the normal matrix has no inverse. Yet no other cone runs through the points.
//!
//! Trials show whether there is one element, and how certain it is. No fit from some way off ends elsewhere and as well. Fits
//! to the points with noise of the size found spread by the uncertainty.

use super::Kind;
use super::family::{Element, Family};
use super::gauss::{FULL, minimize};
use super::normal::Alike;
use super::sample::Sample;
use super::solution::Covariance;
use crate::num::random::Random;
use crate::shape::{MAX_SHAPE_NUMBERS, Quantity};
use crate::space::Point;
use std::borrow::Cow;

/// Fits that are tried: the spread of so many is known to a fifth.
const SPREAD_TRIALS: u64 = 16;
/// Most points among which one at a corner counts: among more it weighs nothing.
const MAX_POINTS_WITH_CORNER: usize = 1024;
/// Offset of those starts that show whether another element is as good, in each unknown of the unit frame. It is so many times
/// what noise hides in second order, between the limits below.
const START_OFFSET_NOISE: f64 = 100.0;
/// Least and greatest of these offsets.
const START_OFFSET_LIMITS: [f64; 2] = [2e-3, MAX_NUMBER_DEVIATION];
/// Share of that offset from which on a number belongs to another element.
const OTHER_ELEMENT_SHARE: f64 = 0.2;
/// Greatest residual of a fit to points with noise, over the noise.
const MAX_NOISE_RATIO: f64 = 8.0;
/// Root mean square distance in the unit frame that is as good as none: in a valley that flat a search ends above rounding.
const NO_DISTANCE_RMS: f64 = 1e-12;
/// Standard deviation of a number in the unit frame beyond which the points tell nothing of it.
const MAX_NUMBER_DEVIATION: f64 = 0.1;
/// Distances in the unit frame that rounding alone makes.
const UNIT_FRAME_ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Root mean square distances from a corner within which a point has no linear distance.
const NOT_LINEAR_RMS: f64 = 30.0;

/// The element with a corner at one of few points.
pub(super) fn corner<const P: usize, F: Family<P>>(
    element: &Element,
    sample: &Sample,
    within: f64,
) -> Option<Element> {
    if sample.len() <= MAX_POINTS_WITH_CORNER { F::at_corner(element, sample, within) } else { None }
}

/// Whether distances are not linear in the unknowns, as one of few points lies at a corner of theirs.
pub(super) fn is_bent<const P: usize, F: Family<P>>(element: &Element, sample: &Sample, rms: f64) -> bool {
    corner::<P, F>(element, sample, NOT_LINEAR_RMS * rms.max(UNIT_FRAME_ROUNDING)).is_some()
}

/// The covariance of the parameters of `element`; `None` if the points do not determine it.
pub(super) fn covariance<const P: usize, F: Family<P>>(
    element: &Element,
    sample: &Sample,
) -> Option<Covariance> {
    let points: Vec<Point> = sample.units().collect();
    let unit =
        Sample { points: Cow::Borrowed(&points), center: [0.0; 3], scale: 1.0, station: sample.station };
    let rms = |element: &Element| {
        let square = |&p: &Point| F::distance(element.size, element.pose.local(p)).powi(2);
        (points.iter().map(square).sum::<f64>() / points.len() as f64).sqrt()
    };
    let noise = rms(element).max(UNIT_FRAME_ROUNDING);
    let kind = F::shape(element, &unit).kind();
    let (best, size) = F::shape(element, &unit).flattened();
    // Ends of fits to points with noise from starts some way off, as far as they are of this element and not of another.
    let ends = |noise: f64, off: f64| -> Vec<(f64, [f64; MAX_SHAPE_NUMBERS])> {
        let end = |trial: u64| {
            let mut random = Random::stream(17, trial);
            // Uniform, of standard deviation 1.
            let mut next = || 12f64.sqrt() * (random.unit() - 0.5);
            let step: [f64; P] = std::array::from_fn(|_| off * next());
            let moved: Vec<Point> = points.iter().map(|p| p.map(|x| x + noise * next())).collect();
            let start = element.moved(&F::LOCAL, &step)?;
            let end = minimize::<P, F, _>(&start, &unit.with(moved.into()), &Alike, FULL)?;
            let end = F::settled(end.element);
            let rms = rms(&end);
            (rms <= (MAX_NOISE_RATIO * noise).max(off * off).max(NO_DISTANCE_RMS))
                .then(|| (rms, F::shape(&end, &unit).flattened().0))
        };
        (0..SPREAD_TRIALS).filter_map(end).collect()
    };
    // The apex of a cone follows from its other numbers, far off where the half angle is small.
    let first = if kind == Kind::Cone { 3 } else { 0 };
    let [least, most] = START_OFFSET_LIMITS;
    let off = (START_OFFSET_NOISE * noise.sqrt()).clamp(least, most);
    let is_far = |end: &[f64; MAX_SHAPE_NUMBERS]| {
        (first..size).any(|k| (end[k] - best[k]).abs() > OTHER_ELEMENT_SHARE * off)
    };
    if ends(0.0, off).iter().any(|(rms, end)| *rms <= NO_DISTANCE_RMS.max(noise) && is_far(end)) {
        return None;
    }
    let ends = ends(noise, noise.sqrt());
    let covariance = |i: usize, j: usize| {
        ends.iter().map(|(_, end)| (end[i] - best[i]) * (end[j] - best[j])).sum::<f64>() / ends.len() as f64
    };
    if 2 * ends.len() < SPREAD_TRIALS as usize
        || (first..size).any(|k| covariance(k, k).sqrt() > MAX_NUMBER_DEVIATION)
    {
        return None;
    }
    let units = units(kind, 1.0 / sample.scale);
    let values = (0..size * size).map(|at| {
        let [i, j] = [at / size, at % size];
        covariance(i, j) * units[i] * units[j]
    });
    Some(Covariance { size, values: values.collect() })
}

/// The factor of each number of an element that is a length.
fn units(kind: Kind, length: f64) -> Vec<f64> {
    let each = kind.parameters().iter().flat_map(|(_, quantity)| match quantity {
        Quantity::Length => vec![length],
        Quantity::Place => vec![length; 3],
        Quantity::Angle => vec![1.0],
        Quantity::Direction => vec![1.0; 3],
    });
    each.collect()
}
