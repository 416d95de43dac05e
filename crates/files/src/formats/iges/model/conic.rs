//! Conics (104): all places of a plane with `A x² + B xy + C y² + D x + E y + F = 0`, from one place to another.

use super::super::record::Record;
use super::geometry::Geometry;
use crate::formats::brep::Wrong;
use crate::formats::brep::span::{MAX_GAP, between};
use trueness_cad::curve::{Curve, Span};
use trueness_cad::frame::Frame;
use trueness_geom::space::{Aabb, Point};

/// Ratio of the lesser to the greater curvature of the quadratic form below which it is a parabola's: the digits of a file.
const FLAT_FORM: f64 = 1e-9;

/// The conic of an entity.
pub(super) fn conic(geometry: &Geometry, record: &Record) -> Result<Span, Wrong> {
    let n = record.reals(0, 11)?;
    let form = [n[0], n[1], n[2], n[3], n[4], n[5]];
    let height = n[6];
    let ends = [[n[7], n[8]], [n[9], n[10]]];
    let wrong = || record.wrong("has coefficients that are of no ellipse, hyperbola or parabola");
    let curve = in_plane(form, height, ends[0], geometry.unit).ok_or_else(wrong)?;
    let places = ends.map(|[x, y]| [x, y, height].map(|x| x * geometry.unit));
    let closed = ends[0] == ends[1];
    let (span, off) = between(curve, places, true, closed, geometry.tolerance);
    let size = Aabb::of(&[0.0, 0.3, 0.7, 1.0].map(|share| span.derivatives(share)[0])).diagonal();
    match off <= geometry.tolerance.max(MAX_GAP * size) {
        true => Ok(span),
        false => Err(record.wrong(format!("has an end that lies {off:.3e} mm off its curve"))),
    }
}

/// The curve through `start` at this height; one unit is `unit` millimeters.
fn in_plane([a, b, c, d, e, f]: [f64; 6], height: f64, start: [f64; 2], unit: f64) -> Option<Curve> {
    // Axes of the quadratic form, that of the greater curvature second.
    let half = 0.5 * libm::atan2(b, a - c);
    let (cos, sin) = (libm::cos(half), libm::sin(half));
    let along = |[x, y]: [f64; 2]| a * x * x + b * x * y + c * y * y;
    let mut axes = [[cos, sin], [-sin, cos]];
    if along(axes[0]).abs() > along(axes[1]).abs() {
        axes = [axes[1], [-axes[0][0], -axes[0][1]]];
    }
    let [p, q] = axes.map(along);
    let [r, s] = axes.map(|[x, y]| d * x + e * y);
    if q == 0.0 || !q.is_finite() {
        return None;
    }
    let frame = |[u, v]: [f64; 2], x: [f64; 2], sense: f64| {
        let origin: Point = [u * axes[0][0] + v * axes[1][0], u * axes[0][1] + v * axes[1][1], height];
        let x = [sense * x[0], sense * x[1], 0.0];
        Frame::new(origin.map(|x| x * unit), [0.0, 0.0, 1.0], Some(x))
    };
    if p.abs() <= FLAT_FORM * q.abs() {
        // q v² + r u + s v + f = 0.
        let v = -s / (2.0 * q);
        let u = (s * s / (4.0 * q) - f) / r;
        let focal = -r / (4.0 * q);
        let frame = frame([u, v], axes[0], focal.signum())?;
        return (focal != 0.0 && u.is_finite())
            .then_some(Curve::Parabola { frame, focal: focal.abs() * unit });
    }
    let center = [-r / (2.0 * p), -s / (2.0 * q)];
    let rest = f - p * center[0] * center[0] - q * center[1] * center[1];
    let [squared_u, squared_v] = [-rest / p, -rest / q];
    let radii = [squared_u.abs(), squared_v.abs()].map(|r| r.sqrt() * unit);
    if !radii.iter().all(|r| *r > 0.0 && r.is_finite()) {
        return None;
    }
    if squared_u > 0.0 && squared_v > 0.0 {
        return Some(Curve::Ellipse { frame: frame(center, axes[0], 1.0)?, radii });
    }
    // The branch on which it begins.
    let (k, radii) = match squared_u > 0.0 {
        true => (0, radii),
        false if squared_v > 0.0 => (1, [radii[1], radii[0]]),
        false => return None,
    };
    let side = start[0] * axes[k][0] + start[1] * axes[k][1] - center[k];
    Some(Curve::Hyperbola { frame: frame(center, axes[k], side.signum())?, radii })
}
