//! Splines that are given by the points alone that they pass through.
//!
//! The format does not say which curve passes through the points: programs draw a cubic with continuous curvature, its parameter by the lengths
//! of the chords. Without tangents the ends are taken as parts of the cubics beside them (no knot at the second and the last point but
//! one): other programs may draw the first and the last span otherwise.

use crate::drawing::Drawn;
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::curve::{self, Curve, End, Ends};
use trueness_geom::spline::rational::Rational;

/// What the drawing says of the curve.
pub(super) struct Given {
    pub points: Vec<[f64; 2]>,
    /// Directions at its ends.
    pub tangents: [Option<[f64; 2]>; 2],
    pub closed: bool,
}

/// Points of a closed curve that are repeated beyond its ends: the spans there are as those of the endless curve, to rounding.
const OVERLAP: usize = 24;

/// The curve; `None` of fewer than two different points.
pub(super) fn through(given: Given) -> Option<Drawn> {
    let Given { mut points, tangents, mut closed } = given;
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

/// The closed curve: an open one that goes on over both ends, cut there.
fn around(points: &[[f64; 2]]) -> Option<Curve<[f64; 2]>> {
    let n = points.len();
    let all: Vec<[f64; 2]> =
        (0..n + 1 + 2 * OVERLAP).map(|i| points[(i + n * OVERLAP - OVERLAP) % n]).collect();
    let parameters = curve::chord_parameters(&all)?;
    let [from, to] = [OVERLAP, OVERLAP + n].map(|i| parameters[i]);
    cubic(&all, [None; 2])?.part(from, to).ok()
}

/// The cubic through points, with these directions at its ends.
fn cubic(points: &[[f64; 2]], tangents: [Option<[f64; 2]>; 2]) -> Option<Curve<[f64; 2]>> {
    let parameters = curve::chord_parameters(points)?;
    let last = points.len() - 1;
    // Few points without tangents have a curve of lower degree.
    let free = tangents.iter().filter(|t| t.is_none()).count();
    let degree = 3.min(last + 2 - free);
    // As many control points as there are conditions: an end without a direction has no knot at the point beside.
    let skip = |tangent: Option<[f64; 2]>| if tangent.is_none() && degree == 3 { 2 } else { 1 };
    let (first, end) = (skip(tangents[0]), (last + 1).saturating_sub(skip(tangents[1])));
    let inner = if degree == 3 { parameters.get(first..end).unwrap_or(&[]) } else { &[] };
    let knots = Knots::clamped(degree, 0.0, inner, 1.0).ok()?;
    let of = |place: [f64; 2], tangent: Option<[f64; 2]>| match tangent {
        Some(along) => End::Tangent(place, along),
        None => End::Through(place),
    };
    let ends = Ends { start: of(points[0], tangents[0]), end: of(points[last], tangents[1]) };
    curve::fit(points, &parameters, &knots, ends, 0.0).ok().map(|f| f.curve)
}
