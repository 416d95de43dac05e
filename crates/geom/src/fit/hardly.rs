//! Elements that distances determine only in second order: a cone by its apex and one ring. Each small tilt of such a cone moves
//! the distances by its square, so the normal matrix has no inverse; yet no other cone runs through the points.
//!
//! Whether there is one element, and how certain it is, is tried out: no fit from some way off ends elsewhere and as well; and fits to
//! the points with noise of the size found spread by the uncertainty.

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
const TRIALS: u64 = 16;
/// Points up to which one at a corner counts: among more it is nothing.
const MOST_POINTS: usize = 1024;
/// How far off those start, in each unknown of the unit frame, that show whether another element is as good: so many times what noise hides in
/// second order, between these limits.
const START_OFF: f64 = 100.0;
const START_OFF_LIMITS: [f64; 2] = [2e-3, LOOSE];
/// Share of that from which on a number is of another element.
const ANOTHER: f64 = 0.2;
/// Times the noise that a fit to points with noise leaves at most.
const NOISE_LEFT: f64 = 8.0;
/// Root mean square distance in the unit frame that is as good as none: in a valley that flat a search ends above rounding.
const AS_GOOD: f64 = 1e-12;
/// Standard deviation of a number in the unit frame beyond which the points tell nothing of it.
const LOOSE: f64 = 0.1;
/// Distances of the size of rounding in the unit frame.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Root mean square distances from a corner within which a point has no linear distance.
const NOT_LINEAR: f64 = 30.0;

/// The element with a corner at one of few points.
pub(super) fn corner<const P: usize, F: Family<P>>(
    element: &Element,
    sample: &Sample,
    within: f64,
) -> Option<Element> {
    if sample.len() <= MOST_POINTS { F::at_corner(element, sample, within) } else { None }
}

/// Whether distances are not linear in the unknowns, as one of few points lies at a corner of theirs.
pub(super) fn is_bent<const P: usize, F: Family<P>>(element: &Element, sample: &Sample, rms: f64) -> bool {
    corner::<P, F>(element, sample, NOT_LINEAR * rms.max(ROUNDING)).is_some()
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
    let noise = rms(element).max(ROUNDING);
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
            (rms <= (NOISE_LEFT * noise).max(off * off).max(AS_GOOD))
                .then(|| (rms, F::shape(&end, &unit).flattened().0))
        };
        (0..TRIALS).filter_map(end).collect()
    };
    // The apex of a cone follows from its other numbers, far off where the half angle is small.
    let first = if kind == Kind::Cone { 3 } else { 0 };
    let [least, most] = START_OFF_LIMITS;
    let off = (START_OFF * noise.sqrt()).clamp(least, most);
    let is_far =
        |end: &[f64; MAX_SHAPE_NUMBERS]| (first..size).any(|k| (end[k] - best[k]).abs() > ANOTHER * off);
    if ends(0.0, off).iter().any(|(rms, end)| *rms <= AS_GOOD.max(noise) && is_far(end)) {
        return None;
    }
    let ends = ends(noise, noise.sqrt());
    let covariance = |i: usize, j: usize| {
        ends.iter().map(|(_, end)| (end[i] - best[i]) * (end[j] - best[j])).sum::<f64>() / ends.len() as f64
    };
    if 2 * ends.len() < TRIALS as usize || (first..size).any(|k| covariance(k, k).sqrt() > LOOSE) {
        return None;
    }
    let units = units(kind, 1.0 / sample.scale);
    let values = (0..size * size).map(|at| {
        let [i, j] = [at / size, at % size];
        covariance(i, j) * units[i] * units[j]
    });
    Some(Covariance { size, values: values.collect() })
}

/// What each number of an element is multiplied with where lengths are.
fn units(kind: Kind, length: f64) -> Vec<f64> {
    let each = kind.parameters().iter().flat_map(|(_, quantity)| match quantity {
        Quantity::Length => vec![length],
        Quantity::Place => vec![length; 3],
        Quantity::Angle => vec![1.0],
        Quantity::Direction => vec![1.0; 3],
    });
    each.collect()
}
