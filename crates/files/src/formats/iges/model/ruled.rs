//! Ruled surfaces (118): straight from each place of one curve to that of another one with the same parameter, as B-splines exactly.

use super::super::record::Record;
use super::geometry::Geometry;
use crate::formats::brep::Wrong;
use std::f64::consts::FRAC_PI_2;
use trueness_cad::curve::{Curve, Span};
use trueness_geom::space::{Point, minus, norm, plus, times, unit};
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::curve::Curve as Spline;
use trueness_geom::spline::surface::Nurbs;
use trueness_geom::spline::value::Mass;

/// The parameters of arcs are no rational ones: two of them are ruled exactly only where both have so many radians, but for rounding.
const SAME_TURN: f64 = 1e-9;

/// The surface of an entity: two curves, whether the second one is gone along backwards, and whether it can be unrolled.
pub(super) fn surface(geometry: &Geometry, record: &Record) -> Result<Nurbs, Wrong> {
    let spans = [side(geometry, record.pointer(0)?)?, side(geometry, record.pointer(1)?)?];
    let lengths = spans.each_ref().map(turn);
    let is_straight = |span: &Span| matches!(span.curve, Curve::Line { .. }) || size(span) == 0.0;
    let all_straight = spans.iter().all(is_straight);
    let a_point = spans.iter().any(|span| size(span) == 0.0);
    // Equal shares of length are equal parameters on lines and arcs alone.
    if record.entity.form == 0 && !all_straight && lengths.contains(&None) && !a_point {
        return Err(record.wrong("joins equal shares of the length of curves that are neither lines nor arcs, which is no surface of splines"));
    }
    let same = match lengths {
        [Some(a), Some(b)] => (a - b).abs() <= SAME_TURN,
        [None, None] => true,
        _ => a_point,
    };
    if !same {
        return Err(
            record.wrong("joins an arc with a curve of another kind or turn, which is no surface of splines")
        );
    }
    let [first, second] = spans.each_ref().map(masses);
    let wrong = || record.wrong("joins curves that are no splines");
    let (first, mut second) = (first.ok_or_else(wrong)?, second.ok_or_else(wrong)?);
    if record.integer(2)? != 0 {
        second = unitary(second.reversed()).ok_or_else(wrong)?;
    }
    let [first, second] = alike(first, second).ok_or_else(wrong)?;
    geometry.budget.spend(first.points().len() + second.points().len(), record)?;
    let across = Knots::uniform(1, 1, 0.0, 1.0);
    let pairs = first.points().iter().zip(second.points()).flat_map(|(a, b)| [*a, *b]);
    let points: Option<Vec<(Point, f64)>> = pairs.map(|m| Some((m.place()?, m.mass))).collect();
    let knots = [first.knots().clone(), across];
    Nurbs::weighted(knots, &points.ok_or_else(wrong)?).map_err(|e| record.wrong(e.to_string()))
}

/// A curve; a point stands for one that is as long as nothing.
fn side(geometry: &Geometry, number: u64) -> Result<Span, Wrong> {
    if geometry.file.record(number)?.entity.kind != 116 {
        return geometry.curve(number);
    }
    let p = geometry.point(number)?;
    Ok(Span { curve: Curve::Polyline(vec![p, p]), range: [0.0, 1.0] })
}

/// The angle of an arc.
fn turn(span: &Span) -> Option<f64> {
    matches!(span.curve, Curve::Circle { .. }).then_some((span.range[1] - span.range[0]).abs())
}

/// How far apart its places are.
fn size(span: &Span) -> f64 {
    let [a, b, c] = [0.0, 0.4, 1.0].map(|share| span.derivatives(share)[0]);
    norm(minus(a, b)).max(norm(minus(b, c)))
}

