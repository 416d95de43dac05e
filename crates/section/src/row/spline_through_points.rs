//! Curves that keep to the points of a row without noise.

use crate::model::flat::{angle, distance};
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::curve::{self, Curve, Ends};

/// Shares of the distance between points within which a curve keeps its points. Curves of three points to a span keep the first;
/// where these do not follow, the second holds.
pub(super) const FOLLOWED_TOLERANCES: [f64; 2] = [1e-4, 1e-3];

/// From one place to another.
pub(super) fn chord(from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
    [to[0] - from[0], to[1] - from[1]]
}

/// Shares of the length at which points follow each other: chords and the bends beside them, as of arcs.
fn shares(points: &[[f64; 2]]) -> Vec<f64> {
    let n = points.len();
    let chord = |i: usize| chord(points[i], points[i + 1]);
    let turn = |i: usize| if i == 0 || i + 1 >= n { 0.0 } else { angle(chord(i - 1), chord(i)) };
    let mut all = vec![0.0];
    let mut sum = 0.0;
    for i in 0..n - 1 {
        let ends = if i == 0 || i + 2 == n { 1.0 } else { 0.5 };
        let half = 0.5 * ends * (turn(i) + turn(i + 1));
        let longer = if half.abs() > 1e-4 { half / libm::sin(half.clamp(-1.5, 1.5)) } else { 1.0 };
        sum += distance(points[i], points[i + 1]) * longer;
        all.push(sum);
    }
    all.iter_mut().for_each(|s| *s /= sum);
    all
}

/// A curve, and the parameters of the places nearest to its points.
pub(super) type Followed = (Curve<[f64; 2]>, Vec<f64>);

/// Feet are found anew so many times.
const FOOT_PASSES: usize = 3;
/// Points to a control point, at least, where spans are halved to keep the narrower tolerance.
const MIN_POINTS_PER_CONTROL_POINT: usize = 4;
/// Spans that are halved are so many at first, of as many points at least.
const FIRST_SPANS: usize = 16;

/// The curve along points without noise. It has knots where the error asks for them, at the parameters of the nearest
/// places. Where points are few for its bends, it has up to a knot at each point. `None` where that swings between the
/// points.
pub(super) fn followed(points: &[[f64; 2]], ends: Ends<2>, spacing: f64, least: f64) -> Option<Followed> {
    let tolerances = FOLLOWED_TOLERANCES.map(|share| least.max(share * spacing));
    let divided = |parameters: &[f64]| {
        Some(curve::divided(points, parameters, 3, &[0.0, 1.0], ends, tolerances[0]).ok()?.curve)
    };
    let halves = |tolerance: f64| near(points, tolerance, |t| halved(points, t, ends, tolerance));
    let (even, own) = (near(points, tolerances[0], divided), halves(tolerances[0]));
    let count = |f: &Followed| f.0.points().len();
    // A knot at every second point is a curve through noise.
    let own = own.filter(|f| MIN_POINTS_PER_CONTROL_POINT * count(f) <= points.len());
    even.into_iter().chain(own).min_by_key(count).or_else(|| halves(tolerances[1]))
}

/// A curve within `tolerance` of the points, fitted anew at the parameters of the nearest places.
fn near(
    points: &[[f64; 2]],
    tolerance: f64,
    fit: impl Fn(&[f64]) -> Option<Curve<[f64; 2]>>,
) -> Option<Followed> {
    let mut parameters = shares(points);
    let last = parameters.len() - 1;
    for _ in 0..FOOT_PASSES {
        let curve = fit(&parameters)?;
        let domain = curve.domain();
        let feet: Vec<_> =
            points.iter().zip(&parameters).map(|(p, t)| curve.closest_from(*p, *t, domain)).collect();
        let mut near: Vec<f64> = feet.iter().map(|f| f.parameter).collect();
        if feet.iter().all(|f| f.distance <= tolerance) {
            return Some((curve, near));
        }
        (near[0], near[last]) = (0.0, 1.0);
        // Places that change their order are those of a curve that swings between the points.
        if near.windows(2).any(|w| w[0] >= w[1]) {
            return None;
        }
        parameters = near;
    }
    None
}

/// A curve with knots at points: spans whose points it misses are halved, down to one for each point.
fn halved(points: &[[f64; 2]], parameters: &[f64], ends: Ends<2>, tolerance: f64) -> Option<Curve<[f64; 2]>> {
    let last = points.len() - 1;
    // Beside the ends there are no knots: a curve through all points has as many control points.
    let count = (last / FIRST_SPANS).clamp(1, FIRST_SPANS);
    let mut limits: Vec<usize> = (0..=count).map(|k| k * last / count).collect();
    loop {
        let inner: Vec<f64> = limits[1..limits.len() - 1].iter().map(|i| parameters[*i]).collect();
        let knots = Knots::clamped(3, 0.0, &inner, 1.0).ok()?;
        let fitted = curve::fit(points, parameters, &knots, ends, 0.0).ok()?.curve;
        let off = |i: usize| distance(fitted.at(parameters[i]), points[i]) > 0.7 * tolerance;
        let mut finer = vec![0];
        for w in limits.windows(2) {
            let middle = (w[0] + w[1]) / 2;
            let divides = middle > w[0] && middle > 1 && middle + 1 < last && (w[0]..=w[1]).any(off);
            finer.extend(divides.then_some(middle));
            finer.push(w[1]);
        }
        if finer.len() == limits.len() {
            return Some(fitted);
        }
        limits = finer;
    }
}
