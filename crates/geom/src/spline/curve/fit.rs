//! Curves through rows of points, by least squares.

use super::super::basis::Knots;
use super::super::value::Value;
use super::b_spline::Curve;
use super::fair::bending;
use crate::num::cholesky::Cholesky;

/// The condition that an end of the curve must keep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End<const D: usize> {
    /// Nothing.
    Free,
    /// It passes through a place.
    Through([f64; D]),
    /// It passes through a place and is tangent to a direction there, as the curve runs. The next control point lies on that
    /// side along it, or on the place itself where the points want it on the other side.
    Tangent([f64; D], [f64; D]),
}

/// Conditions at the ends of a curve that is fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ends<const D: usize> {
    /// At the first parameter.
    pub start: End<D>,
    /// At the last parameter.
    pub end: End<D>,
}

impl<const D: usize> Ends<D> {
    /// No condition.
    pub const FREE: Ends<D> = Ends { start: End::Free, end: End::Free };
}

/// Why there is no curve.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum FitCurveError {
    /// As many parameters as points are needed.
    #[error("{points} points need as many parameters, there are {parameters}")]
    Parameters {
        /// Points given.
        points: usize,
        /// Parameters given.
        parameters: usize,
    },
    /// Some control point is near no data.
    #[error("the points do not determine all {unknowns} control points: use fewer knots")]
    Undetermined {
        /// Control points sought.
        unknowns: usize,
    },
    /// A coordinate or parameter is no number.
    #[error("point {index} or its parameter is not a finite number")]
    NotFinite {
        /// Index of the first such point.
        index: usize,
    },
    /// Limits of spans that do not rise, or fewer than two.
    #[error("spans lie between two or more rising numbers")]
    Spans,
    /// Fewer than two different points.
    #[error("a curve needs at least two different points")]
    TooFewPoints,
}

/// A fitted curve and how far the points are from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted<const D: usize> {
    /// The curve.
    pub curve: Curve<[f64; D]>,
    /// Sum of squared distances of the points from the curve at their parameters.
    pub sum_of_squares: f64,
    /// Greatest such distance.
    pub max: f64,
}

/// Parameters of `points` by the lengths of the chords between them, from 0 to 1. `None` where all points are equal or a
/// coordinate is no number.
pub fn chord_parameters<const D: usize>(points: &[[f64; D]]) -> Option<Vec<f64>> {
    let mut sum = 0.0;
    let mut out = vec![0.0];
    for pair in points.windows(2) {
        let d = pair[1].minus(pair[0]);
        sum += d.iter().map(|x| x * x).sum::<f64>().sqrt();
        out.push(sum);
    }
    out.iter_mut().for_each(|t| *t /= sum);
    (sum > 0.0 && sum.is_finite()).then_some(out)
}

/// Clamped knots of a curve with `count` control points, so that each span holds data: Piegl and Tiller, equation 9.69.
/// `count` is taken between `degree + 1` and the number of parameters.
pub fn spread_knots(degree: usize, count: usize, parameters: &[f64]) -> Knots {
    let (from, to) = (parameters.first().copied().unwrap_or(0.0), parameters.last().copied().unwrap_or(1.0));
    let count = count.min(parameters.len()).max(degree + 1);
    let spans = count - degree;
    let step = parameters.len() as f64 / spans as f64;
    let at = |j: usize| {
        let i = (j as f64 * step).floor();
        let part = j as f64 * step - i;
        let i = (i as usize).clamp(1, parameters.len() - 1);
        (1.0 - part) * parameters[i - 1] + part * parameters[i]
    };
    let mut inner: Vec<f64> = (1..spans).map(at).filter(|k| *k > from && *k < to).collect();
    inner.dedup();
    Knots::clamped(degree, from, &inner, to).unwrap_or_else(|_| Knots::uniform(degree, 1, from, to))
}

