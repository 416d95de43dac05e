//! Curves that keep a tolerance over as few spans as the error of their fit asks for.

use super::super::basis::Knots;
use super::super::value::Value;
use super::fit::{Ends, FitCurveError, Fitted, fit};

/// Share of the tolerance that a span is divided for: the adjacent spans add to its error.
const AIMED_ERROR_SHARE: f64 = 0.7;
/// Most parts that a span is divided into at once, and most times that spans are divided.
const MAX_DIVISIONS: (usize, usize) = (8, 12);
/// Least points of a part: between fewer the curve may swing as it likes.
const MIN_POINTS_PER_PART: usize = 3;

/// A curve of degree `degree` within `tolerance` of every point at its parameter, over as few spans as that needs. The spans
/// are those between the rising numbers `spans`, divided where the fit is farther off.
///
/// The error of a fit falls with the power `degree + 1` of the width of its spans, so it tells how many parts a span needs. Few
/// fits do, where knots taken out one by one need one for each. Parameters stay what they are: for points that follow a curve
/// at steps of its length. No span is divided into parts of fewer than three points. Where no more spans are of use, the last
/// curve is the answer: [`Fitted::max`] says so.
///
/// # Errors
/// As [`fit`]; [`FitCurveError::Spans`] where `spans` are not two or more rising numbers.
///
/// ```
/// use trueness_geom::spline::curve::{divided, Ends};
/// let parameters: Vec<f64> = (0..200).map(|i| f64::from(i) / 199.0).collect();
/// let points: Vec<[f64; 2]> = parameters.iter().map(|t| [*t, (5.0 * t).sin()]).collect();
/// let found = divided(&points, &parameters, 3, &[0.0, 1.0], Ends::FREE, 1e-4).unwrap();
/// assert!(found.max <= 1e-4 && found.curve.points().len() < 20);
/// ```
pub fn divided<const D: usize>(
    points: &[[f64; D]],
    parameters: &[f64],
    degree: usize,
    spans: &[f64],
    ends: Ends<D>,
    tolerance: f64,
) -> Result<Fitted<D>, FitCurveError> {
    let mut spans = spans.to_vec();
    let mut last: Option<Fitted<D>> = None;
    for _ in 0..MAX_DIVISIONS.1 {
        let (from, to) = (spans.first().copied().unwrap_or(0.0), spans.last().copied().unwrap_or(0.0));
        let inner = spans.get(1..spans.len().saturating_sub(1)).unwrap_or_default();
        let knots = Knots::clamped(degree, from, inner, to).map_err(|_| FitCurveError::Spans)?;
        let fitted = match (fit(points, parameters, &knots, ends, 0.0), last) {
            (Ok(fitted), _) => fitted,
            // Spans without points determine nothing: the last curve is as near as there is.
            (Err(FitCurveError::Undetermined { .. }), Some(last)) => return Ok(last),
            (Err(error), _) => return Err(error),
        };
        if fitted.max <= tolerance || 2 * spans.len() > points.len() {
            return Ok(fitted);
        }
        let next = finer(&spans, &errors(points, parameters, &spans, &fitted), degree, tolerance);
        if next.len() == spans.len() {
            return Ok(fitted);
        }
        spans = next;
        last = Some(fitted);
    }
    last.ok_or(FitCurveError::Spans)
}

/// The greatest distance of a point from the curve in each span, and how many points it holds.
fn errors<const D: usize>(
    points: &[[f64; D]],
    parameters: &[f64],
    spans: &[f64],
    fitted: &Fitted<D>,
) -> Vec<(f64, usize)> {
    let mut all = vec![(0.0, 0); spans.len() - 1];
    for (point, t) in points.iter().zip(parameters) {
        let span = spans.partition_point(|s| s <= t).clamp(1, spans.len() - 1) - 1;
        let off = fitted.curve.at(*t).minus(*point).iter().map(|x| x * x).sum::<f64>().sqrt();
        all[span] = (f64::max(all[span].0, off), all[span].1 + 1);
    }
    all
}

/// Spans divided into as many parts as their errors ask for.
fn finer(spans: &[f64], errors: &[(f64, usize)], degree: usize, tolerance: f64) -> Vec<f64> {
    let mut all = vec![spans[0]];
    for (w, (error, count)) in spans.windows(2).zip(errors) {
        let parts = libm::pow(error / (AIMED_ERROR_SHARE * tolerance), 1.0 / (degree + 1) as f64).ceil();
        let parts = if *error > tolerance { parts.clamp(2.0, MAX_DIVISIONS.0 as f64) as usize } else { 1 };
        let parts = parts.min(count / MIN_POINTS_PER_PART).max(1);
        all.extend((1..=parts).map(|k| match k == parts {
            true => w[1],
            false => w[0] + (w[1] - w[0]) * k as f64 / parts as f64,
        }));
    }
    all
}
