//! The parameter of a place on a curve.

use trueness_cad::curve::Curve;
use trueness_geom::space::{Point, dot, minus, norm};

/// Looks between two knots for each degree.
const LOOKS: usize = 3;
/// Steps of Newton's method; each doubles the digits.
const STEPS: usize = 24;

/// The parameter whose place is nearest to a point, and how far off the point is.
pub(super) fn foot(curve: &Curve, p: Point) -> (f64, f64) {
    let t = match curve {
        Curve::Line { origin, direction } => dot(minus(p, *origin), *direction) / dot(*direction, *direction),
        Curve::Circle { frame, .. } => {
            let [x, y, _] = frame.local(p);
            libm::atan2(y, x)
        }
        _ => search(curve, p),
    };
    (t, norm(minus(curve.at(t), p)))
}

/// The best of many places, refined.
fn search(curve: &Curve, p: Point) -> f64 {
    let starts = starts(curve, p);
    let away = |t: f64| norm(minus(curve.at(t), p));
    let distances: Vec<f64> = starts.iter().map(|t| away(*t)).collect();
    let last = starts.len().saturating_sub(1);
    let is_low = |k: usize| {
        (k == 0 || distances[k] <= distances[k - 1]) && (k == last || distances[k] <= distances[k + 1])
    };
    let mut low: Vec<usize> = (0..starts.len()).filter(|k| is_low(*k)).collect();
    low.sort_by(|a, b| distances[*a].total_cmp(&distances[*b]));
    let mut best = (f64::NAN, f64::INFINITY);
    for k in low.into_iter().take(LOOKS) {
        let range = [starts[k.saturating_sub(1)], starts[(k + 1).min(last)]];
        let t = refine(curve, p, starts[k], range);
        for t in [t, starts[k]] {
            let distance = away(t);
            if distance < best.1 {
                best = (t, distance);
            }
        }
    }
    best.0
}

/// Places to look at.
fn starts(curve: &Curve, p: Point) -> Vec<f64> {
    let even = |from: f64, to: f64, n: usize| (0..=n).map(move |k| from + (to - from) * k as f64 / n as f64);
    let of_knots = |knots: &trueness_geom::spline::basis::Knots| {
        let n = LOOKS * (knots.degree() + 1);
        let mut all: Vec<f64> = knots.distinct().windows(2).flat_map(|w| even(w[0], w[1], n)).collect();
        all.dedup();
        all
    };
    match curve {
        Curve::Spline(spline) => of_knots(spline.knots()),
        Curve::Rational(rational) => of_knots(rational.masses().knots()),
        Curve::Hyperbola { frame, radii } => {
            let t = libm::asinh(frame.local(p)[1] / radii[1]);
            even(t - 1.0, t + 1.0, 2).collect()
        }
        Curve::Parabola { frame, focal } => {
            let t = frame.local(p)[1] / (2.0 * focal);
            even(t - 1.0, t + 1.0, 2).collect()
        }
        Curve::Polyline(points) => (0..points.len()).flat_map(|k| even(k as f64, k as f64 + 1.0, LOOKS)).collect(),
        Curve::Joined(spans) => (0..spans.len()).flat_map(|k| even(k as f64, k as f64 + 1.0, 64)).collect(),
        _ => {
            let [from, to] = curve.domain();
            even(from, to, 64).collect()
        }
    }
}

/// Newton's method for the place where the way to the point is at right angles to the curve, kept within a range.
fn refine(curve: &Curve, p: Point, start: f64, [low, high]: [f64; 2]) -> f64 {
    let mut t = start;
    for _ in 0..STEPS {
        let [place, first, second] = curve.derivatives(t);
        let away = minus(place, p);
        let slope = dot(first, first) + dot(away, second);
        let rise = dot(first, first);
        let step = dot(away, first) / if slope > 0.0 { slope } else { rise };
        let next = (t - step).clamp(low, high);
        if !next.is_finite() || next == t {
            break;
        }
        t = next;
    }
    t
}