/// The curve over `knots` with the least sum of squared distances from `points` at `parameters`, plus `fairness` times
/// the integral of its squared second derivative.
///
/// # Errors
/// [`FitCurveError`]: unequal lists, numbers that are none, control points that no data determine.
///
/// ```
/// use trueness_geom::spline::curve::{self, Ends};
/// let points: Vec<[f64; 2]> = (0..50).map(|i| f64::from(i) / 49.0).map(|t| [t, t * t * t]).collect();
/// let parameters: Vec<f64> = points.iter().map(|p| p[0]).collect();
/// let knots = curve::spread_knots(3, 6, &parameters);
/// assert!(curve::fit(&points, &parameters, &knots, Ends::FREE, 0.0).unwrap().max < 1e-14);
/// ```
pub fn fit<const D: usize>(
    points: &[[f64; D]],
    parameters: &[f64],
    knots: &Knots,
    ends: Ends<D>,
    fairness: f64,
) -> Result<Fitted<D>, FitCurveError> {
    check(points, parameters)?;
    let n = knots.count();
    let rows: Vec<(usize, Vec<f64>)> = parameters.iter().map(|t| knots.basis(*t)).collect();
    let mut fixed: Vec<Option<[f64; D]>> = vec![None; n];
    // Control points that are a place plus a multiple of a direction.
    let mut handles: Vec<(usize, [f64; D])> = vec![];
    for (end, first, next) in [(ends.start, 0, 1), (ends.end, n - 1, n - 2)] {
        match end {
            End::Free => {}
            End::Through(place) => fixed[first] = Some(place),
            End::Tangent(place, direction) => {
                (fixed[first], fixed[next]) = (Some(place), Some(place));
                handles.push((next, if next > first { direction } else { direction.times(-1.0) }));
            }
        }
    }
    let system = System::new(n, &rows, &fixed, fairness, knots)?;
    let mut control: Vec<[f64; D]> = fixed.iter().map(|f| f.unwrap_or([0.0; D])).collect();
    system.solve(&rows, points, &mut control);
    if !handles.is_empty() {
        system.pull(&rows, points, &mut control, &handles);
    }
    let curve = Curve { knots: knots.clone(), points: control };
    let (mut sum_of_squares, mut max) = (0.0, 0.0f64);
    for (point, t) in points.iter().zip(parameters) {
        let d = curve.at(*t).minus(*point).iter().map(|x| x * x).sum::<f64>();
        sum_of_squares += d;
        max = max.max(d.sqrt());
    }
    Ok(Fitted { curve, sum_of_squares, max })
}

fn check<const D: usize>(points: &[[f64; D]], parameters: &[f64]) -> Result<(), FitCurveError> {
    if points.len() != parameters.len() {
        return Err(FitCurveError::Parameters { points: points.len(), parameters: parameters.len() });
    }
    let bad = |(p, t): (&[f64; D], &f64)| !t.is_finite() || p.iter().any(|x| !x.is_finite());
    match points.iter().zip(parameters).position(bad) {
        Some(index) => Err(FitCurveError::NotFinite { index }),
        None => Ok(()),
    }
}

/// The normal equations of the control points that are free.
struct System {
    /// Which unknown a control point is.
    unknown: Vec<Option<usize>>,
    factor: Cholesky,
    /// Fairness between control points `i` and `i + k`.
    energy: Vec<Vec<f64>>,
}

