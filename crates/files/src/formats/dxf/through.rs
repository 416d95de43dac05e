//! Splines that are given only by the points on them.
//!
//! The format does not say which curve passes through the points. Programs draw a cubic with continuous curvature, whose parameter grows by the
//! lengths of the chords. An end without a tangent has no curvature. Other programs may draw the first and the last span otherwise.

use crate::content::drawing::Drawn;
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::curve::{self, Curve};
use trueness_geom::spline::rational::Rational;
use trueness_geom::spline::value::Value;

/// The points and tangents that the drawing gives.
pub(super) struct PointsOnCurve {
    pub points: Vec<[f64; 2]>,
    /// Directions at its ends.
    pub tangents: [Option<[f64; 2]>; 2],
    pub closed: bool,
}

/// So many points of a closed curve are repeated beyond its ends. With them its spans agree with those of the endless curve, up to rounding.
const OVERLAP_POINTS: usize = 24;

/// The curve; `None` for fewer than two different points.
pub(super) fn through(given: PointsOnCurve) -> Option<Drawn> {
    let PointsOnCurve { mut points, tangents, mut closed } = given;
    points.dedup();
    while closed && points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    closed &= points.len() > 2;
    if let ([start, end], [None, None], false) = (&points[..], tangents, closed) {
        return Some(Drawn::Line { start: *start, end: *end });
    }
    if points.len() < 2 {
        return None;
    }
    let found = if closed { around(&points)? } else { cubic(&points, tangents)? };
    let masses: Vec<([f64; 3], f64)> = found.points().iter().map(|p| ([p[0], p[1], 0.0], 1.0)).collect();
    Some(Drawn::Spline(Rational::new(found.knots().clone(), &masses).ok()?))
}

/// The closed curve: an open one that goes on beyond both ends and is cut there.
fn around(points: &[[f64; 2]]) -> Option<Curve<[f64; 2]>> {
    let n = points.len();
    let all: Vec<[f64; 2]> = (0..n + 1 + 2 * OVERLAP_POINTS)
        .map(|i| points[(i + n * OVERLAP_POINTS - OVERLAP_POINTS) % n])
        .collect();
    let parameters = curve::chord_parameters(&all)?;
    let [from, to] = [OVERLAP_POINTS, OVERLAP_POINTS + n].map(|i| parameters[i]);
    cubic(&all, [None; 2])?.part(from, to).ok()
}

/// The cubic through points, with these directions at its ends. A continuous second derivative gives tridiagonal equations for the derivatives
/// at the points (de Boor, A Practical Guide to Splines, chapter IV). The derivatives give the control points.
fn cubic(points: &[[f64; 2]], tangents: [Option<[f64; 2]>; 2]) -> Option<Curve<[f64; 2]>> {
    let parameters = curve::chord_parameters(points)?;
    let last = points.len() - 1;
    let width = |i: usize| parameters[i + 1] - parameters[i];
    let chord = |i: usize| points[i + 1].minus(points[i]);
    let whole: f64 = (0..last).map(|i| libm::hypot(chord(i)[0], chord(i)[1])).sum();
    // A direction is passed at the speed of the parameter.
    let fixed = |t: [f64; 2]| t.times(whole / libm::hypot(t[0], t[1]).max(f64::MIN_POSITIVE));
    // Below, on and above the diagonal, and the right side.
    let row = |i: usize| -> ([f64; 3], [f64; 2]) {
        match (i, tangents) {
            (0, [Some(t), _]) => ([0.0, 1.0, 0.0], fixed(t)),
            (0, _) => ([0.0, 2.0, 1.0], chord(0).times(3.0 / width(0))),
            (_, [_, Some(t)]) if i == last => ([0.0, 1.0, 0.0], fixed(t)),
            _ if i == last => ([1.0, 2.0, 0.0], chord(last - 1).times(3.0 / width(last - 1))),
            _ => {
                let (a, b) = (width(i - 1), width(i));
                let right = chord(i - 1).times(3.0 * b / a).plus(3.0 * a / b, chord(i));
                ([b, 2.0 * (a + b), a], right)
            }
        }
    };
    let (mut above, mut slopes) = (vec![0.0; last + 1], vec![[0.0; 2]; last + 1]);
    for i in 0..=last {
        let ([below, on, over], mut right) = row(i);
        let mut pivot = on;
        if i > 0 {
            pivot -= below * above[i - 1];
            right = right.plus(-below, slopes[i - 1]);
        }
        (above[i], slopes[i]) = (over / pivot, right.times(1.0 / pivot));
    }
    for i in (0..last).rev() {
        slopes[i] = slopes[i].plus(-above[i], slopes[i + 1]);
    }
    // Between two knots the inner points of the cubic's polygon; a control point lies on the line through both.
    let inner = |i: usize| {
        let h = width(i) / 3.0;
        [points[i].plus(h, slopes[i]), points[i + 1].plus(-h, slopes[i + 1])]
    };
    let control = |i: usize| {
        let [a, b] = inner(i);
        a.plus(-width(i - 1) / width(i), b.minus(a))
    };
    let mut all = vec![points[0], inner(0)[0]];
    all.extend((1..last).map(control));
    all.extend([inner(last - 1)[1], points[last]]);
    let knots = Knots::clamped(3, 0.0, &parameters[1..last], 1.0).ok()?;
    Curve::new(knots, all).ok()
}