/// A span as a spline from 0 to 1.
fn masses(span: &Span) -> Option<Spline<Mass<3>>> {
    let of = |points: &[Point]| points.iter().map(|p| Mass::new(*p, 1.0)).collect::<Vec<_>>();
    let cut = |spline: Spline<Mass<3>>| spline.part(span.range[0], span.range[1]).ok();
    let found = match &span.curve {
        Curve::Line { .. } => Spline::new(Knots::uniform(1, 1, 0.0, 1.0), of(&span.ends())).ok()?,
        Curve::Polyline(points) => {
            let knots = Knots::uniform(1, points.len().checked_sub(1)?, 0.0, 1.0);
            Spline::new(knots, of(points)).ok()?
        }
        Curve::Spline(spline) => cut(Spline::new(spline.knots().clone(), of(spline.points())).ok()?)?,
        Curve::Rational(rational) => cut(rational.masses().clone())?,
        Curve::Circle { .. } => arc(span)?,
        _ => return None,
    };
    unitary(found)
}

/// An arc in pieces of a quarter of a turn at most.
fn arc(span: &Span) -> Option<Spline<Mass<3>>> {
    let angle = (span.range[1] - span.range[0]).abs();
    let pieces = (angle / FRAC_PI_2 - SAME_TURN).ceil().max(1.0);
    let weight = libm::cos(0.5 * angle / pieces);
    let mut points = vec![];
    for k in 0..pieces as usize {
        let [from, to] = [k as f64 / pieces, (k as f64 + 1.0) / pieces].map(|share| span.derivatives(share));
        // Where the tangents meet: half the chord divided by the cosine of half the angle, along the first one.
        let (way, _) = unit(from[1])?;
        let reach = 0.5 * norm(minus(to[0], from[0])) / weight;
        if k == 0 {
            points.push(Mass::new(from[0], 1.0));
        }
        points.push(Mass::new(plus(from[0], times(reach, way)), weight));
        points.push(Mass::new(to[0], 1.0));
    }
    let inner: Vec<f64> = (1..pieces as usize).flat_map(|k| [k as f64 / pieces; 2]).collect();
    Spline::new(Knots::clamped(2, 0.0, &inner, 1.0).ok()?, points).ok()
}

/// The same spline over 0 to 1.
fn unitary(spline: Spline<Mass<3>>) -> Option<Spline<Mass<3>>> {
    let (from, to) = spline.domain();
    let value = |t: &f64| match *t {
        t if t == from => 0.0,
        t if t == to => 1.0,
        t => (t - from) / (to - from),
    };
    let knots =
        Knots::new(spline.knots().degree(), spline.knots().values().iter().map(value).collect()).ok()?;
    Spline::new(knots, spline.points().to_vec()).ok()
}

/// Both splines with the same degree and knots.
fn alike(mut first: Spline<Mass<3>>, mut second: Spline<Mass<3>>) -> Option<[Spline<Mass<3>>; 2]> {
    while first.knots().degree() < second.knots().degree() {
        first = first.elevated();
    }
    while second.knots().degree() < first.knots().degree() {
        second = second.elevated();
    }
    for pass in 0..2 {
        let (from, into) = if pass == 0 { (&first, &mut second) } else { (&second, &mut first) };
        for knot in from.knots().distinct() {
            while into.knots().multiplicity(knot) < from.knots().multiplicity(knot) {
                *into = into.insert(knot).ok()?;
            }
        }
    }
    (first.points().len() == second.points().len()).then_some([first, second])
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_cad::frame::Frame;

    #[test]
    fn an_arc_becomes_the_same_arc() {
        let frame = Frame::new([1.0, 2.0, 3.0], [0.3, -0.2, 1.0], None).unwrap();
        for range in [[0.2, 0.9], [1.0, 5.0], [0.5, 0.5 + std::f64::consts::TAU]] {
            let span = Span { curve: Curve::Circle { frame, radius: 2.5 }, range };
            let spline = masses(&span).unwrap();
            for k in 0..=10 {
                let p = spline.at(k as f64 / 10.0).place().unwrap();
                let [x, y, z] = frame.local(p);
                assert!((x.hypot(y) - 2.5).abs() < 1e-14 && z.abs() < 1e-14, "{range:?}");
            }
            for (share, end) in [(0.0, range[0]), (1.0, range[1])] {
                let p = spline.at(share).place().unwrap();
                assert!(norm(minus(p, span.curve.at(end))) < 1e-14);
            }
        }
    }
}
