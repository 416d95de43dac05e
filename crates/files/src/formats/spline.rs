//! Surfaces and curves from the numbers of a file.

use crate::error::Fault;
use trueness_geom::spline::basis::{KnotError, Knots};
use trueness_geom::spline::rational::Rational;
use trueness_geom::spline::surface::Nurbs;

/// The numbers of a B-spline in a file, millimeters. `degree`, `knots` and `counts` have one entry for each parameter. Control points lie
/// row after row, those of the first knot of the first parameter first.
#[derive(Default)]
pub(crate) struct Raw {
    pub degree: Vec<usize>,
    pub knots: Vec<Vec<f64>>,
    pub counts: Vec<usize>,
    pub points: Vec<[f64; 3]>,
    pub weights: Vec<f64>,
}

/// Splines are read up to this degree. Beyond it, sums of the basis functions lose their digits.
const MAX_READ_DEGREE: usize = 25;

/// The surface of two parameters.
pub(crate) fn surface(raw: Raw) -> Result<Nurbs, Fault> {
    let (knots, points) = parts(raw, 2)?;
    let mut knots = knots.into_iter();
    match (knots.next(), knots.next()) {
        (Some(u), Some(v)) => Nurbs::weighted([u, v], &points).map_err(fault),
        _ => Err(Fault::unexpected("two parameters of a surface", b"")),
    }
}

/// The curve of one parameter.
pub(crate) fn curve(raw: Raw) -> Result<Rational<3>, Fault> {
    let (knots, points) = parts(raw, 1)?;
    if let Some(index) = points.iter().position(|(_, w)| w.is_nan() || *w <= 0.0) {
        return Err(fault(KnotError::Weight { index, value: points[index].1 }));
    }
    match knots.into_iter().next() {
        Some(knots) => Rational::new(knots, &points).map_err(fault),
        None => Err(Fault::unexpected("the parameter of a curve", b"")),
    }
}

/// The curve of one parameter, without weights where they are all alike.
pub(crate) fn cad_curve(raw: Raw) -> Result<trueness_cad::curve::Curve, Fault> {
    use trueness_cad::curve::Curve;
    let plain = raw.weights.windows(2).all(|w| w[0] == w[1]);
    let rational = curve(raw)?;
    if !plain {
        return Ok(Curve::Rational(rational));
    }
    // All weights are alike: moments are places times that weight.
    let masses = rational.masses();
    let points = masses.points().iter().map(|m| m.moment.map(|x| x / m.mass)).collect();
    let plain = trueness_geom::spline::curve::Curve::new(masses.knots().clone(), points);
    plain.map(Curve::Spline).map_err(fault)
}

/// Checked knots, and points with their weights.
type KnotsAndPoints = (Vec<Knots>, Vec<([f64; 3], f64)>);

fn parts(raw: Raw, parameters: usize) -> Result<KnotsAndPoints, Fault> {
    if raw.points.is_empty() || raw.counts.len() != parameters {
        return Err(Fault::unexpected("control points in space", b""));
    }
    if raw.weights.len() != raw.points.len() {
        let what = format!("{} weights for {} control points", raw.weights.len(), raw.points.len());
        return Err(Fault::unexpected("a weight for each control point", what.as_bytes()));
    }
    if let Some(number) = raw.points.iter().position(|p| p.iter().any(|x| !x.is_finite())) {
        return Err(Fault::NotFinite { what: "point", number: number as u64 + 1 });
    }
    let mut knots = vec![];
    for (degree, values) in raw.degree.into_iter().zip(raw.knots) {
        if !(1..=MAX_READ_DEGREE).contains(&degree) {
            let what = format!("a B-spline of degree {degree} is not read, only of 1 to {MAX_READ_DEGREE}");
            return Err(Fault::Unsupported { what, remedy: "export it in another way" });
        }
        knots.push(Knots::new(degree, values).map_err(fault)?);
    }
    Ok((knots, raw.points.into_iter().zip(raw.weights).collect()))
}

fn fault(e: KnotError) -> Fault {
    Fault::Unsupported { what: format!("this is no B-spline ({e})"), remedy: "export the file again" }
}
