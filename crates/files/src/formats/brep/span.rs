//! The part of a curve that an edge is: from the parameter of its first vertex to that of its last one, the way that its sense says.

use std::f64::consts::TAU;
use trueness_cad::curve::{Curve, CurveFeet, Foot, Span};
use trueness_geom::space::{Point, minus, norm};

/// How far two ends that should meet may lie apart, as a share of what they bound: beyond, the entity is damaged.
pub(crate) const MAX_GAP: f64 = 1e-2;
/// The share of a turn, or of the length of a spline's domain, within which two parameters are one: rounding of places.
const SAME: f64 = 1e-9;

/// The span of an edge between two places on a curve. `same` says that the edge has the sense of the curve, `closed` that both
/// vertices are one. The vertices may lie off the curve; so far as they do is the second value.
pub(crate) fn between(
    curve: Curve,
    ends: [Point; 2],
    same: bool,
    closed: bool,
    tolerance: f64,
) -> (Span, f64) {
    let feet = CurveFeet::new(&curve, curve.domain());
    let [Foot { parameter: from, distance: a, .. }, Foot { parameter: to, distance: b, .. }] =
        ends.map(|p| feet.nearest(p));
    let off = a.max(b);
    if curve.period().is_some() {
        let range = if closed { turn(from, same) } else { onward([from, to], same, &curve, ends, tolerance) };
        return (Span { curve, range }, off);
    }
    let [low, high] = curve.domain();
    let loops =
        low.is_finite() && high.is_finite() && norm(minus(curve.at(low), curve.at(high))) <= tolerance;
    if !loops {
        return (Span { curve, range: [from, to] }, off);
    }
    (around(curve, [from, to], same), off)
}

/// The place of a curve nearest to a point.
pub(crate) fn foot(curve: &Curve, p: Point) -> Foot {
    CurveFeet::new(curve, curve.domain()).nearest(p)
}

/// A whole turn.
fn turn(from: f64, same: bool) -> [f64; 2] {
    [from, if same { from + TAU } else { from - TAU }]
}

/// From one parameter to another in the sense of a periodic curve, or against it. Two vertices at one place bound a whole turn.
fn onward([from, to]: [f64; 2], same: bool, curve: &Curve, ends: [Point; 2], tolerance: f64) -> [f64; 2] {
    let way = if same { to - from } else { from - to };
    let way = way.rem_euclid(TAU);
    let apart = norm(minus(ends[0], ends[1]));
    let nearly = is_whole(way);
    // Vertices within the uncertainty of each other, but out of order, stand at the seam of a whole turn.
    let short = apart <= tolerance && way * speed(curve) > tolerance;
    let way = if nearly && apart <= tolerance || short && way > TAU / 2.0 { TAU } else { way };
    [from, if same { from + way } else { from - way }]
}

/// Whether an angle from 0 to a turn is none or all of it, but for rounding.
fn is_whole(way: f64) -> bool {
    way.min(TAU - way) < SAME * TAU
}

/// Length of a radian at the greatest curvature.
fn speed(curve: &Curve) -> f64 {
    match curve {
        Curve::Circle { radius, .. } => *radius,
        Curve::Ellipse { radii, .. } => radii[0].min(radii[1]),
        _ => 1.0,
    }
}

/// On a curve whose two ends meet: straight on, or over these ends.
fn around(curve: Curve, [from, to]: [f64; 2], same: bool) -> Span {
    let [low, high] = curve.domain();
    let near = |t: f64, end: f64| (t - end).abs() <= SAME * (high - low);
    let at_seam = |t: f64| near(t, low) || near(t, high);
    let [first, last] = if same { [low, high] } else { [high, low] };
    let from = if at_seam(from) { first } else { from };
    let to = if at_seam(to) { last } else { to };
    let onward = if same { to > from } else { to < from };
    if onward {
        return Span { curve, range: [from, to] };
    }
    if from == first && to == last {
        return Span { curve, range: [first, last] };
    }
    let rest = Span { curve: curve.clone(), range: [first, to] };
    let begin = Span { curve, range: [from, last] };
    Span { curve: Curve::Joined(vec![begin, rest]), range: [0.0, 2.0] }
}

/// The span between two parameters.
///
/// # Errors
/// They are one on a curve that does not close.
pub(crate) fn from_parameters(curve: Curve, [from, to]: [f64; 2], same: bool) -> Result<Span, &'static str> {
    if curve.period().is_some() {
        let way = if same { to - from } else { from - to };
        let mut turns = way.rem_euclid(TAU);
        if is_whole(turns) {
            turns = TAU;
        }
        return Ok(Span { curve, range: [from, if same { from + turns } else { from - turns }] });
    }
    let [low, high] = curve.domain();
    let [from, to] = [from, to].map(|t| t.clamp(low, high));
    let in_order = if same { from < to } else { to < from };
    if in_order {
        return Ok(Span { curve, range: [from, to] });
    }
    let loops = low.is_finite()
        && high.is_finite()
        && norm(minus(curve.at(low), curve.at(high))) <= SAME * (1.0 + norm(curve.at(low)));
    match loops {
        true => Ok(around(curve, [from, to], same)),
        // A sense that contradicts the ends: these tell more.
        false if from != to => Ok(Span { curve, range: [from, to] }),
        false => Err("has both its ends at one place"),
    }
}