impl System {
    fn new<const D: usize>(
        n: usize,
        rows: &[(usize, Vec<f64>)],
        fixed: &[Option<[f64; D]>],
        fairness: f64,
        knots: &Knots,
    ) -> Result<System, FitCurveError> {
        let mut unknowns = 0;
        let unknown: Vec<Option<usize>> = fixed
            .iter()
            .map(|f| {
                f.is_none().then(|| {
                    unknowns += 1;
                    unknowns - 1
                })
            })
            .collect();
        let mut a = vec![0.0; unknowns * unknowns];
        for (first, values) in rows {
            for (i, x) in values.iter().enumerate() {
                let Some(r) = unknown[first + i] else { continue };
                for (j, y) in values[..=i].iter().enumerate() {
                    if let Some(c) = unknown[first + j] {
                        a[r * unknowns + c] += x * y;
                    }
                }
            }
        }
        let mut energy = vec![];
        if fairness > 0.0 {
            energy = bending(knots);
            energy.iter_mut().flatten().for_each(|e| *e *= fairness);
            for i in 0..n {
                for (k, e) in energy[i].iter().enumerate() {
                    if let (Some(c), Some(r)) = (unknown[i], unknown.get(i + k).copied().flatten()) {
                        a[r * unknowns + c] += e;
                    }
                }
            }
        }
        let factor = Cholesky::new(a, unknowns).ok_or(FitCurveError::Undetermined { unknowns })?;
        Ok(System { unknown, factor, energy })
    }

    /// Fills in the free ones of `control`, where the others are held.
    fn solve<const D: usize>(
        &self,
        rows: &[(usize, Vec<f64>)],
        points: &[[f64; D]],
        control: &mut [[f64; D]],
    ) {
        let count = self.unknown.iter().flatten().count();
        let held: Vec<[f64; D]> =
            control.iter().zip(&self.unknown).map(|(c, u)| if u.is_none() { *c } else { [0.0; D] }).collect();
        for d in 0..D {
            let mut b = vec![0.0; count];
            for ((first, values), point) in rows.iter().zip(points) {
                let known: f64 = values.iter().zip(&held[*first..]).map(|(n, p)| n * p[d]).sum();
                for (i, n) in values.iter().enumerate() {
                    if let Some(r) = self.unknown[first + i] {
                        b[r] += n * (point[d] - known);
                    }
                }
            }
            for (i, row) in self.energy.iter().enumerate() {
                for (k, e) in row.iter().enumerate().filter(|(k, _)| i + k < held.len()) {
                    if let Some(r) = self.unknown[i] {
                        b[r] -= e * held[i + k][d];
                    }
                    if let Some(r) = self.unknown[i + k].filter(|_| k > 0) {
                        b[r] -= e * held[i][d];
                    }
                }
            }
            self.factor.solve(&mut b);
            for (c, u) in control.iter_mut().zip(&self.unknown) {
                if let Some(u) = u {
                    c[d] = b[*u];
                }
            }
        }
    }

    /// Moves the control points of `handles` along their directions to where the sum is least, and the free ones with them.
    ///
    /// All coordinates have the same matrix, so the answer to one unit is the same for all.
    fn pull<const D: usize>(
        &self,
        rows: &[(usize, Vec<f64>)],
        points: &[[f64; D]],
        control: &mut [[f64; D]],
        handles: &[(usize, [f64; D])],
    ) {
        let n = control.len();
        let nothing = vec![[0.0]; points.len()];
        let answers: Vec<Vec<[f64; 1]>> = handles
            .iter()
            .map(|(next, _)| {
                let mut unit = vec![[0.0]; n];
                unit[*next] = [1.0];
                self.solve(rows, &nothing, &mut unit);
                unit
            })
            .collect();
        // Residuals and their change with each length, all coordinates one after the other.
        let k = handles.len();
        let (mut a, mut b) = (vec![vec![0.0; k]; k], vec![0.0; k]);
        for ((first, values), point) in rows.iter().zip(points) {
            let mut residual = *point;
            let mut change = vec![0.0; k];
            for (i, w) in values.iter().enumerate() {
                residual = residual.plus(-w, control[first + i]);
                for (c, answer) in change.iter_mut().zip(&answers) {
                    *c += w * answer[first + i][0];
                }
            }
            for (i, (_, s)) in handles.iter().enumerate() {
                for (j, (_, t)) in handles.iter().enumerate() {
                    a[i][j] += change[i] * change[j] * s.iter().zip(t).map(|(x, y)| x * y).sum::<f64>();
                }
                b[i] += change[i] * s.iter().zip(&residual).map(|(x, y)| x * y).sum::<f64>();
            }
        }
        let lengths = crate::num::dense::solve(a, b).unwrap_or_else(|| vec![0.0; k]);
        for ((answer, (_, direction)), length) in answers.iter().zip(handles).zip(lengths) {
            for (c, w) in control.iter_mut().zip(answer) {
                *c = c.plus(length.max(0.0) * w[0], *direction);
            }
        }
    }
}

/// Distances at parameters that were not found anew come down by this factor at most, as a rule.
const REFINED_FALL: f64 = 2.0;

/// A curve of as few control points as keep every point within `tolerance`: from many to few.
///
/// The number of spans is doubled until the tolerance holds, then knots are taken out while it still does, the one of least
/// effect first. The parameters are those of the nearest places, found anew in every pass. Where even a span per point
/// does not keep the tolerance, the last curve is the answer: [`Fitted::max`] says so.
///
/// # Errors
/// As [`fit`].
pub fn approximate<const D: usize>(
    points: &[[f64; D]],
    degree: usize,
    ends: Ends<D>,
    tolerance: f64,
) -> Result<Fitted<D>, FitCurveError> {
    let mut parameters = chord_parameters(points).ok_or(FitCurveError::TooFewPoints)?;
    let mut count = degree + 1;
    let mut best = loop {
        let knots = spread_knots(degree, count, &parameters);
        let fitted = corrected(points, &mut parameters, &knots, ends)?;
        if fitted.max <= tolerance || 2 * count > points.len() {
            break fitted;
        }
        count *= 2;
    };
    if best.max > tolerance {
        return Ok(best);
    }
    let mut kept: Vec<f64> = vec![];
    loop {
        let knots = best.curve.knots().clone();
        let inner = degree + 1..knots.values().len() - degree - 1;
        let tried = inner.filter(|i| !kept.contains(&knots.values()[*i]));
        let effect = |i: usize| best.curve.remove(i, f64::INFINITY).map(|(_, moved)| (i, moved));
        let Some((index, _)) = tried.filter_map(effect).min_by(|a, b| a.1.total_cmp(&b.1)) else {
            return Ok(best);
        };
        let Some(fewer) = knots.without(index) else { return Ok(best) };
        // The parameters are those of the nearest places of a curve that is hardly another. Most often they will do, and where
        // the distances at them are far too large, nearer places would not help.
        match fit(points, &parameters, &fewer, ends, 0.0) {
            Ok(fitted) if fitted.max <= tolerance => {
                best = fitted;
                continue;
            }
            Ok(fitted) if fitted.max > REFINED_FALL * tolerance => {
                kept.push(knots.values()[index]);
                continue;
            }
            _ => {}
        }
        let mut own = parameters.clone();
        match corrected(points, &mut own, &fewer, ends) {
            Ok(fitted) if fitted.max <= tolerance => (best, parameters) = (fitted, own),
            _ => kept.push(knots.values()[index]),
        }
    }
}

/// Fits, and fits again at the parameters of the nearest places.
pub fn corrected<const D: usize>(
    points: &[[f64; D]],
    parameters: &mut [f64],
    knots: &Knots,
    ends: Ends<D>,
) -> Result<Fitted<D>, FitCurveError> {
    let mut fitted = fit(points, parameters, knots, ends, 0.0)?;
    for _ in 0..3 {
        let mut own = parameters.to_vec();
        let (from, to) = fitted.curve.domain();
        for (t, point) in own.iter_mut().zip(points) {
            *t = fitted.curve.closest_from(*point, *t, (from, to)).parameter;
        }
        // Places that changed their order belong to a curve that turned back: the chords were better.
        if own.windows(2).any(|w| w[0] > w[1]) {
            break;
        }
        match fit(points, &own, knots, ends, 0.0) {
            Ok(next) if next.sum_of_squares < fitted.sum_of_squares => {
                fitted = next;
                parameters.copy_from_slice(&own);
            }
            _ => break,
        }
    }
    Ok(fitted)
}
